"""Pages of packings, bond tests, bars and calibrations: numbers against closed forms, what is drawn, what is refused."""
import json
import math
import unittest

import numpy
from report_folders import InFolder

from platen.errors import InputError
from platen.report import house, pages, programs

BONDS = "run,modulus_pa,stiffness_ratio,force_n,displacement_m,moment_nm,rotation_rad,strain_ratio\n"
TWO = numpy.array([[0, 0, 1], [0, 0, 3.0]])


class OfPrograms(InFolder):
    def page(self, info, **files):
        for name, text in {"summary.json": json.dumps(info) if info else "", **files}.items():
            if text:
                (self.folder / name).write_text(text)
        return programs.page_of(self.folder)

    @staticmethod
    def axes(made, name):
        return house.figure_of(next(picture for section in made.sections for picture in section.pictures if picture.name == name)).axes

    def refused(self, words, *arguments, **files):
        with self.assertRaisesRegex(InputError, words):
            self.page(*arguments, **files)


class Packings(OfPrograms):
    SPHERES = ("# shape: cylinder radius_m=0.01 height_m=0.03\nx_m,y_m,z_m,radius_m\n0,0,0.005,0.004\n0,0,0.014,0.005\n"
               "0,0,0.024,0.004\n")

    def test_slices_hold_the_volume_of_their_spheres(self):
        radius = numpy.ones(2)
        for slices in (1, 2, 7, 40):
            height, share = programs.density_profile(TWO[:, 2], radius, 4, 4, slices)
            self.assertAlmostEqual((share * 4 * 4 / slices).sum(), 8 * math.pi / 3, delta=1e-12)
            self.assertAlmostEqual(height[0], 2 / slices)
        share = programs.density_profile(TWO[:, 2], radius, 4, 4, 8)[1]
        self.assertAlmostEqual(share[0], math.pi * 0.25 * 2.5 / 3 / 2, delta=1e-12)  # a cap of height 1/2: pi h^2 (3 r - h) / 3

    def test_neighbours_are_counted_within_the_gap(self):
        apart = TWO + [[0, 0, 0], [0, 0, 0.02]]
        self.assertEqual(programs.neighbours(apart, numpy.ones(2), 0.021).tolist(), [1, 1])
        self.assertEqual(programs.neighbours(apart, numpy.ones(2), 0.019).tolist(), [0, 0])
        x, y, z = numpy.meshgrid(*[numpy.arange(-4, 5)] * 3)
        cube = numpy.column_stack([x.ravel(), y.ravel(), z.ravel()]) * 2.0
        count = programs.neighbours(cube, numpy.ones(len(cube)), 1e-9)
        self.assertEqual((count[numpy.abs(cube).max(1) < 7].tolist(), count.min()), ([6] * 343, 3))
        near = programs.neighbours(cube, numpy.ones(len(cube)), 0.9)  # sqrt(8) - 2 < .9: the twelve diagonals too
        self.assertEqual(set(near[numpy.abs(cube).max(1) < 7]), {18})

    def test_a_packing_has_its_sizes_its_density_and_its_numbers(self):
        info = {"app": "platen-pack", "scene": "Three <spheres>", "packing_fraction": 0.1, "steps": 3}
        made = self.page(info, **{"specimen.csv": self.SPHERES})
        self.assertEqual(made.sections[0].tables[0].rows, [["packing_fraction", "0.1"]])
        sizes, coordination = self.axes(made, "sizes")
        self.assertAlmostEqual(sum(bar.get_height() for bar in sizes.patches), 100)
        self.assertIn("3 spheres", made.sections[0].pictures[0].caption)
        self.assertEqual(coordination.lines[0].get_ydata().sum(), 100)
        self.assertAlmostEqual(self.axes(made, "density")[0].lines[1].get_ydata()[0],
                               4 * math.pi / 3 * (2 * 4**3 + 5**3) / (math.pi * 100 * 30))
        text = pages.write(made, self.folder / "pictures", say=lambda _: None).read_text()
        self.assertIn("Three &lt;spheres&gt;", text)
        self.assertNotIn("<spheres>", text)

    def test_a_packing_without_a_summary_or_a_shape_says_so(self):
        made = self.page(None, **{"specimen.csv": self.SPHERES.partition("\n")[2]})
        self.assertEqual(made.remarks, ["density over the height is drawn for cylinders and boxes only",
                                        "summary.json is not there: its figures are left out"])
        (self.folder / "history.csv").touch()
        self.assertIsNone(programs.page_of(self.folder))

    def test_damage_is_said_with_the_file(self):
        self.refused("specimen.csv: no column radius_m", {"app": "platen-pack"}, **{"specimen.csv": "x_m,y_m,z_m\n1,2,3\n"})
        self.refused("specimen.csv: column z_m holds something else", None, **{"specimen.csv": "x_m,y_m,z_m,radius_m\n1,2,high,4\n"})
        self.refused("specimen.csv: damaged: no spheres", None, **{"specimen.csv": "x_m,y_m,z_m,radius_m\n1,2,3,0\n"})


