#!/usr/bin/env python3
"""Lays out the pages of the manual for Sphinx, in a folder of their own.

    scripts/manual_pages.py BUILD PAGES

Pages of the repository are copied and their links led to where the pages stand in the manual; what they link to
beside pages goes with them. Pages of all entries of scenes and of the programs' options are made of what the programs
in BUILD/apps say of themselves. scripts/manual.sh calls this.
"""

import argparse
import os
import pathlib
import re
import shutil
import sys

from check_markdown import LINK, without_code
from manual_reference import library_page, programs_page, scene_pages

SOURCE = pathlib.Path(__file__).resolve().parent.parent
ONE_BY_ONE = {
    "docs/manual/index.md": "index.md",
    "README.md": "overview.md",
    "CHANGELOG.md": "changes.md",
    "CONTRIBUTING.md": "contributing.md",
    "ROADMAP.md": "roadmap.md",
}
BENCH = """# Measurements

What was measured of speed, accuracy and physics, beside laboratories, papers and other programs. Each page says how its
numbers were made.

```{toctree}
:maxdepth: 1
:glob:

*
```
"""
TUTORIAL = """# Tutorial

```{toctree}
:maxdepth: 1
:glob:

lesson*
```
"""


def pages_of_manual():
    """Path in the repository to path in the manual."""
    pages = {SOURCE / of: pathlib.PurePosixPath(to) for of, to in ONE_BY_ONE.items() if (SOURCE / of).exists()}
    for path in sorted((SOURCE / "docs").rglob("*.md")):
        name = path.relative_to(SOURCE / "docs")
        if name.parts[0] != "manual":
            pages[path] = pathlib.PurePosixPath(name)
    for path in sorted((SOURCE / "bench/results").glob("*.md")):
        pages[path] = pathlib.PurePosixPath("bench") / path.name
    return pages


class Layout:
    """Pages on their way into the manual."""

    def __init__(self, to):
        self.to = to
        self.pages = pages_of_manual()

    def beside(self, path):
        """Where a file that is no page stands in the manual; it is copied there."""
        inside = path.relative_to(SOURCE)
        place = pathlib.PurePosixPath(*inside.parts[1:]) if inside.parts[0] == "docs" else "files" / inside
        goal = self.to / place
        if not goal.exists():
            goal.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(path, goal)
        return place

    def led(self, page, target, words, picture):
        """The link as it stands in the manual; its words alone where it leads to a folder."""
        if re.match(r"^([a-z][a-z0-9+.-]*:|#)", target, re.I):
            return target
        name, mark, anchor = target.partition("#")
        goal = (page.parent / name).resolve()
        if goal in self.pages:
            place = self.pages[goal]
        elif goal.is_file() and (picture or goal.suffix != ".md"):
            place = self.beside(goal)
        else:
            return None
        return os.path.relpath(place, self.pages[page].parent) + mark + anchor

    def copy(self, page):
        text = page.read_text(encoding="utf-8")
        parts, at = [], 0
        for match in LINK.finditer("\n".join(without_code(text))):
            start = match.start()
            whole = LINK.match(text, start)
            if whole is None:
                continue
            led = self.led(page, whole.group(3), whole.group(2), whole.group(1))
            parts += [text[at:start], f"{whole.group(1)}[{self.inner(page, whole.group(2))}]({led})"
                      if led else whole.group(2)]
            at = whole.end()
        goal = self.to / self.pages[page]
        goal.parent.mkdir(parents=True, exist_ok=True)
        goal.write_text("".join(parts) + text[at:], encoding="utf-8")

    def inner(self, page, words):
        """Words of a link, which may be a picture with a place of its own."""
        def lead(match):
            return f"![{match.group(2)}]({self.led(page, match.group(3), match.group(2), '!')})" \
                if match.group(1) else match.group(0)
        return LINK.sub(lead, words)


def main():
    parser = argparse.ArgumentParser(description="Lays out the pages of the manual.")
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("pages", type=pathlib.Path)
    asked = parser.parse_args()
    layout = Layout(asked.pages.resolve())
    layout.to.mkdir(parents=True)
    for page in layout.pages:
        layout.copy(page)
    made = {"bench/index.md": BENCH, "library.md": library_page(), "tutorial/index.md": TUTORIAL,
            "programs.md": programs_page(asked.build / "apps"), **scene_pages(asked.build / "apps")}
    for name, text in made.items():
        goal = layout.to / name
        goal.parent.mkdir(parents=True, exist_ok=True)
        goal.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
