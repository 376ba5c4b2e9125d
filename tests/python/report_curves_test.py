"""Charts of runs: moments of the test, stress, energies, acoustic events, costs, stages, sides, strength under pressure."""
import json
import math
import unittest

import numpy
from report_folders import InFolder, lines_of, write_history

from platen.errors import InputError
from platen.report import comparison, curves, envelope, house
from platen.report.run import TestRun

MPA = 1e6


class WithRuns(InFolder):
    def run_of(self, columns, info=None, scene="", name="run", **files):
        """A TestRun of columns (see write_history), a summary, entries {path: value} and further files."""
        folder = self.folder / name
        folder.mkdir(exist_ok=True)
        write_history(folder, columns)
        (folder / "summary.json").write_text(json.dumps(info or {}))
        (folder / "scene.prm").write_text(scene)
        for file, text in files.items():
            (folder / file.replace("_", ".")).write_text(text)
        return TestRun(folder)


class Moments(WithRuns):
    def test_the_stress_is_the_mean_of_both_platens(self):
        run = self.run_of({"axial_stress_top_pa": [0, 10, 4], "axial_stress_bottom_pa": [0, 6, 12]})
        self.assertEqual(run.stress.tolist(), [0, 8, 8])

    def test_the_fall_to_eight_tenths_is_found_between_samples(self):
        run = self.run_of({"z": [0, 60, 100, 90, 70, 20]})
        self.assertEqual((run.peak_row, run.end_time), (2, 5))
        self.assertAlmostEqual(run.fall_time, 3.5)

    def test_the_largest_stress_is_a_peak_only_where_it_is_a_strength(self):
        stress = [0, 60, 100, 90, 70]
        for name, words, z, info in (("a", "peak", stress, {}), ("b", "largest stress", stress[:3], {}),
                                     ("c", "peak", stress[:3], {"peak_reached": True}),
                                     ("d", "largest stress", stress, {"peak_reached": False}),
                                     ("e", "largest stress", stress, {"peak_reached": True, "validity": {"strength_pa": ["too fast"]}})):
            run = self.run_of({"z": z}, info, name=name)
            label = list(lines_of(curves.pictures_of_curves(run)[0])[0])[0]
            self.assertTrue(label.startswith(f"axial, between platens: {words} 0.0001 MPa"), label)

    def test_a_dip_before_the_peak_is_no_fall(self):
        run = self.run_of({"z": [0, 90, 40, 100, 85]})
        self.assertEqual((run.peak_row, run.fall_time, run.pattern_time), (3, None, 4))

    def test_a_tension_test_has_its_peak_at_the_most_negative_stress(self):
        run = self.run_of({"z": [0, -2, -4, -2]})
        self.assertEqual(run.peak_stress, -4)
        self.assertAlmostEqual(run.fall_time, 2.4)

    def test_the_peak_is_along_the_axis_that_is_loaded(self):
        columns = {"z": [50] * 5, "stress_left_pa": [0, 5, 11, 10, 2], "stress_right_pa": [0, 5, 9, 12, 2], "strain_x": [0] * 5,
                   "stress_front_pa": [0, 30, 10, 0, 0], "stress_back_pa": [0, 32, 10, 0, 0], "strain_y": [0] * 5}
        x, y = self.run_of(columns, {"loaded_axis": "x"}), self.run_of(columns, {"loaded_axis": "y"}, name="y")
        self.assertEqual([(run.peak_row, run.peak_stress) for run in (x, y)], [(3, 11), (1, 31)])

    def test_a_history_without_samples_is_refused(self):
        with self.assertRaisesRegex(InputError, "no sample with a stress along z"):
            self.run_of({"z": []})

    def test_strains_count_from_the_end_of_consolidation(self):
        columns = {"z": [0, 2, 4, 40, 61, 30], "axial_strain_platen": [0, 5e-5, 1e-4, 9e-4, 1.4e-3, 2e-3]}
        run = self.run_of(columns, {"consolidation_end_time_s": 2.0})
        self.assertAlmostEqual(run.strain[run.peak_row], 1.3e-3)
        self.assertEqual(run.strain_title, "Axial strain between platens from the end of consolidation (mm/m)")
        axial = next(iter(lines_of(curves.pictures_of_curves(run)[0])[0].values()))
        numpy.testing.assert_allclose(axial, [[0, 4e-6], [0.8, 4e-5], [1.3, 6.1e-5], [1.9, 3e-5]])
        for name, told in (("bare", None), ("hydrostatic", 5.0)):  # all of it is consolidation: it counts from the start
            bare = self.run_of(columns, {"consolidation_end_time_s": told}, name=name)
            self.assertEqual((bare.zero, bare.strain_title), (0, "Axial strain between platens (mm/m)"))


