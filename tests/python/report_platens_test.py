"""Platens and ends: friction, pressure and shear, strips, sides; numbers by closed forms, and which pictures a run has."""
import math
import unittest

import numpy
from report_folders import InFolder, lines_of, write_history, write_series

from platen.errors import InputError
from platen.report import house, platens
from platen.report.run import TestRun

RADIUS, PRESSURE, INWARD, STICKING, COUNT = 0.025, 30e6, 0.2, 0.4, 2000  # m, Pa, of shear at the rim over pressure, share of the area


def contacts(x=0, y=0, force=1, inward=0, sliding=False, shear=0, slip=0):
    columns = numpy.broadcast_arrays(x, y, force, inward, sliding, shear, slip)
    return platens.Contacts(*(numpy.atleast_1d(column) for column in columns))


def ends():
    """Points and arrays of a sunflower of contacts at each end, bottom first, whose shear grows with the radius, and of five of a
    sleeve that press to -x."""
    share = (numpy.arange(COUNT) + 0.5) / COUNT
    r, turn, each = RADIUS * numpy.sqrt(share), 2.399963 * numpy.arange(COUNT), PRESSURE * math.pi * RADIUS**2 / COUNT
    x, y, zero = r * numpy.cos(turn), r * numpy.sin(turn), numpy.zeros(COUNT)
    one_end = numpy.stack([-x, -y, zero], axis=1) * INWARD * each / RADIUS
    side = numpy.tile([RADIUS, 0, 0], (5, 1)) + numpy.outer(numpy.arange(5), [0, 0, 0.01])
    return (numpy.concatenate([numpy.stack([x, y, zero], 1), numpy.stack([x, y, zero + 0.1], 1), side]), {
        "normal": [[0, 0, 1]] * COUNT + [[0, 0, -1]] * COUNT + [[-1, 0, 0]] * 5, "shear": numpy.concatenate([one_end, one_end, 0 * side]),
        "normal_force": [each] * 2 * COUNT + [1e3] * 5, "sliding": [*(1 * (share > STICKING))] * 2 + [0] * 5,
        "slip": [2e-6] * (2 * COUNT + 5)})


class Runs(InFolder):
    def run_of(self, scene=None, sides=(), of_ends=None, corner=1):
        """A run with further sides, entries of Platens, contacts, and spheres around a circle, and beyond it by `corner`."""
        write_history(self.folder, {"z": [0, 1e6, 0], **{f"stress_{side}_pa": [0, 1e6, 0] for side in sides}})
        (self.folder / "scene.prm").write_text("subsection Platens\n" + "".join(
            f"set {key} = {value}\n" if "/" not in key else f"subsection {key.split('/')[0]}\nset {key.split('/')[1]} = {value}\nend\n"
            for key, value in (scene or {}).items()) + "end\n")
        if of_ends:
            write_series(self.folder, "contacts", {0: ([], {}), 1: of_ends})
        turn = math.pi / 4 * numpy.arange(8)
        far = (RADIUS - 1e-3) * numpy.where(numpy.arange(8) % 2, corner, 1)
        places = numpy.stack([far * numpy.cos(turn), far * numpy.sin(turn), 0 * turn], axis=1)
        places = numpy.concatenate([places + [0, 0, 1e-3], places + [0, 0, 0.1 - 1e-3]])
        one = numpy.ones(16)
        write_series(self.folder, "specimen", {0: (places, {"radius": 1e-3 * one, "displacement": 0 * places, "intact_bonds": one,
                                                            "broken_bonds": 0 * one, "fragment": 0 * one})})
        return TestRun(self.folder)


