"""What a script does wrong, or from two threads at once: each is told as a PlatenError, or waits for its turn."""
import math
import os
import threading
import unittest
from pathlib import Path

import numpy

from folders import CRUSHED, SMALL, InFolder, differing

import platen
from platen import _core, vtu

NO_NUMBERS = ("a", math.nan, math.inf, -math.inf, True, [1], 1j, b"1")
NO_PATHS = (None, 5, 1.5, True, [], "a\0b", "half \ud800")


def in_threads(*acts):
    """Each act in a thread of its own, at the same time; what they raised."""
    raised = []

    def call(act):
        try:
            act()
        except BaseException as error:
            raised.append(error)

    threads = [threading.Thread(target=call, args=(act,)) for act in acts]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return raised


class Threads(InFolder):
    def test_two_threads_that_advance_one_experiment_write_what_one_writes(self):
        self.experiment("one").run()
        experiment = self.experiment("two")

        def advance():
            while experiment.advance(samples=1):
                pass

        self.assertEqual(in_threads(advance, advance, advance), [])
        self.assertTrue(experiment.finished)
        experiment.end()
        self.assertEqual(differing(self.folder / "one", self.folder / "two"), [])

    def test_what_another_thread_looks_at_is_whole(self):
        experiment = self.experiment()
        experiment.on_sample = lambda row: experiment.history  # and the thread that computes looks, too
        seen = []
        looked = threading.Event()

        def run():
            while experiment.advance(samples=1):
                if len(set(seen)) <= 5:  # a slow machine may let the others look at the end alone
                    looked.clear()
                    looked.wait(timeout=5)
            experiment.end()

        def look():
            while not experiment.finished:
                history = experiment.history
                seen.append(history.rows)
                looked.set()
                self.assertEqual({len(column) for column in history.values()}, {history.rows})
                self.assertTrue(numpy.isfinite(history["time_s"]).all())
                self.assertTrue((numpy.diff(history["time_s"]) > 0).all())
                experiment.summary, experiment.stress, experiment.strain, experiment.spheres, experiment.bonds, experiment.units

        self.assertEqual(in_threads(run, look, look), [])
        self.assertGreater(len(set(seen)), 5, "it looked while rows were added")

    def test_two_threads_that_end_it_are_told_the_same(self):
        experiment = self.experiment(more={"Expect/strength_pa": "1 MPa ... 2 MPa"})
        while experiment.advance(samples=50):
            pass
        self.assertEqual(in_threads(experiment.end, experiment.end, experiment.end), [])
        self.assertIs(experiment.expected, False)
        self.assertEqual(experiment.end().summary["status"], "done")

    def test_one_that_another_thread_has_ended_or_closed_is_refused(self):
        for act in ("end", "close"):
            experiment = self.experiment(act)
            begun = threading.Event()
            experiment.on_sample = lambda row: begun.set()

            def stop():
                begun.wait()
                getattr(experiment, act)()

            raised = in_threads(lambda: experiment.advance(strain=1), stop)
            self.assertEqual([type(error) for error in raised], [platen.InputError] if not experiment.finished else [])

    def test_what_a_callback_raises_comes_out_where_it_was_called(self):
        experiment = self.experiment()

        def stop(row):
            raise KeyError(threading.get_ident())

        experiment.on_sample = stop
        raised = {}

        def advance():
            try:
                experiment.advance(samples=1)
            except KeyError as error:
                raised[threading.get_ident()] = error.args[0]

        self.assertEqual(in_threads(advance, advance), [])
        self.assertTrue(raised)
        self.assertEqual(list(raised), list(raised.values()))
        experiment.on_sample = None
        self.assertTrue(experiment.advance(samples=1), "it can go on")

    def test_a_callback_cannot_advance_or_end_what_calls_it(self):
        experiment = self.experiment()
        for act in (lambda: experiment.advance(steps=1), experiment.run, experiment.end, experiment.close):
            experiment.on_sample = lambda row: act()
            with self.assertRaisesRegex(platen.InputError, "called from on_sample"):
                experiment.advance(samples=1)
        experiment.on_sample = None
        experiment.run()
        self.experiment("whole").run()
        self.assertEqual(differing(self.folder / "whole", self.folder / "run"), [])

    def test_a_callback_may_take_itself_away(self):
        experiment = self.experiment()
        rows = []

        def once(row):
            experiment.on_sample = None
            rows.append(row)

        experiment.on_sample = once
        experiment.advance(samples=3)
        self.assertEqual(len(rows), 1)


