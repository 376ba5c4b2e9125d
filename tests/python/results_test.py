"""Reading results: tables, summaries and frames agree with the files; damage is told."""
import csv
import json
import math
import unittest

import numpy

from folders import CRUSHED, SMALL, InFolder, entries, run_app

import platen


class Results(InFolder):
    def setUp(self):
        super().setUp()
        self.path = self.folder / "run"
        done = run_app("platen-compress", CRUSHED, self.path, *entries(SMALL))
        assert done.returncode == 0, done.stderr
        self.run_ = platen.Run(self.path)

    def test_columns_are_the_cells_of_the_file(self):
        with (self.path / "history.csv").open() as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(self.run_.history.rows, len(rows))
        for name in rows[0]:
            cells = [float(row[name]) if row[name] else math.nan for row in rows]
            self.assertEqual(numpy.array(cells).tobytes(), self.run_.history[name].tobytes(), name)
        self.assertEqual(set(self.run_.cracks["mode"]) - {"tension", "shear"}, set())

    def test_records_are_the_rows_of_the_file(self):
        with (self.path / "cracks.csv").open() as file:
            rows = [{name: cell if name == "mode" else float(cell) for name, cell in row.items()} for row in csv.DictReader(file)]
        self.assertEqual(self.run_.cracks.records(), rows)
        self.assertEqual({type(cell) for row in self.run_.cracks.records() for cell in row.values()}, {float, str})

    def test_the_specimen_is_read_below_its_shape(self):
        self.assertEqual(list(self.run_.spheres), ["x_m", "y_m", "z_m", "radius_m"])
        self.assertEqual(self.run_.spheres.rows, self.run_.summary["particles"])
        specimen = self.path / "specimen.csv"
        specimen.write_text(specimen.read_text() + "1,2,3\n")
        with self.assertRaisesRegex(platen.InputError, f"specimen.csv:{self.run_.spheres.rows + 3}: 3 cells"):
            platen.Run(self.path).spheres

    def test_runs_of_a_folder_are_found_by_name(self):
        (self.folder / "rung").mkdir()
        (self.folder / "run.txt").touch()
        self.assertEqual(list(platen.runs(self.folder)), ["run"])
        self.assertEqual(platen.runs(self.folder, "ru?")["run"].summary, self.run_.summary)
        self.assertEqual(platen.runs(self.folder, "other_*"), {})
        self.assertEqual(platen.runs(self.folder / "none"), {})

    def test_a_row_without_a_stress_leaves_no_largest(self):
        history = self.path / "history.csv"
        lines = history.read_text().splitlines()
        cells = lines[3].split(",")
        cells[lines[0].split(",").index("axial_stress_top_pa")] = ""
        history.write_text("\n".join([*lines[:3], ",".join(cells), *lines[4:]]) + "\n")
        with self.assertRaisesRegex(platen.InputError, "1 of .* rows have no stress"):
            platen.Run(self.path).peak_time

    def test_a_run_without_a_summary_has_not_ended(self):
        self.assertEqual(self.run_.status, "done")
        (self.path / "summary.json").unlink()
        self.assertIsNone(platen.Run(self.path).status)

    def test_the_peak_is_the_strength_of_the_summary(self):
        summary = json.loads((self.path / "summary.json").read_text())
        self.assertAlmostEqual(self.run_.stress.max() / summary["strength_pa"], 1, delta=1e-12)
        self.assertEqual(self.run_.summary, summary)

    def test_the_last_frame_has_the_bonds_that_the_history_counts(self):
        state = self.run_.bonds[-1].cell_data["state"]
        history = self.run_.history
        self.assertEqual(int((state >= 2).sum()), int(history["broken_tension"][-1] + history["broken_shear"][-1]))
        self.assertEqual(self.run_.bonds[-1].lines().shape, (len(state), 2))

    def test_displacements_are_those_of_the_places(self):
        first, last = self.run_.specimen[0], self.run_.specimen[-1]
        numpy.testing.assert_array_equal(first.point_data["id"], last.point_data["id"])
        numpy.testing.assert_allclose(last.points - first.points, last.point_data["displacement"], atol=1e-12)

    def test_frames_of_platens_are_read_part_by_part(self):
        parts = self.run_.platens.parts(0)
        self.assertEqual(len(parts), 2)
        heights = sorted(part.points[:, 2].mean() for part in parts)
        self.assertLess(heights[0], 0)
        self.assertGreater(heights[1], 0.02)
        joined = self.run_.platens[0]
        self.assertEqual(len(joined.points), sum(len(part.points) for part in parts))
        self.assertEqual(joined.connectivity.max(), len(joined.points) - 1)

    def test_a_row_that_is_being_written_does_not_count(self):
        path = self.path / "history.csv"
        rows = self.run_.history.rows
        path.write_text(path.read_text() + "1,2,3")
        self.assertEqual(platen.Run(self.path).history.rows, rows)

    def test_damage_is_told_with_the_file(self):
        frame = self.path / "frames" / "specimen_000001.vtu"
        frame.write_bytes(frame.read_bytes()[:2000])
        with self.assertRaisesRegex(platen.InputError, "specimen_000001.vtu"):
            self.run_.specimen[1]
        history = self.path / "history.csv"
        history.write_text(history.read_text().replace("\n", ",\n", 3).replace(",\n", "\n", 1))
        with self.assertRaisesRegex(platen.InputError, "history.csv:2"):
            platen.Run(self.path).history
        (self.path / "summary.json").write_text("{")
        with self.assertRaisesRegex(platen.InputError, "summary.json"):
            platen.Run(self.path).summary
        with self.assertRaises(platen.InputError):
            platen.Run(self.folder / "none")
        with self.assertRaises(AttributeError):
            self.run_.nothing

    def test_tables_become_pandas_where_it_is_installed(self):
        try:
            import pandas  # noqa: F401
        except ImportError:
            self.skipTest("pandas is not installed")
        frame = self.run_.history.to_pandas()
        self.assertEqual(list(frame.columns), list(self.run_.history))
        self.assertEqual(len(frame), self.run_.history.rows)


