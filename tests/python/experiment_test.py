"""Experiments driven from Python: the bytes of the program, views without copies, changes on the way, exceptions."""
import json
import signal
import unittest

import numpy

from folders import CRUSHED, SMALL, SOURCE, InFolder, bytes_in, differing, entries, run_app

import platen


class Bytes(InFolder):
    def test_a_run_from_python_writes_what_the_program_writes(self):
        done = run_app("platen-compress", CRUSHED, self.folder / "app", *entries(SMALL), "-t", "1")
        self.assertEqual(done.returncode, 0, done.stderr)
        experiment = self.experiment("python")
        while experiment.advance(samples=7):  # in pieces, looked at in between
            experiment.history, experiment.summary, experiment.spheres["force"].sum()
        run = experiment.end()
        app, python = bytes_in(self.folder / "app"), bytes_in(self.folder / "python")
        self.assertGreater(len(app), 10)
        self.assertEqual(sorted(app), sorted(python))
        self.assertEqual([name for name in app if app[name] != python[name]], [])
        told = json.loads((self.folder / "app" / "summary.json").read_text())
        for key in ("strength_pa", "broken_tension", "pattern", "steps", "energy_residual_relative", "scene_sha256"):
            self.assertEqual(run.summary.get(key), told.get(key), key)

    def test_two_threads_write_the_same(self):
        self.experiment("one").run()
        self.experiment("two", threads=2).run()
        self.assertEqual(differing(self.folder / "one", self.folder / "two"), [])


class Shipped(InFolder):
    def test_a_scene_includes_ready_materials_and_parts(self):
        for part in ("materials/concrete_c40.prm", "parts/concrete.prm"):
            scene = self.folder / "mine.prm"
            scene.write_text(f"include {part}\nsubsection Specimen\n  set Shape = cylinder\n  set Radius = 25 mm\n  set Height = 50 mm\n"
                             "  set Sphere radius = 3 mm\nend\nsubsection Loading\n  set Axial rate = 0.1 m/s\n  set Target strain = 0.001\nend\n")
            experiment = platen.Experiment(scene, output=self.folder / part)
            self.assertGreater(len(experiment.spheres["id"]), 100)

    def test_all_scenes_that_came_with_it_are_there(self):
        shipped = {path.stem for path in (SOURCE / "scenes").glob("*.prm")}
        self.assertGreater(len(shipped), 50)
        self.assertEqual(set(platen.scenes()), shipped)


class Looking(InFolder):
    def test_the_history_is_that_of_the_file_to_the_bit(self):
        experiment = self.experiment()
        experiment.advance(samples=20)
        table = platen.read_table(self.folder / "run" / "history.csv")
        history = experiment.history
        self.assertEqual(list(history), list(table))
        self.assertEqual(history.rows, table.rows)
        self.assertGreaterEqual(table.rows, 20)
        for name in table:
            self.assertEqual(history[name].tobytes(), table[name].astype(float).tobytes(), name)

    def test_columns_are_views_that_are_only_read(self):
        experiment = self.experiment()
        position = experiment.spheres["position"]
        before = position.copy()
        self.assertFalse(position.flags.owndata)
        self.assertEqual(position.shape, (len(experiment.spheres["id"]), 3))
        self.assertEqual(position.ctypes.data, experiment.spheres["position"].ctypes.data)
        experiment.advance(steps=200)
        self.assertGreater(numpy.abs(position - before).max(), 1e-7, "the view must follow the spheres")
        self.assertEqual(position.ctypes.data, experiment.spheres["position"].ctypes.data)
        with self.assertRaises(ValueError):
            position[0, 0] = 0
        state = experiment.bonds["state"]
        self.assertFalse(state.flags.owndata)
        self.assertEqual(experiment.units["position"], "m")
        self.assertEqual(experiment.units["break_time"], "s")

    def test_a_view_outlives_its_experiment(self):
        position = self.experiment().spheres["position"]
        self.assertTrue(numpy.isfinite(position).all())

    def test_broken_bonds_agree_with_the_history(self):
        experiment = self.experiment()
        run = experiment.run()
        state = experiment.bonds["state"]
        self.assertGreater(run.summary["broken_tension"], 10)
        self.assertEqual(int((state == 2).sum()), run.summary["broken_tension"])
        self.assertEqual(int((state == 3).sum()), run.summary["broken_shear"])
        times = experiment.bonds["break_time"]
        self.assertEqual(int(numpy.isnan(times).sum()), int((state < 2).sum()))

    def test_the_mass_times_velocity_is_the_kinetic_energy_of_the_history(self):
        experiment = self.experiment(more={"Effects/Rotation": False, "Output/Every": 10})
        experiment.advance(samples=5)
        spheres = experiment.spheres
        kinetic = 0.5 * (spheres["mass"] * (spheres["velocity"] ** 2).sum(axis=1)).sum()
        # Between two steps velocities are those of the last full or half step: within their change in one step.
        self.assertAlmostEqual(kinetic / experiment.history["kinetic_energy_j"][-1], 1, delta=0.05)