class Friction(Runs):
    def test_what_presses_more_counts_more(self):
        share, friction, slip = platens.friction_state(contacts(force=[30, 10], shear=[3, 1], slip=[1e-3, 5e-3], sliding=[True, False]))
        numpy.testing.assert_allclose([share[0], friction[0], slip[0]], [0.5, 0.1, 2e-3], rtol=1e-12)

    def test_errors_are_those_of_the_scatter(self):
        share, friction, slip = platens.friction_state(contacts(force=[30, 10], shear=[3, 1], slip=[1e-3, 5e-3], sliding=[True, False]))
        self.assertAlmostEqual(share[1], 0.5)  # standard deviation 0.71 over the root of 2
        self.assertAlmostEqual(friction[1], 0)
        self.assertAlmostEqual(slip[1], 0.03 * 2 / 40)  # each is 0.03 N m off
        self.assertTrue(math.isnan(platens.friction_state(contacts(force=1, shear=1))[1, 1]))

    def test_where_nothing_presses_nothing_is_told(self):
        for none in (contacts(force=0, sliding=True), contacts(*[[]] * 7)):
            self.assertTrue(numpy.isnan(platens.friction_state(none)).all())

    def test_of_a_known_traction_friction_is_the_mean(self):
        run = self.run_of(of_ends=ends())
        for side in ("bottom", "top"):  # over a disc two thirds of what it is at the rim
            share, friction, slip = platens.friction_state(platens.contacts_of(run, side, 1))[:, 0]
            numpy.testing.assert_allclose([share, friction, slip], [1 - STICKING, INWARD * 2 / 3, 2e-6], rtol=1e-5)
        self.assertTrue(platens.has_friction(run))

    def test_limits_are_those_of_the_side_else_of_all_platens_in_their_units(self):
        run = self.run_of({"Friction static": "57 %", "Friction dynamic": 0.4, "Top/Friction static": "5e-1 %",
                           "Bottom/Friction dynamic": ""})
        numpy.testing.assert_allclose([platens.friction_limits(run, side) for side in ("bottom", "top")], [[0.57, 0.4], [0.005, 0.4]])
        self.assertEqual(platens.friction_words(run), ["bottom 0.57, sliding 0.4", "top 0.005, sliding 0.4"])

    def test_sliding_friction_that_is_not_said_is_the_static_one(self):
        run = self.run_of({"Friction static": 0.3})
        self.assertEqual(platens.friction_limits(run, "left"), (0.3, 0.3))
        self.assertEqual(platens.friction_words(run), ["bottom 0.3", "top 0.3"])
        self.assertEqual(platens.friction_words(self.run_of()), [])

    def test_an_entry_that_is_no_such_number_is_refused_by_name(self):
        for text in ("0.5 MPa", "much", "0,57"):
            with self.assertRaisesRegex(InputError, f"scene.prm: Platens/Friction static = {text} is no number"):
                platens.friction_words(self.run_of({"Friction static": text}))

    def test_glued_ends_have_none(self):
        run = self.run_of({"Attachment": "glued", "Friction static": 0.3}, of_ends=ends())
        self.assertFalse(platens.has_friction(run))
        self.assertEqual(platens.friction_words(run), ["glued"])


class Pressure(Runs):
    def test_profiles_are_those_of_a_known_traction_and_leave_out_the_sleeve(self):
        run = self.run_of(of_ends=ends())
        edges = numpy.sqrt(numpy.linspace(0, 1, 6))
        mean_radius = 2 / 3 * numpy.diff(edges**3) / 0.2  # of a shear that grows with the radius the mean is that there
        for side in ("bottom", "top"):
            found = platens.contacts_of(run, side, 1)
            self.assertEqual((len(found.x), found.sliding.sum()), (COUNT, round(COUNT * (1 - STICKING))))
            middle, pressure, shear, n = platens.ring_profile(found, RADIUS)
            numpy.testing.assert_allclose(middle, RADIUS * numpy.sqrt([0.1, 0.3, 0.5, 0.7, 0.9]))
            numpy.testing.assert_allclose(pressure[0], PRESSURE, rtol=1e-9)
            numpy.testing.assert_allclose(shear[0], INWARD * mean_radius * PRESSURE, rtol=1e-3)
            self.assertEqual(n.tolist(), [COUNT / 5] * 5)

    def test_without_contacts_nothing_presses(self):
        numpy.testing.assert_array_equal(platens.ring_profile(contacts(*[[]] * 7), RADIUS, 3)[1], numpy.zeros((2, 3)))

    def test_errors_of_sums_are_those_of_the_scatter_and_a_single_one_is_its_own(self):
        total, n, error = platens.sums(numpy.array([1.0, 3, 5, 7]), numpy.array([0, 0, 0, 2]), 3)
        self.assertEqual((total.tolist(), n.tolist()), ([9, 0, 7], [3, 0, 1]))
        numpy.testing.assert_allclose(error, [2 * math.sqrt(3), 0, 7])

    def test_pressure_over_a_face_is_force_over_area_and_loses_none(self):
        x, y = numpy.meshgrid(-0.1 + (numpy.arange(100) + 0.5) * 1e-3, (numpy.arange(200) + 0.5) * 1e-3)  # 2 N a square centimetre
        one = contacts([*x.ravel(), 0.11], [*y.ravel(), 0.05], [0.02] * x.size + [7])  # the last is beyond the border
        face = platens.face_pressure(one, [-0.1, 0], [0.1, 0.2], 0.05)
        expected = numpy.tile([2e4, 2e4, 0, 0], (4, 1))
        expected[1, 3] = 7 / 0.0025
        numpy.testing.assert_allclose(face, expected, atol=1e-6)

    def test_contacts_of_a_side_are_told_by_their_direction_in_its_own_plane(self):
        run = self.run_of(of_ends=ends())
        right = platens.contacts_of(run, "right", 1)
        self.assertEqual(right.x.tolist(), [0] * 5)  # y
        numpy.testing.assert_allclose(right.y, 0.01 * numpy.arange(5))  # z
        for side in ("left", "front", "back"):
            self.assertEqual(len(platens.contacts_of(run, side, 1).x), 0)

    def test_platens_are_known_by_their_columns(self):
        self.assertEqual(platens.sides_of(self.run_of()), ["bottom", "top"])
        self.assertEqual(platens.sides_of(self.run_of(sides=("front", "back"))), ["bottom", "top", "front", "back"])


