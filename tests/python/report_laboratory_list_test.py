"""A laboratory's list: read as it is written, beside a study by one rule, as targets that platen-calibrate takes, and what is refused."""
import json
import math
import os
import subprocess
from pathlib import Path
from unittest import mock

import numpy
from report_app_test import Folder, call
from report_folders import write_history
from report_studies_test import case, parameters

from platen.errors import InputError
from platen.report import house, laboratory_list, laboratory_study, studies

BUILD, SOURCE = Path(os.environ["PLATEN_BUILD"]), Path(os.environ["PLATEN_SOURCE"])
NAN = math.nan
# Of each case by seed: strength, strain at the peak, half-angle.
MEASURED = {"pressure_0_mpa": [(40e6, 2e-3, NAN), (44e6, 2.2e-3, NAN), (48e6, 2.4e-3, NAN)],
            "pressure_9_mpa": [(80e6, 6e-3, NAN), (NAN, NAN, NAN), (120e6, 8e-3, NAN)]}
KEYS = ("strength_pa", "strain_at_peak_platen", "cone_top/half_angle_deg")
HEAD, NINE, ZERO = "case;figure;value;unit;deviation;over;curve\n", *(f"Loading/Confining pressure = {p} MPa" for p in (9, 0))


class List(Folder):
    def write(self, text, head=HEAD, coding="utf-8"):
        path = self.folder / "mine.csv"
        path.write_bytes((head + text).encode(coding))
        return path

    def read(self, text, head=HEAD, **more):
        return laboratory_list.read(self.write(text, head, **more))

    def study(self):
        folder = self.folder / "study"
        (folder / "runs").mkdir(parents=True, exist_ok=True)
        cases = [{**case(name, 50e6, confining_pressure_pa=p * 1e6), "overrides": [f"Loading/Confining pressure = {p} MPa"]}
                 for name, p in zip(MEASURED, (0, 9))]
        said = {**parameters("vary", *cases), "varied": ["confining_pressure_pa"]}
        (folder / "study.json").write_text(json.dumps(said))
        rows = [",".join(["vary", name, str(seed), "done", *("" if math.isnan(value) else repr(value) for value in values), "crushing"])
                for name, of in MEASURED.items() for seed, values in enumerate(of, 1)]
        (folder / "study.csv").write_text("\n".join(["kind,case,seed,status," + ",".join(KEYS) + ",pattern", *rows]) + "\n")
        return folder

    def run_of(self, name, stress=(0, 40e6, 10e6), **more):
        folder = self.study() / "runs" / name
        folder.mkdir()
        write_history(folder, {"z": stress})
        (folder / "summary.json").write_text(json.dumps({"status": "done", "section": {"area_m2": 1e-3}, **more}))

    def compare(self, text):
        path = self.write(text)
        return laboratory_study.compare(studies.Studied(self.study()), laboratory_list.read(path))

    def row(self, text):
        compared, = self.compare(text)
        return laboratory_study.table_of(studies.Studied(self.study()), [compared]).rows[0]