class Advancing(InFolder):
    def test_each_limit_is_met_within_a_pass(self):
        experiment = self.experiment()
        self.assertTrue(experiment.advance(steps=100))
        self.assertTrue(100 <= experiment.steps <= 116, experiment.steps)
        self.assertTrue(experiment.advance(strain=0.001))
        self.assertTrue(0.001 <= experiment.strain <= 0.0011, experiment.strain)
        time = experiment.time + 50 * experiment.time_step
        self.assertTrue(experiment.advance(time=time))
        self.assertTrue(time <= experiment.time <= time + 17 * experiment.time_step)
        rows = experiment.history.rows
        experiment.advance(samples=2)
        self.assertEqual(experiment.history.rows, rows + 2)
        self.assertFalse(experiment.advance(strain=1))
        self.assertTrue(experiment.finished)

    def test_a_callback_sees_each_row(self):
        experiment = self.experiment()
        rows = []
        experiment.on_sample = rows.append
        first = experiment.history.rows
        run = experiment.run()
        self.assertEqual(len(rows), run.history.rows - first)
        for name, column in run.history.items():
            seen = numpy.array([row[name] for row in rows])
            self.assertEqual(seen.tobytes(), column[first:].astype(float).tobytes(), name)

    def test_what_a_callback_raises_comes_out(self):
        experiment = self.experiment()

        def stop(row):
            raise KeyError("enough")

        experiment.on_sample = stop
        with self.assertRaises(KeyError):
            experiment.run()
        experiment.on_sample = None
        self.assertTrue(experiment.advance(samples=1), "it can go on")

    def test_control_c_interrupts_and_can_be_gone_on_from(self):
        experiment = self.experiment()
        signal.signal(signal.SIGINT, signal.default_int_handler)  # whatever started the tests may have it ignored
        experiment.on_sample = lambda row: signal.raise_signal(signal.SIGINT)
        with self.assertRaises(KeyboardInterrupt):
            experiment.run()
        experiment.on_sample = None
        self.assertGreater(experiment.run().summary["strength_pa"], 1e6)


