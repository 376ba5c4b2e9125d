"""Fields on a grid: what comes out is what was put in, whatever the grid; the platens' forces are in the stress, and each body keeps to
itself."""
import json
import math
import re
import struct
import unittest
import zlib

import numpy
from report_folders import InFolder, write_history, write_series

from platen.errors import InputError
from platen.report import fields, house
from platen.report.run import TestRun
from platen.vtu import Grid, read_pvd

REACH = 3.5  # in mean radii
RADIUS, FORCE, SHARE, STEEL = 0.01, 50.0, 0.6, -7e6  # m, N, 1, Pa


def grid_of(origin, spacing, nodes):
    return fields.Grid(numpy.array(origin, float), spacing, numpy.array(nodes))


def shaken(n):
    """A shaken lattice of unequal spheres in a box of side 2 n about the origin."""
    draw = numpy.random.default_rng(5).uniform
    places = 2.0 * numpy.stack(numpy.meshgrid(*[numpy.arange(n)] * 3), -1).reshape(-1, 3) - (n - 1)
    return places + 0.4 * draw(-1, 1, places.shape), 0.9 + 0.1 * draw(-1, 1, len(places))


class CoarseGrain(unittest.TestCase):
    def test_the_kernel_has_the_integral_one_and_a_smooth_end(self):
        r = REACH * (numpy.arange(2000) + 0.5) / 2000
        self.assertAlmostEqual((4 * math.pi * r**2 * fields.wendland(r, REACH)).sum() * REACH / 2000, 1, delta=1e-6)
        self.assertEqual(fields.wendland(REACH, REACH), 0)
        self.assertLess(fields.wendland(0.99 * REACH, REACH), 1e-6 * fields.wendland(0, REACH))

    def test_what_is_the_same_everywhere_stays_so_and_outside_is_empty(self):
        (x, r), grid = shaken(8), grid_of([-14] * 3, 2, [15] * 3)
        share, means, *_ = fields.coarse_grain(x, r, numpy.tile([-30.0, 0.25], (len(x), 1)), grid, REACH)
        out = numpy.abs(grid.places).max(1)
        self.assertTrue((out[share == 0] > 8).all() and (out[share > 0] < 7.4 + REACH).all())
        self.assertTrue(numpy.isnan(means[share == 0]).all())
        numpy.testing.assert_allclose(means[share > 0], [[-30, 0.25]] * (share > 0).sum(), rtol=1e-13)

    def test_linear_displacements_and_their_strain_come_out_as_they_are(self):
        """At the surface and in the corners too: this is what a mean alone would not give. Turning as a whole strains nothing."""
        (x, r), grid, shift = shaken(8), grid_of([-7] * 3, 1.4, [11, 9, 10]), [0.01, -0.02, 0.03]
        for g in ([[1e-3, 2e-4, -3e-4], [4e-4, 5e-4, 0], [7e-4, -1e-4, -2e-3]], [[0, -1e-3, 2e-3], [1e-3, 0, 5e-4], [-2e-3, -5e-4, 0]]):
            g = numpy.array(g)
            _, _, u, strain = fields.coarse_grain(x, r, x, grid, REACH, x @ g.T + shift)
            numpy.testing.assert_allclose(u, grid.places @ g.T + shift, atol=1e-12)
            numpy.testing.assert_allclose(strain, numpy.tile((g + g.T).ravel() / 2, (len(u), 1)), atol=1e-12)

    def test_integrals_are_kept(self):
        (x, r), grid = shaken(6), grid_of([-10.2] * 3, 0.6, [35] * 3)
        damage, volume = numpy.abs(numpy.sin(x[:, 0] + 2 * x[:, 2])), 4 / 3 * math.pi * r**3
        share, means, *_ = fields.coarse_grain(x, r, damage[:, None], grid, REACH)
        self.assertAlmostEqual(share.sum() * 0.6**3 / volume.sum(), 1, delta=1e-3)
        self.assertAlmostEqual(numpy.nansum(share * means[:, 0]) * 0.6**3 / (volume * damage).sum(), 1, delta=1e-3)

    def test_a_node_does_not_know_the_rest_of_its_grid(self):
        (x, r), u = shaken(6), numpy.sin(shaken(6)[0])
        fine = fields.coarse_grain(x, r, x, grid_of([-4] * 3, 1, [9] * 3), REACH, u)
        coarse = fields.coarse_grain(x, r, x, grid_of([-4] * 3, 4, [3] * 3), REACH, u)
        for one, other in zip(fine, coarse):  # OpenBLAS sums many small products in another order than few
            numpy.testing.assert_allclose(one.reshape(9, 9, 9, -1)[::4, ::4, ::4], other.reshape(3, 3, 3, -1), rtol=0, atol=1e-14)

    def test_in_a_turned_frame_everything_is_turned(self):
        (x, r), c, d = shaken(6), math.cos(0.7), math.sin(0.7)
        q, place = numpy.array([[c, -d, 0], [0.6 * d, 0.6 * c, -0.8], [0.8 * d, 0.8 * c, 0.6]]), numpy.array([1.3, -0.4, 2.1])
        u = numpy.stack([numpy.sin(x[:, 1]), x[:, 0] * x[:, 2], numpy.cos(x[:, 0])], axis=1)
        share, _, moved, strain = fields.coarse_grain(x, r, x, grid_of(place, 1, [1] * 3), REACH, u)
        after = fields.coarse_grain(x @ q.T, r, x, grid_of(q @ place, 1, [1] * 3), REACH, u @ q.T)
        for found, expected in zip((after[0], after[2], after[3]), (share, moved @ q.T, (q @ strain.reshape(3, 3) @ q.T).reshape(1, 9))):
            numpy.testing.assert_allclose(found, expected, atol=1e-12)

    def test_spheres_in_a_plane_and_single_ones_have_a_displacement_but_no_strain(self):
        x = numpy.stack([*numpy.meshgrid(numpy.arange(-3.0, 4), numpy.arange(-3.0, 4)), numpy.zeros((7, 7))], -1).reshape(-1, 3)
        apart = 100 * numpy.arange(20)[:, None] * [1, 0, 0] + numpy.random.default_rng(2).uniform(-1, 1, (20, 3))
        for x, count in ((x, 1), (apart, 20)):
            u = numpy.tile([0.1, 0, 0], (len(x), 1))
            _, _, moved, strain = fields.coarse_grain(x, numpy.full(len(x), 0.5), x, grid_of([0] * 3, 100, [count, 1, 1]), REACH, u)
            numpy.testing.assert_allclose(moved, [[0.1, 0, 0]] * count, atol=1e-14)
            self.assertTrue(numpy.isnan(strain).all())


    def test_a_thin_layer_is_strained_across(self):
        """A tenth of a radius across is enough to tell a strain from a plane's."""
        x = numpy.array([[i, j, 0.08 if (i + j) % 2 == 0 else -0.08] for i in range(-3, 4) for j in range(-3, 4)])
        _, _, _, strain = fields.coarse_grain(x, numpy.full(49, 0.5), x, grid_of([0] * 3, 1, [1] * 3), 3.1, x * [2e-3, 0, 0.01])
        numpy.testing.assert_allclose(strain[0, [0, 8]], [2e-3, 0.01], atol=1e-12)


