"""What all pictures look like: colours that the colour-blind tell apart, sizes, axes, and how a picture becomes PNG, SVG, PDF.

A Picture is a grid of panels, each a function that draws on one axes. Nothing here changes matplotlib's settings for others.
"""
import base64
import html
import io
import json
import math
import os
from typing import NamedTuple

import matplotlib
import numpy
from matplotlib import font_manager
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image, features

# Okabe and Ito's colours; one meaning each through a page where it can be.
BLACK, BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY, GREY = (
    "#000000", "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#999999")
CYCLE = (BLUE, VERMILION, GREEN, ORANGE, PURPLE, SKY, BLACK)
MM, MPA, GPA, MS = 1e3, 1e-6, 1e-9, 1e3  # from SI to what axes and tables show
MARKS = "osD^vP*X<>"  # of series that a laboratory or several studies have

# Letters of Chinese, Japanese and Korean titles, where a font for them is installed.
_FURTHER = [name for name in ("WenQuanYi Micro Hei", "Noto Sans CJK JP")
            if any(font.name == name for font in font_manager.fontManager.ttflist)]
STYLE = {"font.family": ["DejaVu Sans", *_FURTHER], "font.size": 9, "axes.titlesize": 9, "axes.titley": 1.02, "axes.labelsize": 9, "legend.fontsize": 8,
         "axes.grid": True, "grid.color": "#e1e1e1", "grid.linewidth": 0.6, "axes.axisbelow": True, "axes.spines.top": False,
         "axes.spines.right": False, "legend.frameon": False, "lines.linewidth": 1.4, "lines.markersize": 4, "svg.fonttype": "none",
         "svg.hashsalt": "platen", "axes.formatter.limits": (-4, 5), "axes.formatter.useoffset": False, "image.interpolation": "nearest",
         "axes.prop_cycle": matplotlib.cycler(color=CYCLE), "path.simplify": True, "pdf.fonttype": 42}
DPI = 120


def digits(value, factor=1.0):
    """Four digits, whole numbers as such; "-" for NaN and None."""
    if value is None or not math.isfinite(value):
        return "-"
    value *= factor
    return f"{value:.0f}" if value == round(value) and abs(value) < 1e7 else f"{value:.4g}"


class Picture(NamedTuple):
    """name: of its files, without ending. rows: of each row of panels the functions draw(axes). heights: inches of each row,
    or one for all. bar: room on the right for colour_bar. shared: all rows have one x axis, labelled at the lowest.
    raster: what it shows is an image, so the page holds a PNG; a chart is held as SVG. titles: room over panels for a title.
    margin: on the left (inches); with less than 0.3 there is no room for labels of axes."""

    name: str
    caption: str
    rows: list
    heights: object = 2.6
    width: float = 7.6
    shared: bool = False
    raster: bool = False
    bar: bool = False
    titles: bool = False
    margin: float = 0.72


def chart(name, caption, *draws, heights=2.6, **more):
    """A Picture of charts one over another."""
    return Picture(name, caption, [[draw] for draw in draws], heights, **more)


def images(name, caption, *draws, height=4.4, width=7.6, bar=True, **more):
    """A Picture of images side by side."""
    return Picture(name, caption, [list(draws)], height, width, raster=True, bar=bar, titles=True, margin=0.1, **more)


def figure_of(picture):
    """The matplotlib Figure of a picture, drawn. Sizes in inches are laid out here: matplotlib's own layouts take most of the
    time of a page."""
    rows = len(picture.rows)
    heights = list(picture.heights) if isinstance(picture.heights, (list, tuple)) else [picture.heights] * rows
    bottom, right, top = (0.5 if picture.margin > 0.3 else 0.12), (0.95 if picture.bar else 0.15), (0.3 if picture.titles else 0.12)
    between = 0.14 if picture.shared else 0.55 + (0.3 if picture.titles else 0)
    total = sum(heights) + bottom + top + between * (rows - 1)
    with matplotlib.rc_context(STYLE):
        figure = Figure(figsize=(picture.width, total))
        FigureCanvasAgg(figure)
        y, first = total - top, None
        for line, height in zip(picture.rows, heights):
            y -= height
            gap = 0.72 if picture.margin > 0.3 else 0.12
            each = (picture.width - picture.margin - right - gap * (len(line) - 1)) / len(line)
            for k, draw in enumerate(line):
                place = [(picture.margin + k * (each + gap)) / picture.width, y / total, each / picture.width, height / total]
                axes = figure.add_axes(place, sharex=first if picture.shared else None)
                first = first or axes
                draw(axes)
                if picture.shared and line is not picture.rows[-1]:
                    axes.tick_params(labelbottom=False, which="both")
                    axes.set_xlabel("")
            y -= between
    return figure


