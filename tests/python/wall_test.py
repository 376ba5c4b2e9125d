"""Means around a wall over its height are those of the frame, and a wave is what stands out of a taper."""
import math
import unittest

import numpy

import platen
from platen.vtu import Grid

RADIUS, THICK, HEIGHT, AROUND, ALONG = 0.05, 0.002, 0.2, 12, 40  # m, m, m


def tube(outward):
    """A frame of a tube that has moved outwards by `outward(z)` and down by z / 1000, its nodes in no order."""
    z, angle, radius = numpy.meshgrid(numpy.linspace(0, HEIGHT, ALONG + 1), 2 * math.pi * numpy.arange(AROUND) / AROUND, [RADIUS, RADIUS + THICK],
                                      indexing="ij")
    z, angle, radius = (numpy.random.default_rng(1).permutation(numpy.stack([z.ravel(), angle.ravel(), radius.ravel()], axis=1)).T)
    start = numpy.stack([radius * numpy.cos(angle), radius * numpy.sin(angle), z], axis=1)
    moved = numpy.stack([outward(z) * numpy.cos(angle), outward(z) * numpy.sin(angle), -1e-3 * z], axis=1)
    # hoop 2e6 (1 + z), radial -1e6, axial -3e6 z; turned to x and y
    hoop, radial, c, s = 2e6 * (1 + z), -1e6, numpy.cos(angle), numpy.sin(angle)
    stress = numpy.zeros((len(z), 3, 3))
    stress[:, 0, 0], stress[:, 1, 1] = radial * c * c + hoop * s * s, radial * s * s + hoop * c * c
    stress[:, 0, 1] = stress[:, 1, 0] = (radial - hoop) * c * s
    stress[:, 2, 2] = -3e6 * z
    pressure = numpy.where(radius < RADIUS + 0.5 * THICK, 1e6 * (1 + z), 0)
    # Elements of one node each, so that a ring has the strain of its own.
    return Grid(start + moved, {"displacement": moved, "stress": stress.reshape(-1, 9), "contact_pressure": pressure}, {"plastic_strain": 0.1 * z},
                {}, numpy.arange(len(z)), numpy.arange(1, len(z) + 1))


class Wall(unittest.TestCase):
    def test_rings_have_the_means_of_their_nodes(self):
        table = platen.wall_rings(tube(lambda z: 1e-4 * (1 + z)))
        z = numpy.linspace(0, HEIGHT, ALONG + 1)
        for name, expected in {"z_m": z, "axial_stress_pa": 3e6 * z, "hoop_stress_pa": 2e6 * (1 + z), "plastic_strain": 0.1 * z,
                               "outward_m": 1e-4 * (1 + z), "pressure_pa": 1e6 * (1 + z)}.items():
            numpy.testing.assert_allclose(table[name], expected, rtol=1e-9, atol=1e-15, err_msg=name)

    def test_a_wave_stands_out_of_a_taper(self):
        half = math.pi / (12 * 0.91) ** 0.25 * math.sqrt((RADIUS + 0.5 * THICK) * THICK)
        self.assertAlmostEqual(half, 1.728 * math.sqrt((RADIUS + 0.5 * THICK) * THICK), places=5)
        taper = platen.wall_rings(tube(lambda z: 1e-3 + 5e-3 * z))["wave_m"]
        within = ~numpy.isnan(taper)
        self.assertLess(abs(taper[within]).max(), 1e-12)
        # Rings nearer to an end than half a wave have no neighbour there.
        self.assertEqual(within.sum(), sum(half <= k * HEIGHT / ALONG <= HEIGHT - half for k in range(ALONG + 1)))
        crest = platen.wall_rings(tube(lambda z: 1e-3 + 5e-3 * z + 1e-4 * numpy.cos(math.pi * (z - 0.5 * HEIGHT) / half)))["wave_m"]
        self.assertAlmostEqual(crest[ALONG // 2] / 2e-4, 1, delta=0.05)  # from trough to crest; between rings it is a straight line
        self.assertEqual(numpy.nanargmax(crest), ALONG // 2)

    def test_another_frame_is_refused(self):
        bare = tube(lambda z: 0 * z)
        bare.point_data.pop("stress")
        for frame in (bare, None, "sleeve.pvd"):
            with self.assertRaisesRegex(platen.InputError, "one of sleeve.pvd"):
                platen.wall_rings(frame)


if __name__ == "__main__":
    unittest.main()