class Curves(WithRuns):
    def test_kinds_of_strain_have_their_colours_and_lateral_strain_its_side(self):
        run = self.run_of({"z": [0, MPA, 2 * MPA], "axial_strain_gauge": [0, 1e-3, 3e-3], "lateral_strain": [0, -1e-4, -2e-4],
                           "volumetric_strain": [0, 1e-3, -5e-3], "broken_tension": [0, 1, 5]})
        axes = house.figure_of(curves.pictures_of_curves(run)[0]).axes
        colours = [line.get_color() for line in axes[0].lines if len(line.get_xdata()) > 1]
        self.assertEqual(colours, [house.BLACK, house.GREY, house.GREEN])
        numpy.testing.assert_allclose(axes[0].lines[3].get_xydata(), [[0, 0], [-0.1, 1], [-0.2, 2]])
        numpy.testing.assert_allclose(axes[2].lines[0].get_xydata(), [[0, 0], [1, 1], [2, -5]])
        self.assertEqual(axes[0].get_xlim(), axes[2].get_xlim())  # one strain axis
        told = json.loads(house._hover(axes[0].figure, "a"))
        self.assertEqual([panel["units"] for panel in told], [[" mm/m", " MPa"], [" mm/m", ""], [" mm/m", " mm/m"]])
        self.assertEqual(told[0]["curves"][0][1], "axial, between platens")
        self.assertLessEqual(axes[0].get_xlim()[1], 1.5 * 2)  # the largest strains are cut off
        self.assertNotIn("cut off", curves.pictures_of_curves(run)[0].caption)
        wide = self.run_of({"z": [0, MPA, 2 * MPA], "lateral_strain": [0, -1e-4, -3e-3]}, name="wide")
        self.assertIn("cut off", curves.pictures_of_curves(wide)[0].caption)

    def test_a_tension_test_is_drawn_with_tension_positive(self):
        run = self.run_of({"z": [0, -2 * MPA, -MPA], "axial_strain_platen": [0, -1e-4, -3e-4], "volumetric_strain": [0, -5e-5, -2e-4],
                           "boundary_work_j": [0, 1, 2]}, {"test": "tension"})
        pictures = curves.pictures_of_curves(run)
        above, volume = house.figure_of(pictures[0]).axes
        numpy.testing.assert_allclose(above.lines[0].get_xydata(), [[0, 0], [0.1, 2], [0.3, 1]])
        numpy.testing.assert_allclose(volume.lines[0].get_xydata(), [[0, 0], [0.1, 0.05], [0.3, 0.2]])
        self.assertEqual(above.lines[0].get_label(), "axial, between platens: peak 2 MPa at 0.1 mm/m")
        self.assertEqual((above.get_ylabel(), volume.get_xlabel()),
                         ("Axial stress (MPa), tension positive", "Strain (mm/m), tension positive"))
        numpy.testing.assert_allclose(lines_of(pictures[1])[0]["work of the platens"][:, 0], [0, 0.1, 0.3])

    def test_what_unloads_is_drawn_over_time(self):
        strain = [0, 1e-3, 0.5e-3, 2e-3]
        columns = {"z": [0, 2 * MPA, MPA, 3 * MPA], "axial_strain_platen": strain, "broken_tension": [0, 1, 2, 9],
                   "volumetric_strain": strain, "boundary_work_j": [0, 1, 0.5, 2]}
        run = self.run_of(columns)
        stress, bonds, volume = house.figure_of(curves.pictures_of_curves(run)[0]).axes
        energies = house.figure_of(curves.pictures_of_curves(run)[1]).axes[0]
        numpy.testing.assert_allclose(stress.lines[0].get_xdata(), [0, 1, 0.5, 2])
        for axes in (bonds, volume, energies):
            numpy.testing.assert_allclose(axes.lines[0].get_xdata(), [0, 1e3, 2e3, 3e3])  # ms
        self.assertEqual([axes.get_xlabel() for axes in (stress, bonds, volume, energies)],
                         ["Strain (mm/m), compression positive", "", "Time (ms)", "Time (ms)"])
        self.assertFalse(self.run_of({**columns, "axial_strain_platen": [0, 1e-3, 0.91e-3, 2e-3]}, name="nearly").goes_back)

    def test_plastic_work_is_named_by_its_law_and_what_is_zero_is_not_drawn(self):
        columns = {"z": [0, 1, 2], "boundary_work_j": [0, 5, 10], "bond_energy_j": [0, 4, 6], "plastic_work_j": [0, 1, 3],
                   "friction_work_j": [0, 0, 0], "contact_energy_j": [0, 0.1, 0.2], "energy_residual_j": [0, 0, 1e-3]}
        picture = curves.pictures_of_curves(self.run_of(columns, scene="subsection Effects\n set Bond = yielding parallel bond\nend\n"))[1]
        main, small = lines_of(picture)
        self.assertEqual(list(main), ["work of the platens", "elastic energy of bonds", "plastic work of bonds (yielding parallel bond)"])
        self.assertEqual(list(small), ["elastic energy of contacts", "residual"])
        tiny = self.run_of({**columns, "contact_energy_j": [0, 1e-6, 2e-6], "energy_residual_j": [0, 0, 1e-6]}, name="tiny")
        axes = house.figure_of(curves.pictures_of_curves(tiny)[1]).axes[1]
        self.assertEqual((axes.get_ylabel(), axes.lines[0].get_ydata()[2]), ("Energy (mJ)", 2e-3))
        columns["contact_energy_j"], columns["body_energy_j"] = [0, 1, 2], [0, 0.1, 0.2]  # a fifth of the work
        main, small = lines_of(curves.pictures_of_curves(self.run_of(columns, name="other"))[1])
        self.assertIn("elastic energy of contacts", main)
        for machine, bodies in (("", "platens"), ("1", "platens and machine")):
            scene = f"subsection Platens\nset Kind = deformable\nset Machine stiffness = {machine}\nend\n"
            run = self.run_of(columns, scene=scene, name=bodies)
            self.assertIn(f"elastic energy of {bodies}", lines_of(curves.pictures_of_curves(run)[1])[1])

    def test_damage_is_not_called_broken_bonds_where_the_law_softens(self):
        columns = {"z": [0, 1, 2], "boundary_work_j": [0, 5, 10], "fracture_work_j": [0, 1, 3]}
        for law, words in (("parallel bond", "broken bonds"), ("elasto damage plastic", "damage of bonds"), ("facet", "damage and slip of bonds")):
            run = self.run_of(columns, scene=f"subsection Effects\n set Bond = {law}\nend\n", name=law)
            self.assertEqual(list(lines_of(curves.pictures_of_curves(run)[1])[0]), ["work of the platens", words])

    def test_discs_and_cells_have_their_pictures(self):
        names = lambda run: [picture.name for picture in curves.pictures_of_curves(run)]  # noqa: E731
        disc = self.run_of({"z": [0, MPA, 0], "opening_m": [0, 1e-4, 2e-3], "broken_tension": [0, 1, 9]}, name="disc")
        self.assertEqual((names(disc), disc.strain_title), (["opening"], "Closure over the diameter (mm/m)"))
        stress, bonds = lines_of(curves.pictures_of_curves(disc)[0])
        numpy.testing.assert_allclose(list(stress.values())[0], [[0, 0], [0.1, 1], [2, 0]])
        numpy.testing.assert_allclose(bonds["broken in tension"], [[0, 0], [0.1, 1], [2, 9]])
        self.assertAlmostEqual(house.figure_of(curves.pictures_of_curves(disc)[0]).axes[0].get_xlim()[1], 1)  # ten times that at the peak
        cell = self.run_of({"z": [0, 9, 0], "deviator_pa": [0, 6 * MPA, -3], "confining_pressure_pa": [0, 3, 3]}, name="cell")
        self.assertEqual(names(cell), ["stress_strain", "confinement", "stress_path"])
        self.assertEqual([axes.get_xlabel() for axes in house.figure_of(curves.pictures_of_curves(cell)[1]).axes],
                         ["", "Axial strain between platens (mm/m)", "Time (ms)"])
        drawn = lines_of(curves.pictures_of_curves(cell)[1])[0]
        numpy.testing.assert_allclose(drawn["axial stress less the pressure of the cell"][1], [1, 6])


