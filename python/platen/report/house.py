"""What all pictures look like: colours that the colour-blind tell apart, sizes, axes, and how a picture becomes PNG, SVG, PDF.

A Picture is a grid of panels, each a function that draws on one axes. Nothing here changes matplotlib's settings for others.
"""
import base64
import gc
import html
import io
import json
import math
import os
import re
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from multiprocessing import get_context
from typing import NamedTuple

import matplotlib
import numpy
from matplotlib import font_manager
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullLocator
from PIL import Image

# Okabe and Ito's colours; one meaning each through a page where it can be.
BLACK, BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY, GREY = (
    "#000000", "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#999999")
PALE = "#eeeeee"  # of stretches and bands behind curves
CYCLE = (BLUE, VERMILION, GREEN, ORANGE, PURPLE, SKY, BLACK)
VIRIDIS = matplotlib.colormaps["viridis"]
MM, MPA, GPA, MS = 1e3, 1e-6, 1e-9, 1e3  # from SI to what axes and tables show
MARKS = "osD^vP*X<>"  # of series that a laboratory or several studies have

# Letters of Chinese, Japanese and Korean titles, where a font for them is installed.
_FURTHER = [name for name in ("WenQuanYi Micro Hei", "Noto Sans CJK JP")
            if any(font.name == name for font in font_manager.fontManager.ttflist)]
STYLE = {"font.family": ["DejaVu Sans", *_FURTHER], "font.size": 9, "axes.titlesize": 9, "axes.titley": 1.02, "axes.labelsize": 9,
         "legend.fontsize": 8, "axes.grid": True, "grid.color": "#e1e1e1", "grid.linewidth": 0.6, "axes.axisbelow": True,
         "axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False, "lines.linewidth": 1.4, "lines.markersize": 4,
         "svg.fonttype": "none", "svg.hashsalt": "platen", "axes.formatter.limits": (-4, 5), "axes.formatter.useoffset": False,
         "image.interpolation": "nearest", "axes.prop_cycle": matplotlib.cycler(color=CYCLE), "path.simplify": True, "pdf.fonttype": 42}
DPI = 120


def digits(value, factor=1.0):
    """Four digits, whole numbers as such; "-" for NaN and None."""
    if value is None or not math.isfinite(value):
        return "-"
    value *= factor
    return f"{value:.0f}" if value == round(value) and abs(value) < 1e7 else f"{value:.4g}"


class Picture(NamedTuple):
    """name: of its files, without ending. rows: of each row of panels the functions draw(axes). heights: inches of each row,
    or one for all. bar: room on the right for colour_bar. shared: rows that have the x axis of the one above; True: all have one, labelled
    at the lowest.
    raster: what it shows is an image, so the page holds a PNG; a chart is held as SVG. titles: room over panels for a title.
    margin: on the left (inches); with less than 0.3 there is no room for labels of axes."""

    name: str
    caption: str
    rows: list
    heights: object = 2.6
    width: float = 7.6
    shared: object = ()
    raster: bool = False
    bar: bool = False
    titles: bool = False
    margin: float = 0.72


def chart(name, caption, *draws, heights=2.6, width=7.6, shared=(), titles=False, margin=0.72, **of):
    """A Picture of charts one over another; of: what each function draws, by the name of its argument."""
    return Picture(name, caption, [[partial(draw, **of)] for draw in draws], heights, width, shared, titles=titles, margin=margin)