def colour_bar(axes, colours, norm, label):
    """A scale beside the axes: the last panel of a Picture with `bar`."""
    scale = axes.inset_axes([1.03, 0.18, 0.045, 0.64]) if axes.get_aspect() == "auto" else axes.figure.add_axes(_beside(axes))
    axes.figure.colorbar(matplotlib.cm.ScalarMappable(norm, colours), cax=scale, label=label)
    scale.grid(False)
    return scale


def _beside(axes):
    box, width = axes.get_position(), axes.figure.get_figwidth()
    return [1 - 0.82 / width, box.y0 + 0.18 * box.height, 0.13 / width, 0.64 * box.height]


def legend(axes, above=False, **more):
    """A legend where anything has a label; above: over the axes, so that it covers no curve (a Picture with `titles` has room)."""
    if axes.get_legend_handles_labels()[0]:
        axes.legend(**{**({"loc": "lower left", "bbox_to_anchor": (-0.02, 1.0), "ncols": 4, "borderaxespad": 0.1} if above else {}), **more})


def legend_over(axes, columns=1):
    """A legend in the upper part of the axes, whose y axis is made longer, so that it covers no curve."""
    count = len(axes.get_legend_handles_labels()[0])
    if count:
        need = (12 * -(-count // columns) + 6) / (72 * axes.get_position().height * axes.figure.get_figheight())
        scale = axes.yaxis.get_transform()
        low, high = scale.transform(axes.get_ylim())
        axes.set_ylim(top=scale.inverted().transform(low + (high - low) / (1 - min(need, 0.7))))
        axes.legend(loc="upper left", ncols=columns, labelspacing=0.3, borderpad=0.1, borderaxespad=0.4)


def span(axes, start, end, words=""):
    """A grey stretch along x, with words at its top."""
    axes.axvspan(start, end, color="#eeeeee", zorder=0)
    axes.annotate(words, ((start + end) / 2, 1), xycoords=("data", "axes fraction"), ha="center", va="bottom", fontsize=8)


def _hover(figure, name):
    """What the page's script needs to read values off a chart: boxes of axes in SVG's units, limits, labelled curves."""
    width, height = 72 * figure.get_figwidth(), 72 * figure.get_figheight()
    found = []
    for k, axes in enumerate(figure.axes):
        curves = []
        for n, line in enumerate(axes.lines):
            if len(line.get_xdata()) > 1 and line.get_transform() == axes.transData:
                line.set_gid(f"{name}-{k}-{n}")
                label = line.get_label()
                curves.append([f"{name}-{k}-{n}", "" if label.startswith("_") else label])
        if curves:
            box = axes.get_position()
            found.append({"box": [round(v, 2) for v in (box.x0 * width, (1 - box.y1) * height, box.x1 * width, (1 - box.y0) * height)],
                          "x": axes.get_xlim(), "y": axes.get_ylim(), "log": [axes.get_xscale() == "log", axes.get_yscale() == "log"],
                          "curves": curves})
    return json.dumps(found)


def _bytes(figure, form):
    out = io.BytesIO()
    with matplotlib.rc_context(STYLE):
        figure.savefig(out, format=form, metadata={"svg": {"Date": None}, "pdf": {"CreationDate": None}}[form])
    return out.getvalue()


def _pixels(figure):
    with matplotlib.rc_context(STYLE):
        figure.set_dpi(DPI)
        figure.canvas.draw()
    return Image.fromarray(numpy.asarray(figure.canvas.buffer_rgba())).convert("RGB")


def _encoded(image, form, **how):
    out = io.BytesIO()
    image.save(out, form, **how)
    return out.getvalue()


def save(picture, folder, forms=()):
    """Draws a picture into folder as PNG, and, where it is a chart, as what `forms` names (pdf, svg). Returns (files, what
    stands for it in a page): a chart as SVG, an image as WebP, a fifth as large as PNG."""
    figure = figure_of(picture)
    pixels = _pixels(figure)
    written = {"png": _encoded(pixels, "png", compress_level=1)}
    if picture.raster:
        form = "webp" if features.check("webp") else "png"
        data = base64.b64encode(_encoded(pixels, form, quality=82, method=0) if form == "webp" else written["png"]).decode()
        inside = f'<img alt="{html.escape(picture.caption)}" src="data:image/{form};base64,{data}">'
    else:
        hover = _hover(figure, picture.name)
        svg = _bytes(figure, "svg")
        written.update({form: svg if form == "svg" else _bytes(figure, form) for form in forms})
        text = svg.decode()
        inside = text[text.index("<svg"):].replace("<svg", f'<svg class="chart" data-axes="{html.escape(hover)}"', 1)
    files = []
    for form, data in written.items():
        files.append(folder / f"{picture.name}.{form}")
        write_aside(files[-1], data)
    return files, inside


def write_aside(path, data):
    """Writes a file whole or not at all: what was there stays where the disk is full. OSError."""
    aside = path.with_name(path.name + ".new")
    try:
        aside.write_bytes(data)
        os.replace(aside, path)
    except OSError:
        aside.unlink(missing_ok=True)
        raise