class Read(List):
    def test_separators_decimal_marks_and_units_give_the_same_numbers(self):
        for text, head in (("a;strength_pa;81,2;MPa;1,5", HEAD), ("a;strength_pa;81,2 N/mm²;;1,5", HEAD),
                           ("a;strength_pa;81200,0 kPa;;1500 kPa", HEAD), ("a,strength_pa,81.2,MPa,+- 1.5", HEAD.replace(";", ",")),
                           ("a\tstrength_pa\t81,2\t1,5", "case\tfigure\tvalue (MPa)\tdeviation\n"),
                           ("a;strength_pa;81,2;MPa;1,84729064039409 %", HEAD), ("81,2;;a;strength_pa", "Value [MPa];Unit;Case;Figure\n")):
            row, = self.read("# b;strength_pa;1;MPa\n\n" + text + "\n", "Cores of March\n" + head, coding="utf-16" if "²" in text else "utf-8")
            self.assertAlmostEqual(row.value, 81.2e6, delta=1e-3)
            if "Unit" not in head:
                self.assertAlmostEqual(row.deviation, 1.5e6, delta=1)
        self.assertTrue(math.isnan(row.deviation))

    def test_each_kind_of_figure_has_its_units(self):
        rows = self.read("a;strain_at_peak_platen;2,5;mm/m\na;strain_at_peak_platen;0,25 %;;0,01 %\na;poisson_ratio;0,2;;5 %\n"
                         "a;cone_top/half_angle_deg;30;°\na;strength_pa;1,42;;;b\na;bond_fracture_energy_j_m2;60;N/m\n")
        numpy.testing.assert_allclose([row.value for row in rows], [2.5e-3, 2.5e-3, 0.2, 30, 1.42, 60])
        numpy.testing.assert_allclose([row.deviation for row in rows[1:3]], [1e-4, 0.01])

    def test_what_cannot_be_meant_is_refused_with_file_line_column_and_value(self):
        for text, words in (
                ("a;strength_pa;81.2,1;MPa", r"mine.csv:2: value = '81.2,1' is no number.*',' as decimal mark"),
                ("a;strength_pa;8,1;MPa\na;strength_pa;81.2;MPa", r"mine.csv:3: value = '81.2' is no number"),
                ("a;strength_pa;40 42;MPa", "value = '40 42' has the unit '42' and 'mpa'"),
                ("a;strength_pa;;MPa", "value = '' is no number"), ("a;;4;MPa", "figure = '' is empty"),
                ("a;strength_pa;81;kN", "mine.csv:2: unit = 'kN' has the unit 'kn'. Allowed for strength_pa: mpa, n/mm2"),
                ("a;strength_pa;81", "value = '81' has no unit"), ("a;strain_at_peak_platen;2.4", "has no unit. Allowed .*: mm/m"),
                ("a;strength_pa;1.4 MPa;;;b", "Allowed for strength_pa over another case: mm/m"),
                ("a;strength_pa;81 MPa;kPa", "has the unit 'mpa' and 'kpa'"), ("a;strength_pa;81;MPa;-2", "deviation = '-2' is no number"),
                ("a;strength_pa;81;MPa;2 mm", "deviation = '2 mm' has the unit 'mm'"),
                ("a;strength_pa;81;MPa;;;no.csv", "curve = 'no.csv' is not there"), ("a;strength_pa;81;MPa;;;;9", "8 cells where the header has 7"),
                ("", "has no row below its header")):
            with self.assertRaisesRegex(InputError, words, msg=text) as refused:
                self.read(text + "\n")
            self.assertEqual(refused.exception.line is None, text == "")
        for text, words in (("", "mine.csv: is empty"), ("strength;4\n", "no header with case, figure and value. Allowed: .*deviation"),
                            ("case;figure;value;deviaton\n", "mine.csv:1: column 'deviaton' is not known"),
                            ("case,figure,value,Value\n", "column 'value' .* is there twice"),
                            ('case,figure,value\na,strength_pa,"81,2 MPa"\n', "mine.csv:2: value = '81,2 MPa' is no number.*'.' as decimal mark")):
            with self.assertRaisesRegex(InputError, words):
                self.read("", text)
        with self.assertRaisesRegex(InputError, "none.csv: cannot be read"):
            laboratory_list.read(self.folder / "none.csv")