class Elements(unittest.TestCase):
    def test_nodes_in_distorted_elements_have_the_fields_of_their_corners(self):
        for size, degree in ((8, 1), (27, 2)):
            cube = fields._POINTS[:size]
            points = cube + 0.1 * numpy.stack([cube[:, 1] * cube[:, 2], cube[:, 2] ** degree, cube[:, 0] * cube[:, 1]], axis=1)
            points = numpy.concatenate([points, points + [2, 0, 0]]) * [1.5, 1, 1]  # two apart
            cells = Grid(points, {}, {}, {}, numpy.arange(2 * size), size * numpy.arange(1, 3))
            grid = grid_of([-0.5, -0.5, 0.45], 0.05, [100, 40, 3])
            nodes, corners, weights = fields.in_hexahedra(grid, cells, "platens.pvd")
            numpy.testing.assert_allclose((weights[:, :, None] * points[corners]).sum(1), grid.places[nodes], atol=1e-9)
            self.assertAlmostEqual(len(nodes) / 3 * 0.05**2, 3, delta=0.2)  # area of the section
            self.assertEqual(len(nodes), len(set(nodes)))
        with self.assertRaisesRegex(InputError, "platens.pvd: holds other elements than hexahedra"):
            fields.in_hexahedra(grid, Grid(points, {}, {}, {}, numpy.arange(4), numpy.array([4])), "platens.pvd")


