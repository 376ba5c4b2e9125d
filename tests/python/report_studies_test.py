"""Pages of studies: figures over packings, what is drawn over what, laboratories beside, errors over cost, what is refused."""
import json
import math
import shutil
import unittest

import numpy
from report_folders import InFolder, write_history

from platen.errors import InputError
from platen.report import house, pages, studies
from platen.report.words import Spread, over_packings


def spread(mean, half=0.0, runs=3):
    if mean is None:
        return {"mean": None, "deviation": None, "low": None, "high": None, "runs": 0}
    half = half if runs > 1 else 0
    return {"mean": mean, "deviation": half if runs > 1 else None, "low": mean - half, "high": mean + half, "runs": runs}


def case(name, strength, runs=3, half=2e6, **labels):
    return {"name": name, "runs": runs, "failed": 0, "strength_pa": spread(strength, half, runs),
            "youngs_modulus_gauge_pa": spread(24e9, 1e9, runs), "strain_at_peak_platen": spread(2.4e-3, 1e-4, runs), **labels}


def platens(surface, friction, slenderness, strength, pressure=0.0, **more):
    return case(f"{surface}_{slenderness}_{pressure:g}", strength, surface=surface, friction_static=friction, slenderness=slenderness,
                height_m=0.05 * slenderness, sphere_radius_m=0.002, confining_pressure_pa=pressure, without_peak=0, **more)


HUGHES, CORES, FREE = (
    {"effect": effect, "platens": of, "slenderness": slenderness, "mean": mean, "low": low, "high": high, "source": source}
    for effect, of, slenderness, mean, low, high, source in (
        (studies.GAIN, "steel", 1.0, 1.42, 1.21, 1.59, "Hughes, four mixes"),
        (studies.RELATIVE, "steel", 1.0, 1.15, 1.1, 1.2, "ASTM C42, factor"),
        (studies.RELATIVE, "free ends", 1.5, 1.02, 0.95, 1.1, "RILEM")))


def friction():
    """Steel, grease and glue at 1 and 2: cubes gain a half by steel."""
    cases = [platens(surface, mu, h, s) for h, strengths in ((1, (60e6, 40e6, 70e6)), (2, (44e6, 40e6, 45e6)))
             for surface, mu, s in zip(("dry steel", "grease", "glued"), (0.57, 0.0048, None), strengths)]
    gain, relative = ({**spread(mean, half), "effect": effect, "case": cases[0]["name"], "over": cases[over]["name"], **more}
                      for mean, half, effect, over, more in ((1.5, 0.05, studies.GAIN, 1, {"laboratory": HUGHES, "verdict": "within"}),
                                                             (1.36, 0.04, studies.RELATIVE, 3, {"laboratory": None})))
    return {"kind": "friction", "status": "done", "runs": 18, "failed_runs": 1, "cases": cases, "comparisons": [gain, relative],
            "laboratory": [HUGHES, {**HUGHES, "slenderness": 2.39}, CORES, FREE]}


def parameters(kind, *cases):
    return {"kind": kind, "status": "done", "runs": 9, "failed_runs": 0, "cases": list(cases)}


class OfStudies(InFolder):
    def setUp(self):
        super().setUp()
        self.folder = self.folder / "study"
        self.folder.mkdir()

    def page(self, study, **files):
        for name, text in {"study.json": json.dumps(study), **files}.items():
            (self.folder / name).write_text(text)
        return studies.page_of(self.folder)

    def run_of(self, name, stress, validity=None):
        folder = self.folder / "runs" / name
        folder.mkdir(parents=True)
        write_history(folder, {"axial_stress_top_pa": stress, "axial_stress_bottom_pa": stress})
        (folder / "summary.json").write_text(json.dumps({"status": "done", "validity": validity or {}}))

    @staticmethod
    def pictures(made):
        return {picture.name: picture for section in made.sections for picture in section.pictures}

    @staticmethod
    def curves(picture, row):
        """Lines of one chart by label, and the scattered symbols by label."""
        axes = house.figure_of(picture).axes[row]
        symbols = {of.get_label(): of for of in axes.collections if not of.get_label().startswith("_")}
        return {line.get_label(): line for line in axes.lines if len(line.get_xdata()) and line.get_transform() == axes.transData}, symbols

    def refused(self, study, words):
        with self.assertRaisesRegex(InputError, "study.json.*" + words):
            self.page(study)


