"""A page: a title, what leads, tables, pictures under headings; one HTML file that needs no other file and no network."""
import gc
import html
import itertools
import os
import textwrap
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from typing import NamedTuple

from ..errors import OutputError
from . import house

HERE = Path(__file__).resolve().parent


class Table(NamedTuple):
    """header: one text a column. rows: of texts, as many. title: said over it; note: under it."""

    header: list
    rows: list
    title: str = ""
    note: str = ""

    def text(self, width=100):
        """In columns, one line a row; texts of the last column that are too long for `width` are broken."""
        lines = [[str(cell) for cell in line] for line in (self.header, *self.rows)]
        widths = [max(len(line[k]) for line in lines) for k in range(len(self.header))]
        wide = [k for k in range(1, len(widths)) if sum(widths) + 2 * len(widths) > width and widths[k] > 30]
        for k in wide:  # these share what the others leave, and their texts are broken
            rest = sum(w for j, w in enumerate(widths) if j not in wide) + 2 * len(widths)
            widths[k] = min(widths[k], max(24, (width - rest) // len(wide)))
        out = [self.title] if self.title else []
        for n, line in enumerate(lines):
            cells = [textwrap.wrap(cell, w) or [""] if k in wide else [cell] for k, (cell, w) in enumerate(zip(line, widths))]
            for row in itertools.zip_longest(*cells, fillvalue=""):
                out.append("  ".join(f"{cell:<{w}}" if k == 0 or k in wide else f"{cell:>{w}}"
                                     for k, (cell, w) in enumerate(zip(row, widths))).rstrip())
            if n == 0:
                out.append("-" * (sum(widths) + 2 * (len(widths) - 1)))
        return "\n".join([*out, *textwrap.wrap(self.note, width)])

    def html(self):
        def is_text(k):
            return any(len(cell) > 16 and any(map(str.isalpha, cell)) for cell in (str(row[k]) for row in self.rows))

        text = [' class="text"' if is_text(k) else "" for k in range(len(self.header))]

        def row(cells, kind):
            return "<tr>" + "".join(f"<{kind}{how}>{html.escape(str(cell))}</{kind}>" for cell, how in zip(cells, text)) + "</tr>"

        caption = f"<caption>{html.escape(self.title)}</caption>" if self.title else ""
        note = f'<p class="note">{html.escape(self.note)}</p>' if self.note else ""
        return (f'<div class="table"><table>{caption}<thead>{row(self.header, "th")}</thead><tbody>'
                + "\n".join(row(cells, "td") for cells in self.rows) + f"</tbody></table></div>{note}\n")


class Section(NamedTuple):
    """heading: "" for none. tables stand before element (HTML of its own, or a function that returns it), this before the
    pictures."""

    heading: str
    pictures: list
    tables: list = []
    element: object = ""

    @property
    def anchor(self):
        return self.heading.replace(" ", "-")


class Page(NamedTuple):
    """leads: sentences, each a paragraph; head: tables that follow them; remarks: a list after the figures' tables."""

    title: str
    leads: list
    head: list
    sections: list
    remarks: list = []


def _one(job):
    made, folder, forms = _JOBS[job]
    return house.save(made, folder, forms) if isinstance(made, house.Picture) else ([], made())


_JOBS = []


def _draw(jobs, folder, forms):
    """Results of house.save of pictures, and of elements, one after another, made over the cores. Workers are forked, so that they
    have what has been read."""
    _JOBS[:] = [(job, folder, forms) for job in jobs]
    workers = min(len(os.sched_getaffinity(0)), len(_JOBS))
    if workers < 2:
        yield from map(_one, range(len(_JOBS)))
        return
    with ProcessPoolExecutor(workers, get_context("fork"), initializer=gc.disable) as pool:  # workers end soon
        yield from pool.map(_one, range(len(_JOBS)))


def _written(page, drawn):
    body = [f"<h1>{html.escape(page.title)}</h1>"]
    body += [f'<p class="{"verdict" if k == 0 else "lead"}">{html.escape(lead)}</p>' for k, lead in enumerate(page.leads)]
    shown = [s for s in page.sections if s.pictures or s.tables or s.element]
    if any(s.heading for s in shown):
        body.append("<nav>" + " &middot; ".join(f'<a href="#{html.escape(s.anchor)}">{html.escape(s.heading)}</a>'
                                                for s in shown if s.heading) + "</nav>")
    body += [table.html() for table in page.head]
    if page.remarks:
        body.append("<ul>" + "".join(f"<li>{html.escape(one)}</li>" for one in page.remarks) + "</ul>")
    for section in shown:
        if section.heading:
            body.append(f'<h2 id="{html.escape(section.anchor)}">{html.escape(section.heading)}</h2>')
        body += [table.html() for table in section.tables]
        body.append(drawn.get(section.anchor, "") if callable(section.element) else section.element)
        for picture in section.pictures:
            inside = drawn.get(picture.name, '<p class="note">is being drawn: load the page again in a few seconds</p>')
            body.append(f'<figure id="{picture.name}">{inside}<figcaption>{html.escape(picture.caption)}</figcaption></figure>')
    return ('<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
            '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
            f"<title>{html.escape(page.title)}</title>\n<style>{(HERE / 'page.css').read_text()}</style>\n</head>\n<body>\n"
            + "\n".join(body) + f"\n<script>{(HERE / 'page.js').read_text()}</script>\n</body>\n</html>\n")


def write(page, folder, forms=(), say=print):
    """Draws the pictures of a page into folder (made where it is not there) and writes report.html there: first with its
    charts and tables, then whole. Returns the path of the page. OutputError where a file cannot be written."""
    folder = Path(folder)
    pictures = [picture for section in page.sections for picture in section.pictures]
    path, drawn, files = folder / "report.html", {}, []
    try:
        folder.mkdir(parents=True, exist_ok=True)
        charts, images = ([p for p in pictures if p.raster == raster] for raster in (False, True))
        elements = {section.anchor: section.element for section in page.sections if callable(section.element)}
        jobs = {**{p.name: p for p in charts}, **elements, **{p.name: p for p in images}}
        for name, (written, inside) in zip(jobs, _draw(jobs.values(), folder, forms)):
            drawn[name] = inside
            files += written
            if len(drawn) == len(charts) < len(jobs):
                house.write_aside(path, _written(page, drawn).encode(errors="replace"))
        house.write_aside(path, _written(page, drawn).encode(errors="replace"))
    except OSError as error:
        raise OutputError(f"{error.filename or folder}: cannot be written: {error.strerror}") from None
    for file in sorted(files, key=lambda f: [p.name for p in pictures].index(f.stem)):
        say(f"drawn: {file}")
    say(f"page: {path}\n")
    for lead in page.leads:
        say(lead)
    for table in [*page.head, *(t for s in page.sections for t in s.tables)]:
        say(table.text() + "\n")
    for remark in page.remarks:
        say(remark)
    return path