class Acoustic(WithRuns):
    B = {"b_before": 1.5, "b_before_error": 0.1, "b_before_events": 100, "b_before_limit": -6, "b_after": None, "b_after_error": None,
         "b_after_events": 3, "b_after_limit": None, "b_after_reason": "3 events"}

    def heard(self, **more):
        return self.run_of({"z": [0, 2, 1]}, {"acoustic": {**self.B, **more}},
                           events_csv="time_s,magnitude\n0.5,-5\n0.2,-6\n0.9,-4\n0.9,\n1,-3\n1.5,-5.5\n")

    def test_events_are_counted_from_the_large_ones_down_on_their_side_of_the_peak(self):
        chart, = lines_of(curves.pictures_of_events(self.heard())[0])
        self.assertEqual(chart["4 events before the peak"].tolist(), [[-6, 4], [-5, 3], [-4, 2], [-3, 1]])
        self.assertEqual(chart["1 events after the peak: no b-value"].tolist(), [[-5.5, 1]])

    def test_the_law_has_all_counted_events_at_its_limit_and_falls_by_b(self):
        law, reason = curves.power_law(self.heard(), True)
        self.assertEqual(reason, "")
        self.assertAlmostEqual(math.log10(law.count(-6)), 2)
        self.assertAlmostEqual(math.log10(law.count(-5)), 0.5)
        self.assertAlmostEqual(law.end, -6 + 2 / 1.5)  # where one event is left

    def test_no_b_value_is_told_with_its_reason(self):
        run = self.heard()
        self.assertEqual(curves.power_law(run, False), (None, "3 events"))
        self.assertIn("No b-value after the peak: 3 events.", curves.pictures_of_events(run)[0].caption)
        self.assertIn("M = (log10(E/J) - 4.8)/1.5", curves.pictures_of_events(run)[0].caption)
        self.assertEqual(curves.power_law(self.run_of({"z": [0, 1]}, name="none"), True), (None, ""))

    def test_a_law_is_drawn_over_its_range_alone(self):
        run = self.heard(b_before_upper=-5, b_before_above=7)
        law = curves.power_law(run, True)[0]
        self.assertAlmostEqual(law.count(-6), 107)
        self.assertAlmostEqual(law.count(-5), 7)
        chart, = lines_of(curves.pictures_of_events(run)[0])
        drawn = chart["b = 1.50 +- 0.10 before the peak, M from -6.0 to -5.0: 100 events"]
        self.assertEqual((drawn[0, 0], drawn[-1, 0]), (-6, -5))