class Cases(OfStudies):
    def test_a_deviation_is_of_five_packings_and_more_a_range_of_fewer(self):
        self.assertEqual(over_packings(spread(41.5e6, 1e6, 5), 1e-6).words(".1f"), "41.5 +- 1.0")
        self.assertEqual(over_packings(spread(41.5e6, 1e6, 4), 1e-6).words(".1f"), "40.5 ... 42.5")
        self.assertEqual(over_packings({**spread(41.5e6, 1e6, 5), "low": 0}, 1e-6)[1:3], (40.5, 42.5))
        self.assertEqual(over_packings(spread(41.5e6, 0, 1), 1e-6), (41.5, 41.5, 41.5, 1))
        self.assertEqual((Spread().words(".1f"), Spread(2, 1, 3, 2).words(".1f", 3)), ("-", "1.0 ... 3.0 (2)"))

    def test_tables_have_a_row_for_each_case_and_ratios_stand_beside_the_laboratory(self):
        study = friction()
        study["cases"][2]["without_peak"] = 2
        study["cases"][1]["failed"] = 1
        made = self.page(study)
        cases, ratios = made.head[-2], made.sections[0].tables
        self.assertEqual(cases.rows[0], ["dry steel_1_0", "dry steel", "1", "3", "58.0 ... 62.0"])
        self.assertEqual([row[-2:] for row in cases.rows[1:3]], [["2 of 3", "38.0 ... 42.0 (3)"], ["3", "> 68.0 ... 72.0"]])
        self.assertEqual(ratios[0].rows, [["dry steel, height/width 1", "grease, height/width 1", "1.450 ... 1.550", "1.42 (1.21 ... 1.59)",
                                           "within"]])
        self.assertIn("Hughes, four mixes", ratios[0].note)
        self.assertEqual(ratios[1].rows[0][3:], ["-", "-"])
        self.assertIn("glued, height/width 1: 2 of 3 runs reached no peak up to the target strain: its strength is not compared", made.remarks)
        self.assertEqual(made.remarks[-1], "1 of 18 runs failed: no mean contains them")
        self.assertLess(max(len(line) for table in [*made.head, *ratios] for line in table.text().splitlines()[:-1]), 121)

    def test_what_is_outside_the_laboratory_is_said_at_the_top_and_in_the_picture(self):
        study = friction()
        study["comparisons"][0].update({**spread(1.94, 0.05), "verdict": "outside"})
        study["comparisons"][1].update({**spread(None), "reason": "not calibrated"})
        study["comparisons"].append({**friction()["comparisons"][0], "case": "dry steel_2_0", "over": "grease_2_0"})
        made = self.page(study)
        self.assertEqual(made.leads[-1], "Laboratory: 1 of 2 ratios is outside the measured range.")
        self.assertEqual(made.remarks[0], "gain over free ends, dry steel, height/width 1: 1.890 ... 1.990 is above the laboratory's "
                                          "range, 1.21 ... 1.59 (Hughes, four mixes)")
        self.assertIn("slenderness 2, dry steel, height/width 1: not given: not calibrated", made.remarks[1])
        self.assertEqual(made.sections[0].tables[0].rows[0][-1], "above the range")
        texts = house.figure_of(self.pictures(made)["strength_friction"]).axes[1].texts
        self.assertEqual([(text.get_text(), text.xy) for text in texts], [("outside the laboratory's range", (0.57, 1.94))])
        study["comparisons"][0].update(spread(1.1, 0.05))
        self.assertIn("is below the laboratory's range", self.page(study).remarks[0])

    def test_strength_is_drawn_over_friction_and_slenderness_with_the_laboratory_beside(self):
        pictures = self.pictures(self.page(friction()))
        lines, _ = self.curves(pictures["strength_friction"], 0)
        self.assertEqual(lines["height/width 1"].get_xydata().tolist(), [[0.0048, 40], [0.57, 60]])  # glue is no friction
        lines, symbols = self.curves(pictures["strength_friction"], 1)
        self.assertEqual(next(iter(lines.values())).get_xydata().tolist(), [[0.0048, 1], [0.57, 1.5]])
        self.assertEqual(list(symbols), ["laboratory, height/width 1: Hughes"])
        place = symbols["laboratory, height/width 1: Hughes"].get_offsets()[0]
        self.assertGreater(place[0], 0.57)
        self.assertEqual(place[1], 1.42)
        lines, symbols = self.curves(pictures["strength_slenderness"], 0)
        self.assertEqual(lines["dry steel"].get_xydata().tolist(), [[1, 60], [2, 44]])
        _, symbols = self.curves(pictures["strength_slenderness"], 1)
        marks = [of.get_paths()[0].vertices.tolist() for of in symbols.values()]
        self.assertEqual(sorted(symbols), ["laboratory, free ends: RILEM", "laboratory, steel: ASTM C42"])
        self.assertNotEqual(*marks)
        self.assertEqual(symbols["laboratory, steel: ASTM C42"].get_offsets()[0][0], CORES["slenderness"])

    def test_one_packing_is_drawn_as_points_and_several_as_a_line_with_bars(self):
        several = parameters("packing", case("a", 40e6, gap_over_radius=0.02), case("b", 50e6, gap_over_radius=0.1))
        one = parameters("packing", case("a", 40e6, 1, gap_over_radius=0.02), case("b", 50e6, 1, gap_over_radius=0.1))
        for study, style in ((several, "-"), (one, "None")):
            made = self.page(study)
            self.assertEqual(made.leads, ["Strength 40.0 ... 50.0 MPa over 2 cases."])
            axes = house.figure_of(self.pictures(made)["study_packing"]).axes[0]
            self.assertEqual(axes.lines[0].get_linestyle(), style)
            ends = [path.vertices[:, 1].tolist() for path in axes.collections[0].get_paths()]
            self.assertEqual(ends, [[38, 42], [48, 52]] if style == "-" else [])

    def test_a_case_without_a_figure_is_a_gap_with_its_reason(self):
        cases = [case(f"gap_{gap}", strength, gap_over_radius=gap) for gap, strength in ((0.02, 40e6), (0.05, None), (0.1, 50e6))]
        for seed in (1, 2):
            self.run_of(f"gap_0.05_seed_{seed}", [0, 1e6], {"strength_pa": ["the stress was still rising"], "poisson_ratio": "valid"})
        made = self.page(parameters("packing", *cases))
        self.assertEqual(made.remarks, ["gap_0.05: no strength, 2 of 2 runs: the stress was still rising; a gap in the picture"])
        lines, _ = self.curves(self.pictures(made)["study_packing"], 0)
        self.assertTrue(math.isnan(next(iter(lines.values())).get_ydata()[1]))

    def test_rates_are_of_strain_where_the_scene_has_a_height(self):
        study = parameters("rate", case("slow", 40e6, axial_rate_m_s=0.03), case("fast", 42e6, axial_rate_m_s=0.24))
        self.assertEqual(self.page(study).head[-2].header[1], "speed (mm/s)")
        for height in ("60 mm", "6 cm", "0.06", "60000 um"):
            made = self.page(study, **{"scene.prm": f"subsection Specimen\n  set Height = {height}\nend\n"})
            self.assertEqual([row[1] for row in made.head[-2].rows], ["0.5", "4"])
        self.assertEqual(made.head[-2].header[1], "strain rate (1/s)")
        self.assertEqual(made.head[-1].rows[0], ["strain rate 0.5 1/s", "23.0 ... 25.0", "2.30 ... 2.50"])
        self.assertEqual(house.figure_of(self.pictures(made)["study_rate"]).axes[0].get_xscale(), "log")

    def test_of_sizes_what_counts_is_how_many_spheres_lie_across(self):
        size = lambda name, sphere, radius: case(name, 40e6, sphere_radius_m=sphere, radius_m=radius, height_m=4 * radius)  # noqa: E731
        made = self.page(parameters("size", size("a", 0.0025, 0.015), size("b", 0.0015, 0.015)))
        self.assertEqual([row[1] for row in made.head[-2].rows], ["6", "10"])
        made = self.page(parameters("size", size("a", 0.0025, 0.015), size("b", 0.0025, 0.03), size("c", 0.0015, 0.015)))
        lines, _ = self.curves(self.pictures(made)["study_size"], 0)
        self.assertEqual({name: line.get_xdata().tolist() for name, line in lines.items()},
                         {"radius 15 mm, height 60 mm": [6, 10], "sphere radius 2.5 mm": [12]})

    def test_curves_of_stress_have_a_colour_a_case_and_a_line_a_packing(self):
        for name, peak in (("a_seed_1", 4e7), ("a_seed_2", 5e7), ("b_seed_1", 6e7)):
            self.run_of(name, [0, peak, 1e6])
        (self.folder / "runs" / "b_seed_1" / "history.csv").write_text("time_s\n0\n")
        made = self.page(parameters("rate", case("a", 40e6, axial_rate_m_s=0.03), case("b", 42e6, axial_rate_m_s=0.24)))
        axes = house.figure_of(self.pictures(made)["stress_strain"]).axes[0]
        self.assertEqual([line.get_xydata()[1].tolist() for line in axes.lines], [[1, 40], [1, 50]])
        self.assertEqual(len({line.get_color() for line in axes.lines}), 1)
        self.assertRegex(made.remarks[-1], "b_seed_1: its curve is left out: no column")

    def test_a_study_of_one_case_has_no_curve(self):
        made = self.page(parameters("rate", case("only", 40e6, axial_rate_m_s=0.03)))
        self.assertEqual(made.remarks, ["one case: there is no curve to draw"])
        study = friction()
        study.update(cases=[study["cases"][0], study["cases"][3]], comparisons=study["comparisons"][1:])
        self.assertEqual(list(self.pictures(self.page(study))), ["strength_slenderness"])

    def test_strengths_under_pressures_have_a_line_of_failure(self):
        cases = [platens("dry steel", 0.57, 2, 40e6 + 4 * p, p) for p in (0.0, 5e6, 10e6)]
        study = {**friction(), "cases": cases, "comparisons": []}
        self.assertIn("without envelopes: no line of failure", self.page(study).remarks[-1])
        keys = ("pressure_low_pa", "pressure_high_pa", "cohesion_pa", "cohesion_error_pa", "friction_angle_deg", "friction_angle_error_deg",
                "q_pa", "q_error_pa", "k", "k_error", "residual_error_pa", "largest_miss", "hoek_brown_sc_pa", "hoek_brown_m")
        said = dict(zip(keys, (0, 10e6, 11e6, 0.2e6, 37, 1.5, 40e6, 0.4e6, 4, 0.1, 0.5e6, 0.06, 38e6, 12)))
        lost = {**dict.fromkeys(keys), "runs": 1, "reason": "strengths at fewer than two pressures: no line"}
        names = [one["name"] for one in cases]
        steel = {"name": "dry_steel", "cases": names, "runs": 6, **said, "reason": "1 of 7 runs failed", "packings": [
            {"seed": 1, "runs": 3, **said, "q_pa": 41e6, "k_error": None}, {"seed": 2, **lost}]}
        self.assertEqual(self.page({**study, "envelopes": [{"name": "", "cases": names, **lost}]}).remarks[-1], f"dry steel: {lost['reason']}")
        made = self.page({**study, "envelopes": [steel]})
        points, lines = next(section.tables for section in made.sections if section.heading == "Failure under pressure")
        self.assertEqual(points.rows[1], ["5", "3", "58.0 ... 62.0", "4", "64.75", "60.5"])  # 40 (1 + 3.7 (5 / 40)^0.86), 40 + 4.1 x 5
        self.assertEqual(lines.rows, [["1", "3", "41 +- 0.4", "4", "11 +- 0.2", "37 +- 1.5"], ["2", "1", "-", "-", "-", "-"],
                                      ["all", "6", "40 +- 0.4", "4 +- 0.1", "11 +- 0.2", "37 +- 1.5"]])
        self.assertIn("1 of 7 runs failed", lines.note)
        drawn, _ = self.curves(self.pictures(made)["failure_envelope"], 0)
        line, curve = (next(drawn[label] for label in drawn if start in label) for start in ("40.0 + 4.00 s3", "sc = 38.0 MPa, m = 12.0"))
        numpy.testing.assert_allclose(line.get_xydata()[[0, -1]], [[0, 40], [10, 80]])
        self.assertAlmostEqual(curve.get_ydata()[-1], 10 + 38 * math.sqrt(12 * 10 / 38 + 1))
        self.assertIn("standard error 0.5 MPa", line.get_label())
        vary = {**parameters("vary", *cases), "varied": ["confining_pressure_pa"], "envelopes": [steel]}
        self.assertIn("failure_envelope", self.pictures(self.page(vary)))

    def test_several_studies_are_in_one_figure_and_kinds_are_not_mixed(self):
        self.page(friction())
        cubes = self.folder.with_name("cubes")
        shutil.copytree(self.folder, cubes)
        made = studies.page_of(self.folder, cubes)
        lines, symbols = self.curves(self.pictures(made)["strength_friction"], 0)
        self.assertEqual(list(lines), [f"{name}: height/width {h}" for name in ("study", "cubes") for h in (1, 2)])
        self.assertEqual(len(self.curves(self.pictures(made)["strength_friction"], 1)[1]), 1)  # a laboratory is drawn once
        (cubes / "study.json").write_text(json.dumps(parameters("rate", case("a", 4e7, axial_rate_m_s=0.1))))
        for other, words in ((cubes, "cubes is of a study of rate"), (self.folder.parent, "holds no study")):
            with self.assertRaisesRegex(InputError, words):
                studies.page_of(self.folder, other)

    def test_what_is_no_finished_study_is_refused(self):
        self.assertIsNone(studies.page_of(self.folder))
        self.refused({"kind": "friction", "status": "running"}, "has not ended; go on with it by platen-study friction --resume")
        self.refused({"kind": "friction", "status": "planned"}, "--run, then --collect")
        self.refused({"kind": "colour", "status": "done"}, "is of a study of colour; .*single runs")
        self.refused(3, "damaged")
        self.refused({"kind": "friction", "status": "done"}, "damaged: no cases")
        study = friction()
        study["comparisons"][0]["over"] = "teflon_1"
        self.refused(study, "no case teflon_1")

    def test_the_page_is_written(self):
        made = self.page(friction(), **{"summary.json": json.dumps({"scene": "Made-up platens"})})
        path = pages.write(made, self.folder / "pictures", say=lambda _: None)
        self.assertIn("Made-up platens", path.read_text())
        self.assertTrue((path.parent / "strength_friction.png").is_file())


