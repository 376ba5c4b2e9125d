"""The interactive view holds the numbers of the run, and needs no other file; the sleeve is stretched as it was made."""
import base64
import math
import shutil
import tempfile
import unittest
from pathlib import Path

import numpy
from report_folders import made_up_run

from platen.errors import InputError
from platen.report import house, specimen, view
from platen.report.run import TestRun
from platen.vtu import Grid

AROUND, ALONG = made_up_run.SLEEVE


class WithRun(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        kept = tempfile.TemporaryDirectory()
        cls.addClassCleanup(kept.cleanup)
        cls.path = Path(kept.name) / "run"
        cls.spheres, cls.times = made_up_run.write_run(cls.path, 0.004)
        cls.run_ = TestRun(cls.path)
        cls.meta, cls.data = view.pack(cls.run_)

    def take(self, kind, *shape):
        values = numpy.frombuffer(self.data, kind, math.prod(shape), self.at).reshape(shape).astype(float)
        self.at += values.size * numpy.dtype(kind).itemsize
        return values

    def places(self, count):
        return self.meta["origin"] + self.meta["step"] * self.take("<u2", count, 3)


class Frames(unittest.TestCase):
    def test_all_are_shown_where_there_is_room(self):
        self.assertEqual(view.frames_to_show(4, 20, [1, 2]), [0, 1, 2, 3])

    def test_of_many_the_first_the_last_and_those_asked_for_stay(self):
        for count in (21, 30, 100, 101, 1000):
            for wanted in (3, 11, 19):
                shown = view.frames_to_show(count, 20, [wanted, count - 2])
                self.assertTrue(17 <= len(shown) <= 20)
                self.assertEqual(shown, sorted(set(shown)))
                self.assertLessEqual({0, wanted, count - 2, count - 1}, set(shown))
                self.assertLessEqual(numpy.diff(shown).max(), count // 15 + 1)


class Packed(WithRun):
    def test_everything_comes_back_within_a_step_in_its_order(self):
        n, radius_step, step = len(self.spheres), self.meta["radius_step"], self.meta["step"]
        self.assertLess(step, 3e-6)  # 0.1 mm would be the displacements that it shows
        self.assertEqual((self.meta["spheres"], len(self.meta["frames"])), (n, len(self.times)))
        self.assertEqual(self.meta["ids"], [s.id for s in self.spheres])
        self.at = 0
        numpy.testing.assert_allclose(self.take("<u2", n) * radius_step, [s.radius for s in self.spheres], atol=0.51 * radius_step)
        for time in self.times:
            wanted = [numpy.add(s.place, s.displacement(time)) for s in self.spheres]
            numpy.testing.assert_allclose(self.places(n), wanted, atol=0.51 * step)
            numpy.testing.assert_allclose(self.take("u1", n) / 255, [s.broken(time) / 10 for s in self.spheres], atol=0.51 / 255)
            piece = [s.piece if time >= 1.5 else 0 for s in self.spheres]
            alone = [255 if p >= 2 else p for p in piece]  # these are spheres by themselves
            self.assertEqual(self.take("u1", n).tolist(), alone)

        rows = list(made_up_run.cracks(self.spheres))
        c, place = len(rows), {s.id: s.place for s in self.spheres}
        self.assertEqual(self.meta["cracks"], c)
        numpy.testing.assert_allclose(self.places(c), [place[row[11]] for row in rows], atol=0.51 * step)
        numpy.testing.assert_allclose(self.take("i1", c, 3) / 127, [row[5:8] for row in rows], atol=0.51 / 127)
        self.assertEqual(self.take("u1", c).tolist(), [row[9] == "shear" for row in rows])
        numpy.testing.assert_allclose(math.pi * (self.take("<u2", c) * radius_step) ** 2, [row[8] for row in rows], rtol=1e-3)
        for since, row in zip(self.take("u1", c).astype(int), rows):
            self.assertGreaterEqual(self.times[since], row[0])
            self.assertTrue(since == 0 or self.times[since - 1] < row[0], "it comes with the first frame that has it")

        corners = self.meta["sleeve"]["corners"]
        self.assertEqual((corners, len(self.meta["sleeve"]["faces"])), (AROUND * (ALONG + 1), 4 * AROUND * ALONG))
        outer = made_up_run.RADIUS + made_up_run.WALL
        for time in [0, *self.times]:
            where = self.places(corners)
            height = where[:, 2] / (1 - 0.01 * time / made_up_run.END) / made_up_run.HEIGHT
            bulge = 0.06 * numpy.sin(math.pi * height) * max(0, time - 0.8)
            numpy.testing.assert_allclose(numpy.hypot(*where.T[:2]), outer * (1 + bulge), atol=1.5 * step)
        self.assertEqual(self.at, len(self.data))

    def test_it_opens_at_the_frame_in_which_the_pattern_is_judged(self):
        frame = self.meta["frames"][self.meta["start_frame"]]
        self.assertEqual((frame["time_s"], frame["words"]), (1.5, "strain 7.50 mm/m, stress 35.0 MPa"))

    def test_a_page_grows_by_eleven_bytes_a_sphere_and_frame(self):
        n, frames, corners = len(self.spheres), len(self.times), self.meta["sleeve"]["corners"]
        self.assertEqual(len(self.data), 2 * n + 8 * n * frames + 13 * self.meta["cracks"] + 6 * corners * (frames + 1))
        self.assertLess((2 + 8 * view.MOST_FRAMES) * 5000 * 4 / 3, 1.2e6)  # letters, of 3 MB that a page of 5 000 spheres may have

    def test_the_element_needs_no_other_file(self):
        html = view.element(self.run_)
        for left in ("@META@", "@DATA@", "@PROGRAM@", "http:", "https:", "src=", "import "):
            self.assertNotIn(left, html)
        self.assertIn(base64.b64encode(self.data).decode(), html)

    def test_frames_with_other_spheres_are_refused(self):
        other = self.path.with_name("other")
        shutil.copytree(self.path, other)
        made_up_run.write_spheres(other / "specimen_2.vtu", self.spheres[1:], 1.0)
        with self.assertRaisesRegex(InputError, "specimen.pvd: the frame at 1 s holds other spheres than the first one"):
            view.pack(TestRun(other))


class Bodies(WithRun):
    def test_two_supports_are_two_and_a_round_platen_is_round(self):
        boxes = self.meta["frames"][0]["platens"]
        self.assertEqual(len(boxes), 3)
        self.assertEqual(boxes[0], [-0.03, -0.03, -0.012, -0.005, 0.03, 0, 0])
        self.assertLess(boxes[1][5], boxes[2][2], "the lower one does not reach into the upper one")
        tube = view.boxes_of(self.run_.series("sleeve")[0], "x")
        self.assertEqual(len(tube), 1, "elements with corners of their own are one body")
        outer = made_up_run.RADIUS + made_up_run.WALL
        numpy.testing.assert_allclose(tube[0], [-outer, -outer, 0, outer, outer, made_up_run.HEIGHT, 1], atol=1e-7)


class Sleeve(WithRun):
    def test_each_face_has_its_corners_from_low_to_high(self):
        grid = self.run_.series("sleeve")[-1]  # deformed: the faces are those of before
        faces = specimen.faces_of(grid, "x")
        for of, radius in ((faces.inner, made_up_run.RADIUS), (faces.outer, made_up_run.RADIUS + made_up_run.WALL)):
            self.assertEqual(of.shape, (AROUND * ALONG, 4))
            x, y, z = faces.initial[of].transpose(2, 0, 1)
            numpy.testing.assert_allclose(numpy.hypot(x, y), radius)
            numpy.testing.assert_allclose(z, z[:, :1] + numpy.array([0, 0, 1, 1]) * made_up_run.HEIGHT / ALONG, atol=1e-12)
            numpy.testing.assert_allclose(x[:, :2], x[:, :1:-1], atol=1e-12)  # upper corners above lower ones
            self.assertTrue((x[:, 0] * y[:, 1] > y[:, 0] * x[:, 1]).all(), "around in one sense")

    def test_stretch_pressure_and_slip_are_those_of_a_known_bulge(self):
        frames = self.run_.series("sleeve")
        faces = specimen.faces_of(frames[0], "x")
        height = faces.initial[faces.inner][:, ::2, 2] / made_up_run.HEIGHT  # of both edges around
        for time, grid in zip(self.times, (frames[k] for k in range(len(frames)))):
            grid.point_data["contact_pressure"] = 1e6 * numpy.arange(len(grid.points))
            around, along, pressure, slip = specimen.state(faces, grid, "x")
            bulge = 0.06 * numpy.sin(math.pi * height) * max(0, time - 0.8)
            numpy.testing.assert_allclose(around, bulge.mean(1), atol=1e-9)
            slope = made_up_run.RADIUS * (bulge[:, 1] - bulge[:, 0]) * ALONG / made_up_run.HEIGHT
            edge = numpy.hypot(slope, 1 - 0.01 * time / made_up_run.END)
            numpy.testing.assert_allclose(along, edge - 1, atol=1e-9)
            numpy.testing.assert_allclose(pressure, 1e6 * faces.inner.mean(1))
            numpy.testing.assert_allclose(slip, 1e-4 * time)

    def test_what_is_no_tube_is_refused(self):
        spheres, frames = self.run_.series("specimen")[0], self.run_.series("sleeve")
        with self.assertRaisesRegex(InputError, "x: holds other elements than hexahedra"):
            specimen.faces_of(spheres, "x")
        with self.assertRaisesRegex(InputError, "x: another sleeve than in the first frame"):
            specimen.state(specimen.faces_of(frames[0], "x"), spheres, "x")
        aside = numpy.array(made_up_run.brick((0.01, 0, 0), (0.02, 0.01, 0.01)))
        with self.assertRaisesRegex(InputError, "x: no tube around the axis"):
            specimen.faces_of(Grid(aside, {"displacement": 0 * aside}, {}, {}, numpy.arange(8), numpy.array([8])), "x")

    def test_it_is_drawn_where_it_is_and_unrolled_over_its_whole_circumference(self):
        pictures = specimen.pictures_of_sleeve(self.run_)
        self.assertEqual([p.name for p in pictures], ["sleeve", "sleeve_unrolled"])
        axes = house.figure_of(pictures[1]).axes[1]
        self.assertEqual(axes.get_title(loc="left"), "at the end: circumferential stretch (%)")
        faces = axes.collections[0]
        covered = sum(numpy.ptp(path.vertices[:, 0].clip(*axes.get_xlim())) * numpy.ptp(path.vertices[:, 1]) for path in faces.get_paths())
        self.assertAlmostEqual(covered / (2e3 * math.pi * made_up_run.RADIUS * 1e3 * made_up_run.HEIGHT), 1)
        self.assertAlmostEqual(faces.get_array().max(), 100 * 0.06 * 1.2 * (1 + math.cos(math.pi / ALONG)) / 2, 6)
        bare = self.path.with_name("bare")
        shutil.copytree(self.path, bare)
        (bare / "sleeve.pvd").unlink()
        self.assertEqual(specimen.pictures_of_sleeve(TestRun(bare)), [])
        self.assertNotIn("sleeve", view.pack(TestRun(bare))[0])


if __name__ == "__main__":
    unittest.main()
