"""Sweeps: each value with each of the others on each packing, rows for a table, what is refused, a sweep that is stopped and resumed."""
import os
import shutil
import signal
import subprocess
import sys
import threading
import time
import unittest

import numpy

from folders import BUILD, CRUSHED, SMALL, InFolder, run_app

import platen

FRICTION, ROTATION = "Platens/Friction static", "Effects/Rotation"


class OfSweeps(InFolder):
    def sweep(self, vary, name="study", **options):
        return platen.Sweep(CRUSHED, vary, **{"set": SMALL, "output": self.folder / name, **options})

    def refused(self, vary, error=platen.InputError, **options):
        with self.assertRaises(error) as caught:
            self.sweep(vary, **options).run()
        self.assertFalse((self.folder / "study").exists())
        return caught.exception


class Runs(OfSweeps):
    def test_each_value_of_an_entry_runs_with_each_of_the_other_on_each_packing(self):
        study = self.sweep({FRICTION: numpy.array([0.2, 0.3]), ROTATION: [True, False]}, packings=2, threads=1).run()
        self.assertIsInstance(study, platen.Study)
        self.assertEqual([(row["friction_static"], row["rotation"], row["seed"]) for row in study.rows],
                         [(mu, on, seed) for mu in (0.2, 0.3) for on in ("on", "off") for seed in (3, 4)])
        self.assertEqual({type(row["strength_pa"]) for row in study.rows}, {float})
        self.assertEqual({row["status"] for row in study.rows}, {"done"})
        run = study.runs["friction_static_0.3_rotation_on_seed_4"]
        self.assertEqual(run.summary["strength_pa"], study.rows[5]["strength_pa"])
        alone = run_app("platen-compress", CRUSHED, self.folder / "alone", "-s", f"{FRICTION} = 0.3", "-s", "Scene/Seed = 4",
                        *(word for entry, value in SMALL.items() for word in ("-s", f"{entry} = {value}")))
        self.assertEqual(alone.returncode, 0, alone.stderr)
        self.assertEqual(platen.Run(self.folder / "alone").summary["strength_pa"], study.rows[5]["strength_pa"])

    def test_lists_of_the_scene_are_replaced_and_what_the_scene_expects_ends_no_sweep(self):
        scene = self.folder / "mine.prm"
        scene.write_text(f"include {CRUSHED}\nsubsection Study\n  set Vary 2 = {ROTATION}: on, off\n  set Seeds = 1\nend\n")
        vary, expected = {"Specimen/Height": ["15 mm", 0.016]}, dict(SMALL, **{"Loading/Target strain": 1e-3, "Expect/strength_pa": "... 1 Pa"})
        study = platen.Sweep(scene, vary, set=expected, output=self.folder / "study").run()
        self.assertEqual([row["height_m"] for row in study.rows], [0.015, 0.016])
        self.assertNotIn("rotation", study.rows[0])

    def test_control_c_stops_all_runs_and_a_resumed_sweep_is_that_of_one_call(self):
        vary, values = {FRICTION: [0.2, 0.3]}, dict(SMALL, **{"Specimen/Sphere radius": "0.85 mm", "Checkpoint/Every": 50})
        stopped = self.sweep(vary, packings=1, set=values)
        signal.signal(signal.SIGINT, signal.default_int_handler)  # whatever started the tests may have it ignored

        def interrupt():
            while not list(self.folder.glob("study/runs/*/history.csv")):
                time.sleep(0.01)
            os.kill(os.getpid(), signal.SIGINT)

        thread = threading.Thread(target=interrupt)
        thread.start()
        with self.assertRaises(KeyboardInterrupt):
            stopped.run()
        thread.join()
        self.assertIn("stopped by a signal", (stopped.folder / "run.log").read_text())
        with self.assertRaisesRegex(platen.InputError, "holds an earlier run"):
            stopped.run()
        rows = stopped.run(resume=True).rows
        whole = self.sweep(vary, "whole", packings=1, set=values).run()
        self.assertEqual(str(rows), str(whole.rows))  # nan is nan
        self.assertEqual(len(stopped.run(overwrite=True).rows), 2)


class Refused(OfSweeps):
    def test_a_sweep_over_nothing_or_too_much(self):
        for vary in ({}, None, [FRICTION], {f"Bond/{k}": [1] for k in range(5)}):
            self.assertIn("Allowed: a dictionary of one to 4", str(self.refused(vary)))
        for values in (0.3, "0.2, 0.3", [[1, 2], [3, 4]], ["1, 2"], [None]):
            self.assertEqual(self.refused({FRICTION: values}).entry, FRICTION, values)
        for options in ({"packings": 0}, {"packings": 1.5}, {"threads": 0}):
            self.refused({FRICTION: [0.3]}, **options)
        with self.assertRaisesRegex(platen.InputError, "resume = 1"):
            self.sweep({FRICTION: [0.3]}).run(resume=1)

    def test_what_the_program_refuses_is_an_input_error_with_its_entry_and_place(self):
        error = self.refused({FRICTION: [0.3, 300]})
        self.assertEqual(error.entry, FRICTION)
        self.assertIn("Allowed: 0 ... 5", error.reason)
        error = self.refused({FRICTION: [0.1]})  # below the dynamic friction of the scene
        self.assertEqual((error.entry, error.file, error.line), ("Platens/Friction dynamic", str(CRUSHED), 42))
        self.assertEqual(self.refused({"Platens/Frction static": [0.3]}).entry, "Study/Vary 1")
        with self.assertRaisesRegex(platen.InputError, "no scene of this name"):
            platen.Sweep("no such scene", {FRICTION: [0.3]})

    def test_runs_that_all_stop_are_a_numerics_error_and_one_that_stops_is_a_row(self):
        values = dict(SMALL, **{"Effects/Contact": "hertz", "Material/Young modulus": "100 GPa", "Checkpoint/Every": 0})
        with self.assertRaises(platen.NumericsError):
            self.sweep({"Integration/Time step": ["0.2 us"]}, packings=1, set=values).run()
        rows = self.sweep({"Integration/Time step": ["0.2 us", 1e-7]}, "two", packings=1, set=values).run().rows
        self.assertEqual([row["status"] for row in rows], ["failed", "done"])

    def test_a_folder_that_cannot_be_written(self):
        (self.folder / "study").write_text("")
        with self.assertRaises(platen.PlatenError):
            self.sweep({FRICTION: [0.3]}).run()

    def test_a_program_that_is_not_there_is_named(self):
        """The package alone, without its compiled module: PATH has the programs, or has them not."""
        shutil.copytree(BUILD / "python" / "platen", self.folder / "lib" / "platen", ignore=shutil.ignore_patterns("_core*"))
        script = f"import platen; print(platen.Sweep({str(CRUSHED)!r}, {{{FRICTION!r}: [0.2]}}, 1, {SMALL!r}, 'made').run().rows[0]['status'])"
        for path, said in (("", "PlatenError: platen-study is not found"), (str(BUILD / "apps"), "done")):
            called = subprocess.run([sys.executable, "-c", script], cwd=self.folder, capture_output=True, text=True, check=False,
                                    env={**os.environ, "PYTHONPATH": str(self.folder / "lib"), "PATH": path})
            self.assertIn(said, called.stdout + called.stderr)


if __name__ == "__main__":
    unittest.main()