class Arguments(InFolder):
    def setUp(self):
        super().setUp()
        self.made = self.experiment()
        self.addCleanup(self.made.close)

    def test_limits_that_are_none(self):
        with self.assertRaisesRegex(platen.InputError, "needs a limit"):
            self.made.advance()
        for limit in ("strain", "time", "steps", "samples"):
            wrong = [*NO_NUMBERS, -1, -1e-9]
            wrong += [1.0001, 2] if limit == "strain" else []
            wrong += [1.5, 0.0, numpy.float64(2)] if limit in ("steps", "samples") else []
            for value in wrong:
                with self.assertRaisesRegex(platen.InputError, f"{limit} = .*Allowed", msg=repr(value)):
                    self.made.advance(**{limit: value})
        self.assertEqual(self.made.steps, 0)

    def test_limits_of_numpy_are_numbers(self):
        self.assertTrue(self.made.advance(steps=numpy.int64(16)))
        self.assertEqual(self.made.steps, 16)
        self.assertTrue(self.made.advance(steps=0, strain=numpy.float64(0.9)))
        self.assertEqual(self.made.steps, 16)
        self.assertTrue(self.made.advance(strain=numpy.float32(0.0)))

    def test_entries_and_values_that_are_none(self):
        for entries in ([1], 5, "Scene/Title", {1: 2}, {None: 1}):
            with self.assertRaisesRegex(platen.InputError, "no entries"):
                self.made.change(entries)
            with self.assertRaisesRegex(platen.InputError, "no entries"):
                platen.Experiment(CRUSHED, set=entries, output=self.folder / "none")
        for value in (None, {}, object(), 1j, b"1"):
            with self.assertRaises(platen.InputError) as caught:
                self.made.change({"Contact/Friction": value})
            self.assertEqual(caught.exception.entry, "Contact/Friction")
        for value in (math.nan, math.inf, "nan", [], "\udcff"):
            with self.assertRaises(platen.InputError):
                self.made.change({"Contact/Friction": value})
        self.assertNotIn("changes", self.made.summary)

    def test_half_a_character(self):
        for entries in ({"Scene/Title": "half \ud800"}, {"Scene/\ud800": 1}):
            with self.assertRaisesRegex(platen.InputError, "half of one"):
                platen.Experiment(CRUSHED, set=entries, output=self.folder / "none")

    def test_values_of_numpy_are_values(self):
        values = {"Contact/Friction": numpy.float64(0.25), "Effects/Rotation": numpy.bool_(True), "Output/Every": numpy.int64(30)}
        with self.experiment("numpy", values) as experiment:
            text = Path(experiment.folder, "scene.prm").read_text()
        self.assertRegex(text, r"set Every\s*= 30\n")

    def test_arguments_of_an_experiment(self):
        for name, values in {"scene": NO_PATHS, "output": NO_PATHS, "threads": (*NO_NUMBERS, 0, -1, 1.5, 100000, None),
                             "overwrite": ("no", 1, None), "disc": ("x", 0), "verbose": (1.5, None)}.items():
            for value in values:
                options = {"scene": CRUSHED, "set": SMALL, "output": self.folder / "none", name: value}
                with self.assertRaises(platen.PlatenError, msg=f"{name} = {value!r}"):
                    platen.Experiment(**options)
        self.assertFalse((self.folder / "none").exists())

    def test_an_experiment_without_a_scene(self):
        with self.assertRaisesRegex(platen.InputError, "needs a scene"):
            _core.Experiment.__new__(_core.Experiment)
        with self.assertRaisesRegex(platen.InputError, "needs a scene"):
            _core.Experiment()

        class Mine(_core.Experiment):
            pass

        with self.assertRaisesRegex(platen.InputError, "needs a scene"):
            Mine()
        with self.assertRaises(TypeError):
            object.__new__(_core.Experiment)
        empty = platen.Experiment.__new__(platen.Experiment)
        for name in ("steps", "history", "summary", "spheres", "finished", "folder"):
            with self.assertRaisesRegex(platen.InputError, "was not made"):
                getattr(empty, name)
        with self.assertRaisesRegex(platen.InputError, "was not made"):
            empty.run()

    def test_callbacks_that_are_none(self):
        for value in (5, "print", []):
            with self.assertRaisesRegex(platen.InputError, "on_sample"):
                self.made.on_sample = value
        self.assertIsNone(self.made.on_sample)

    def test_a_closed_experiment_is_looked_at_and_goes_on_nowhere(self):
        self.made.advance(samples=2)
        self.made.close()
        self.made.close()
        self.assertGreaterEqual(self.made.history.rows, 2)
        self.assertTrue(self.made.summary and self.made.units and repr(self.made))
        for act in (self.made.run, self.made.end, lambda: self.made.advance(steps=1),
                    lambda: self.made.change({"Contact/Friction": 0.1})):
            with self.assertRaises(platen.InputError):
                act()

    def test_a_folder_whose_name_is_no_text(self):
        name = os.fsdecode(os.fsencode(self.folder) + b"/\xff run")
        with platen.Experiment(CRUSHED, set=SMALL, output=name) as experiment:
            self.assertEqual(os.fsencode(experiment.folder), os.fsencode(name))
            self.assertTrue(experiment.folder.is_dir())


