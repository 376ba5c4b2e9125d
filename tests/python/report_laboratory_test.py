"""A laboratory's raw file: headers, separators, units, signs and noise; figures beside those of a run."""
import json
import math
import unittest

import numpy
from report_folders import InFolder, lines_of, write_history

from platen.errors import InputError
from platen.report import curves, laboratory
from platen.report.run import TestRun

ROWS = ((0, 0), (1, 10), (2, 20), (3, 5), (4, 4))


class Laboratory(InFolder):
    def read(self, text, coding="utf-8", **more):
        path = self.folder / "core.csv"
        path.write_bytes(text.encode(coding))
        return laboratory.read(path, **more)

    def expect(self, text, strain, stress, rows=ROWS, **more):
        """That a file gives the rows times factors."""
        curve = self.read(text, **more)
        numpy.testing.assert_allclose(curve.strain, [strain * row[0] for row in rows], rtol=1e-12, err_msg=text)
        numpy.testing.assert_allclose(curve.stress, [stress * row[1] for row in rows], rtol=1e-12, err_msg=text)
        return curve

    def body(self, separator=",", form="{}"):
        return "\n".join(separator.join(form.format(value) for value in row) for row in ROWS) + "\n"

    def test_units_of_headers_are_understood(self):
        for header, strain, stress in (
                ("Axial strain (mm/m),Stress (MPa)", 1e-3, 1e6), ("strain [%],stress in N/mm2", 1e-2, 1e6), ("per mille,kPa", 1e-3, 1e3),
                ("microstrain,Stress - psi", 1e-6, 6894.757), ("ε (‰),σ (N/mm²)", 1e-3, 1e6), ("strain_platen,stress_pa", 1, 1),
                ("Strain (µm/m),Spannung / bar", 1e-6, 1e5), ("Dehnung,Spannung\n%,MPa", 1e-2, 1e6), ("Strain (-),Stress [GPa]", 1, 1e9)):
            self.expect(header + "\n" + self.body(), strain, stress)

    def test_load_and_displacement_are_over_the_size_of_the_specimen(self):
        for header in ("Displacement, mm,Load kN", "Weg (mm),Kraft [kN]", "LVDT mm,Force_kN"):
            curve = self.expect(header + "\n" + self.body(), 1e-3 / 0.1, 1e3 / 2e-3, area=2e-3, height=0.1)
            self.assertIn("over the height of 100 mm", curve.remarks[0])
            self.assertIn("over the area of 2000 mm2", curve.remarks[0])
        with self.assertRaisesRegex(InputError, "core.csv: 'Load kN' is a load: it needs the area of the specimen"):
            self.read("strain (%),Load kN\n" + self.body(), height=0.1)

    def test_separators_decimal_commas_codings_and_lines_above_the_header_are_understood(self):
        above = "Protocol;No 17\nArea;1963,5;mm2\nDate;12.03.2024\n\n"
        self.expect(above + "Dehnung in ‰;Spannung (N/mm²)\n" + self.body(";", "{:.2f}").replace(".", ","), 1e-3, 1e6, coding="cp1252")
        self.expect("# core 7\n# strain (%)\tstress (MPa)\n" + self.body("\t"), 1e-2, 1e6, coding="utf-16")
        self.expect('"Strain\n[%]","Stress, kPa"\n' + self.body(), 1e-2, 1e3)
        self.expect('strain (%),Load (kN)\n' + "".join(f'{x},"{1000 * y:,}.0"\n' for x, y in ROWS), 1e-2, 1e6, area=1)

    def test_the_axial_column_is_taken_and_others_are_not(self):
        rows = "".join(f"{k},-9,{x},7,50,{y}\n" for k, (x, y) in enumerate(ROWS))
        header = "Time (s),lateral strain (%),strain (mm/m),volumetric strain (%),confining pressure (MPa),axial stress (MPa)\n"
        curve = self.expect(header + rows, 1e-3, 1e6)
        self.assertEqual(curve.remarks, ["core.csv: strain from 'strain (mm/m)' and stress from 'axial stress (MPa)'"])
        alike = self.read("strain 1 (%),strain 2 (%),Stress (MPa)\n" + "".join(f"{x},{x},{y}\n" for x, y in ROWS))
        self.assertIn("other columns that fit: strain 2 (%)", alike.remarks[1])

    def test_compression_becomes_positive_and_an_offset_of_the_strain_goes_and_both_are_told(self):
        text = "Displacement (mm),Load (kN)\n" + "".join(f"{-x - 0.5},{-y}\n" for x, y in ROWS)
        curve = self.expect(text, 1e-2, 1e6, area=1e-3, height=0.1)
        said = " ".join(curve.remarks)
        for part in ("negative in the stress of the file", "negative in the strain of the file", "counts from its first value, -5 mm/m"):
            self.assertIn(part, said)

    def test_empty_cells_are_left_out_and_repeated_strains_become_their_mean(self):
        curve = self.expect("strain (%),stress (MPa)\n0,0\n1,8\n1,12\n,14\n2,20\n3,5\n4,\n4,4\n", 1e-2, 1e6)
        self.assertIn("a number is missing: 2", curve.remarks[1])
        self.assertIn("6 rows are thinned to 5", curve.remarks[2])

    def test_noise_is_thinned_and_keeps_strength_and_modulus(self):
        noise = numpy.random.default_rng(1)
        strain = numpy.linspace(0, 4, 4000)  # mm/m; a parabola of 40 MPa at 2 mm/m: its secant modulus between 10 and 40 % by hand
        stress = 40 * (1 - (1 - strain / 2) ** 2)
        stress[2000] = 40.3  # one row
        text = "".join(f"{x + noise.normal(0, 0.02):.4f},{y:.3f}\n" for x, y in zip(strain, stress))
        curve = self.read("strain (mm/m),stress (MPa)\n" + text)
        self.assertLess(len(curve.strain), 600)
        self.assertIn("4000 rows are thinned", curve.remarks[-1])
        modulus, strength, at, later = laboratory.figures(curve.strain, curve.stress)
        expected = 12.09e6 / (2e-3 * (math.sqrt(1 - 4.03 / 40) - math.sqrt(1 - 16.12 / 40)))
        self.assertAlmostEqual(modulus / expected, 1, delta=0.03)
        self.assertAlmostEqual(strength, 40.3e6)
        self.assertAlmostEqual(at, 2e-3, delta=1e-4)
        self.assertAlmostEqual(later, 30e6, delta=3e6)

    def test_what_is_not_recognised_is_told_with_the_header_and_how_to_name_columns(self):
        with self.assertRaises(InputError) as told:
            self.read("first,second\n" + self.body())
        for part in ("core.csv", "Header found: first | second", '--columns "strain=COLUMN,stress=COLUMN"'):
            self.assertIn(part, str(told.exception))
        for columns in ("strain/%=first,stress/MPa=second", "strain/%=1, stress/MPa=2"):
            self.expect("first,second\n" + self.body(), 1e-2, 1e6, columns=columns)
        self.expect("Displacement, mm;Load; t\n" + self.body(";"), 1e-2, 1e6, columns="displacement=Displacement, mm,load/kN=2", area=1e-3,
                    height=0.1)
        self.expect(self.body(), 1e-2, 1e6, columns="strain/%=1,stress/MPa=2")  # without any header
        for columns, why in (("strain=third", "'strain=third' does not fit its header"), ("strain", "is not understood"),
                             ("strain/kN=first", "is not understood at 'strain/kN=first'")):
            with self.assertRaisesRegex(InputError, why):
                self.read("first,second\n" + self.body(), columns=columns)
        with self.assertRaisesRegex(InputError, "no rows with two numbers"):
            self.read("")
        with self.assertRaisesRegex(InputError, "none.csv: cannot be read"):
            laboratory.read(self.folder / "none.csv")

    def run_with(self, stress, sign=1, **info):
        strain = [sign * 1e-3 * k for k in range(len(stress))]
        write_history(self.folder, {"axial_strain_platen": strain, "z": [sign * 1e6 * s for s in stress]})
        (self.folder / "summary.json").write_text(json.dumps(info))
        return TestRun(self.folder)

    def test_differences_are_of_the_run_from_the_laboratory_by_one_rule(self):
        curve = self.read("strain (mm/m),stress (MPa)\n0,0\n2,20\n3,10\n4,0\n")
        run = self.run_with([0, 5, 20, 25, 20, 15])  # peak at 3 mm/m; 2.5 at .5, 10 at 4/3 mm/m
        table = laboratory.differences(run, curve)
        self.assertEqual(table.header, ["figure", run.name, "laboratory", "difference (%)"])
        self.assertEqual([row[1:] for row in table.rows], [["9", "10", "-10"], ["25", "20", "25"], ["3", "2", "50"], ["17.5", "10", "75"]])
        unbroken = laboratory.differences(self.run_with([0, 5, 20, 25], peak_reached=False), curve)
        self.assertEqual([row[1:] for row in unbroken.rows][1], ["no peak reached", "20", "-"])
        short = laboratory.differences(self.run_with([0, 5, 20, 25, 20]), curve)
        self.assertEqual(short.rows[3][1:], ["-", "10", "-"])  # it ends before 1.5 times the strain at its peak

    def test_a_figure_that_is_not_valid_is_not_compared(self):
        curve = self.read("strain (mm/m),stress (MPa)\n0,0\n2,20\n3,10\n4,0\n")
        bent = self.run_with([0, 5, 20, 25, 20, 15], validity={"strength_pa": "valid", "youngs_modulus_platen_pa": ["a bent bar"],
                                                              "strain_at_peak_platen": ["closure is no strain"]})
        table = laboratory.differences(bent, curve)
        self.assertEqual([row[1] for row in table.rows], ["not valid", "25", "not valid", "not valid"])
        self.assertEqual([row[3] for row in table.rows], ["-", "25", "-", "-"])
        self.assertIn("Not valid: a bent bar; closure is no strain.", table.note)

    def test_the_chart_has_both_curves_with_the_sign_of_the_run(self):
        curve = self.read("strain (mm/m),stress (MPa)\n" + self.body())
        for sign in (1, -1):
            pictures = curves.pictures_of_curves(self.run_with([0, 5, 3], sign), curve)
            picture, = (picture for picture in pictures if picture.name == "laboratory")
            drawn = lines_of(picture)[0]
            numpy.testing.assert_allclose(drawn["laboratory"][2], [sign * 2, sign * 20])
            numpy.testing.assert_allclose(drawn[f"{self.folder.name}, between platens"][1], [sign * 1, sign * 5])
        self.assertNotIn("laboratory", [picture.name for picture in curves.pictures_of_curves(self.run_with([0, 5, 3]))])


if __name__ == "__main__":
    unittest.main()
