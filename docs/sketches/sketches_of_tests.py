"""Sketches of the specimen and of tests: strains, loads, slowness."""

import math

from sketch import BLUE, LIGHT, ORANGE, PALE_BLUE, PALE_GREEN, PALE_ORANGE, PALE_RED, RED, SHADE, Sketch, by_name


def strains():
    s = Sketch("Platen strain between the faces, gauge strain of the middle half")
    s.specimen_between_platens()
    s.box(60, 62, 100, 65, fill=PALE_BLUE, stroke=BLUE)
    s.arrow(38, 30, 38, 160, stroke=RED, both=True)
    s.words(32, 90, "H", "end", fill=RED)
    s.arrow(180, 62, 180, 127, stroke=BLUE, both=True)
    s.words(186, 98, "H/2", fill=BLUE)
    for x, y in ((75, 75), (105, 83), (140, 72), (90, 108), (125, 115), (148, 100), (70, 98), (115, 100)):
        s.circle(x, y, 4, fill="#fff")
    s.words(110, 188, "red: platen strain; blue: gauge strain", "middle")
    return s


def wave_crossing():
    s = Sketch("Wave crossing: a wave runs from one platen to the other")
    s.specimen_between_platens()
    for k, y in enumerate((44, 72, 100, 128)):
        s.curve(lambda t, y=y: y + 5 * math.sin(2 * math.pi * t), 66, 154, stroke=BLUE, width=2.4 - .5 * k)
    s.arrow(180, 34, 180, 156, stroke=BLUE)
    s.lines_of_words(187, 90, ("one crossing", "T = H / c"), fill=BLUE, size=10)
    return s


def quasi_static():
    s = Sketch("Quasi-static: the test is slow enough that speed does not raise the strength")
    s.axes(30, 160, 210, 140, "strain", "stress")
    rise = lambda top, width: (lambda t: 160 - top * math.sin(math.pi * min(t / width, 1)) ** .9)  # noqa: E731
    s.curve(rise(86, .95), 30, 220, stroke=BLUE, width=2)
    s.curve(lambda t: 160 - 122 * math.sin(math.pi * min(t, 1)) ** .9 + 3 * math.sin(60 * t), 30, 226, stroke=RED)
    s.words(186, 62, "too fast", fill=RED)
    s.words(104, 96, "slow", fill=BLUE)
    return s


def peak():
    s = Sketch("Peak, 0.8 of the peak, secant modulus at 40 percent, residual")
    s.axes(30, 165, 215, 150, "strain", "stress")
    points = [(30, 165), (80, 95), (110, 57), (130, 42), (146, 46), (160, 64), (176, 100), (200, 138), (232, 150)]
    s.path(points, stroke=BLUE, width=2)
    s.line(30, 42, 130, 42, dash="3 3")
    s.words(134, 36, "peak: strength")
    s.circle(161, 66, 3.5, fill=RED, stroke=RED)
    s.words(168, 68, "0.8 of it, after it", fill=RED, size=10)
    s.line(30, 165, 92, 79, stroke=ORANGE, dash="5 3", width=1.8)
    s.circle(65, 116, 3.5, fill=ORANGE, stroke=ORANGE)
    s.words(72, 122, "secant at 0.4", fill=ORANGE, size=10)
    s.words(182, 146, "residual", size=10)
    return s


def packing_fraction():
    s = Sketch("Packing fraction: volume of the spheres over that of the specimen")
    s.box(60, 20, 130, 130, fill="#fff")
    for x, y, r in ((82, 42, 20), (122, 40, 18), (164, 46, 22), (82, 86, 20), (120, 78, 17), (160, 92, 20), (78, 128, 18),
                    (116, 120, 21), (158, 130, 17)):
        s.circle(x, y, r, fill=SHADE)
    s.words(125, 172, "grey over the whole box", "middle")
    return s


def friction():
    s = Sketch("Platen friction: a platen holds the end of the specimen back")
    s.box(46, 30, 150, 16, fill=SHADE)
    s.box(70, 46, 102, 90)
    for x in (80, 100, 142, 162):
        way = 12 if x < 121 else -12
        s.arrow(x, 54, x + way, 54, stroke=RED)
    s.arrow(70, 110, 48, 110, stroke=BLUE)
    s.arrow(172, 110, 194, 110, stroke=BLUE)
    s.words(121, 70, "friction on the specimen", "middle", fill=RED, size=9)
    s.words(121, 114, "it wants to widen", "middle", fill=BLUE, size=9)
    s.arrow(121, 8, 121, 28)
    s.words(121, 160, "at most mu times the pressure", "middle")
    return s


def confinement():
    s = Sketch("Confining pressure, deviator")
    s.box(75, 40, 90, 100)
    for y in (55, 80, 105, 130):
        s.arrow(45, y, 73, y, stroke=BLUE)
        s.arrow(195, y, 167, y, stroke=BLUE)
    for x in (85, 108, 132, 155):
        s.arrow(x, 14, x, 38, stroke=RED)
        s.arrow(x, 166, x, 142, stroke=RED)
    s.words(200, 94, "p", fill=BLUE)
    s.words(176, 24, "axial stress", fill=RED, size=10)
    s.words(120, 186, "deviator = axial stress - p", "middle")
    return s


def energy_balance():
    s = Sketch("Energy balance: work done against what is stored and lost")
    s.box(50, 40, 46, 120, fill=PALE_BLUE)
    s.words(73, 178, "work done", "middle", size=10)
    at = 160
    for name, h, fill in (("bonds", 52, PALE_GREEN), ("motion", 6, PALE_ORANGE), ("fracture", 34, PALE_RED),
                          ("friction", 18, SHADE), ("damping", 6, LIGHT)):
        at -= h
        s.box(130, at, 46, h, fill=fill)
        s.words(182, at + h / 2 + 4, name, size=10)
    s.line(96, 40, 180, 40, dash="3 3")
    s.arrow(120, 28, 120, 40, stroke=RED)
    s.words(116, 24, "residual", "middle", fill=RED, size=10)
    s.words(153, 178, "stored, lost", "middle", size=10)
    return s


def slenderness():
    s = Sketch("Slenderness: height over width")
    for x, h in ((40, 60), (152, 120)):
        s.platens(x, 60, 160 - h, 160)
        s.box(x, 160 - h, 60, h)
    s.words(70, 188, "1", "middle")
    s.words(182, 188, "2", "middle")
    s.arrow(236, 40, 236, 160, both=True)
    s.words(243, 104, "H")
    return s


TESTS = by_name(strains, wave_crossing, quasi_static, peak, packing_fraction, friction, confinement, energy_balance,
                slenderness)
