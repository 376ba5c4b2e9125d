"""What a steel tube or a wrap around a specimen bears: loads of both, stresses of the wall, strains of the hoops."""
import numpy

from .curves import along, along_title, wall_word
from .house import BLACK, BLUE, GREEN, MPA, ORANGE, VERMILION, chart, titled

_KN = 1e-3


def loads(axes, run):
    """Load of the platens on specimen and tube, and of each, over strain; a dot at the largest."""
    way, both, tube, word = along(run), run.h["total_load_n"] * _KN, run.h["tube_load_n"] * _KN, wall_word(run)
    row = int(numpy.nanargmax(both))
    axes.plot(way, both, color=BLACK, lw=1.8, label=f"{word} and specimen: at most {both[row]:.4g} kN")
    axes.plot(way, both - tube, color=BLUE, label="specimen")
    axes.plot(way, tube, "--", color=ORANGE, label=word)
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


def hoops(axes, run):
    """Strains of the hoops of a wrap over strain, and what has torn."""
    way = along(run)
    for column, words, colour, line in (("wrap_hoop_strain", "mean of the middle half", BLUE, "-"), ("wrap_largest_hoop_strain", "of any element not torn", VERMILION, "--"),
                                        ("wrap_torn_share", "elements that have torn", BLACK, ":")):
        axes.plot(way, run.h[column] * 100, line, color=colour, label=words)
    titled(axes, along_title(run), "Hoop strain, share (%)", 2)


def pictures_of_tube(run):
    """The Pictures of the tube or wrap; [] of a run without one."""
    if not run.has("total_load_n", "tube_load_n", "tube_axial_stress_pa", "tube_hoop_stress_pa", "tube_pressure_pa"):
        return []
    if wall_word(run) == "wrap":
        return [chart("wrap", "What the specimen bears, and the strains of the wrap's hoops. The second line begins where the concrete, about to fail, presses the wrap; "
                      "it ends where an element of it reaches its rupture strain and the tear runs.", loads, hoops, run=run, heights=[3.2, 2.8], shared=True, margin=0.9)]
    return [chart("tube", "What tube and specimen bear, and the stresses of the tube's middle half. The tube yields along its axis first; as the "
                  "specimen presses it, its hoop stress grows and its axial stress falls on von Mises' ellipse. The curve of both need not have "
                  "a peak.", loads, stresses, run=run, heights=[3.2, 2.8], shared=True, margin=0.9)]
