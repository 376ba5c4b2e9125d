"""A sheet to sketch on: lines, shapes, arrows and words, written as SVG."""

import math

INK, SHADE, LIGHT, RED, BLUE, ORANGE = "#222", "#b9c4cf", "#e8edf2", "#c0392b", "#2a6fb0", "#d9822b"
PALE_RED, PALE_BLUE, PALE_ORANGE, PALE_GREEN = "#f0c9c4", "#c7dbee", "#f6d9b8", "#d5e8d4"
HEAD = ('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {w} {h}" width="{w}" height="{h}" '
        'font-family="DejaVu Sans, sans-serif" font-size="11" stroke-linejoin="round">\n'
        '<title>{title}</title>\n<rect width="{w}" height="{h}" fill="#fff"/>\n')


def n(value):
    return f"{value:.1f}".rstrip("0").rstrip(".")


def by_name(*sketches):
    """The functions that draw, by the names of their files."""
    return {sketch.__name__: sketch for sketch in sketches}


class Sketch:
    """A sheet; y goes down, in pixels."""

    def __init__(self, title, width=290, height=198):
        self.parts = [HEAD.format(w=width, h=height, title=title)]

    def path(self, points, fill="none", stroke=INK, width=1.4, dash="", close=False):
        d = "M" + " L".join(f"{n(x)} {n(y)}" for x, y in points) + (" Z" if close else "")
        dashes = f' stroke-dasharray="{dash}"' if dash else ""
        self.parts.append(f'<path d="{d}" fill="{fill}" stroke="{stroke}" stroke-width="{n(width)}"{dashes}/>\n')

    def line(self, x1, y1, x2, y2, **style):
        self.path([(x1, y1), (x2, y2)], **style)

    def box(self, x, y, w, h, fill=LIGHT, stroke=INK, width=1.4, dash=""):
        self.path([(x, y), (x + w, y), (x + w, y + h), (x, y + h)], fill=fill, stroke=stroke, width=width, dash=dash,
                  close=True)

    def circle(self, x, y, r, fill=LIGHT, stroke=INK, width=1.2):
        self.parts.append(f'<circle cx="{n(x)}" cy="{n(y)}" r="{n(r)}" fill="{fill}" stroke="{stroke}" '
                          f'stroke-width="{n(width)}"/>\n')

    def arrow(self, x1, y1, x2, y2, stroke=INK, both=False, width=1.4):
        self.line(x1, y1, x2, y2, stroke=stroke, width=width)
        tips = [(x1, y1, x2, y2)] + ([(x2, y2, x1, y1)] if both else [])
        for ax, ay, bx, by in tips:
            angle = math.atan2(by - ay, bx - ax)
            self.path([(bx, by)] + [(bx - 7 * math.cos(angle + turn), by - 7 * math.sin(angle + turn))
                                    for turn in (.42, -.42)], fill=stroke, stroke=stroke, width=.5, close=True)

    def words(self, x, y, text, anchor="start", fill=INK, size=11):
        safe = text.replace("&", "&amp;").replace("<", "&lt;")
        self.parts.append(f'<text x="{n(x)}" y="{n(y)}" text-anchor="{anchor}" fill="{fill}" '
                          f'font-size="{n(size)}">{safe}</text>\n')

    def lines_of_words(self, x, y, lines, spacing=13, **style):
        for k, text in enumerate(lines):
            self.words(x, y + spacing * k, text, **style)

    def platens(self, x=60, w=100, top=30, bottom=160):
        """Both platens; what is between them is the caller's."""
        self.box(x - 14, top - 14, w + 28, 14, fill=SHADE)
        self.box(x - 14, bottom, w + 28, 14, fill=SHADE)

    def specimen_between_platens(self):
        self.platens()
        self.box(60, 30, 100, 130)

    def widened_specimen_between_platens(self, opening, x=60, w=100, top=30, bottom=160, steps=30):
        """The lateral surface has moved outwards by opening(z), z from 0 at the top to 1 at the bottom."""
        self.platens(x, w, top, bottom)
        zs = [k / steps for k in range(steps + 1)]
        left = [(x - opening(z), top + z * (bottom - top)) for z in zs]
        right = [(x + w + opening(z), top + z * (bottom - top)) for z in reversed(zs)]
        self.path(left + right, fill=LIGHT, close=True)

    def curve(self, of, x0, x1, steps=40, **style):
        self.path([(x0 + (x1 - x0) * k / steps, of(k / steps)) for k in range(steps + 1)], **style)

    def axes(self, x, y, w, h, along, up):
        self.arrow(x, y, x + w, y)
        self.arrow(x, y, x, y - h)
        self.words(x + w, y + 14, along, "end")
        self.words(x + 6, y - h + 4, up)

    def text(self):
        return "".join(self.parts) + "</svg>\n"