class Beside(List):
    def test_a_figure_agrees_within_two_scatters_of_both_and_not_beyond(self):
        # 40, 44, 48: 44 +- 4; with 3 of the laboratory the scatter is 5.
        for value, deviation, verdict, over in ((54, "3", True, -2), (54.01, "3", False, -2.002), (34, "3", True, 2), (33.9, "3", False, 2.02),
                                                (52, "", True, -2), (52.1, "", False, -2.025), (44, "0", True, 0)):
            compared, = self.compare(f"pressure_0_mpa;strength_pa;{value};MPa;{deviation}\n")
            self.assertIs(compared.agrees, verdict, value)
            self.assertAlmostEqual((compared.mean - compared.row.value) / compared.scatter, over)
        self.assertEqual(self.row("pressure_0_mpa;strength_pa;55;MPa;3"),
                         ["strength (MPa)", "cell 0 MPa", "55 +- 3", "44 +- 4", "3", "-20", "-2.2", "does not"])

    def test_without_a_scatter_nothing_is_said(self):
        compared, = self.compare("pressure_0_mpa;strength_pa;40;MPa\n")
        alone = compared._replace(values=compared.values[:1])
        self.assertIsNone(alone.agrees)
        self.assertEqual(laboratory_study.table_of(studies.Studied(self.study()), [alone]).rows[0][3:], ["40", "1 of 3", "0", "-", "-"])
        self.assertIs(alone._replace(row=alone.row._replace(deviation=1e3)).agrees, True)

    def test_ratios_are_of_the_packings_one_by_one_and_a_missing_one_is_counted_apart(self):
        compared, = self.compare(f"{NINE};strength_pa;2,2;;0,1;{ZERO}\n")
        self.assertEqual(compared.values, [2, 2.5])  # not 100 over 44
        self.assertEqual(self.row(f"{NINE};strength_pa;2,5;-;;pressure_0_mpa")[:5],
                         ["strength", "cell 9 MPa over cell 0 MPa", "2.5", "2.25 +- 0.35", "2 of 3"])

    def test_a_figure_that_no_packing_has_is_a_dash_with_the_reason(self):
        self.run_of("pressure_9_mpa_seed_1", validity={"cone_top": ["no peak was found"]})
        row = self.row("pressure_9_mpa;cone_top/half_angle_deg;30;°;2")
        self.assertEqual(row[3:], ["-", "0 of 3", "-", "-", "none: 1 of 1 runs: no peak was found"])

    def test_a_long_reason_is_cut_in_the_table_and_whole_in_the_remarks(self):
        reason = "no peak was found, " + "because it grew and " * 6 + "grew"
        self.run_of("pressure_9_mpa_seed_1", validity={"cone_top": [reason]})
        made = laboratory_study.added(studies.page_of(self.study()), self.study(), self.write("pressure_9_mpa;cone_top/half_angle_deg;30;°;2\n"))
        cell = made.sections[0].tables[0].rows[0][-1]
        self.assertTrue(cell.startswith("none: 1 of 1 runs: no peak was found") and cell.endswith(" ...") and len(cell) <= 110, cell)
        self.assertEqual(made.remarks[-1], f"cell 9 MPa: no half-angle of the top cone: 1 of 1 runs: {reason}")

    def test_a_strength_before_the_peak_is_none(self):
        self.run_of("pressure_0_mpa_seed_2", peak_reached=False)
        self.assertEqual(self.compare("pressure_0_mpa;strength_pa;2;MPa;1\n")[0].values, [40e6, 48e6])

    def test_cases_are_named_by_name_or_entries_in_any_unit(self):
        for name in ("pressure_9_mpa", NINE, "Loading/Confining pressure=9000 kPa"):
            self.assertEqual(self.compare(f"{name};strength_pa;2;MPa\n")[0].case.name, "pressure_9_mpa")

    def test_as_many_entries_name_a_case_as_tell_it_from_the_others(self):
        row, = self.read("a;strength_pa;2;MPa\n")
        study = studies.Studied(self.study())
        names = ("pressure_0_mpa", "pressure_9_mpa")
        for both, text, found in (((["A/B = 1", "C/D = 2 mm"], ["A/B = 1", "C/D = 3 mm"]), "C/D = 0.3 cm", names[1]),
                                  ((["A/B = 1"], ["A/B = 1", "C/D = 3 mm"]), "A/B = 1", names[0]),
                                  ((["A/B = 1", "C/D = 2 mm"], ["A/B = 1", "C/D = 3 mm"]), "A/B = 1", None)):
            study.said["cases"] = [{"name": name, "overrides": of} for name, of in zip(names, both)]
            if found:
                self.assertEqual(laboratory_study._case_of(study, row, "case", text).name, found)
            else:
                with self.assertRaisesRegex(InputError, "fits 2 cases of .*study. Allowed: pressure_0_mpa, pressure_9_mpa, or"):
                    laboratory_study._case_of(study, row, "case", text)

    def test_what_the_study_does_not_have_is_refused_with_what_it_has(self):
        for text, words in (
                ("pressure_8;strength_pa;2;MPa",
                 "mine.csv:2: case = 'pressure_8' is no case of .*study. Allowed: pressure_0_mpa, pressure_9_mpa, or"),
                (";strength_pa;2;MPa", "case = '' is no case"), ("Loading/Confining pressure = 8 MPa;strength_pa;2;MPa", "is no case"),
                ("pressure_9_mpa;strenght_pa;2;MPa", "figure = 'strenght_pa' is no number of study.csv. Near: strength_pa"),
                ("pressure_9_mpa;seed;2", "figure = 'seed' is no number.*Allowed: strength_pa, strain_at"),
                ("pressure_9_mpa;pattern;2", "is no number of study.csv"),
                ("pressure_9_mpa;strength_pa;2;;;pressure_8", "over = 'pressure_8' is no case"),
                (f"pressure_9_mpa;strength_pa;2;MPa\n{NINE};strength_pa;3;MPa", "mine.csv:3: case = .* has strength_pa twice")):
            with self.assertRaisesRegex(InputError, words):
                self.compare(text + "\n")
        self.assertEqual(len(self.compare(f"pressure_9_mpa;strength_pa;2;MPa\n{NINE};strength_pa;3;;;{ZERO}\n")), 2)

    def test_the_page_leads_with_the_list_and_draws_ratios_and_curves(self):
        for name in ("pressure_0_mpa_seed_1", "pressure_0_mpa_seed_2"):
            self.run_of(name, [0, 40e6, 10e6])
        (self.folder / "curves").mkdir()
        (self.folder / "curves/a.csv").write_text("strain (mm/m),stress (MPa)\n0,0\n1,30\n2,5\n")
        path = self.write("pressure_0_mpa;strength_pa;55;MPa;3;;curves/a.csv\npressure_0_mpa;strain_at_peak_platen;2,2;mm/m;;;curves/a.csv\n"
                          "pressure_9_mpa;cone_top/half_angle_deg;30;°\npressure_9_mpa;strength_pa;90;MPa;;;curves/a.csv\n"
                          "pressure_9_mpa;strain_at_peak_platen;0;mm/m\n")
        made = laboratory_study.added(studies.page_of(self.study()), self.study(), path)
        self.assertEqual(made.leads[0], "Laboratory's list: 2 of 4 figures that have a scatter agree within two of it.")
        section = made.sections[0]
        self.assertEqual([picture.name for picture in section.pictures], ["laboratory_figures", "laboratory_pressure_0_mpa"])
        self.assertIn("pressure_9_mpa: the measured curve is not drawn: no run is kept", made.remarks)
        forest, curves = (house.figure_of(picture).axes[0] for picture in section.pictures)
        points = [line.get_xydata()[0].tolist() for line in forest.lines if len(line.get_xdata()) == 1]
        numpy.testing.assert_allclose(points, [[0.8, 0], [1, 1], [100 / 90, 2]])
        ends = [of.get_segments()[0][:, 0] for of in forest.collections]
        numpy.testing.assert_allclose(ends[0], [0.8 - 10 / 55, 0.8 + 10 / 55])
        lines = {line.get_label(): line.get_xydata() for line in curves.lines}
        self.assertEqual(len(curves.lines), 3)
        numpy.testing.assert_allclose(lines["laboratory"][1], [1, 30])
        numpy.testing.assert_allclose(lines["cell 0 MPa"][1], [1, 40])
        self.run_of("pressure_9_mpa_seed_1", [0, -4e6, -1e6])
        made = laboratory_study.added(studies.page_of(self.study()), self.study(), path)
        curves, = house.figure_of(made.sections[0].pictures[2]).axes
        numpy.testing.assert_allclose(curves.lines[0].get_xydata()[1], [-1, -30])  # tension, as the run has it
        with mock.patch.object(studies, "MOST", 1):
            made = laboratory_study.added(studies.page_of(self.study()), self.study(), path)
        self.assertEqual(len(made.sections[0].pictures), 2)
        self.assertIn("pressure_9_mpa: the measured curve is not drawn: 1 others are", made.remarks)
        status, _, err = call(self.study(), "--laboratory", path, "--quiet")
        self.assertEqual((status, err), (0, ""))
        self.assertIn("agree within two of it", (self.study() / "pictures/report.html").read_text())

    def test_the_program_refuses_what_does_not_go_together(self):
        path, study = self.write("pressure_8;strength_pa;2;MPa\n"), self.study()
        self.refused("mine.csv:2: case = 'pressure_8'", study, "--laboratory", path)
        self.refused("--laboratory is for one study alone", study, "--laboratory", path, "--compare", study)
        path = self.write("pressure_0_mpa;strength_pa;2;MPa\n")
        self.refused("--columns = 'strain=1' has no effect", study, "--laboratory", path, "--columns", "strain=1")
        self.refused("--targets prints a list and draws nothing", path, "--targets", "-o", self.folder / "new")
        self.assertFalse((study / "pictures").exists())


