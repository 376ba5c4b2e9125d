"""Cracks: which count, where they lie, their density over height and radius, and what a rose has by chance."""
import math
import unittest

import numpy
from report_folders import InRun, made_up_run

from platen.errors import InputError
from platen.report import cracks, house
from platen.report.run import Extent, TestRun

CYLINDER, DISC = Extent("cylinder", 0.025, 0.025, 0.0, 0.1), Extent("disc", 0.025, 0.01, 0.0, 0.05)


class Density(unittest.TestCase):
    def test_times_the_volume_it_gives_back_every_crack(self):
        draw = numpy.random.default_rng(3).uniform(-1, 1, (500, 3))
        found = cracks.density(draw * [0.02, 0.02, 0.06] + [0, 0, 0.05], None, CYLINDER)  # some outside: they count where they left it
        self.assertFalse(found.is_share)
        rows, columns = found.values.shape
        ring = math.pi * numpy.diff((0.025 * numpy.arange(columns + 1) / columns) ** 2)
        self.assertAlmostEqual((found.values * ring * 0.1 / rows).sum(), 500)

    def test_a_ring_of_cracks_lies_in_its_ring_whatever_the_angle(self):
        turn = numpy.arange(36)
        ring = numpy.column_stack([0.016 * numpy.cos(turn), 0.016 * numpy.sin(turn), 0.07 + 0 * turn])
        found = cracks.density(ring, None, CYLINDER).values
        rows, columns = found.shape
        self.assertEqual((rows, columns), (32, 8), "cells about as high as wide")
        self.assertEqual(numpy.argwhere(found > 0).tolist(), [[int(0.7 * rows), int(0.016 / 0.025 * columns)]])

    def test_a_disc_counts_by_the_distance_from_its_loaded_diameter(self):
        split = numpy.column_stack([[-0.0005] * 19, 0.001 * numpy.arange(-9, 10), [0.025] * 19])  # through the whole thickness
        found = cracks.density(split, None, DISC).values
        rows, columns = found.shape
        self.assertAlmostEqual(found[:, 0].sum() * 2 * 0.025 / columns * 2 * 0.01 * 0.05 / rows, 19)
        self.assertEqual(found[:, 1:].sum(), 0)

    def test_the_share_is_one_where_all_bonds_broke_and_unknown_where_there_are_few(self):
        bonds = numpy.repeat([[0.001, 0, 0.001], [0.001, 0, 0.099], [0.024, 0, 0.05], [0.012, 0, 0.05]], [20, 10, 4, 5], axis=0)
        found = cracks.density(bonds[:20], bonds, CYLINDER)
        self.assertTrue(found.is_share)
        self.assertEqual((found.values[0, 0], found.values[-1, 0], found.values[16, 3]), (1, 0, 0))
        self.assertTrue(math.isnan(found.values[16, -1]))


class Widths(unittest.TestCase):
    def test_shares_are_of_the_area_of_all_cracks_also_of_those_that_no_bin_has(self):
        opening = numpy.array([-1e-6, 2e-8, 3e-6, 4e-6, 2e-4])
        shares = cracks.shares_of_widths(opening, numpy.array([1, 1, 2, 3, 3]) * 1e-6, [1e-7, 1e-6, 1e-5, 1e-4, 1e-3])
        numpy.testing.assert_allclose(shares, [0, 0.5, 0, 0.3])