class Bonds(OfPrograms):
    def test_loads_are_drawn_over_displacements_from_rest(self):
        made = self.page({"app": "platen-bonds", "runs": [{"modulus_pa": 1e11, "stiffness": 1.66667e8, "break_load": None}]},
                         **{"bonds.csv": BONDS + "1,1e11,0.5,500,3e-6,0,0,\n1,1e11,0.5,1000,6e-6,0,0,\n"})
        self.assertEqual(made.sections[0].tables[0].rows[0], ["1", "100", "-", "1.667e+08", "-"])
        measured, = self.axes(made, "bonds")[0].lines
        self.assertEqual(measured.get_label(), "modulus 100 GPa, stiffness ratio 0.5")
        numpy.testing.assert_allclose(measured.get_xydata(), [[0, 0], [3, 500], [6, 1000]])

    def test_a_bond_that_is_bent_is_drawn_by_its_moment(self):
        made = self.page({"app": "platen-bonds"}, **{"bonds.csv": BONDS + "1,1e11,0.5,0,0,2,3,\n"})
        measured, = self.axes(made, "bonds")[0].lines
        numpy.testing.assert_allclose(measured.get_xydata()[1], [3000, 2])

    def test_strain_ratios_of_three_bonds_have_a_chart_of_their_own(self):
        rows = "".join(f"{run},1e11,{ratio},-1,-2e-9,0,0,{nu}\n"
                       for run, ratio, nu in ((1, 0.5, 0.1), (1, 0.5, 1 / 7), (2, 0.6, 1 / 9)))
        load, strain = self.axes(self.page({"app": "platen-bonds"}, **{"bonds.csv": BONDS + rows}), "bonds")
        self.assertEqual(len(load.lines), 2)
        numpy.testing.assert_allclose(strain.lines[0].get_xydata(), [[0.5, 1 / 7], [0.6, 1 / 9]])

    def test_a_missing_column_is_refused_and_no_row_is_said(self):
        self.refused("bonds.csv: no column modulus_pa", {"app": "platen-bonds"}, **{"bonds.csv": "run,force_n\n1,5\n"})
        made = self.page({"app": "platen-bonds"}, **{"bonds.csv": BONDS})
        self.assertEqual(made.remarks, ["bonds.csv has no row: there is nothing to draw"])


class Bars(OfPrograms):
    def test_a_bar_stands_beside_strength_of_materials(self):
        info = {"app": "platen-bar", "tension": {"static_displacement_m": 1.1e-5, "static_by_hand": 1e-5, "static_error_effective": -0.02}, "bulk": {"poisson_ratio": 0.17}}
        made = self.page(info, **{"history.csv": "time_s,load,end_x_m,end_z_m,end_twist_rad\n1,tension,0,1e-5,0\n1.001,tension,0,-1e-5,0\n"
                                                 "2,impact,0,0,0\n"})
        self.assertEqual(made.sections[0].tables[0].rows, [["stretch under tension", "um", "11", "10", "1.1"],
                                                           ["Poisson's ratio, in bulk", "", "0.17", "-", "-"]])
        axes = self.axes(made, "bar")[0]
        numpy.testing.assert_allclose([bar.get_width() for bar in axes.patches], [10, -2])
        self.assertEqual([text.get_text() for text in axes.texts], ["+10.00 %", "-2.00 %"])
        motion, static = self.axes(made, "swings")[0].lines
        numpy.testing.assert_allclose(motion.get_xydata(), [[0, 10], [1, -10]], atol=1e-12)
        self.assertAlmostEqual(static.get_ydata()[0], 10)
        self.assertEqual(len(self.axes(made, "swings")), 1)

    def test_what_is_missing_is_said_and_refused(self):
        self.assertEqual(self.page({"app": "platen-bar"}).remarks,
                         ["history.csv is not there: no picture of how the bar oscillates",
                          "neither summary.json nor history.csv has a load: there is nothing to draw"])
        self.refused("history.csv: no column end_z_m", {"app": "platen-bar"}, **{"history.csv": "time_s,load\n0,tension\n1,tension\n"})