class Targets(List):
    def test_targets_have_entries_values_and_tolerances_in_the_grammar_of_calibrate(self):
        text = laboratory_list.targets(self.write(
            f";strength_pa;40;MPa;3 %\n{NINE}, Loading/Target  strain=0.02;strength_pa;81,2;MPa;1,8\n{NINE};strength_pa;2,05;;0,0205;{ZERO}\n"
            f"{NINE};strain_at_peak_platen;5,5;mm/m\n;young modulus;25 GPa\n"))
        self.assertEqual(text.splitlines(), [
            "subsection Calibrate", "  set Target 1 = strength_pa: 40 MPa +- 1.2 MPa",
            f"  set Target 2 = strength_pa at {NINE}, Loading/Target strain = 0.02: 81.2 MPa +- 1.8 MPa",
            f"  set Target 3 = strength_pa at {NINE} over {ZERO}: 2.05 +- 1 %",
            f"  set Target 4 = strain_at_peak_platen at {NINE}: 0.0055", "  set Target 5 = young modulus: 25000 MPa", "end"])

    def test_calibrate_takes_what_is_printed(self):
        path = self.write(f"Platens/Friction static = 0.4;strength_pa;21;MPa;1\n{NINE};strength_pa;58,5;MPa;1,5\n{NINE};strength_pa;2,7;;0,1;{ZERO}\n"
                          ";young modulus;11,5 GPa;;3 %\n")
        status, out, err = call(path, "--targets")
        self.assertEqual((status, err), (0, ""))
        (self.folder / "targets.prm").write_text(out)
        scene = self.folder / "scene.prm"
        scene.write_text(f"include {SOURCE}/tests/apps/scenes/crushed.prm\ninclude targets.prm\nsubsection Loading\n  set Confinement = particles\n"
                         "  set Confining pressure = 0 MPa\nend\nsubsection Calibrate\n  set Mode = search\nend\n")
        read = subprocess.run([str(BUILD / "apps/platen-calibrate"), str(scene), "--dry-run"], capture_output=True, text=True)
        self.assertEqual(read.returncode, 0, read.stderr)
        for line in (f"strength_pa at {NINE}: 58.5 MPa +- 1.5 MPa (tolerance 2.56 %)",
                     f"strength_pa at {NINE} over {ZERO}: 2.7 +- 3.704 % (tolerance 3.7 %)",
                     "strength_pa at Platens/Friction static = 0.4: 21 MPa +- 1 MPa (tolerance 4.76 %)",
                     "young modulus: 11500 MPa +- 345 MPa (tolerance 3 %)"):
            self.assertIn(line, read.stdout)

    def test_what_is_no_target_is_refused(self):
        many = "".join(f"Contact/Friction = 0.{k};strength_pa;2;MPa\n" for k in range(10, 31))
        for text, words in (
                ("confining_pressure_9_mpa;strength_pa;2;MPa", 'mine.csv:2: case = .* cannot be turned into entries. Allowed: "Section/Key = value'),
                (f"{NINE};strength_pa;2;;;dry", "over = 'dry' cannot be turned into entries"),
                ("A/B = a: b;strength_pa;2;MPa", "case = 'A/B = a: b' cannot"),
                (f"{NINE};strength_pa;2;;;Platens/Friction static = 0", "over = .* does not set Loading/Confining pressure, which the case sets"),
                (f"{NINE};strength_pa;-2;MPa", "value = '-2' is no target"), (f"{NINE};strength_pa;2;MPa;1,1", "deviation = '1,1' is no target"),
                (f"{NINE};strength_pa;2;MPa\nLoading/Confining pressure = 9e3 kPa;strength_pa;3;MPa", "mine.csv:3: .*has strength_pa twice"),
                (many, "mine.csv:22: figure = 'strength_pa' is one too many. Allowed: 20 targets")):
            with self.assertRaisesRegex(InputError, words):
                laboratory_list.targets(self.write(text + "\n"))
