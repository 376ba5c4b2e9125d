"""A page: a title, what leads, tables, pictures under headings; one HTML file that needs no other file and no network."""
import html
import itertools
import textwrap
from collections import namedtuple
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
        """In columns, one line a row; long texts are broken where the table is wider than `width`."""
        lines = [[str(cell) for cell in line] for line in (self.header, *self.rows)]
        widths = [max(map(len, column)) for column in zip(*lines)]
        wide = [k for k in range(len(widths)) if sum(widths) + 2 * len(widths) > width and widths[k] > 30]
        for k in wide:  # these share what the others leave, and their texts are broken
            rest = sum(w for j, w in enumerate(widths) if j not in wide) + 2 * len(widths)
            widths[k] = min(widths[k], max(24, (width - rest) // len(wide)))
        out = [self.title] if self.title else []
        for n, line in enumerate(lines):
            cells = [textwrap.wrap(cell, w) or [""] if k in wide else [cell] for k, (cell, w) in enumerate(zip(line, widths))]
            for row in itertools.zip_longest(*cells, fillvalue=""):
                out.append("  ".join(f"{cell:{'<' if k == 0 or k in wide else '>'}{w}}"
                                     for k, (cell, w) in enumerate(zip(row, widths))).rstrip())
            if n == 0:
                out.append("-" * (sum(widths) + 2 * (len(widths) - 1)))
        return "\n".join([*out, *textwrap.wrap(self.note, width)])

    def html(self):
        columns = [[str(cell) for cell in column] for column in zip(*self.rows)] or [[] for _ in self.header]
        how = [' class="text"' * any(len(cell) > 16 and any(map(str.isalpha, cell)) for cell in column) for column in columns]

        def row(cells, kind):
            return "<tr>" + "".join(f"<{kind}{of}>{html.escape(str(cell))}</{kind}>" for cell, of in zip(cells, how)) + "</tr>"

        caption = f"<caption>{html.escape(self.title)}</caption>" if self.title else ""
        note = f'<p class="note">{html.escape(self.note)}</p>' if self.note else ""
        return (f'<div class="table"><table>{caption}<thead>{row(self.header, "th")}</thead><tbody>'
                + "\n".join(row(cells, "td") for cells in self.rows) + f"</tbody></table></div>{note}\n")


class Section(NamedTuple):
    """heading: "" for none. tables stand before element (a function that returns HTML of its own), this before the pictures."""

    heading: str
    pictures: list
    tables: list = []
    element: object = None

    @property
    def anchor(self):
        return self.heading.replace(" ", "-")


class Page(namedtuple("Page", "title leads head sections remarks")):
    """leads: sentences, each a paragraph; head: tables that follow them; remarks: a list after the figures' tables. Tables without rows and
    sections that are None are left out."""

    def __new__(cls, title, leads, head, sections, remarks):
        filled = lambda tables: [table for table in tables if table.rows]  # noqa: E731
        sections = [section._replace(tables=filled(section.tables)) for section in sections if section is not None]
        return super().__new__(cls, title, leads, filled(head), sections, remarks)


def _written(page, drawn):
    title, shown = html.escape(page.title), [s for s in page.sections if s.pictures or s.tables or s.element]
    body = [f"<h1>{title}</h1>"]
    body += [f'<p class="{"lead" if k else "verdict"}">{html.escape(lead)}</p>' for k, lead in enumerate(page.leads)]
    links = [f'<a href="#{html.escape(s.anchor)}">{html.escape(s.heading)}</a>' for s in shown if s.heading]
    body += ["<nav>" + " &middot; ".join(links) + "</nav>"] if links else []
    body += [table.html() for table in page.head]
    body += ["<ul>" + "".join(f"<li>{html.escape(one)}</li>" for one in page.remarks) + "</ul>"] if page.remarks else []
    for section in shown:
        body += [f'<h2 id="{html.escape(section.anchor)}">{html.escape(section.heading)}</h2>'] if section.heading else []
        body += [*(table.html() for table in section.tables), drawn.get(section.anchor, "") if section.element else ""]
        for picture in section.pictures:
            inside = drawn.get(picture.name, '<p class="note">is being drawn: load the page again in a few seconds</p>')
            body.append(f'<figure id="{picture.name}">{inside}<figcaption>{html.escape(picture.caption)}</figcaption></figure>')
    return ('<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
            '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
            f"<title>{title}</title>\n<style>{(HERE / 'page.css').read_text()}</style>\n</head>\n<body>\n"
            + "\n".join(body) + f"\n<script>{(HERE / 'page.js').read_text()}</script>\n</body>\n</html>\n").encode(errors="replace")


def write(page, folder, forms=(), say=print, file="report.html"):
    """Draws the pictures of a page into folder (made where it is not there) and writes the page there as `file`: first with its
    charts and tables, then whole. Returns the path of the page. OutputError where a file cannot be written."""
    folder = Path(folder)
    path, drawn, files = folder / file, {}, {}
    pictures = {picture.name: picture for section in page.sections for picture in section.pictures}
    charts, images = ({name: p for name, p in pictures.items() if p.raster == raster} for raster in (False, True))
    make = lambda what: house.save(what, folder, forms) if isinstance(what, house.Picture) else ([], what())  # noqa: E731
    jobs = {**charts, **{section.anchor: section.element for section in page.sections if section.element}, **images}
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name, (written, inside) in zip(jobs, house.over_cores(make, jobs.values())):
            drawn[name], files[name] = inside, written
            if len(drawn) == len(charts) < len(jobs):
                house.write_aside(path, _written(page, drawn))
        house.write_aside(path, _written(page, drawn))
    except OSError as error:
        raise OutputError(f"{error.filename or folder}: cannot be written: {error.strerror}") from None
    for file in (file for name in pictures for file in files[name]):
        say(f"drawn: {file}")
    say(f"page: {path}\n")
    tables = [*page.head, *(table for section in page.sections for table in section.tables)]
    for text in [*page.leads, *(table.text() + "\n" for table in tables), *page.remarks]:
        say(text)
    return path