def figure_of(picture):
    """The matplotlib Figure of a picture, drawn. Sizes in inches are laid out here: matplotlib's own layouts take most of the
    time of a page."""
    heights, named = numpy.broadcast_to(picture.heights, len(picture.rows)).tolist(), picture.margin > 0.3
    bottom, right, top = (0.5 if named else 0.12), (0.95 if picture.bar else 0.15), (0.3 if picture.titles else 0.12)
    gap, shared = 0.72 if named else 0.12, range(1, len(heights)) if picture.shared is True else picture.shared
    between = [0.14 if k in shared else 0.55 + (0.3 if picture.titles else 0) for k in range(1, len(heights))] + [0]
    total = sum(heights) + bottom + top + sum(between)
    with matplotlib.rc_context(STYLE):
        figure = Figure(figsize=(picture.width, total))
        FigureCanvasAgg(figure)
        y, first = total - top, None
        for row, (line, height) in enumerate(zip(picture.rows, heights)):
            y -= height
            first = first if row in shared else None
            each = (picture.width - picture.margin - right - gap * (len(line) - 1)) / len(line)
            for k, draw in enumerate(line):
                place = [(picture.margin + k * (each + gap)) / picture.width, y / total, each / picture.width, height / total]
                axes = figure.add_axes(place, sharex=first if shared else None)
                first = first or axes
                draw(axes)
                if row + 1 in shared:
                    axes.tick_params(labelbottom=False, which="both")
                    axes.set_xlabel("")
            y -= between[row]
    return figure


# ---- what several charts have
def titled(axes, x, y, columns=1, **more):
    """Titles of both axes, further settings, and legend_over."""
    axes.set(xlabel=x, ylabel=y, **more)
    legend_over(axes, columns)


