#!/usr/bin/env python3
"""Draws the sketches of docs/glossary.md.

    docs/sketches/draw.py           writes docs/images/glossary/*.svg
    docs/sketches/draw.py --check   writes none: says which are not as they would be drawn, with status 1
"""

import math
import pathlib
import sys

sys.dont_write_bytecode = True

from sketch import BLUE, LIGHT, ORANGE, RED, SHADE, Sketch  # noqa: E402
from sketches_of_bonds import BONDS  # noqa: E402

IMAGES = pathlib.Path(__file__).resolve().parent.parent / "images/glossary"


def skin(s, opening, x=60, w=100, top=30, bottom=160, fill=LIGHT):
    """A specimen whose skin has opened by opening(z), z from 0 on top to 1 below."""
    steps = 30
    zs = [k / steps for k in range(steps + 1)]
    left = [(x - opening(z), top + z * (bottom - top)) for z in zs]
    right = [(x + w + opening(z), top + z * (bottom - top)) for z in reversed(zs)]
    s.path(left + right, fill=fill, close=True)


def end_spread():
    s = Sketch("End spread: opening of the skin near the ends over its largest")
    s.platens()
    skin(s, lambda z: 3 + 22 * math.sin(math.pi * z))
    for y in (38, 152):
        s.arrow(160, y, 172, y, stroke=RED)
    s.arrow(160, 95, 184, 95, stroke=BLUE)
    s.line(160, 30, 160, 160, dash="3 3")
    s.words(194, 40, "near the end", fill=RED)
    s.words(194, 99, "largest", fill=BLUE)
    s.words(110, 188, "red over blue: small here, dry ends", "middle")
    return s


def barrel():
    s = Sketch("Barrel: opening at the ends over opening of the middle, at the peak")
    s.platens()
    skin(s, lambda z: 6 + 16 * math.sin(math.pi * z))
    s.line(160, 30, 160, 160, dash="3 3")
    for y in (37, 153):
        s.arrow(160, y, 169, y, stroke=RED)
    for y in (88, 102):
        s.arrow(160, y, 182, y, stroke=BLUE)
    s.words(192, 41, "two end slices", fill=RED, size=10)
    s.words(192, 99, "two middle", fill=BLUE, size=10)
    s.words(110, 188, "mean of red over mean of blue", "middle")
    return s


def damage():
    s = Sketch("End damage and middle damage: shares of broken bonds in three regions of the core")
    s.platens()
    s.box(60, 30, 100, 130)
    s.box(85, 30, 50, 25, fill="#f0c9c4", stroke=RED)
    s.box(85, 135, 50, 25, fill="#f0c9c4", stroke=RED)
    s.box(85, 82, 50, 25, fill="#c7dbee", stroke=BLUE)
    s.words(178, 46, "end damage", fill=RED)
    s.words(178, 60, "top", fill=RED)
    s.words(178, 98, "middle damage", fill=BLUE, size=10)
    s.words(178, 146, "end damage", fill=RED)
    s.words(178, 160, "bottom", fill=RED)
    s.arrow(85, 121, 135, 121, both=True)
    s.words(110, 119, "Rc", "middle", size=9)
    return s


def strains():
    s = Sketch("Platen strain between the faces, gauge strain of the middle half")
    s.platens()
    s.box(60, 30, 100, 130)
    s.box(60, 62, 100, 65, fill="#c7dbee", stroke=BLUE)
    s.arrow(38, 30, 38, 160, stroke=RED, both=True)
    s.words(32, 90, "H", "end", fill=RED)
    s.arrow(180, 62, 180, 127, stroke=BLUE, both=True)
    s.words(186, 98, "H/2", fill=BLUE)
    for x, y in ((75, 75), (105, 83), (140, 72), (90, 108), (125, 115), (148, 100), (70, 98), (115, 100)):
        s.circle(x, y, 4, fill="#fff")
    s.words(110, 188, "red: platen strain; blue: gauge strain", "middle")
    return s


def cone():
    s = Sketch("Cone by displacement: what has moved with the platen since the peak")
    s.platens()
    skin(s, lambda z: 2 + 16 * math.sin(math.pi * z))
    s.path([(62, 30), (158, 30), (110, 92)], fill="#f6d9b8", stroke=ORANGE, close=True)
    s.path([(62, 160), (158, 160), (110, 98)], fill="#c7dbee", stroke=BLUE, close=True)
    s.line(110, 16, 110, 92, dash="4 3")
    s.path([(110, 66), (119, 70), (124, 74)], width=1)
    s.words(116, 64, "half-angle", size=9)
    s.arrow(110, 30, 110, 50, stroke=RED)
    s.words(192, 44, "moves with", fill=ORANGE, size=10)
    s.words(192, 57, "the top", fill=ORANGE, size=10)
    s.words(192, 140, "with the", fill=BLUE, size=10)
    s.words(192, 153, "bottom", fill=BLUE, size=10)
    s.words(110, 188, "the rest is wedged aside", "middle")
    return s


def dead_zone():
    s = Sketch("Dead zone and r0: radius of its base over that of the specimen")
    s.box(46, 16, 128, 14, fill=SHADE)
    s.box(60, 30, 100, 130)
    s.path([(74, 30), (146, 30), (140, 55), (122, 76), (104, 80), (84, 60)], fill="#f6d9b8", stroke=ORANGE, close=True)
    s.arrow(110, 38, 146, 38, stroke=ORANGE)
    s.words(120, 51, "r", fill=ORANGE)
    s.arrow(110, 110, 160, 110)
    s.words(134, 124, "Rc", "middle")
    s.line(110, 30, 110, 160, dash="4 3")
    s.words(180, 48, "dead zone", fill=ORANGE)
    s.words(110, 180, "r0 = r / Rc at the platen", "middle")
    return s