def calibrated():
    strength = {"key": "triaxial_strength_pa_2", "name": "strength at 9 MPa", "wanted": 43e6, "tolerance": 0.05,
                "met_in_training": True, "met": False,
                "training": {"mean": 42e6, "deviation": 1e6, "low": 41e6, "high": 43.2e6, "seeds": 3},
                "verification": {"mean": 40e6, "deviation": None, "low": 40e6, "high": 40e6, "seeds": 1}}
    curve = {"key": "curve_miss", "wanted": 0, "tolerance": 0.05, "met_in_training": True, "training_miss": 0.0453,
             "training": {"mean": 0.0576, "deviation": 0.01, "low": 0.05, "high": 0.06, "seeds": 5}}
    return {"app": "platen-calibrate", "scene": "Made-up bonds", "targets": [strength, curve],
            "missed": ["gain by friction: 1.45 is out of reach"], "targets_missed": ["compressive strength, MPa: wanted 43"],
            "found": {"bond_modulus_pa": 48e9, "friction_angle_rad": math.pi / 6}}


class Calibrations(OfPrograms):
    def test_targets_stand_beside_calibrated_values_and_a_curve_by_what_it_is_judged_by(self):
        made = self.page(calibrated())
        targets, found = made.sections[0].tables
        self.assertEqual(targets.rows, [["strength at 9 MPa (MPa)", "43", "41 ... 43.2 (3)", "40 (1)", "5 %", "no"],
                                        ["curve miss", "the curve", "error 4.53 %", "-", "5 %", "yes"]])
        self.assertEqual(found.rows, [["bond modulus (GPa)", "48"], ["friction angle (degrees)", "30"]])
        self.assertEqual((made.title, made.remarks), ("Made-up bonds", ["not met together: gain by friction: 1.45 is out of reach"]))
        self.assertEqual(made.leads[0], "Not met: 1 target.")

    def test_values_are_drawn_over_their_targets_within_the_tolerance(self):
        axes = self.axes(self.page(calibrated()), "targets")[0]
        numpy.testing.assert_allclose([line.get_xdata()[0] for line in axes.lines if line.get_marker() in "os"], [42 / 43, 40 / 43])
        box = axes.patches[0]
        numpy.testing.assert_allclose([box.get_x(), box.get_x() + box.get_width()], [0.95, 1.05])
        self.assertEqual(len(axes.get_yticks()), 1)  # a curve has no ratio

    def test_curves_begin_at_rest_and_stand_in_the_order_of_their_numbers(self):
        rows = "0.001,20e6,18e6,17e6\n0.002,30e6,31e6,\n"
        files = {f"curve{end}.csv": f"strain_{of},wanted_pa,calibrated_pa,unseen_pa\n{rows}"
                 for end, of in (("", "platen"), ("_2", "gauge"), ("_10", "gauge"))}
        made = self.page(calibrated(), **files)
        self.assertEqual([picture.name for picture in made.sections[-1].pictures], ["curve", "curve_2", "curve_10"])
        axes = self.axes(made, "curve")[0]
        self.assertEqual({line.get_label(): line.get_xydata().tolist() for line in axes.lines}["target"], [[0, 0], [1, 20], [2, 30]])
        self.assertIn("between platens", axes.get_xlabel())
        self.refused("curve.csv: no column unseen_pa", calibrated(),
                     **{"curve.csv": "strain_platen,wanted_pa,calibrated_pa\n1,2,3\n"})

    def test_an_abacus_has_a_curve_for_each_choice_and_moduli_over_that_of_the_bonds(self):
        rows = [{"bond_modulus_pa": e, "stiffness_ratio": None, "radius_multiplier": r, "bond_poisson_ratio": nu,
                 "youngs_modulus_gauge_pa": e * r / 2, "poisson_ratio": nu * r}
                for r in (0.5, 1.0) for nu in (0.0, 0.3) for e in (65e9, 130e9)]
        young, poisson = self.axes(self.page({"app": "platen-calibrate", "abacus": rows}), "abacus")
        self.assertEqual([line.get_xydata().tolist() for line in young.lines], [[[0.5, 0.25], [1, 0.5]]] * 2)
        self.assertEqual(poisson.lines[1].get_ydata().tolist(), [0.15, 0.3])

    def test_damage_is_said_and_another_folder_passed_over(self):
        self.assertIsNone(self.page({"app": "platen-compress"}))
        damaged = calibrated()
        del damaged["targets"][0]["wanted"]
        self.refused("summary.json: damaged: no wanted", damaged)
        self.assertEqual(self.page({"app": "platen-calibrate", "targets": []}).remarks,
                         ["summary.json has no value of a target: there is no picture of them"])


if __name__ == "__main__":
    unittest.main()
