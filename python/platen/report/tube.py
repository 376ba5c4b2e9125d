"""What a steel tube around a specimen bears: loads of both, and stresses of the wall."""
import numpy

from .curves import along, along_title
from .house import BLACK, BLUE, GREEN, MPA, ORANGE, VERMILION, chart, titled

_KN = 1e-3


def loads(axes, run):
    """Load of the platens on specimen and tube, and of each, over strain; a dot at the largest."""
    way, both, tube = along(run), run.h["total_load_n"] * _KN, run.h["tube_load_n"] * _KN
    row = int(numpy.nanargmax(both))
    axes.plot(way, both, color=BLACK, lw=1.8, label=f"tube and specimen: at most {both[row]:.4g} kN")
    axes.plot(way, both - tube, color=BLUE, label="specimen")
    axes.plot(way, tube, "--", color=ORANGE, label="tube")
    axes.plot(way[row], both[row], "o", color=BLACK)
    titled(axes, along_title(run), "Load (kN)", 2)


def von_mises(run):
    """Pa, of the mean stresses of the wall; its radial stress, up to the pressure, is left out."""
    axial, hoop = run.h["tube_axial_stress_pa"], run.h["tube_hoop_stress_pa"]
    return numpy.sqrt(axial**2 + hoop**2 + axial * hoop)  # compression and tension, each positive


def stresses(axes, run):
    """Stresses of the wall and its pressure over strain."""
    way = along(run)
    for values, words, colour, line in ((run.h["tube_axial_stress_pa"], "axial, compression positive", ORANGE, "-"),
                                        (run.h["tube_hoop_stress_pa"], "hoop, tension positive", VERMILION, "-"),
                                        (von_mises(run), "von Mises of both", BLACK, ":"),
                                        (run.h["tube_pressure_pa"], "pressure on the specimen", GREEN, "--")):
        axes.plot(way, values * MPA, line, color=colour, label=words)
    titled(axes, along_title(run), "Stress (MPa)", 2)


def pictures_of_tube(run):
    """The Pictures of the tube; [] of a run without one."""
    if not run.has("total_load_n", "tube_load_n", "tube_axial_stress_pa", "tube_hoop_stress_pa", "tube_pressure_pa"):
        return []
    return [chart("tube", "What tube and specimen bear, and the stresses of the tube's middle half. The tube yields along its axis first; as the "
                  "specimen presses it, its hoop stress grows and its axial stress falls on von Mises' ellipse. The curve of both need not have "
                  "a peak.", loads, stresses, run=run, heights=[3.2, 2.8], shared=True, margin=0.9)]