class Costs(WithRuns):
    def test_the_largest_comes_first_the_rest_last_and_all_make_the_wall_clock(self):
        run = self.run_of({"z": [0, 1]}, {"wall_seconds": 20.0, "setup_seconds": 4.0,
                                          "stage_seconds": {"motion": 2.0, "bonds": 9.0, "stable_step": 1.5, "bodies": 0.0}})
        found = curves.costs_of(run)
        self.assertEqual(found[:4], [("forces of bonds", 9, True), ("setting up", 4, False), ("motion of the spheres", 2, True),
                                     ("choice of the time step", 1.5, True)])
        self.assertEqual((found[4][0], sum(cost[1] for cost in found)), ("other", 20))

    def test_the_machine_is_that_of_the_log(self):
        run = self.run_of({"z": [0, 1]}, {"threads": 2, "peak_memory_bytes": 190e6}, run_log="Platen\nmachine Difference Engine, 2 cores\n")
        self.assertEqual(curves.machine_words(run), "2 threads; Difference Engine, 2 cores; 190 MB of memory at most")
        self.assertEqual((curves.pictures_of_costs(run), curves.machine_words(self.run_of({"z": [0, 1]}, name="none"))), ([], ""))


class Stages(WithRuns):
    STRESS = [s * MPA for s in (0, 0.5, 1, 11, 21, 16, 6)]

    def staged(self, axis="z", name="run", **more):
        strain = [1e-10 * s for s in self.STRESS]
        columns = {"axial_strain_platen": strain, "lateral_strain": [-0.2 * e for e in strain], "z": self.STRESS,
                   "stage": [1, 1, 1, 2, 2, 2, 3]}
        columns |= more or {"stress_left_pa": [2.2 * s for s in self.STRESS], "stress_right_pa": [1.8 * s for s in self.STRESS],
                            "strain_x": [3 * e for e in strain]}
        info = {"loaded_axis": axis, "consolidation_end_time_s": 2, "stages": [
            {"stage": 1, "ended_by": "not settled"}, {"stage": 2, "ended_by": "share of peak"}, {"stage": 3, "ended_by": None}]}
        scene = ("subsection Loading\n  subsection Stage 1\n    set Top = stress 1 MPa\n    set Lateral x = hold\n    set Until = settled\n"
                 "  end\n  subsection Stage 2\n    set Axial = rate\n    set Until =\n  end\nend\n")
        return self.run_of(columns, info, scene, name)

    def test_a_stage_begins_at_the_last_row_of_the_one_before(self):
        run = self.staged()
        self.assertEqual(curves.stages_of(run), [(1, 0, 2), (2, 2, 5), (3, 5, 6)])
        self.assertEqual([curves.stage_words(run, k) for k in (1, 2, 3)], ["Lateral x hold, Top stress 1 MPa", "Axial rate", ""])
        drawn = lines_of(curves.section_of_stages(run).pictures[0])[0]
        numpy.testing.assert_allclose(drawn["2: Axial rate"], [[0, 1], [1, 11], [2, 21], [1.5, 16]], atol=1e-12)

    def test_the_table_counts_from_the_end_of_the_consolidation(self):
        self.assertEqual(curves.table_of_stages(self.staged()).rows, [  # s1 = 6, s2 = 12, s3 = 0 MPa: q = sqrt((36 + 36 + 144) / 2)
            ["1", "Lateral x hold, Top stress 1 MPa", "settled", "not settled", "2000", "0", "0", "1", "1", "1.732"],
            ["2", "Axial rate", "-", "share of peak", "5000", "1.5", "-0.3", "16", "21", "27.71"],
            ["3", "-", "-", "-", "6000", "0.5", "-0.1", "6", "16", "10.39"]])

    def test_a_test_along_x_has_the_strain_of_its_platens_and_across_those_of_the_others(self):
        run = self.staged("x")
        self.assertEqual(curves.table_of_stages(run).rows[1][5:8], ["4.5", "1.5", "32"])
        self.assertEqual(run.strain_title, "Strain along x between platens from the end of consolidation (mm/m)")

    def test_a_circumference_that_is_measured_is_the_strain_across(self):
        run = self.staged(circumferential_strain=[0, 1e-4, 2e-4, 3e-4, 4e-4, 7e-4, 9e-4], confining_pressure_pa=[MPA] * 7)
        table = curves.table_of_stages(run)
        self.assertEqual((table.header[6], table.rows[1][6], table.rows[1][9]), ("circumferential strain (mm/m)", "-0.5", "15"))
        self.assertIsNone(curves.section_of_stages(self.run_of({"z": [0, 1]}, name="none")))