def accuracy():
    def value(text, error):
        of = {**spread(error, 0.001), "root_mean_square": abs(error)}
        return {"value": text, "number": float(text) if text[0] == "0" else None, "errors": {key: dict(of) for key in scatter}}

    scatter = {"strength": 0.02, "strain_at_peak": 0.03, "modulus": 0.004, "broken_bonds": None}
    rate = {"knob": "axial rate", "unit": "m/s", "ordered": True, "values": [value("0.2", -0.1), value("0.1", 0.02), value("0.05", 0)]}
    effects = {"knob": "effects", "unit": "", "ordered": False,
               "values": [value("Effects/Rotation = off", 0.5), value("the scene as it is", 0)]}
    seconds = [{"knob": knob, "value": text, "mean": mean} for knob, text, mean in (
        ("axial rate", "0.2", 1.0), ("axial rate", "0.1", 2.0), ("axial rate", "0.05", 4.0), ("effects", "Effects/Rotation = off", 2.5))]
    prices = [{"knob": "axial rate", "of": "strength", "within": 0.05, "value": "0.1", "seconds": 2.0},
              {"knob": "axial rate", "of": "strength", "within": 0.01, "value": None, "seconds": None}]
    return {"kind": "accuracy", "status": "done", "runs": 15, "failed_runs": 0, "cases": [],
            "costs": {"wall_seconds": seconds, "prices": prices},
            "accuracy": [{**one, "scatter_of_seeds": scatter} for one in (rate, effects)]}


