"""platen-report as a user calls it: pages, messages and exit statuses, and what a page says before its pictures."""
import contextlib
import csv
import io
import json
import math
import os
import shutil
import subprocess
import sys
import unittest

from report_folders import InFolder, made_up_run

from platen import report
from platen.report import main, run, words

CURVE = [(0, 0), (1, 10), (2, 20), (3, 30), (4, 20), (5, 5)]  # strain in 1e-3, MPa


def call(*arguments):
    """(status, screen, errors) of platen-report."""
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        status = main.main([str(a) for a in arguments])
    return status, out.getvalue(), err.getvalue()


def history(folder, rows=None):
    """A run's folder with history.csv alone."""
    folder.mkdir(exist_ok=True)
    with open(folder / "history.csv", "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(["time_s", "axial_strain_platen", "axial_stress_top_pa", "axial_stress_bottom_pa"])
        table.writerows(rows if rows is not None else [(1e-3 * k, 1e-3 * e, 1.1e6 * s, 0.9e6 * s) for k, (e, s) in enumerate(CURVE)])
    return folder


def summary(folder, **more):
    """history.csv and summary.json of a run that has ended."""
    history(folder)
    read = {"status": "done", "app": "platen-compress", "peak_reached": True, "strength_pa": 30e6, "validity": {"strength_pa": "valid"}}
    (folder / "summary.json").write_text(json.dumps({**read, **more}))
    return folder


class Folder(InFolder):
    def refused(self, words_of_error, *arguments, status=2):
        ended, out, err = call(*arguments)
        self.assertEqual(ended, status, err)
        self.assertEqual((out, err.count("\n")), ("", 1), err)
        self.assertTrue(err.startswith("error: ") and words_of_error in err, err)


class Page(Folder):
    def test_a_whole_run_has_its_page_without_a_display_and_the_same_bytes_again(self):
        made_up_run.write_run(self.folder / "run", 0.004)
        os.environ.pop("DISPLAY", None)
        status, out, err = call(self.folder / "run", "--pictures", "svg,pdf")
        self.assertEqual((status, err), (0, ""))
        pictures = self.folder / "run/pictures"
        first = {file.name: file.read_bytes() for file in pictures.iterdir()}
        for name in ("report.html", "stress_strain.png", "stress_strain.svg", "stress_strain.pdf", "specimen_outside.png", "damage.png"):
            self.assertIn(name, first)
            self.assertIn(f"{pictures / name}", out)
        self.assertNotIn("damage.svg", first)
        self.assertEqual(first["damage.png"][:4], b"\x89PNG")
        page = first["report.html"].decode()
        self.assertEqual(page.count("<figure id="), 1 + sum(name.endswith(".png") for name in first))  # the view is one
        self.assertNotIn("is being drawn", page)
        self.assertNotIn("http", page.replace("http://www.w3.org", "").replace("http://purl.org", "").replace("http://creativecommons.org", "")
                         .replace("https://matplotlib.org", ""))
        self.assertLess(len(page), 3e6)
        self.assertEqual(call(self.folder / "run", "--pictures", "svg,pdf", "--quiet"), (0, "", ""))
        self.assertEqual(first, {file.name: file.read_bytes() for file in pictures.iterdir()})

    def test_a_run_without_frames_has_its_curves_and_says_what_is_missing(self):
        status, out, _ = call(history(self.folder / "run"), "-o", self.folder / "here")
        self.assertEqual(status, 0)
        self.assertTrue((self.folder / "here/stress_strain.png").is_file())
        for missing in ("summary.json is not there", "cracks.csv is not there", "specimen.pvd is not there"):
            self.assertIn(missing, out)

    def test_short_and_silent_histories_are_drawn(self):
        for rows in ([(0, 0, 1, 1)], [(0, 0, 0, 0), (1e-3, 1e-4, 0, 0)], [(0, 0, 0, 0), (1e-3, 1e-4, "", 5), (2e-3, 2e-4, 7, 7)]):
            self.assertEqual(call(history(self.folder / "run", rows))[0], 0, rows)

    def test_titles_of_any_kind_cannot_break_the_page(self):
        folder = summary(self.folder / "run")
        (folder / "scene.prm").write_bytes('subsection Scene\n  set Title = <b>"混凝土" & \xe9'.encode() + b"\xff\nend\n")
        self.assertEqual(call(folder)[0], 0)
        page = (folder / "pictures/report.html").read_text(encoding="utf-8")
        self.assertIn("<h1>&lt;b&gt;&quot;混凝土&quot; &amp; é\ufffd</h1>", page)

    def test_a_library_user_gets_the_page_and_charts_on_axes_of_his_own(self):
        from matplotlib.figure import Figure

        folder = summary(self.folder / "run")
        self.assertEqual(report.page(report.TestRun(folder), self.folder / "mine"), self.folder / "mine/report.html")
        axes = Figure().add_subplot()
        report.curves.stress(axes, [report.TestRun(folder)])
        self.assertEqual(max(axes.lines[0].get_ydata()), 30)

    def test_a_laboratory_is_drawn_beside_the_run(self):
        folder = summary(self.folder / "run")
        measured = self.folder / "mine.csv"
        measured.write_text("strain (mm/m);stress (MPa)\n" + "".join(f"{k / 4};{2.6 * k}\n".replace(".", ",") for k in range(12)))
        status, out, err = call(folder, "--laboratory", measured)
        self.assertEqual((status, err), (0, ""))
        self.assertTrue((folder / "pictures/laboratory.png").is_file())
        self.assertRegex(out, r"strength.*30.*28\.6")

    def test_a_laboratory_file_becomes_a_curve_to_calibrate_on(self):
        measured, curve = self.folder / "mine.csv", self.folder / "curve.csv"
        strain = [0, 0.5, 1, 1.5, 2]  # mm/m
        measured.write_text("strain (mm/m);stress (MPa)\n" + "".join(f"{e};{10 * e}\n".replace(".", ",") for e in strain))
        status, out, err = call("--laboratory", measured, "--curve", curve)
        self.assertEqual((status, err), (0, ""))
        self.assertIn("4 points are in", out)
        self.assertEqual(curve.read_text(), "strain_platen,stress_pa\n0.0005,5000000\n0.001,10000000\n0.0015,15000000\n0.002,20000000\n")
        self.refused(f"--curve = {curve} is there already", "--laboratory", measured, "--curve", curve)
        self.refused("--curve needs --laboratory", "--curve", self.folder / "other.csv")
        measured.write_text("mm,kN\n0,0\n1,100\n2,50\n")
        self.refused("needs the height of the specimen", "--laboratory", measured, "--curve", self.folder / "other.csv")


class Refused(Folder):
    def test_bad_input_ends_with_status_two_and_one_line(self):
        run_folder = summary(self.folder / "run")
        self.refused("no folder is given")
        self.refused("no such folder", self.folder / "none")
        self.refused("holds no run", self.folder)
        self.refused("unrecognized arguments: --nothing", run_folder, "--nothing")
        self.refused("--pictures = gif is not known. Allowed: pdf, svg", run_folder, "--pictures", "gif")
        self.refused("--columns needs --laboratory", run_folder, "--columns", "strain=a")
        self.refused("no fields can be made", run_folder, "--fields", "-q")
        self.refused("mine.csv: cannot be read", run_folder, "--laboratory", self.folder / "mine.csv")
        self.assertEqual(call("--help")[0], 0)

    def test_damaged_files_end_in_one_line_that_names_them(self):
        for name, text, said in (("summary.json", "{", "damaged"), ("summary.json", "[]", "no object"), ("history.csv", "a,a\n1,2\n", "one name"),
                                 ("history.csv", "time_s\n1\n", "no column"), ("cracks.csv", "a,b\n1\n", "1 cells")):
            folder = summary(self.folder / "run")
            (folder / name).write_text(text)
            self.refused(said, folder)
            shutil.rmtree(folder)
        (folder / "history.csv").mkdir(parents=True)
        self.refused("holds no run", folder)

    def test_pipes_under_the_names_of_files_are_refused(self):
        for name in ("summary.json", "scene.prm", "cracks.csv", "specimen.pvd"):
            folder = summary(self.folder / "run")
            (folder / name).unlink(missing_ok=True)
            os.mkfifo(folder / name)
            self.refused(f"{name}: is no file", folder)
            shutil.rmtree(folder)

    def test_a_damaged_frame_leaves_no_picture(self):
        made_up_run.write_run(self.folder / "run", 0.004)
        for file in (self.folder / "run").rglob("specimen*.vtu"):
            file.write_text(file.read_text()[:900])
        self.refused("specimen", self.folder / "run")
        self.assertFalse((self.folder / "run/pictures").exists())

    def test_where_the_disk_is_full_former_pictures_and_page_stay(self):
        folder = summary(self.folder / "run")
        self.assertEqual(call(folder)[0], 0)
        before = {file.name: file.read_bytes() for file in (folder / "pictures").iterdir()}
        limited = ("import resource, sys; resource.setrlimit(resource.RLIMIT_FSIZE, (20000, 20000)); from platen.report.main import main; "
                   "sys.exit(main([sys.argv[1]]))")
        (folder / "history.csv").write_text((folder / "history.csv").read_text() + "6e-3,6e-3,1,1\n")
        done = subprocess.run([sys.executable, "-c", limited, str(folder)], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (4, 1), done.stderr)
        self.assertIn("cannot be written", done.stderr)
        self.assertEqual(before, {file.name: file.read_bytes() for file in (folder / "pictures").iterdir()})

    def test_a_folder_that_cannot_be_written_ends_with_status_four(self):
        (self.folder / "taken").write_text("")
        self.refused("cannot be written", summary(self.folder / "run"), "-o", self.folder / "taken", status=4)


class Words(Folder):
    def results(self, **more):
        return report.TestRun(summary(self.folder / f"run{len(list(self.folder.iterdir()))}", **more))

    def test_the_verdict_is_a_sentence_with_the_strength_and_what_was_expected(self):
        met, missed = ({"entry": "Expect/strength_pa", "range": "25 MPa ... 35 MPa", "value": 30e6, "met": m, "reason": None} for m in (True, False))
        self.assertEqual(words.verdict([self.results()]), ["Strength 30 MPa, valid."])
        self.assertEqual(words.verdict([self.results(expectations=[met])]),
                         ["Strength 30 MPa, valid. As expected: 1 figure that the scene expects, all met."])
        self.assertIn("Not as expected: 1 of 2 figures that the scene expects not met (strength).",
                      words.verdict([self.results(expectations=[met, missed])])[0])
        self.assertEqual(words.verdict([self.results(status="stopped", signs_of_haste=["36 wave crossings"])]),
                         ["The run has not ended: its figures are of the part that ran. Not quasi-static: 36 wave crossings. Strength 30 MPa, valid."])
        for one, sentence in (({"met": True}, "All 2 targets met on unseen packings."),
                              ({"met_in_training": True}, "All 2 targets met on the packings calibrated on, and not judged on others."),
                              ({"met": False, "met_in_training": True}, "Strength 30 MPa, valid.")):
            self.assertEqual(words.verdict([self.results(targets=[one, one])])[0], sentence)
        self.assertEqual(words.verdict([self.results(targets=[{"met": True}], targets_missed=["E"])])[0], "Not met: 1 target.")
        self.assertEqual(words.verdict([self.results(strength_pa=None, validity={"strength_pa": ["no peak was reached"]})]),
                         ["No strength: no peak was reached."])
        self.assertEqual(words.verdict([self.results(validity={"strength_pa": ["too fast"]})]), ["Strength 30 MPa, not valid: too fast."])

    def test_what_is_not_met_comes_first_in_the_unit_of_its_range(self):
        rows = [{"entry": "Expect/strength_pa", "range": "25 MPa ... 35 MPa", "value": 30e6, "met": True},
                {"entry": "Expect/youngs_modulus_gauge_pa", "range": "... 20 GPa", "value": 25.7157e9, "met": False},
                {"entry": "Expect/middle_damage", "range": "0.5 ...", "value": None, "met": None, "reason": "no peak"}]
        table = words.table_of_expectations([self.results(expectations=rows, signs_of_haste=["waves"], status="stopped")])
        self.assertEqual([row[0] for row in table.rows],
                         ["status", "quasi-static", "Young's modulus, gauge", "damage of the middle", "strength"])
        self.assertEqual(table.rows[2][1:], ["... 20 GPa", "25.72 GPa", "not met"])
        self.assertEqual(table.rows[3][3], "not checked: no peak")
        strain = {"entry": "Expect/strain_at_peak_platen", "range": "0.0021 ... 3e-3", "value": 0.00243, "met": True}
        self.assertEqual(words.table_of_expectations([self.results(expectations=[strain])]).rows[0][1:3], ["2.1 mm/m ... 3 mm/m", "2.43 mm/m"])
        ratio = {"entry": "Expect/strain_ratio", "range": "0.2 ... 0.3", "value": 0.25, "met": True}
        self.assertEqual(words.table_of_expectations([self.results(expectations=[ratio])]).rows[0][1:3], ["0.2 ... 0.3", "0.25"])

    def test_figures_have_four_digits_and_ratios_only_where_they_mean_something(self):
        runs = [report.TestRun(summary(self.folder / name, strength_pa=strength, dead_zone_top={"base_ratio": r}, dead_zone_bottom={"base_ratio": 0.9},
                                       cone_top={"half_angle_deg": 40}, end_damage_top=0.1, end_damage_bottom=0.2, peak_reached=peak))
                for name, strength, r, peak in (("dry", 41.866e6, 0.8, True), ("wet", 20.933e6, 1.0, False))]
        table = {row[0]: row[1:] for row in words.table_of_figures(runs).rows}
        self.assertEqual(table["strength (MPa)"], ["41.87", "20.93, no peak reached", "2"])
        self.assertEqual(table["base of the worse end's cone, r0"], ["0.8", "0.9", "-"])
        self.assertEqual(table["damage of the worse end"], ["0.2", "0.2", "1"])
        self.assertFalse({"Poisson's ratio", "tensile strength (MPa)"} & {*table})
        damaged = {"end_damage_top": 0.1, "dead_zone_top": {"base_ratio": 0.8}}
        for app, names in (("platen-compress", ["strength (MPa)", "damage of the worse end"]), ("platen-brazilian", ["strength (MPa)"])):
            made = words.table_of_figures([self.results(app=app, **damaged)])
            self.assertEqual(([row[0] for row in made.rows], made.note != ""), (names, app == "platen-compress"))  # no cone: no r0

    def test_only_figures_with_a_reason_against_them_have_a_row_of_validity(self):
        valid = report.TestRun(summary(self.folder / "a"))
        self.assertEqual(words.table_of_validity([valid]).rows, [])
        doubtful = report.TestRun(summary(self.folder / "b", validity={"strength_pa": "valid", "poisson_ratio": ["too few", "too fast"]}))
        self.assertEqual(words.table_of_validity([valid, doubtful]).rows, [["Poisson's ratio", "valid", "too few; too fast"]])
        why = ["closure is no strain: opening_at_peak_m"]
        alike = report.TestRun(summary(self.folder / "c", validity={"strain_at_peak_platen": why, "barrel_at_peak": why}))
        self.assertEqual(words.table_of_validity([alike]).rows,
                         [["strain at peak, platens, barrel at peak", "closure is no strain: opening at peak"]])

    def test_what_was_tested_has_sizes_platens_and_how_it_ended(self):
        entries = {"Specimen": {"Shape": "disc", "Radius": "25 mm", "Height": "20 mm", "Packing": "file"},
                   "Platens": {"Kind": "deformable", "Friction static": "0.3", "Pad thickness": "2 mm", "Thickness": "0"}}
        text = "".join(f"subsection {name}\n" + "".join(f"  set {key} = {value}\n" for key, value in of.items()) + "end\n"
                       for name, of in entries.items())
        disc = summary(self.folder / "disc", app="platen-brazilian", test="compression", ended_by="stop at residual")
        (disc / "scene.prm").write_text(text)
        facts = dict(words.table_of_facts([report.TestRun(disc)]).rows)
        self.assertEqual((facts["specimen"], facts["platens"]), ("disc, radius 25 mm, thickness 20 mm", "deformable, pad thickness 2 mm"))
        self.assertEqual(facts["loading"], "splitting, ended: the stress fell to the residual")
        bonds = summary(self.folder / "bonds", app="platen-bonds")
        (bonds / "scene.prm").write_text(text)
        self.assertFalse({"specimen", "packing"} & {*dict(words.table_of_facts([report.TestRun(bonds)]).rows)})

    def test_a_title_is_none_where_an_entry_that_changes_the_test_was_overridden(self):
        over = [{"entry": "Bond/Modulus", "value": "1 GPa", "in_scene_file": "2 GPa"}, {"entry": "Output/Every", "value": "1", "in_scene_file": ""}]
        self.assertEqual(words.true_title(self.results(scene="Concrete", overridden=over[1:])), "Concrete")
        changed = self.results(scene="Concrete", overridden=over)
        self.assertIn("1 entry of its scene changed", words.true_title(changed))
        self.assertIn(["overridden", "Bond/Modulus = 1 GPa (scene file: 2 GPa); Output/Every = 1 (scene file: empty)"],
                      words.table_of_facts([changed]).rows)

    def test_values_of_other_kinds_than_numbers_are_no_figures(self):
        for value in ("12", True, [1], {"a": 1}, None, math.inf):
            table = words.table_of_figures([report.TestRun(summary(self.folder / "odd", poisson_ratio=value))])
            self.assertNotIn("Poisson's ratio", [row[0] for row in table.rows], value)

    def test_texts_of_the_scene_are_numbers_with_their_units(self):
        for text, value in (("25 mm", 0.025), ("2400 kg/m3", 2400), ("30 degree", math.pi / 6), ("5 N/mm2", 5e6), ("0.57", 0.57), ("60 mm/min", 1e-3),
                            ("2 GPa", 2e9), ("1e-3 kN", 1)):
            self.assertAlmostEqual(run.number_with_unit(text) / value, 1, places=12, msg=text)
        for text in ("as grains", "", "3 parsec", "0.05 R_min"):
            self.assertTrue(math.isnan(run.number_with_unit(text)), text)


if __name__ == "__main__":
    unittest.main()