class Studies(InFolder):
    def test_files_of_a_study_are_read_as_they_come(self):
        with self.assertRaises(platen.InputError):
            platen.Study(self.folder)
        (self.folder / "study.json").write_text('{"status": "running"}')
        study = platen.Study(self.folder)
        self.assertEqual((study.summary["status"], study.costs, study.runs), ("running", None, {}))
        with self.assertRaisesRegex(platen.InputError, "study.csv"):
            study.table
        (self.folder / "study.csv").write_text("case,seed,strength_pa\ndry,1,3e7\ndry,2,\n")
        self.assertEqual(study.table["strength_pa"][0], 3e7)
        self.assertTrue(math.isnan(study.table.records()[1]["strength_pa"]))
        run = self.folder / "runs" / "dry_seed_1"
        run.mkdir(parents=True)
        (run / "history.csv").write_text("time_s\n0\n")
        self.assertEqual(list(study.runs), ["dry_seed_1"])
        (self.folder / "study.json").write_text("{")
        with self.assertRaisesRegex(platen.InputError, "study.json"):
            platen.Study(self.folder).summary


class Shipped(unittest.TestCase):
    def test_scenes_are_found(self):
        self.assertIn("demo_dry", platen.scenes())
        self.assertTrue(platen.scenes()["demo_dry"].is_file())

    def test_the_version_is_that_of_the_programs(self):
        import subprocess

        from folders import BUILD

        said = subprocess.run([BUILD / "apps" / "platen", "--version", "--json"], capture_output=True, text=True)
        self.assertEqual(platen.version(), json.loads(said.stdout))


if __name__ == "__main__":
    unittest.main()