class OfARun(InRun):
    def test_widths_are_drawn_where_a_crack_is_open_with_the_share_beyond_each_limit(self):
        self.assertNotIn("crack_widths", [p.name for p in cracks.pictures_of_cracks(TestRun(self.path))])
        state = self.path / "crack_state.csv"
        state.write_text("opening_m,area_m2\n-1e-5,1e-6\n6e-5,2e-6\n1.5e-4,3e-6\n9e-4,4e-6\n")
        picture = {p.name: p for p in cracks.pictures_of_cracks(TestRun(self.path))}["crack_widths"]
        self.assertIn("not drawn: 10 %", picture.caption)
        axes = house.figure_of(picture).axes[0]
        self.assertEqual([text.get_text() for text in axes.texts], [" 90 %", " 70 %", " 40 %"])
        state.write_text("opening_m,area_m2\n-1e-5,1e-6\n")
        self.assertNotIn("crack_widths", [p.name for p in cracks.pictures_of_cracks(TestRun(self.path))])

    def test_open_cracks_are_drawn_wide_and_narrow_in_the_colours_of_one_scale(self):
        rows = [(-1e-5, 0), (6e-5, -1), (1.5e-4, -1), (9e-4, 1), (2e-5, -1), (5e-8, -1)]  # opening, sign of y
        (self.path / "crack_state.csv").write_text("mode,time_s,x_m,y_m,z_m,nx,ny,nz,area_m2,opening_m\n" + "".join(
            f"tension,1,0,{0.01 * y},{0.01 + 0.015 * k},0,1,0,2e-5,{opening}\n" for k, (opening, y) in enumerate(rows)))
        run = TestRun(self.path)
        drawn = {}
        original, cracks.draw_half = cracks.draw_half, lambda axes, extent, found, colours: drawn.update({len(drawn): (found, colours)})
        try:
            figure = house.figure_of({p.name: p for p in cracks.pictures_of_cracks(run)}["crack_openings"])
        finally:
            cracks.draw_half = original
        self.assertEqual([axes.get_title() for axes in figure.axes[:2]], ["1 up to 50 µm (both halves)", "3 wider than 50 µm (both halves)"])
        (narrow, its), (wide, theirs) = drawn[0], drawn[1]
        numpy.testing.assert_allclose(narrow.place, [[0, -0.01, 0.07]])
        numpy.testing.assert_allclose(wide.place[:, 2], [0.025, 0.04, 0.055])
        for opening, colour in zip((2e-5, 6e-5, 1.5e-4, 9e-4), [*its, *theirs]):  # the scale is .1 to 900 um
            numpy.testing.assert_allclose(colour, house.VIRIDIS(math.log(opening / 1e-7) / math.log(9000))[:3], atol=0.01)

    def test_only_the_near_half_is_drawn(self):
        figure = house.figure_of(house.chart("empty", "", lambda axes: axes.set_axis_off(), heights=2))
        found = cracks.Cracks(numpy.array([[0, -0.01, 0.05], [0, 0.01, 0.07]]), numpy.array([[0, 1.0, 0]] * 2), numpy.full(2, 2e-5), None, None)
        cracks.draw_half(figure.axes[0], CYLINDER, found, numpy.array([[1.0, 0, 0], [0, 0, 1.0]]))
        image = figure.axes[0].images[0].get_array()
        red, blue = ((image[..., k] > image[..., 2 - k] + 0.2 * image.max()).any() for k in (0, 2))
        self.assertTrue(red)
        self.assertFalse(blue)

    def setUp(self):
        super().setUp()
        self.rows = list(made_up_run.cracks(self.spheres))

    def rewrite(self, change):
        file = self.path / "cracks.csv"
        header, *lines = file.read_text().splitlines()
        names = header.split(",")
        cells = [line.split(",") for line in lines]
        for line in cells:
            change(dict(zip(names, range(len(names)))), line)
        file.write_text("\n".join([header, *map(",".join, cells)]) + "\n")

    def test_those_up_to_the_time_count_and_lie_where_their_spheres_lay(self):
        def move(column, line):
            line[column["z_m"]] = "7.0"
        self.rewrite(move)
        run = TestRun(self.path)
        self.assertEqual(len(cracks.cracks_until(run, 0.5).time), 0)
        found = cracks.cracks_until(run, 1.2)
        wanted = [row for row in self.rows if row[0] <= 1.2]
        self.assertTrue(0 < len(wanted) < len(self.rows))
        place = {s.id: s.place for s in self.spheres}
        numpy.testing.assert_allclose(found.place, [place[row[11]] for row in wanted], atol=1e-12)
        numpy.testing.assert_allclose(found.normal, [row[5:8] for row in wanted])
        self.assertEqual(found.tension.tolist(), [row[9] == "tension" for row in wanted])
        numpy.testing.assert_allclose(found.area, [row[8] for row in wanted])

        def forget(column, line):
            line[column["particle_b"]] = "1"  # no sphere of the run
        self.rewrite(forget)
        self.assertEqual(set(cracks.cracks_until(TestRun(self.path), 2).place[:, 2]), {7.0})

    def test_a_mode_that_is_no_mode_is_refused_with_its_line(self):
        self.rewrite(lambda column, line: line.__setitem__(column["mode"], "bending") if line[0] == repr(self.rows[4][0]) else None)
        with self.assertRaisesRegex(InputError, 'cracks.csv:6: mode "bending" is neither tension nor shear'):
            cracks.cracks_until(TestRun(self.path), 2)
        (self.path / "cracks.csv").write_text("time_s,mode\n1.0,shear\n")
        with self.assertRaisesRegex(InputError, "no column 'x_m'"):
            cracks.cracks_until(TestRun(self.path), 2)

    def test_no_cell_of_a_folder_has_more_breaks_than_bonds_and_the_ends_are_intact(self):
        points = [s.place for s in self.spheres]
        x = numpy.array(points)
        near = numpy.linalg.norm(x[:, None] - x, axis=2) < 0.0095
        pairs = numpy.argwhere(numpy.triu(near, 1))
        made_up_run.write_series(self.path, "bonds", [0.0], lambda file, _: made_up_run.write_grid(file, points, pairs.tolist(), 3, []))
        broken = pairs[(abs(x[pairs].mean(1)[:, 2] - 0.05) < 0.02)][::2]
        numbers = iter(made_up_run.FIRST_ID + broken)
        self.rows = [[1.0, 0, 0, 0, 0, 1, 0, 0, 1e-6, "tension", 0, *next(numbers)] for _ in broken]
        header = (self.path / "cracks.csv").read_text().splitlines()[0]
        (self.path / "cracks.csv").write_text("\n".join([header, *(",".join(map(str, row)) for row in self.rows)]) + "\n")
        found = cracks._density(TestRun(self.path))
        self.assertTrue(found.is_share)
        self.assertLessEqual(numpy.nanmax(found.values), 1)
        image = house.figure_of(cracks.pictures_of_cracks(TestRun(self.path))[2]).axes[0].images[0]
        self.assertAlmostEqual(image.norm.vmax, numpy.nanmax(found.values))
        height = (numpy.arange(len(found.values)) + 0.5) / len(found.values)
        self.assertGreater(numpy.nansum(found.values[abs(height - 0.5) < 0.2]), 0)
        self.assertEqual(numpy.nansum(found.values[abs(height - 0.5) > 0.35]), 0)
        self.assertIn("White cells had fewer than 5 bonds", cracks.pictures_of_cracks(TestRun(self.path))[2].caption)

    def test_there_are_pictures_that_the_files_allow_and_each_panel_counts_its_cracks(self):
        run = TestRun(self.path)
        pictures = {p.name: p for p in cracks.pictures_of_cracks(run)}
        self.assertEqual(list(pictures), ["cracks", "crack_times", "crack_density"])
        until = [row for row in self.rows if row[0] <= run.fall_time]
        titles = lambda name: [axes.get_title() for axes in house.figure_of(pictures[name]).axes if axes.get_title()]
        shear = sum(row[9] == "shear" for row in until)
        self.assertEqual(titles("cracks"), [f"{len(until) - shear} in tension (both halves)", f"{shear} in shear (both halves)"])
        early = sum(row[0] < run.peak_time for row in until)
        self.assertEqual(titles("crack_times"), [f"{early} before the peak (both halves)",
                                                 f"{len(until) - early} after the peak (both halves)"])
        run.peak_words = "largest stress"
        self.assertEqual(titles("crack_times")[0], f"{early} before the largest stress (both halves)")
        run.info["crack_rose"] = [1.0, 1.0]
        self.assertEqual([p.name for p in cracks.pictures_of_cracks(run)][3:], ["crack_rose"])
        for extent, words in ((CYLINDER, "lies along"), (Extent("box", 0.05, 0.01, 0, 0.02), "is vertical")):
            run.extent = extent
            self.assertIn(f"At 90 degrees a crack {words}", cracks.pictures_of_cracks(run)[3].caption)
        run.info["crack_rose"] = [None, None]
        self.assertEqual(len(cracks.pictures_of_cracks(run)), 3)
        (self.path / "cracks.csv").unlink()
        self.assertEqual(cracks.pictures_of_cracks(TestRun(self.path)), [])


class Rose(unittest.TestCase):
    def test_few_cracks_scatter_as_random_ones_do(self):
        area, draw = numpy.array([1.0, 2.0] * 20), numpy.random.default_rng(1)
        angle = numpy.arccos(draw.uniform(0, 1, (4000, 40)))  # all ways alike
        bins = numpy.minimum((angle / (math.pi / 2) * 3).astype(int), 2)
        shares = numpy.array([((bins == k) * area).sum(1) / area.sum() for k in range(3)])
        directions = -numpy.diff(numpy.cos(numpy.radians([0, 30, 60, 90])))
        numpy.testing.assert_allclose(cracks.scatter_of_rose(area, 3), (shares / directions[:, None]).std(1), rtol=0.05)


if __name__ == "__main__":
    unittest.main()