class OneSphere(InFolder):
    """On an elastic platen, pressed from above, with some shear from below."""

    def run_of(self, shear=0.0, info=None, contacts=None):
        write_history(self.folder, {"z": [0, 1e6]})
        (self.folder / "summary.json").write_text(json.dumps({"packing_fraction": SHARE} if info is None else info))
        write_series(self.folder, "specimen", {1: ([[0, 0, RADIUS]], {
            "radius": [RADIUS], "displacement": [[0, 0, -1e-5]], "stress": [[1e3, 0, 0, 0, 2e3, 0, 0, 0, 3e3]], "id": [7],
            "intact_bonds": [3], "broken_bonds": [1], "fragment": [0]})})
        write_series(self.folder, "contacts", {1: contacts or ([[0, 0, 0], [0, 0, 2 * RADIUS], [0, 0, 0]], {
            "normal": [[0, 0, 1], [0, 0, -1], [0, 0, 1]], "shear": [[shear, 0, 0], [0, 0, 0], [0, 0, 0]],
            "normal_force": [FORCE, FORCE, 1e9], "particle": [7, 7, 8]})})  # the last is of a sphere of another time
        corners = (fields._POINTS[:8] - [0.5, 0.5, 1]) * [4 * RADIUS, 4 * RADIUS, RADIUS]
        write_series(self.folder, "platens", {1: (corners, {"stress": [[0] * 8 + [STEEL]] * 8}, [range(8)])})
        return TestRun(self.folder)

    def stress(self, run):
        return fields.with_contacts(run.specimen[0], run.contacts[0], SHARE, run.folder)[0]

    def test_what_presses_on_a_sphere_is_in_its_stress(self):
        run, volume = self.run_of(shear=12), 4 / 3 * math.pi * RADIUS**3 / SHARE
        s = self.stress(run)
        self.assertAlmostEqual(s[8], 3e3 - 2 * RADIUS * FORCE / volume, delta=1e-6)  # on top of what bonds bring
        self.assertAlmostEqual(s[0], 1e3, delta=1e-6)
        self.assertAlmostEqual(s[2], -0.5 * RADIUS * 12 / volume, delta=1e-6)
        self.assertEqual(s[2], s[6])

    def test_platens_keep_their_own_stress_and_outside_is_empty(self):
        run = self.run_of()
        found = fields.fields_at(run, 1, grid_of([0, 0, -1.5 * RADIUS], RADIUS, [1, 1, 5]), 1.8 * RADIUS)
        self.assertEqual(found.body.tolist(), [0, 2, 1, 1, 0])
        numpy.testing.assert_allclose(found.stress[1:4, 8], [STEEL, *[self.stress(run)[8]] * 2], rtol=1e-9)
        self.assertTrue(numpy.isnan(found.stress[[0, 4]]).all())
        numpy.testing.assert_allclose(found.damage, [math.nan, math.nan, 0.25, 0.25, math.nan])
        numpy.testing.assert_allclose(found.displacement[2], [0, 0, -1e-5])
        self.assertEqual(found.solid_share[[0, 1, 4]].tolist(), [0, 0, 0])

    def test_files_for_paraview_stand_beside_the_frames(self):
        path = fields.write_fields(self.run_of())
        self.assertEqual((path, read_pvd(path)), (self.folder / "fields.pvd", [(1, [self.folder / "frames/fields_000000.vti"])]))
        head, data = (self.folder / "frames/fields_000000.vti").read_bytes().split(b'<AppendedData encoding="raw">\n_')
        nodes = [int(end) + 1 for end in re.search(rb'Piece Extent="0 (\d+) 0 (\d+) 0 (\d+)"', head).groups()]
        origin = numpy.array(re.search(rb'Origin="(.*?)"', head)[1].split(), float)
        numpy.testing.assert_allclose(origin, [-0.03, -0.03, -0.02])
        self.assertTrue((origin + RADIUS * (numpy.array(nodes) - 1) >= [0.03, 0.03, 0.03]).all())
        found = {}
        for kind, name, width, offset in re.findall(rb'type="(\w+)" Name="(\w+)" NumberOfComponents="(\d)".*? offset="(\d+)"', head):
            blocks, size, rest, packed = struct.unpack_from("<4Q", data, int(offset))
            raw = zlib.decompress(data[int(offset) + 32 : int(offset) + 32 + packed])
            self.assertEqual((blocks, size, rest), (1, len(raw), 0))
            found[name.decode()] = numpy.frombuffer(raw, {b"Float32": "<f4", b"UInt8": "u1"}[kind]).reshape(*nodes[::-1], int(width))
        self.assertEqual(list(found), ["stress", "strain", "displacement", "damage", "solid_share", "body"])
        at = (3, 3, 3)  # z, y, x: the centre of the sphere
        self.assertEqual((found["body"][at], found["damage"][at], found["displacement"][at][2]), (1, 0.25, numpy.float32(-1e-5)))
        self.assertEqual(found["stress"][1, 3, 3].tolist(), [0] * 8 + [STEEL])
        self.assertTrue(numpy.isnan(found["strain"][0]).all())

    def test_a_run_that_does_not_say_how_dense_it_is_has_no_stress(self):
        self.assertTrue(fields.has_stress(self.run_of()))
        self.assertFalse(fields.has_stress(self.run_of(info={})))

    def test_contacts_may_be_none_but_a_damaged_file_and_a_missing_array_are_told(self):
        self.assertEqual(self.stress(self.run_of(contacts=([], {})))[8], 3e3)
        with self.assertRaisesRegex(InputError, "contacts.pvd: a frame has no point data 'normal' of 3 components"):
            self.stress(self.run_of(contacts=([[0, 0, 0]], {"normal": [1.0]})))
        run, file = self.run_of(), self.folder / "contacts_0.vtu"
        file.write_text(file.read_text()[:400])
        with self.assertRaisesRegex(InputError, "contacts_0.vtu"):
            self.stress(run)

    def test_the_picture_shows_compression_as_positive_and_half_the_difference_of_principal_stresses(self):
        run = self.run_of()
        picture = fields.picture_of_stress_flow(run)
        panels = house.figure_of(picture).axes[:2]
        self.assertTrue(all(axes.xaxis_inverted() for axes in panels), "x points to the left, as in other pictures")
        scales = [axes.child_axes[0].get_ylim() for axes in panels]
        numpy.testing.assert_allclose(numpy.mean(scales, axis=1), [7, 3.5], rtol=1e-6)  # MPa, of the platen
        self.assertIn("White: neither specimen nor platen", picture.caption)
        self.assertNotIn("rigid", picture.caption)
        del run.grid("platens", run.peak_time).point_data["stress"]
        self.assertIn("Grey: rigid platens", fields.picture_of_stress_flow(run).caption)


if __name__ == "__main__":
    unittest.main()
