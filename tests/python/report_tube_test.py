"""The chart of a tube around a specimen has the numbers of the run."""
import math
import unittest

from report_curves_test import WithRuns
from report_folders import lines_of

from platen.report import tube

COLUMNS = {"z": [0, 40e6, 60e6], "total_load_n": [0, 9e3, 8e3], "tube_load_n": [0, 5e3, 3e3], "tube_axial_stress_pa": [0, 300e6, 200e6],
           "tube_hoop_stress_pa": [0, 0, 150e6], "tube_pressure_pa": [0, 0, 10e6]}


class Tubes(WithRuns):
    def test_what_each_bears_adds_up_and_the_largest_load_is_marked(self):
        lines = lines_of(tube.pictures_of_tube(self.run_of(COLUMNS))[0])[0]
        label = next(words for words in lines if words.startswith("tube and specimen"))
        self.assertEqual(label, "tube and specimen: at most 9 kN")
        for words, loads in ((label, [0, 9, 8]), ("specimen", [0, 4, 5]), ("tube", [0, 5, 3])):
            self.assertEqual([round(float(y), 9) for y in lines[words][:, 1]], loads, words)

    def test_von_mises_takes_compression_and_tension_with_their_signs(self):
        stress = tube.von_mises(self.run_of(COLUMNS))
        self.assertAlmostEqual(stress[1], 300e6)
        self.assertAlmostEqual(stress[2], math.sqrt(200**2 + 150**2 + 200 * 150) * 1e6, places=3)

    def test_a_wrap_shows_the_strains_of_its_hoops_instead_of_stresses(self):
        wrap = {**COLUMNS, "wrap_hoop_strain": [0, 0.002, 0.004], "wrap_largest_hoop_strain": [0, 0.003, 0.005], "wrap_torn_share": [0, 0, 0.25]}
        loads, hoops = lines_of(tube.pictures_of_tube(self.run_of(wrap))[0])
        self.assertIn("wrap and specimen: at most 9 kN", loads)
        for words, values in (("mean of the middle half", [0, 0.2, 0.4]), ("of any element not torn", [0, 0.3, 0.5]),
                              ("elements that have torn", [0, 0, 25])):
            self.assertEqual([round(float(y), 9) for y in hoops[words][:, 1]], values, words)

    def test_a_run_without_a_tube_has_no_such_picture(self):
        self.assertEqual(tube.pictures_of_tube(self.run_of({"z": [0, 1, 2]})), [])


if __name__ == "__main__":
    unittest.main()