class Sides(WithRuns):
    def pressed(self, axial, pressure=0, name="run", scene="", **sides):
        shares = [0, 0.5, 1, 0.5]
        columns = {"axial_stress_top_pa": [1.01 * axial * k for k in shares], "axial_stress_bottom_pa": [0.99 * axial * k for k in shares],
                   "confining_pressure_pa": [pressure * k for k in shares]}
        for side, stress in sides.items():
            columns |= {f"stress_{side}_pa": [stress * k for k in shares], f"friction_work_{side}_j": [0, 1, 2, 0.75]}
        return self.run_of(columns, scene=scene, name=name)

    def test_platens_are_known_by_their_columns(self):
        self.assertEqual(curves.sides_of(self.pressed(10)), ["bottom", "top"])
        self.assertEqual(curves.sides_of(self.pressed(10, name="four", front=2, back=2)), ["bottom", "top", "front", "back"])
        self.assertIsNone(curves.section_of_sides(self.pressed(10, 3, "cell")))

    def test_stress_paths_are_those_of_closed_forms(self):
        s = 30 * MPA
        for k, (p, q, run) in enumerate((
                (s / 3, s, {"axial": s}), (2 * s / 3, s, {"axial": s, "left": s, "right": s}),
                (5 * s / 9, 2 * s / 3, {"axial": s, "pressure": s / 3}),
                (s, 0, {"axial": s, "left": s, "right": s, "front": s, "back": s}),
                (s, math.sqrt(3) * s, {"axial": 2 * s, "left": 0.8 * s, "right": 1.2 * s}))):
            path = curves.stress_path(self.pressed(name=str(k), **run))
            numpy.testing.assert_allclose([path[0][2], path[1][2]], [p, q], rtol=1e-12, atol=1e-6)
        self.assertEqual([curves.has_stress_path(run) for run in (
            self.pressed(s), self.pressed(s, 1, "a"), self.pressed(s, name="b", left=0, right=0))], [False, True, True])

    def test_the_table_has_a_row_for_each_platen(self):
        section = curves.section_of_sides(self.pressed(20 * MPA, left=3 * MPA, right=4 * MPA))
        self.assertEqual([row for row in section.tables[0].rows if row[0] in ("bottom", "right")],
                         [["bottom", "19.8", "19.8", "-"], ["right", "4", "4", "0.75"]])
        numpy.testing.assert_allclose(lines_of(section.pictures[0])[0]["right"][2], [2, 4])

    def test_biaxial_strength_is_over_that_of_free_sides_between_the_same_platens(self):
        def run(name, axial, surface="brush", mesh="", pressure=0, **sides):
            scene = (f"subsection Platens\n  set Surface = {surface} # as used\n  subsection Top\n    set Surface = common\n"
                     f"    set Mesh file = {mesh}\n  end\nend\n")
            return self.pressed(axial * MPA, pressure * MPA, name, scene, **{side: stress * MPA for side, stress in sides.items()})

        unbroken = run("unbroken", 45, left=9, right=9)
        unbroken.fall_time = None
        runs = [run("both", 46, left=46, right=46), run("bare", 40), run("across", 20, front=48, back=48),
                run("other", 50, "dry steel", left=25, right=25), run("all", 80, left=9, right=9, front=8, back=8), unbroken,
                run("cell", 90, pressure=9)]
        points, left_out = comparison.biaxial_strengths(runs)
        self.assertEqual([(point.run, point.surface) for point in points], [("both", "brush"), ("bare", "brush"), ("across", "brush")])
        numpy.testing.assert_allclose([point[2:] for point in points], [(1.15, 1.15), (1, 0), (1.2, 0.5)])
        reasons = ("other has no run with the same specimen", "all is pressed along three axes", "unbroken has not failed")
        for said, why in zip(left_out, reasons, strict=True):
            self.assertIn(why, said)
        self.assertEqual([picture.name for picture in comparison.pictures(runs)],
                         ["comparison_stress_strain", "comparison_stress_path", "comparison_envelope", "comparison_biaxial"])
        numpy.testing.assert_allclose(lines_of(comparison.pictures(runs)[3])[0]["brush"], [[1.15, 1.15], [1, 0], [1.2, 0.5]])
        self.assertIn("both: 1.15 and 1.15 (brush)", comparison.pictures(runs)[3].caption)
        self.assertEqual(comparison.strengths_in_cells(runs), [(0, 40), (9, 90)])
        circle = lines_of(comparison.pictures(runs)[2])[1]["9 MPa on the sides"]
        numpy.testing.assert_allclose([circle[0], circle[45], circle[-1]], [[9, 0], [49.5, 40.5], [90, 0]], atol=1e-9)
        pins = comparison.biaxial_strengths([run("bare", 40), run("pins", 46, mesh="meshes/pins.msh", left=23, right=23),
                                             run("bare pins", 46, mesh="meshes/pins.msh")])[0]
        self.assertEqual((pins[1].surface, pins[1].first), ("brush, mesh pins", 1))  # no other brush is their reference
        self.assertEqual([picture.name for picture in comparison.pictures([run("bare", 40)] * 2)], ["comparison_stress_strain"])