class Strips(Runs):
    def test_the_load_along_a_strip_is_all_that_presses(self):
        load, error = platens.load_along(contacts(y=[-0.012, 0.001, 0.1], force=[10, 20, 30]), 0.0125, 5)
        numpy.testing.assert_allclose(load * 0.005, [10, 0, 20, 0, 30])  # what lies beyond counts at the end
        numpy.testing.assert_allclose(error, load)  # of single spheres

    def test_scenes_say_whether_strips_press(self):
        self.assertTrue(platens.has_strips(self.run_of({"Strip width": "5 mm"})))
        self.assertFalse(platens.has_strips(self.run_of({"Strip width": 0})))
        with self.assertRaisesRegex(InputError, "Platens/Strip width = 5 % is no number in a unit of length"):
            platens.has_strips(self.run_of({"Strip width": "5 %"}))

    def test_two_supports_are_apart(self):
        points, arrays = [[-0.02, -0.024, 0], [0.02, 0.024, 0]], {
            "normal": [[0, 0, 1]] * 2, "shear": [[0, 0, 0]] * 2, "normal_force": [100, 300], "sliding": [0, 0], "slip": [0, 0]}
        run = self.run_of({"Strip width": "5 mm", "Span": "40 mm"}, of_ends=(points, arrays))
        picture = next(p for p in platens.pictures_of_ends(run) if p.name == "strip_loads")
        lines, width = lines_of(picture)[0], 2 * RADIUS / 12  # a part: four radii of spheres
        numpy.testing.assert_allclose(lines["left support"][[0, -1], 1], [0.1 / width, 0])  # kN/m
        numpy.testing.assert_allclose(lines["right support"][[0, -1], 1], [0, 0.3 / width])


class Pictures(Runs):
    def test_which_pictures_a_run_has(self):
        def names(*more, **how):
            return [picture.name for picture in platens.pictures_of_ends(self.run_of(*more, **how))]

        self.assertEqual(names(), [])
        self.assertEqual(names(of_ends=ends()), ["friction", "platen_pressure", "stick_slip"])
        self.assertEqual(names({"Attachment": "glued"}, of_ends=ends()), ["platen_pressure"])
        self.assertEqual(names({"Friction static": 0}, of_ends=ends()), ["platen_pressure"])
        self.assertEqual(names({"Strip width": "1 cm"}, of_ends=ends()), ["friction", "strip_loads", "stick_slip"])
        for box in ({"sides": ("left", "right")}, {"corner": math.sqrt(2)}):
            self.assertEqual(names(of_ends=ends(), **box), ["friction", "side_pressure", "stick_slip"])

    def test_they_show_the_numbers_in_the_units_of_their_axes(self):
        run = self.run_of({"Friction static": 0.5, "Friction dynamic": 0.4}, of_ends=ends())
        drawn = {picture.name: house.figure_of(picture).axes for picture in platens.pictures_of_ends(run)}
        share, friction, slip, _ = drawn["friction"]
        self.assertEqual([line.get_label() for line in share.lines[:2]], ["bottom", "top"])
        numpy.testing.assert_allclose([axes.lines[1].get_xydata()[1] for axes in (share, friction, slip)],
                                      [[1e3, 0.6], [1e3, INWARD * 2 / 3], [1e3, 2]], rtol=1e-3)  # ms; micrometres
        self.assertEqual([text.get_text() for text in friction.texts], ["limit, static: 0.5", "limit, sliding: 0.4", "peak"])
        self.assertEqual(friction.texts[2].get_va(), "top")  # in its chart, not between two
        numpy.testing.assert_allclose(drawn["platen_pressure"][0].lines[0].get_xydata()[0], [1e3 * RADIUS * math.sqrt(0.1), 30], rtol=1e-6)
        self.assertEqual([text.get_text() for text in drawn["stick_slip"][1].get_legend().get_texts()], ["top: 800 stick", "1200 slide"])
        half = self.run_of({"Friction static": 0, "Top/Friction static": 0.1}, of_ends=ends())
        greased = {p.name: p for p in platens.pictures_of_ends(half)}
        pressure, shear = ([bar.get_label() for bar in axes.containers] for axes in house.figure_of(greased["platen_pressure"]).axes)
        self.assertEqual((pressure, shear), (["bottom platen", "top platen"], ["top platen"]))
        self.assertEqual(len(greased["stick_slip"].rows[0]), 1)
        self.assertEqual(len(platens.pictures_of_ends(self.run_of({"Friction static": 0}, of_ends=ends()))[0].rows), 1)

    def test_pressure_over_faces_is_over_the_mean_of_each_platen(self):
        run = self.run_of(of_ends=ends(), sides=("left", "right"))
        picture = next(p for p in platens.pictures_of_ends(run) if p.name == "side_pressure")
        axes = house.figure_of(picture).axes[:4]
        right = 5e3 / (2 * RADIUS * 0.1) / 1e6
        mean = PRESSURE * math.pi / 4 / 1e6
        for shown, side, size in zip(axes, ("top", "right", "bottom", "left"), (mean, right, mean, 0)):
            self.assertEqual(shown.get_title(), f"{side}: mean {size:.3g} MPa")
            self.assertAlmostEqual(float(shown.images[0].get_array().mean()), size > 0, delta=1e-9)


if __name__ == "__main__":
    unittest.main()
