"""Pictures of the specimen: what stands where, what hides what, colours, cones; and of several runs."""
import json
import math
import unittest
from pathlib import Path
from types import SimpleNamespace

import numpy
from report_folders import InRun, made_up_run

from platen.errors import InputError
from platen.report import house, run, specimen, spheres
from platen.vtu import Grid

CYLINDER = run.Extent("cylinder", 0.025, 0.025, 0.0, 0.1)


def spheres_at(initial, position=None, radius=0.001, broken=0, intact=0, **more):
    initial = numpy.array(initial, float)
    column = lambda value: numpy.broadcast_to(numpy.asarray(value, float), len(initial))
    return run.Spheres(0, initial if position is None else numpy.array(position, float), initial, column(radius), column(intact),
                       column(broken), more.get("fragment"), None, {})


def picture_of(draw, extent=CYLINDER, inches=(2.0, 4.0), **more):
    """The image that a scene makes (rows x columns x 3), and the scene."""
    figure = house.Figure(figsize=inches)
    scene = spheres.Scene(figure.add_axes([0, 0, 1, 1]), extent, **more)
    draw(scene)
    scene.show()
    return numpy.asarray(scene.axes.images[0].get_array(), int), scene


def brick(low, high):
    return numpy.array(made_up_run.brick(low, high), float)


class Values(unittest.TestCase):
    def test_a_sphere_does_not_come_or_go_as_it_crosses_the_cut(self):
        moved = spheres_at([[0, -0.001, 0], [0, 0.001, 0]], [[0, 0.002, 0], [0, -0.002, 0]])
        self.assertEqual(specimen.half(moved).tolist(), [0])

    def test_outward_displacement_is_radial_and_turning_about_the_axis_gives_none(self):
        moved = spheres_at([[0.003, 0.004, 0.01]] * 2, [[0.006, 0.008, 0.02], [-0.004, 0.003, 0.01]])
        numpy.testing.assert_allclose(moved.outward, [0.005, 0], atol=1e-15)
        self.assertAlmostEqual(moved.displacement[0], math.hypot(0.005, 0.01), 15)

    def test_of_a_plane_specimen_it_is_away_from_the_middle_plane(self):
        moved = spheres_at([[0.01, 0.004, 0], [-0.01, 0, 0]], [[0.012, 0.1, 0], [-0.009, 0, 0]])
        flat = SimpleNamespace(extent=run.Extent("disc", 0.025, 0.01, 0, 0.05))
        numpy.testing.assert_allclose(specimen.outward(flat, moved), [0.002, -0.001], atol=1e-15)

    def test_damage_is_the_broken_share_and_a_sphere_without_bonds_has_none(self):
        self.assertEqual(spheres_at([[0, 0, 0]] * 2, intact=[0, 1], broken=[0, 3]).damage.tolist(), [0, 0.75])

    def test_one_splinter_does_not_take_the_colours_from_the_rest(self):
        self.assertEqual(specimen.top_of(numpy.array([1e3, *[0.4] * 99])), 0.4)
        self.assertEqual(specimen.top_of(numpy.array([-1.0, -2.0])), 0)

    def test_fragments_of_fewer_than_thirty_spheres_have_no_colour(self):
        number = numpy.repeat([0, 1, 2, 9], [40, 30, 29, 50])
        found = specimen.fragment_colours(spheres_at(numpy.zeros((149, 3)), fragment=number))
        self.assertEqual([found[k] for k in (0, 40, 70, 99)], [1, 2, 0, 0])

    def test_forms_are_told_by_corners_and_rims(self):
        i, j, k = (g.ravel() for g in numpy.meshgrid(*[numpy.arange(-10, 11)] * 3))
        grid = 0.002 * numpy.column_stack([i, k, j])
        flat, thin = abs(j) < 1, abs(k) <= 2
        forms = {"cylinder": grid[flat & (i**2 + k**2 <= 100)], "box": grid[flat], "disc": grid[thin & (i**2 + j**2 <= 100)],
                 "bar": grid[thin & (abs(j) <= 2)]}
        found = {name: run.extent_of(spheres_at(places)) for name, places in forms.items()}
        self.assertEqual({name: (e.form, e.is_plane) for name, e in found.items()},
                         {"cylinder": ("cylinder", False), "box": ("box", False), "disc": ("disc", True), "bar": ("box", True)})
        self.assertAlmostEqual(found["box"].half_width, 0.021)  # centres reach to 0.02, skins one radius further
        self.assertAlmostEqual(found["box"].height, 0.002)
        self.assertAlmostEqual(found["disc"].half_depth, 0.005)