class Envelope(unittest.TestCase):
    def test_a_line_through_its_own_points_gives_q_k_c_and_phi_back_and_touches_the_circles(self):
        line = envelope.fit_line([0, 2, 7], [20 * math.sqrt(3) + 3 * p for p in (0, 2, 7)])
        numpy.testing.assert_allclose([line.k, line.q, line.phi, line.cohesion], [3, 20 * math.sqrt(3), 30, 10])
        self.assertEqual((line.low, line.high, line.misses), (0, 7, False))
        for p in (0, 2, 7):
            centre, angle = 0.5 * (line.at(p) + p), math.radians(line.phi)
            self.assertAlmostEqual(math.cos(angle) * (line.cohesion + centre * math.tan(angle)), 0.5 * (line.at(p) - p))

    def test_standard_errors_are_those_of_least_squares(self):
        line = envelope.fit_line([0, 1, 2, 3], [10, 15, 18, 23])  # 10.2 + 4.2 p, residuals -.2 .6 -.6 .2
        numpy.testing.assert_allclose([line.q, line.k, line.error, line.k_error, line.q_error],
                                      [10.2, 4.2, math.sqrt(0.4), math.sqrt(0.4 / 5), math.sqrt(0.4 * (1 / 4 + 2.25 / 5))])
        numpy.testing.assert_allclose(line.residual, 0.6 / 15)
        step = 1e-6  # c and phi by differences, with the covariance of q and k
        c = lambda q, k: q / (2 * math.sqrt(k))  # noqa: E731
        by_q, by_k = (c(10.2 + step, 4.2) - c(10.2, 4.2)) / step, (c(10.2, 4.2 + step) - c(10.2, 4.2)) / step
        variance = by_q**2 * line.q_error**2 + by_k**2 * line.k_error**2 - 2 * by_q * by_k * 1.5 * line.k_error**2
        self.assertAlmostEqual(line.cohesion_error, math.sqrt(variance), 5)
        phi = lambda k: math.degrees(math.asin((k - 1) / (k + 1)))  # noqa: E731
        self.assertAlmostEqual(line.phi_error, (phi(4.2 + step) - phi(4.2)) / step * line.k_error, 4)

    def test_one_pressure_or_a_falling_strength_gives_no_angle(self):
        self.assertTrue(math.isnan(envelope.fit_line([3, 3], [40, 41]).k))
        falling = envelope.fit_line([0, 10], [40, 45])
        self.assertEqual(falling.k, 0.5)
        self.assertTrue(math.isnan(falling.phi) and math.isnan(falling.error))

    def test_a_curve_stands_where_the_line_misses(self):
        p = numpy.array([0, 5, 10, 20, 40])
        line = envelope.fit_line(p, p + 40 * numpy.sqrt(12 * p / 40 + 1))
        self.assertTrue(line.misses)
        numpy.testing.assert_allclose([line.sc, line.m], [40, 12])
        drawn = lines_of(house.chart("mohr", "", lambda axes: envelope.mohr(axes, list(zip(p, line.curve(p))), line), heights=4))[0]
        curve = drawn["Hoek and Brown: sc = 40.0 MPa, m = 12.0"]
        s1, centre = line.curve(40.0), 0.5 * (40 + line.curve(40.0))  # its end touches the last circle
        self.assertAlmostEqual(math.hypot(curve[-1, 0] - centre, curve[-1, 1]), 0.5 * (s1 - 40))

    def test_mohr_circles_are_circles(self):
        axes = house.figure_of(house.chart("mohr", "", lambda axes: envelope.mohr(axes, [(0, 40), (5, 60)]), heights=4)).axes[0]
        box, size = axes.get_position(), axes.figure.get_size_inches()
        (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
        self.assertAlmostEqual((right - left) / (box.width * size[0]), (high - low) / (box.height * size[1]))

    def test_codes_are_as_published(self):
        self.assertAlmostEqual(envelope.strength_en_1998_3(40, 10), 40 * (1 + 3.7 * 0.303549), 3)  # (10/40)^.86
        self.assertEqual(envelope.strength_richart(40, 10), 81)


if __name__ == "__main__":
    unittest.main()