class Results(InFolder):
    def setUp(self):
        super().setUp()
        with self.experiment(more={"Loading/Target strain": 5e-4}) as experiment:
            self.run_ = experiment.run()

    def test_paths_that_are_none(self):
        for path in NO_PATHS:
            for reader in (platen.Run, platen.Study, platen.Frames, platen.read_table, platen.runs, vtu.read, vtu.read_pvd):
                with self.assertRaises(platen.InputError, msg=f"{reader} {path!r}"):
                    reader(path)
        for pattern in (None, 5, "", "/etc/*"):
            with self.assertRaises(platen.InputError, msg=repr(pattern)):
                platen.runs(self.folder, pattern)

    def test_frames_that_are_not_there(self):
        frames = self.run_.specimen
        self.assertGreater(len(frames), 1)
        for k in (len(frames), -len(frames) - 1, 10**20):
            for reader in (frames.__getitem__, frames.parts):
                with self.assertRaises(platen.MissingError):
                    reader(k)
        for k in ("a", 1.0, None, slice(0, 1), True):
            for reader in (frames.__getitem__, frames.parts):
                with self.assertRaises(platen.InputError):
                    reader(k)
        for time in NO_NUMBERS:
            with self.assertRaises(platen.InputError):
                frames.at(time)
        self.assertEqual(len(list(frames)), len(frames), "a loop over frames ends")
        self.assertEqual(len(frames[-1].points), len(frames[len(frames) - 1].points))

    def test_columns_that_are_not_there(self):
        with self.assertRaisesRegex(platen.MissingError, "time_s"):
            self.run_.history["time"]
        with self.assertRaises(KeyError):
            self.run_.history["time"]
        self.assertIsNone(self.run_.history.get("time"))

    def test_a_stress_that_is_no_number_is_no_peak(self):
        path = self.run_.folder / "history.csv"
        self.assertGreater(self.run_.peak_time, 0)
        header, *rows = path.read_text().splitlines()
        for cell in ("nan", "", "inf"):
            cells = rows[3].split(",")
            cells[header.split(",").index("axial_stress_top_pa")] = cell
            path.write_text("\n".join([header, *rows[:3], ",".join(cells), *rows[4:]]) + "\n")
            with self.assertRaisesRegex(platen.InputError, "1 of .* rows have no stress"):
                platen.Run(self.run_.folder).peak_time
        path.write_text(header + "\n")
        with self.assertRaisesRegex(platen.InputError, "no rows"):
            platen.Run(self.run_.folder).peak_time

    def test_damaged_files_are_told(self):
        folder = self.run_.folder
        for name, contents, reader in (
                ("summary.json", ("[]", "5", "[" * 100000, "\xff", '{"loaded_axis": 5}', '{"loaded_axis": "w"}'), lambda run: (run.summary, run.stress)),
                ("history.csv", ("a,a\n1,2\n", "a\n\0\n", "", "a\n" + "x" * 200000 + "\n", "time_s\n1\n"), lambda run: run.stress),
                ("scene.prm", (None, b"\xff"), lambda run: run.scene),
                ("specimen.pvd", ("<VTKFile/>x", '<VTKFile><Collection><DataSet timestep="nan" file="a"/></Collection></VTKFile>',
                                  '<VTKFile><Collection><DataSet timestep="1"/></Collection></VTKFile>'), lambda run: run.specimen),
                ("specimen.pvd", ('<VTKFile><Collection><DataSet timestep="1" file="none.vtu"/></Collection></VTKFile>',),
                 lambda run: run.specimen[0])):
            kept = (folder / name).read_bytes()
            for content in contents:
                if content is None:
                    (folder / name).unlink()
                else:
                    (folder / name).write_bytes(content if isinstance(content, bytes) else content.encode("latin-1"))
                with self.assertRaises(platen.InputError, msg=f"{name}: {content!r}"[:80]):
                    reader(platen.Run(folder))
            (folder / name).write_bytes(kept)

    def test_arrays_that_do_not_go_together_are_told(self):
        def grid(**other):
            parts = {"points": "0 0 0 1 1 1", "offsets": "2", "connectivity": "0 1", "value": "1 2", "of_cell": "1", **other}
            array = lambda name, kind, more="": f'<DataArray type="{kind}" Name="{name}" format="ascii"{more}>{parts[name]}</DataArray>'
            path = self.folder / "grid.vtu"
            path.write_text('<VTKFile byte_order="LittleEndian"><UnstructuredGrid><Piece><Points>'
                            + array("points", "Float64", ' NumberOfComponents="3"') + "</Points><Cells>" + array("connectivity", "Int32")
                            + array("offsets", "Int32") + "</Cells><PointData>" + array("value", "Float64") + "</PointData><CellData>"
                            + array("of_cell", "Float64") + "</CellData></Piece></UnstructuredGrid></VTKFile>")
            return vtu.read(path)

        self.assertEqual(grid().lines().tolist(), [[0, 1]])
        for other in ({"value": "1"}, {"of_cell": "1 2"}, {"connectivity": "0 2"}, {"connectivity": "-1 0"}, {"offsets": "3"},
                      {"offsets": "2 1", "of_cell": "1 2"}, {"points": "0 0"}):
            with self.assertRaises(platen.InputError, msg=str(other)):
                grid(**other)
        with self.assertRaisesRegex(platen.InputError, "no lines"):
            grid(offsets="1 2", of_cell="1 2").lines()

    def test_a_frame_that_was_cut_is_told(self):
        path = next(self.run_.folder.rglob("specimen*.vtu"))
        whole = path.read_bytes()
        refused = 0
        for length in range(1, len(whole) - 100, max(1, len(whole) // 60)):
            path.write_bytes(whole[:length])
            with self.assertRaises(platen.InputError, msg=length):
                vtu.read(path)
            refused += 1
        self.assertGreater(refused, 50)


if __name__ == "__main__":
    unittest.main()