class Images(unittest.TestCase):
    def test_a_wide_extent_fills_the_width_and_a_high_one_the_height(self):
        wide, high = run.Extent("box", 0.02, 0.02, 0.0, 0.01), CYLINDER
        _, scene = picture_of(lambda s: None, wide, (3, 4), margin=0)
        self.assertEqual(scene.axes.get_xlim(), (-0.02, 0.02))
        self.assertAlmostEqual(sum(scene.axes.get_ylim()) / 2, 0.005, 4)
        _, scene = picture_of(lambda s: None, high, (3, 4), margin=0)
        self.assertAlmostEqual(numpy.ptp(scene.axes.get_ylim()), 0.1)
        _, scene = picture_of(lambda s: None, high, (3, 4), margin=0, foot=1)
        self.assertAlmostEqual(numpy.ptp(scene.axes.get_ylim()), 0.1 * 4 / 3)

    def test_a_sphere_is_a_circle_with_x_to_the_left_and_the_nearer_one_is_shown(self):
        red, blue = (1, 0, 0), (0, 0, 1)
        image, scene = picture_of(lambda s: s.spheres(numpy.array([[0.01, -0.01, 0.07], [0.01, 0, 0.0712]]), numpy.array([0.004, 0.002]),
                                                      numpy.array([red, blue])))
        scale = scene.scale / spheres.FINE
        filled = (image < 255).any(2)
        self.assertAlmostEqual(filled.sum() / scale**2, math.pi * 0.004**2, delta=0.08 * math.pi * 0.004**2)
        rows, columns = numpy.nonzero(filled)
        up = (0.02 + 0.01 * spheres.RISE) / math.hypot(1, spheres.RISE)  # what lies further back is seen higher
        centre = 0.5 * image.shape[1] - 0.01 * scale, 0.5 * image.shape[0] - up * scale
        numpy.testing.assert_allclose((columns.mean() + 0.5, rows.mean() + 0.5), centre, atol=0.5)
        before = image[..., 2] > image[..., 0]
        self.assertAlmostEqual(before.sum() / scale**2, math.pi * 0.002**2, delta=0.1 * math.pi * 0.002**2)

    def test_a_disc_is_as_large_as_its_slope_leaves_of_it(self):
        sight = numpy.array([0, 1, spheres.RISE]) / math.hypot(1, spheres.RISE)
        for normal in ((0, 1, 0), (0.6, 0.8, 0), (0.5, 0.03, 1), (-0.5, 0.03, 1)):
            image, scene = picture_of(lambda s: s.spheres([[0.026, 0, 0.05]], [0.01], [[0, 0, 0]], [normal]))
            share = abs(sight @ normal) / numpy.linalg.norm(normal)
            area = (image < 128).all(2).sum() / (scene.scale / spheres.FINE) ** 2
            self.assertAlmostEqual(area / (math.pi * 0.01**2 * share), 1, delta=0.06)

    def test_discs_are_behind_one_another_along_their_slope(self):
        image, _ = picture_of(lambda s: (s.spheres([[0, 0, 0.05]], [0.02], [[1, 0, 0]], [[1, 1, 0]]),
                                         s.spheres([[0.007, 0, 0.05], [-0.007, 0, 0.05]], [0.002] * 2, [[0, 0, 1]] * 2, [[0, 1, 0]] * 2)))
        blue = numpy.nonzero((image[..., 2] > 50) & (image[..., 0] < 50))[1]
        self.assertGreater(len(blue), 20)
        self.assertTrue((blue < image.shape[1] / 2).all(), "its plane is y = -x: at x = 0.007, on the left, it lies behind y = 0")

    def test_of_two_elements_side_by_side_ten_faces_are_outside(self):
        points = numpy.vstack([brick((0, 0, 0), (1, 1, 1)), brick((1, 0, 0), (2, 1, 1))])
        grid = Grid(points, {}, {}, {}, numpy.arange(16), numpy.array([8, 16]))
        faces = spheres.surface(grid, "x")
        self.assertEqual(len(faces), 10)
        self.assertEqual(spheres.joined(points).max() + 1, 12)
        outward = numpy.cross(points[faces[:, 2]] - points[faces[:, 0]], points[faces[:, 3]] - points[faces[:, 1]])
        self.assertTrue(((points[faces].mean(1) - [1, 0.5, 0.5]) * outward).sum(1).min() > 0)
        with self.assertRaisesRegex(InputError, "x: holds other elements than hexahedra"):
            spheres.surface(Grid(points, {}, {}, {}, numpy.arange(4), numpy.arange(1, 5)), "x")

    def test_a_round_platen_of_few_elements_is_drawn_round(self):
        turn = numpy.pi / 8 * numpy.arange(16)
        rim = 0.02 * numpy.column_stack([numpy.cos(turn), numpy.sin(turn)])
        cells = [[0, 1 + k, 1 + (k + 1) % 16, 1 + (k + 2) % 16] for k in range(0, 16, 2)]
        points = numpy.vstack([numpy.insert(numpy.vstack([[0, 0], rim]), 2, z, axis=1) for z in (0.04, 0.06)])
        grid = Grid(points, {}, {}, {}, numpy.hstack([cells, numpy.add(cells, 17)]).ravel(), 8 * numpy.arange(1, 9))
        self.assertEqual(spheres.boxes_of(grid, "x"), [[-0.02, -0.02, 0.04, 0.02, 0.02, 0.06, 1]])
        corners, faces = spheres.cylinder(spheres.boxes_of(grid, "x")[0])
        a, b, c, d = corners[faces].transpose(1, 0, 2)
        flux = (numpy.cross(c - a, d - b) / 2 * (a + b + c + d) / 4).sum() / 3  # the volume, where all faces look outwards
        self.assertAlmostEqual(flux / (math.pi * 0.02**2 * 0.02), 1, delta=2e-3)
        image, _ = picture_of(lambda s: s.bodies(grid, "x"))
        shades = numpy.unique(image[len(image) // 2], axis=0)
        self.assertGreater(len(shades), 30, "a polygon of 16 sides shows nine shades and those of its edges")

    def test_a_cut_body_is_filled_at_the_cut_and_hides_what_is_behind_it_alone(self):
        block = [brick((-0.01, -0.02, 0.04), (0.01, 0.02, 0.06)), brick((-0.02, -0.03, 0.03), (0.02, -0.025, 0.07))]
        grid = Grid(numpy.vstack(block), {}, {}, {}, numpy.arange(16), numpy.array([8, 16]))
        places = numpy.array([[0, -0.01, 0.05], [0.005, 0.004, 0.05]])  # in the body behind the cut; before it

        def seen(before):
            image, scene = picture_of(lambda s: (s.spheres(places, [0.002, 0.002], [[1, 0, 0], [0, 0, 1]]),
                                                 s.bodies(grid, "x", (0, 0.5, 0), before)))
            colours = [(image[..., k] > image[..., other] + 30) for k, other in ((0, 1), (2, 1), (1, 0))]
            return image, scene, [c.sum() for c in colours]

        image, scene, (red, blue, green) = seen(0)
        self.assertEqual(red, 0)
        self.assertGreater(blue, 20)
        self.assertTrue((image[0] == 255).all(), "nothing is filled beside it")
        scale = scene.scale / spheres.FINE
        middle = image.shape[0] // 2, image.shape[1] // 2
        self.assertEqual(len(numpy.unique(image[middle[0], middle[1] : middle[1] + int(0.009 * scale)], axis=0)), 1, "a flat face")
        _, _, (red, blue, whole) = seen(math.inf)
        self.assertEqual((red, blue), (0, 0))
        self.assertGreater(seen(-0.015)[2][0], 20, "cut further back, the body hides less")


class Cones(unittest.TestCase):
    @staticmethod
    def cone(half_angle, apex, axis, base=1.0):
        return specimen.Cone(half_angle, 0.5, base, numpy.array(apex, float), numpy.array(axis, float))

    def test_an_upright_cone_shows_a_triangle_as_wide_at_the_platen_as_measured(self):
        for base in (1.0, 0.8):
            rim, tip = base * 0.025, 0.05
            found = specimen.section(self.cone(0.6, (0.002, 0, tip), (0, 0, -1), base), 0.0, 0.025)
            flank = found[1:-1]
            side = numpy.repeat([-1, 1], len(flank) // 2)
            numpy.testing.assert_allclose(flank[:, 0], (0.002 + side * (tip - flank[:, 1]) * math.tan(0.6)).clip(-rim, rim), atol=1e-9)
            numpy.testing.assert_allclose(found[[0, -1]], [[-rim, 0], [rim, 0]])

    def test_points_of_a_leaning_cone_beside_the_plane_lie_on_its_flank(self):
        cone = self.cone(0.5, (0.001, -0.008, 0.06), (0.2, 0.1, math.sqrt(0.95)))
        found = specimen.section(cone, 0.1, 0.025)
        self.assertGreater(found[:, 1].min(), 0.065, "beside the plane the tip is not cut")
        free = found[abs(found[:, 0]) < 0.0249]
        w = numpy.insert(free, 1, 0, axis=1) - cone.apex
        numpy.testing.assert_allclose(numpy.arccos(w @ cone.axis / numpy.linalg.norm(w, axis=1)), 0.5, atol=1e-6)
        self.assertEqual(len(specimen.section(self.cone(0.2, (0, 0, 0.06), (0.99, 0, 0.14)), 0.1, 0.025)), 0, "no closed section")

    def test_a_cone_is_carried_by_most_of_its_spheres(self):
        inside, outside = [[0.001 * k, 0, 0.01] for k in range(9)], [[0.05, 0, 0.01]] * 20
        moved = numpy.array([0.03, *[0.001] * 8, *[-0.01] * 20])[:, None] * [1, 0, 2]  # one has fallen out
        cone = self.cone(0.5, (0, 0, 0.05), (0, 0, -1))
        found = specimen.carried(cone, spheres_at(inside + outside, numpy.array(inside + outside) + moved))
        numpy.testing.assert_allclose(found, [0.001, 0, 0.002], atol=1e-12)

    def test_what_was_not_looked_for_is_not_told_as_absent(self):
        told = {"half_angle_deg": 45, "confidence": 0.5, "base_ratio": 0.9, "apex_m": [0.001, 0, 0.07], "axis": [0, 0, 1]}
        one = SimpleNamespace(info={"dead_zone_top": None, "cone_top": None, "dead_zone_bottom": {"base_ratio": 0.2}, "cone_bottom": None,
                                    "final_dead_zone_top": {"base_ratio": 0.9}, "final_cone_top": told}, folder=Path("run"))
        self.assertIsNone(specimen.cone_of(one, "top", False))
        self.assertIs(specimen.cone_of(one, "bottom", False), False)
        found = specimen.cone_of(one, "top", True)
        self.assertEqual(found.words, "45 degrees, r0 = 0.90 (confidence 0.50)")
        self.assertAlmostEqual(found.half_angle, math.pi / 4)
        del told["apex_m"]
        with self.assertRaisesRegex(InputError, "summary.json: damaged: no apex_m"):
            specimen.cone_of(one, "top", True)

    def test_the_cut_is_turned_to_the_axes(self):
        both = [self.cone(0.5, (0.003, 0.004, 0.05), (0.06, 0.08, -math.sqrt(0.99))), self.cone(0.5, (-0.006, -0.008, 0.05), (0, 0, 1))]
        turn = specimen.turn_to([*both, None, False], 0.1)
        for cone in both:
            seen = cone.turned(turn)
            numpy.testing.assert_allclose([seen.apex[1], seen.axis[1], abs(seen.apex[0])], [0, 0, math.hypot(*cone.apex[:2])], atol=1e-12)
        numpy.testing.assert_array_equal(specimen.turn_to([None, False], 0.1), numpy.eye(3))

    def test_the_cut_is_the_same_at_any_size(self):
        def angle(times):
            cone = self.cone(0.5, (0.006 * times, 0, 0.05 * times), (0.1, 0.2, -math.sqrt(0.95)))
            return math.asin(specimen.turn_to([cone], 0.06 * times)[0, 1])

        # 0.06 m high: the axis reaches 0.002 and 0.004 m aside over 0.02 m.
        self.assertAlmostEqual(angle(1), 0.5 * math.atan2(2 * 0.002 * 0.004, 0.006**2 + 0.002**2 - 0.004**2), 12)
        for times in (0.1, 10.0, 1e-3):
            self.assertAlmostEqual(angle(times), angle(1), 12)


class Pictures(InRun):
    def test_there_are_those_that_the_files_allow(self):
        names = lambda: [p.name for p in specimen.pictures_of_specimen(run.TestRun(self.path))]
        always = ["specimen_outside", "specimen_inside", "outward_displacement", "damage", "fragments"]
        self.assertEqual(names(), always)
        one = run.TestRun(self.path)
        self.assertEqual([len(p.rows[0]) for p in specimen.pictures_of_specimen(one)], [3, 3, 2, 2, 2])
        one.peak_time = 1.01 * one.spheres(1.0).time
        self.assertEqual(one.near_peak("specimen"), "near the peak")
        one.peak_time = 1.2 * one.spheres(1.0).time
        self.assertEqual(one.near_peak("specimen"), "at 1000 ms (83 % of the time to the peak)")
        six = specimen.comparison([one] * 6)
        self.assertEqual([p.name for p in six], ["comparison_displacement", "comparison_damage", "comparison_fragments"])
        self.assertEqual([len(row) for row in six[0].rows], [4, 4])
        (self.path / "summary.json").write_text(json.dumps({"fall_time_s": None}))
        self.assertEqual([len(p.rows[0]) for p in specimen.pictures_of_specimen(run.TestRun(self.path))], [3, 3, 1, 1, 1])
        (self.path / "specimen.pvd").unlink()
        self.assertEqual((names(), specimen.comparison([run.TestRun(self.path)])), ([], []))

    def test_at_the_fall_and_at_the_end_each_panel_has_the_scale_of_its_own_values(self):
        one = run.TestRun(self.path)
        found = {p.name: p for p in specimen.pictures_of_specimen(one)}
        bars = [bar for axes in house.figure_of(found["outward_displacement"]).axes for bar in axes.child_axes]
        for axes, time in zip(bars, (one.fall_time, one.end_time)):
            rows = specimen.half(one.spheres(time))
            self.assertAlmostEqual(axes.get_xlim()[1], 1e3 * specimen.top_of(one.spheres(time).outward[rows]))
        self.assertEqual(len(bars), 2)
        self.assertNotIn("Cones are dark", found["outward_displacement"].caption)
        self.assertIn("cut at y = 0", specimen.cones_caption(one))
        told = {"half_angle_deg": 45, "confidence": 0.5, "base_ratio": 0.9, "apex_m": [0.001, 0, 0.07], "axis": [0, 0, 1]}
        one.info.update({"dead_zone_top": {"base_ratio": 0.9}, "cone_top": told})
        self.assertIn("Cones are dark", {p.name: p for p in specimen.pictures_of_specimen(one)}["outward_displacement"].caption)
        self.assertIn("cut along the axes of the cones", specimen.cones_caption(one))
        self.assertIn("Green: the largest", found["fragments"].caption)
        pieces = one.start._replace(fragment=numpy.arange(len(one.start.radius)))
        one.spheres = lambda time: pieces
        self.assertNotIn("Green", {p.name: p for p in specimen.pictures_of_specimen(one)}["fragments"].caption)
        before = house.figure_of(found["specimen_inside"]).axes[0]
        self.assertEqual([text.get_text() for text in before.texts], ["Displacement (mm):\nzero everywhere"])
        small = one.start._replace(position=one.start.initial + [0, 0, 4e-6])
        one.spheres = lambda time: small
        self.assertEqual(house.figure_of(found["specimen_inside"]).axes[1].child_axes[0].get_xlabel(), "Displacement (µm)")


if __name__ == "__main__":
    unittest.main()