class Changing(InFolder):
    def test_friction_changes_what_the_ends_do(self):
        rough = self.experiment("rough")
        changed = self.experiment("changed")
        for experiment in (rough, changed):
            experiment.advance(strain=0.001)
        changed.change({"Platens/Friction static": 0.01, "Platens/Friction dynamic": 0.01})
        work = changed.history["friction_work_j"][-1]
        for experiment in (rough, changed):
            experiment.advance(strain=0.002)

        def sliding(experiment):
            contacts = experiment.end().contacts[-1]
            shear = numpy.linalg.norm(contacts.point_data["shear_force"].reshape(len(contacts.points), -1), axis=1)
            return (shear / contacts.point_data["normal_force"]).max()

        self.assertGreater(sliding(rough), 0.1)
        self.assertLessEqual(sliding(changed), 0.01 * (1 + 1e-9))
        changes = changed.summary["changes"]
        self.assertEqual([change["entry"] for change in changes], ["Platens/Friction static", "Platens/Friction dynamic"])
        self.assertEqual((changes[0]["was"], changes[0]["now"]), ("0.3", "0.01"))
        self.assertIn("Platens/Friction static = 0.01, was 0.3", (self.folder / "changed" / "run.log").read_text())
        self.assertGreaterEqual(changed.history["friction_work_j"][-1], work)

    def test_half_the_rate_closes_half_as_fast(self):
        experiment = self.experiment(more={"Loading/Stop at residual": 0})
        experiment.advance(strain=0.001)

        def speed():
            strain, time = experiment.strain, experiment.time
            experiment.advance(steps=64)
            return (experiment.strain - strain) / (experiment.time - time)

        before = speed()
        experiment.change({"Loading/Axial rate": "0.3 m/s"})
        experiment.advance(strain=experiment.strain + 3e-3)  # the ramp between the two
        self.assertAlmostEqual(speed() / before, 0.5, delta=0.01)

    def test_what_cannot_change_is_refused_and_changes_nothing(self):
        experiment = self.experiment()
        experiment.advance(samples=3)
        for entry, value in (("Bond/Modulus", "30 GPa"), ("Specimen/Height", "30 mm"), ("Loading/Target strain", 0.01)):
            with self.assertRaises(platen.InputError) as caught:
                experiment.change({entry: value, "Platens/Friction static": 0.2})
            self.assertIn(entry, str(caught.exception))
        self.assertNotIn("changes", experiment.summary)

    def test_what_is_refused_in_part_leaves_the_bytes_of_an_unchanged_run(self):
        # One platen has no springs for friction; the other one, grains and the rate could be changed.
        for smooth, rough in (("Bottom", "Top"), ("Top", "Bottom")):
            values = {f"Platens/{smooth}/Friction static": 0, f"Platens/{smooth}/Friction dynamic": 0}
            self.experiment(f"whole {smooth}", values).run()
            experiment = self.experiment(f"run {smooth}", values)
            experiment.advance(samples=5)
            with self.assertRaisesRegex(platen.InputError, "without friction"):
                experiment.change({"Loading/Axial rate": "0.3 m/s", "Contact/Friction": 0.1,
                                   **{f"Platens/{side}/Friction {kind}": 0.05 for side in (smooth, rough) for kind in ("static", "dynamic")}})
            self.assertNotIn("changes", experiment.summary)
            experiment.run()
            self.assertEqual(differing(self.folder / f"whole {smooth}", self.folder / f"run {smooth}"), [], smooth)

    def test_a_surface_without_friction_gets_none(self):
        experiment = self.experiment(more={"Platens/Friction static": 0, "Platens/Friction dynamic": 0})
        experiment.advance(samples=3)
        with self.assertRaisesRegex(platen.InputError, "without friction"):
            experiment.change({"Platens/Friction static": 0.2})

    def test_a_changed_run_is_not_resumed_by_the_program(self):
        values = dict(SMALL, **{"Checkpoint/Every": 50})
        experiment = self.experiment(more=values)
        experiment.advance(strain=0.001)
        experiment.change({"Platens/Friction static": 0.2, "Platens/Friction dynamic": 0.1})
        experiment.advance(steps=200)
        experiment.close()
        done = run_app("platen-compress", CRUSHED, self.folder / "run", *entries(values), "--resume")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("changed on its way by a script", done.stderr)