class Accuracy(OfStudies):
    def test_tables_give_errors_scatter_and_seconds_and_what_a_bound_costs(self):
        rate, effects, prices = self.page(accuracy()).sections[0].tables
        self.assertEqual(rate.rows[0], ["0.2 m/s", "3", *["-10 ... -9.9"] * 4, "1"])
        self.assertEqual(rate.rows[2], ["0.05 m/s (reference)", "3", "(2)", "(3)", "(0.4)", "-", "4"])
        self.assertEqual(effects.rows[0][0], "Rotation = off")
        self.assertEqual((prices.header[1:], prices.rows), (["5 %", "1 %"], [["axial rate, strength", "2 s (0.1)", "not reached"]]))
        study = accuracy()
        study["accuracy"][0]["values"][0]["errors"]["strength"]["runs"] = 5
        self.assertEqual(self.page(study).sections[0].tables[0].rows[0][2], "-10 +- 0.1")

    def test_errors_are_drawn_over_seconds_in_decades_with_the_scatter_of_packings(self):
        picture = self.pictures(self.page(accuracy()))["accuracy"]
        axes = house.figure_of(picture).axes[0]
        lines, _ = self.curves(picture, 0)
        self.assertEqual(lines["axial rate"].get_xydata().tolist(), [[1, 10], [2, 2]])  # nothing has no logarithm
        self.assertEqual(lines["effects: Rotation = off"].get_xydata().tolist(), [[2.5, 50]])
        self.assertEqual((axes.get_xscale(), axes.get_yscale()), ("log", "log"))
        self.assertAlmostEqual(axes.patches[0].get_xy()[:, 1].max(), 2)
        shown = [float(tick.get_text().replace("\N{MINUS SIGN}", "-")) for tick in axes.get_xticklabels()]
        numpy.testing.assert_allclose(shown, axes.get_xticks())

    def test_a_study_without_costs_is_refused(self):
        study = accuracy()
        del study["costs"]
        self.refused(study, "no costs")


