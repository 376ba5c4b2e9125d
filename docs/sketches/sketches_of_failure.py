"""Sketches of how a specimen fails."""

import math

from sketch import BLUE, ORANGE, PALE_BLUE, PALE_ORANGE, PALE_RED, RED, SHADE, Sketch, by_name


def end_spread():
    s = Sketch("End spread: opening of the skin near the ends over its largest")
    s.widened_specimen_between_platens(lambda z: 3 + 22 * math.sin(math.pi * z))
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
    s.widened_specimen_between_platens(lambda z: 6 + 16 * math.sin(math.pi * z))
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
    s.specimen_between_platens()
    s.box(85, 30, 50, 25, fill=PALE_RED, stroke=RED)
    s.box(85, 135, 50, 25, fill=PALE_RED, stroke=RED)
    s.box(85, 82, 50, 25, fill=PALE_BLUE, stroke=BLUE)
    s.lines_of_words(178, 46, ("end damage", "top"), spacing=14, fill=RED)
    s.words(178, 98, "middle damage", fill=BLUE, size=10)
    s.lines_of_words(178, 146, ("end damage", "bottom"), spacing=14, fill=RED)
    s.arrow(85, 121, 135, 121, both=True)
    s.words(110, 119, "Rc", "middle", size=9)
    return s


def cone():
    s = Sketch("Cone by displacement: what has moved with the platen since the peak")
    s.widened_specimen_between_platens(lambda z: 2 + 16 * math.sin(math.pi * z))
    s.path([(62, 30), (158, 30), (110, 92)], fill=PALE_ORANGE, stroke=ORANGE, close=True)
    s.path([(62, 160), (158, 160), (110, 98)], fill=PALE_BLUE, stroke=BLUE, close=True)
    s.line(110, 16, 110, 92, dash="4 3")
    s.path([(110, 66), (119, 70), (124, 74)], width=1)
    s.words(116, 64, "half-angle", size=9)
    s.arrow(110, 30, 110, 50, stroke=RED)
    s.lines_of_words(192, 44, ("moves with", "the top"), fill=ORANGE, size=10)
    s.lines_of_words(192, 140, ("with the", "bottom"), fill=BLUE, size=10)
    s.words(110, 188, "the rest is wedged aside", "middle")
    return s


def dead_zone():
    s = Sketch("Dead zone and r0: radius of its base over that of the specimen")
    s.box(46, 16, 128, 14, fill=SHADE)
    s.box(60, 30, 100, 130)
    s.path([(74, 30), (146, 30), (140, 55), (122, 76), (104, 80), (84, 60)], fill=PALE_ORANGE, stroke=ORANGE,
           close=True)
    s.arrow(110, 38, 146, 38, stroke=ORANGE)
    s.words(120, 51, "r", fill=ORANGE)
    s.arrow(110, 110, 160, 110)
    s.words(134, 124, "Rc", "middle")
    s.line(110, 30, 110, 160, dash="4 3")
    s.words(180, 48, "dead zone", fill=ORANGE)
    s.words(110, 180, "r0 = r / Rc at the platen", "middle")
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
    for colour, group in zip((PALE_BLUE, PALE_ORANGE, "#fff", "#fff"), groups):
        for a in group:
            for b in group:
                if a < b and math.dist(a, b) < 32:
                    s.line(*a, *b, width=3.5)
        for x, y in group:
            s.circle(x, y, 13, fill=colour)
    s.words(130, 178, "two pieces, two loose spheres", "middle")
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


FAILURE = by_name(end_spread, barrel, damage, cone, dead_zone, pattern, fragments, acoustic_event)