def sound_cone():
    s = Sketch("Sound cone: the piece on a platen whose spheres have kept their bonds")
    s.platens()
    s.box(60, 30, 100, 130)
    s.path([(64, 30), (156, 30), (142, 46), (134, 68), (120, 74), (110, 94), (98, 70), (86, 64), (78, 44)],
           fill="#d5e8d4", stroke="#3c7a3a", close=True)
    s.path([(62, 30), (158, 30), (110, 96)], stroke=ORANGE, dash="4 3", close=True)
    for x, y in ((75, 110), (90, 130), (105, 115), (120, 140), (140, 105), (148, 130), (100, 148), (78, 86), (146, 82)):
        s.line(x - 4, y + 3, x + 4, y - 3, stroke=RED)
    s.words(178, 48, "sound piece", fill="#3c7a3a")
    s.words(178, 76, "fitted cone", fill=ORANGE)
    s.words(178, 126, "broken", fill=RED)
    return s


def wave_crossing():
    s = Sketch("Wave crossing: a wave runs from one platen to the other")
    s.platens()
    s.box(60, 30, 100, 130)
    for k, y in enumerate((44, 72, 100, 128)):
        s.curve(lambda t, y=y: y + 5 * math.sin(2 * math.pi * t), 66, 154, stroke=BLUE, width=2.4 - .5 * k)
    s.arrow(180, 34, 180, 156, stroke=BLUE)
    s.words(187, 90, "one crossing", fill=BLUE, size=10)
    s.words(187, 103, "T = H / c", fill=BLUE, size=10)
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


def pattern():
    s = Sketch("Patterns of failure: cones, shear plane, splitting, crushing", 400, 150)
    for k, name in enumerate(("cones", "shear plane", "splitting", "crushing")):
        x = 18 + 96 * k
        s.platens(x + 10, 56, 26, 112)
        s.box(x + 10, 26, 56, 86)
        lines = {0: [((0, 0), (28, 40), (56, 0)), ((0, 86), (28, 46), (56, 86))], 1: [((2, 12), (54, 76))],
                 2: [((16, 2), (15, 84)), ((30, 2), (32, 84)), ((43, 2), (42, 84))],
                 3: [((4 + 9 * j, 52 + 6 * (j % 2)), (10 + 9 * j, 84)) for j in range(6)]}[k]
        for way in lines:
            s.path([(x + 10 + a, 26 + b) for a, b in way], stroke=RED, width=1.8)
        s.words(x + 38, 143, name, "middle")
    return s


def fragments():
    s = Sketch("Fragments: pieces that hang together by bonds")
    groups = (((70, 50), (96, 44), (84, 72), (110, 68)), ((150, 90), (176, 84), (168, 110)), ((90, 130),), ((205, 50),))
    for colour, group in zip(("#c7dbee", "#f6d9b8", "#fff", "#fff"), groups):
        for a in group:
            for b in group:
                if a < b and math.dist(a, b) < 32:
                    s.line(*a, *b, width=3.5)
        for x, y in group:
            s.circle(x, y, 13, fill=colour)
    s.words(130, 178, "two pieces, two loose spheres", "middle")
    return s


def energy_balance():
    s = Sketch("Energy balance: work done against what is stored and lost")
    s.box(50, 40, 46, 120, fill="#c7dbee")
    s.words(73, 178, "work done", "middle", size=10)
    at = 160
    for name, h, fill in (("bonds", 52, "#d5e8d4"), ("motion", 6, "#f6d9b8"), ("fracture", 34, "#f0c9c4"),
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


def acoustic_event():
    s = Sketch("Acoustic event: cracks near each other in place and time")
    s.axes(28, 160, 215, 140, "time", "place")
    for group, colour in (((60, 120, 6, 4), BLUE), ((120, 70, 9, 7), RED), ((190, 100, 3, 2), ORANGE)):
        x, y, count, spread = group
        for k in range(count):
            s.circle(x + spread * 3 * math.cos(2.4 * k) * k / count, y + spread * 3 * math.sin(2.4 * k) * k / count, 2.5,
                     fill=colour, stroke=colour)
        s.circle(x, y, 12 + 2 * spread, fill="none", stroke=colour)
    s.words(130, 26, "each ring is one event", "middle")
    return s


SHEETS = {name: draw for name, draw in globals().items() if callable(draw) and name in (
    "end_spread", "barrel", "damage", "strains", "cone", "dead_zone", "sound_cone", "wave_crossing", "quasi_static", "peak",
    "packing_fraction", "friction", "confinement", "pattern", "fragments", "energy_balance", "slenderness",
    "acoustic_event")}
SHEETS.update(BONDS)


def main():
    check, changed = "--check" in sys.argv[1:], []
    IMAGES.mkdir(parents=True, exist_ok=True)
    for name, draw in SHEETS.items():
        path, text = IMAGES / f"{name}.svg", draw().text()
        if check and (not path.exists() or path.read_text(encoding="utf-8") != text):
            changed.append(path.name)
        elif not check:
            path.write_text(text, encoding="utf-8")
    for name in changed:
        print(f"{name} is not as docs/sketches/draw.py draws it")
    print(f"sketches: {len(SHEETS)}, {len(changed)} not as drawn")
    return 1 if changed else 0


if __name__ == "__main__":
    sys.exit(main())