def legend_over(axes, columns=1):
    """A legend in the upper part of the axes, whose y axis is made longer, so that it covers no curve."""
    count = len(axes.get_legend_handles_labels()[0])
    if count:
        need = (12 * -(-count // columns) + 6) / (72 * axes.get_position().height * axes.figure.get_figheight())
        scale = axes.yaxis.get_transform()
        low, high = scale.transform(axes.get_ylim())
        axes.set_ylim(top=scale.inverted().transform(low + (high - low) / (1 - min(need, 0.7))))
        axes.legend(loc="upper left", ncols=columns, labelspacing=0.3, borderpad=0.1, borderaxespad=0.4)


def legend_above(axes, **more):
    """A legend over the axes, where anything has a label (a Picture with `titles` has room)."""
    if axes.get_legend_handles_labels()[0]:
        axes.legend(**{"loc": "lower left", "bbox_to_anchor": (-0.02, 1.0), "ncols": 4, "borderaxespad": 0.1, **more})


def colour_bar(axes, colours, norm, label):
    """A scale beside the axes: the last panel of a Picture with `bar`."""
    if axes.get_aspect() == "auto":
        inch = axes.figure.dpi / axes.bbox.width
        scale = axes.inset_axes([1 + 0.12 * inch, 0.18, 0.13 * inch, 0.64])
    else:
        box, width = axes.get_position(), axes.figure.get_figwidth()
        scale = axes.figure.add_axes([1 - 0.82 / width, box.y0 + 0.18 * box.height, 0.13 / width, 0.64 * box.height])
    axes.figure.colorbar(matplotlib.cm.ScalarMappable(norm, colours), cax=scale, label=label)
    scale.grid(False)


def above(axes, x, words, **more):
    """Words over the axes; inside at their top with va="top"."""
    axes.annotate(words, (x, 1), xycoords=("data", "axes fraction"), fontsize=8, **{"ha": "center", "va": "bottom", **more})


def span(axes, start, end, words=""):
    """A grey stretch along x, with words inside at its top."""
    axes.axvspan(start, end, color=PALE, zorder=0)
    above(axes, start, words, ha="left", va="top")


def scatter_bars(axes, x, low, high, colour):
    """Bars of scatter with ends; none where there is one number."""
    x, low, high = (numpy.asarray(values, float) for values in (x, low, high))
    some = high > low
    axes.vlines(x[some], low[some], high[some], color=colour, lw=1.2)
    axes.scatter(numpy.r_[x[some], x[some]], numpy.r_[low[some], high[some]], marker="_", color=colour, s=30)


def bars(axes, names, values, texts, title, colours=BLUE, mark=None):
    """Horizontal bars from above to below, with a text after each; a line at `mark`."""
    axes.barh(range(len(values)), values, color=colours, height=0.62)
    for k, (value, text) in enumerate(zip(values, texts)):
        axes.annotate(text, (max(value, 0), k), (4, 0), textcoords="offset points", va="center", bbox={"fc": "w", "ec": "none", "pad": 1})
    axes.set_yticks(range(len(values)), names)
    axes.set_xlabel(title)
    axes.invert_yaxis()
    axes.grid(False, axis="y")
    axes.margins(x=0.15)
    if mark is not None:
        axes.axvline(mark, color=BLACK)


def plain_decades(axis):
    """Ticks and plain numbers at 1, 2, 5 of a logarithmic axis, of about one decade at all digits."""
    low, high = axis.get_view_interval()
    axis.set_major_locator(LogLocator(subs=(1, 2, 5) if high > 12 * low else range(1, 10)))
    axis.set_major_formatter("{x:g}")
    axis.set_minor_locator(NullLocator())


# ---- files
def _unit(title):
    """" MPa", of "Axial stress (MPa)"; "" where it has none."""
    return "".join(f" {unit}" for unit in re.findall(r"\(([^\s()]+)\)", title)[-1:])


def _hover(figure, name):
    """What the page's script needs to read values off a chart: boxes of axes in SVG's units, units, limits, labelled curves."""
    width, height = 72 * figure.get_figwidth(), 72 * figure.get_figheight()
    found = []
    for k, axes in enumerate(figure.axes):
        curves = []
        for n, line in enumerate(axes.lines):
            if len(line.get_xdata()) > 1 and line.get_transform() == axes.transData:
                line.set_gid(f"{name}-{k}-{n}")
                label = re.split(": (?:peak|largest stress) ", line.get_label())[0]  # values stand behind it
                curves.append([line.get_gid(), "" if label.startswith("_") else label])
        if curves:
            box, of_x = axes.get_position(), (other.get_xlabel() for other in axes.get_shared_x_axes().get_siblings(axes))
            found.append({"box": [round(v, 2) for v in (box.x0 * width, (1 - box.y1) * height, box.x1 * width, (1 - box.y0) * height)],
                          "units": [_unit(next(filter(None, of_x), "")), _unit(axes.get_ylabel())], "x": axes.get_xlim(),
                          "y": axes.get_ylim(), "log": [axes.get_xscale() == "log", axes.get_yscale() == "log"], "curves": curves})
    return json.dumps(found)


def _bytes(save, form, **how):
    out = io.BytesIO()
    save(out, format=form, **how)
    return out.getvalue()


def save(picture, folder, forms=()):
    """Draws a picture into folder as PNG, and, where it is a chart, as what `forms` names (pdf, svg). Returns (files, what
    stands for it in a page): a chart as SVG, an image as WebP, a fifth as large as PNG."""
    figure = figure_of(picture)
    with matplotlib.rc_context(STYLE):
        figure.set_dpi(DPI)
        figure.canvas.draw()
        image = Image.fromarray(numpy.asarray(figure.canvas.buffer_rgba())).convert("RGB")
        written = {"png": _bytes(image.save, "png", compress_level=1)}
        if picture.raster:
            data = base64.b64encode(_bytes(image.save, "webp", quality=82, method=0)).decode()
            inside = f'<img alt="{html.escape(picture.caption)}" src="data:image/webp;base64,{data}">'
        else:
            hover, dates = html.escape(_hover(figure, picture.name)), {"svg": {"Date": None}, "pdf": {"CreationDate": None}}
            made = {form: _bytes(figure.savefig, form, metadata=dates[form]) for form in dict.fromkeys(("svg", *forms))}
            written.update((form, made[form]) for form in forms)
            text = made["svg"].decode()
            inside = text[text.index("<svg"):].replace("<svg", f'<svg class="chart" data-axes="{hover}"', 1)
    files = [folder / f"{picture.name}.{form}" for form in written]
    for file, data in zip(files, written.values()):
        write_aside(file, data)
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


_WORK = []  # what forked workers have: a function and its jobs


def _work(k):
    function, jobs = _WORK
    return function(jobs[k])


def over_cores(function, jobs):
    """function(job) of each job, one after another, made over the cores. Workers are forked, so that they have what has been read."""
    _WORK[:] = function, list(jobs)
    count = len(_WORK[1])
    with ProcessPoolExecutor(min(len(os.sched_getaffinity(0)), count) or 1, get_context("fork"), gc.disable) as pool:  # they end soon
        yield from pool.map(_work, range(count))
