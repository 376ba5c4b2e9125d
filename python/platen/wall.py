"""The wall of a sleeve or tube over its height: means around each ring of nodes, from a frame of sleeve.pvd."""
import math

import numpy

from .errors import InputError
from .results import Table

# Half a wave of an elastic tube that buckles alone under axial load: pi / (12 (1 - nu^2))^(1/4) sqrt(R t), with nu = .3 (Timoshenko and Gere 1961).
_HALF_WAVE = math.pi / (12 * (1 - 0.3**2)) ** 0.25


def _rings(height):
    """The ring of each node, from the lower end up. Rings lie far more than a millionth of the height apart."""
    order = numpy.argsort(height, kind="stable")
    new = numpy.diff(height[order], prepend=height[order[0]]) > 1e-6 * numpy.ptp(height)
    ring = numpy.empty(len(height), int)
    ring[order] = numpy.cumsum(new)
    return ring


def wall_rings(frame):
    """A Table of a frame of Run.sleeve, one row a ring of nodes: `z_m` (at the start), `axial_stress_pa` (compression positive), `hoop_stress_pa`
    (tension positive), `plastic_strain` (of the elements at the ring; 0 of rubber), `outward_m`, `pressure_pa` (of the specimen on the inner face),
    `wave_m`: how far the ring lies outside the mean of the wall half a buckling wave below and above it. That is 0 for a wall that has widened alike
    everywhere or in a straight taper, positive for an outward wave, and NaN where the tube ends before."""
    if not {"displacement", "stress", "contact_pressure"} <= set(getattr(frame, "point_data", ())):
        raise InputError("a frame without displacement and stress. Allowed: one of sleeve.pvd")
    moved = frame.point_data["displacement"]
    start = frame.points - moved
    ring, radius = _rings(start[:, 2]), numpy.hypot(start[:, 0], start[:, 1])
    rows = ring.max() + 1

    def mean(values, of=slice(None)):
        return numpy.bincount(ring[of], values[of], rows) / numpy.bincount(ring[of], minlength=rows)

    stress = frame.point_data["stress"].reshape(-1, 3, 3)
    around = numpy.stack([-start[:, 1], start[:, 0]], axis=1) / radius[:, None]
    z, outward = mean(start[:, 2]), mean(numpy.hypot(frame.points[:, 0], frame.points[:, 1]) - radius)
    inner = radius < radius.min() + 1e-3 * numpy.ptp(radius)
    plastic = numpy.zeros(rows)
    if "plastic_strain" in frame.cell_data:
        of_node = numpy.repeat(frame.cell_data["plastic_strain"], numpy.diff(frame.offsets, prepend=0))
        at = ring[frame.connectivity]
        plastic = numpy.bincount(at, of_node, rows) / numpy.bincount(at, minlength=rows)
    half = _HALF_WAVE * math.sqrt(radius.mean() * numpy.ptp(radius))
    beside = [numpy.interp(z + way, z, outward, left=numpy.nan, right=numpy.nan) for way in (-half, half)]
    return Table(z_m=z, axial_stress_pa=-mean(stress[:, 2, 2]), outward_m=outward, plastic_strain=plastic,
                 hoop_stress_pa=mean(numpy.einsum("ni,nij,nj->n", around, stress[:, :2, :2], around)),
                 pressure_pa=mean(frame.point_data["contact_pressure"], inner), wave_m=outward - 0.5 * (beside[0] + beside[1]))