def target(**more):
    looks = [{"runs": n, "mean": mean, "half_interval": half,
              "parts": {"packing": 0.8 * half, "chaos": 0.6 * half, "speed": 0.001, "step": 0.002}}
             for n, mean, half in ((10, 41e6, 0.05), (18, 42e6, 0.019))]
    of = {"figure": "strength", "accuracy": 0.02, "confidence": 0.9, "verdict": "reached", "looks": looks,
          "one_slow_speed": {"wave_crossings": 180, "packings": 6}, "sphere_size": {"change": -0.011}, **more}
    return {"kind": "target", "status": "done", "runs": 18, "failed_runs": 1, "target": of,
            "costs": {"looks_core_seconds": [60, 150], "one_slow_speed_core_seconds": 400}}


class Target(OfStudies):
    def test_its_table_has_each_look_and_its_remarks_what_came_of_the_order(self):
        made = self.page(target())
        table = made.sections[0].tables[0]
        self.assertEqual((table.header[2], table.rows[1]), ("strength (MPa)", ["18", "150", "42", "1.9", "1.5", "1.1", "0.1", "0.2"]))
        self.assertEqual(made.leads[0], "strength of slow loading: 42 MPa +- 1.9 % with 90 % confidence; 2 % were required: reached")
        self.assertEqual(made.remarks[0], "150 s of one core; one slow speed would have taken 400 s (180 wave crossings, 6 packings)")
        self.assertEqual(made.remarks[2], "1 of 18 runs failed: no mean contains them")

    def test_the_interval_is_of_the_logarithm_and_the_order_about_the_last_estimate(self):
        pictures = self.pictures(self.page(target()))
        axes = house.figure_of(pictures["target"]).axes[0]
        self.assertEqual(axes.lines[0].get_xydata().tolist(), [[60, 41], [150, 42]])
        numpy.testing.assert_allclose(axes.collections[0].get_paths()[1].vertices[:, 1], [42 * math.exp(-0.019), 42 * math.exp(0.019)])
        numpy.testing.assert_allclose([line.get_ydata()[0] for line in axes.lines[1:]], [42 * 0.98, 42 * 1.02])
        parts = house.figure_of(pictures["target_parts"]).axes[0]
        numpy.testing.assert_allclose([bar.get_width() for bar in parts.patches], [1.52, 1.14, 0.1, 0.2, 1.9])
        self.assertEqual(parts.lines[0].get_xdata()[0], 2)

    def test_one_without_costs_is_refused_and_one_without_a_figure_says_so(self):
        study = target()
        del study["costs"]
        self.refused(study, "no costs")
        made = self.page(target(looks=[], verdict="none"))
        self.assertEqual(made.leads[0], "too few runs gave the figure: there is no interval")


if __name__ == "__main__":
    unittest.main()
