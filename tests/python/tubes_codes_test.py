"""Codes for steel tubes filled with concrete: against a tube computed by hand, and the tables of bench/results/tubes.md against the program."""
import os
import sys
import unittest
from pathlib import Path

SOURCE = Path(os.environ["PLATEN_SOURCE"])
sys.path.insert(0, str(SOURCE / "bench" / "tubes"))
import codes  # noqa: E402


def tube(**other):
    """100 mm x 5 mm x 300 mm, 300 and 40 MPa."""
    return codes.Tube({"author": "a", "year": "1", "specimen": "s", "diameter_mm": 100, "wall_mm": 5, "length_mm": 300, "steel_yield_mpa": 300,
                       "concrete_strength_mpa": 40, "concrete_strength_of": "cylinder", "largest_load_kn": 1000, "chosen": "1", "pair": "",
                       "greased": "0", **other})


class Codes(unittest.TestCase):
    def test_a_tube_is_as_computed_by_hand(self):
        """A_a = 475 pi mm2, A_c = 2025 pi mm2; E_cm = 22 GPa x 4^.3 = 33.346 GPa; (EI)_eff = 418.94 kN m2, so that N_cr = 183.77 MN over 150 mm;
        lambda = .061813, eta_a = .780906, eta_c = 3.821416."""
        self.assertAlmostEqual(tube().plain(), 702145.96, delta=0.1)
        self.assertAlmostEqual(tube().slenderness(), 0.0618129, delta=1e-7)
        self.assertAlmostEqual(tube().confined(), 968724.81, delta=0.1)

    def test_confinement_ends_at_a_slenderness_of_one_half(self):
        """eta_a is .25 (3 + 2 lambda); eta_c, below 0 from .4556 to .6326, never takes off:
        what is left is eta_a of the steel, and the plain sum from .5 on, also where eta_c would be above 0 again."""
        for slenderness, eta_a in ((0.47, 0.985), (0.5 - 1e-9, 1.0), (0.7, 1.0)):
            long = tube(length_mm=300 * slenderness / tube().slenderness())
            self.assertAlmostEqual(long.confined() / (eta_a * long.steel_area * long.f_y + long.concrete_area * long.f_c), 1, delta=1e-7)

    def test_a_cube_counts_as_eight_tenths(self):
        self.assertAlmostEqual(tube(concrete_strength_of="cube", concrete_strength_mpa=50).plain() / tube().plain(), 1, delta=1e-12)

    def test_limits_of_the_code_hold_for_steel_concrete_and_wall(self):
        allowed = {"steel_yield_mpa": (460, 461), "concrete_strength_mpa": (58, 58.1), "wall_mm": (1.42, 1.41)}  # 100/1.42 = 70.4, 90 x 235/300 = 70.5
        for key, (within, outside) in allowed.items():
            self.assertEqual([tube(**{key: within}).within_the_code(), tube(**{key: outside}).within_the_code()], [True, False], key)
        self.assertEqual([tube(concrete_strength_mpa=f).within_the_code() for f in (28, 27.9)], [True, False])


class Tests(unittest.TestCase):
    def test_chosen_tests_follow_the_rule(self):
        chosen = [tube for tube in codes.tubes() if tube.chosen]
        self.assertEqual(len(chosen), 30)
        self.assertTrue(all(0.1 <= tube.d <= 0.17 and not tube.greased and 1.8 <= tube.length / tube.d <= 3.2 for tube in chosen))
        ratios = [tube.t / tube.d for tube in chosen]
        self.assertEqual(ratios, sorted(ratios))

    def test_pairs_differ_by_grease_alone(self):
        pairs = codes.pairs()
        self.assertEqual(len(pairs), 3)
        for bonded, greased in pairs:
            self.assertEqual((bonded.pair, bonded.f_c, bonded.f_y, bonded.greased, greased.greased), (greased.pair, greased.f_c, greased.f_y, False, True))

    def test_the_page_has_the_tables_of_the_program(self):
        page = (SOURCE / "bench" / "results" / "tubes.md").read_text(encoding="utf-8")
        for row in codes.rows():
            self.assertIn(row, page)
