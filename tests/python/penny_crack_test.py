"""The stress intensity by which bench/flaws takes the finite bar out, beside finite elements and what is exact."""
import math
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "bench/flaws"))
import flaws
import penny


class PennyCrack(unittest.TestCase):
    def test_finite_elements_know_the_crack_in_an_endless_solid(self):
        # Sneddon 1946: K = 2/pi stress sqrt(pi a). A tenth of the radius: the bar counts .1 %, the elements .7 %.
        self.assertAlmostEqual(penny.factor(0.1) / (2 / math.pi), 1, delta=1e-2)

    def test_a_fit_of_the_book_agrees_with_finite_elements(self):
        for part in (0.2, 0.4, 0.6):
            self.assertAlmostEqual(flaws.shape(part) / penny.factor(part), 1, delta=8e-3)
        self.assertAlmostEqual(flaws.shape(0) / (2 / math.pi), 1, delta=1e-12)

    def test_half_of_a_bar_without_a_crack_is_as_stiff_as_its_material(self):
        # length over E A; a crack of a thousandth of the radius is none
        self.assertAlmostEqual(penny.compliance(1e-3, 3, False, 0.3) * math.pi / 3, 1, delta=1e-6)

    def test_ends_that_do_not_widen_load_the_middle_of_a_short_bar_more(self):
        # The more so, the smaller the crack and the nearer the ends; not at all if the bar does not contract.
        nearer, here, small = (penny.factor(part, height, True) / penny.factor(part) for part, height in ((0.25, 0.75), (0.5, 1.125), (0.25, 1.125)))
        self.assertAlmostEqual(small, 1.043, delta=2e-3)
        self.assertAlmostEqual(here, 1.025, delta=2e-3)
        self.assertGreater(nearer, small)
        self.assertAlmostEqual(penny.factor(0.25, 2, True, nu=0) / penny.factor(0.25, nu=0), 1, delta=3e-3)


if __name__ == "__main__":
    unittest.main()