class Closing(InFolder):
    def test_an_early_end_says_so_and_judges_nothing(self):
        expecting = {"Expect/strength_pa": "1 MPa ... 2 MPa"}
        early = self.experiment("early", expecting)
        early.advance(samples=3)
        self.assertEqual(early.end().summary["ended_by"], "script")
        self.assertIsNone(early.expected)
        (unchecked,) = early.summary["expectations"]
        self.assertEqual((unchecked["entry"], unchecked["value"], unchecked["met"]), ("Expect/strength_pa", None, None))
        log = (self.folder / "early" / "run.log").read_text()
        self.assertNotIn("expected:", log)
        self.assertIn("ended before its target: what the scene expects is not checked", log)
        whole = self.experiment("whole", expecting)
        self.assertEqual(whole.run().summary["ended_by"], "target")
        self.assertIs(whole.expected, False)
        self.assertIs(platen.Run(whole.folder).summary["expectations"][0]["met"], False)
        self.assertIs(whole.summary["expectations"][0]["met"], False)
        self.assertIn("error: expected: ", (self.folder / "whole" / "run.log").read_text())

    def test_a_folder_is_free_again_after_the_end(self):
        first = self.experiment()
        first.advance(samples=2)
        with self.assertRaisesRegex(platen.PlatenError, "at work"):
            self.experiment("run", overwrite=True)
        first.end()
        second = self.experiment("run", overwrite=True)
        second.close()
        with self.experiment("run", overwrite=True) as third:
            third.advance(samples=2)
        for over in (first, second, third):
            with self.assertRaises(platen.PlatenError):
                over.advance(samples=1)
            self.assertTrue(numpy.isfinite(over.spheres["position"]).all(), "what it computed is still there")

    def test_a_closed_run_is_resumed_by_the_program_to_the_same_bytes(self):
        values = dict(SMALL, **{"Checkpoint/Every": 50})
        whole = run_app("platen-compress", CRUSHED, self.folder / "whole", *entries(values))
        self.assertEqual(whole.returncode, 0, whole.stderr)
        with self.experiment(more=values) as experiment:
            experiment.advance(strain=0.002)
        done = run_app("platen-compress", CRUSHED, self.folder / "run", *entries(values), "--resume")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(differing(self.folder / "whole", self.folder / "run"), [])


class BadInput(InFolder):
    def test_what_is_refused_is_told_with_its_entry_and_place_and_nothing_is_written(self):
        scene = self.folder / "mine.prm"
        scene.write_text(f"include {CRUSHED}\nsubsection Bond\n  set Gap = -3\nend\n")
        for options, said, reason in (
                ({"set": {"Platens/Friction static": 300}}, {"entry": "Platens/Friction static", "file": "command line, --set 1"}, "Allowed: 0 ... 5"),
                ({"set": {"Bond/Modulu": 1}}, {"entry": "Bond/Modulus"}, "Did you mean"),
                ({"set": {"Specimen/Radius": "3 MPa"}}, {"entry": "Specimen/Radius"}, ""), ({"scene": "no such scene.prm"}, {}, "no such scene.prm"),
                ({"scene": scene}, {"entry": "Bond/Gap", "file": str(scene), "line": 3}, ""), ({"set": {"Specimen/Height": "200 m"}}, {}, ""),
                ({"set": {**SMALL, "Integration/Time step": "1 s"}}, {}, ""),
                *(({"threads": threads}, {}, "") for threads in (0, -1, 100000, 1.5, True))):
            with self.assertRaises(platen.InputError, msg=options) as caught:
                platen.Experiment(**{"scene": CRUSHED, "output": self.folder / "run", **options})
            self.assertEqual({name: getattr(caught.exception, name) for name in said}, said)
            self.assertIn(reason, caught.exception.reason if said else str(caught.exception))
            self.assertFalse((self.folder / "run" / "history.csv").exists())

    def test_a_folder_that_holds_a_run(self):
        self.experiment("held").end()
        before = bytes_in(self.folder / "held")
        with self.assertRaises((platen.InputError, platen.OutputError)):
            self.experiment("held")
        self.assertTrue(before == bytes_in(self.folder / "held"), "the earlier run is as it was")

    def test_numerics_that_stop(self):
        # Contacts by Hertz' law grow stiffer as they close, and a step that is given stays.
        values = {"Effects/Contact": "hertz", "Material/Young modulus": "100 GPa", "Integration/Time step": "0.1 us", "Checkpoint/Every": 0}
        experiment = platen.Experiment(CRUSHED, set=values, output=self.folder / "run")
        with self.assertRaisesRegex(platen.NumericsError, "is above the stability limit of"):
            experiment.run()
        self.assertEqual(platen.Run(self.folder / "run").summary["status"], "failed")
        with self.assertRaises(platen.InputError):
            experiment.run()

    def test_every_error_of_platen_is_one_class(self):
        for error in (platen.InputError, platen.NumericsError, platen.OutputError):
            self.assertTrue(issubclass(error, platen.PlatenError))


if __name__ == "__main__":
    unittest.main()
