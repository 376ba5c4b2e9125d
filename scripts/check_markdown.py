#!/usr/bin/env python3
"""Reads Markdown and tells what is dead or broken in it.

    scripts/check_markdown.py                 all *.md of this repository, but of builds and results
    scripts/check_markdown.py FILE...         these alone
    scripts/check_markdown.py --root FOLDER   all *.md below another folder

Told are: links to files or headings that are not there, pictures that are not there, tables whose rows have
different numbers of columns, rows of a table that stand twice, and tables that a blank line cuts in two. What
stands in code is left alone. Exit status: 0; 1 where something is told.
"""

import argparse
import pathlib
import re
import sys
import unicodedata

SOURCE = pathlib.Path(__file__).resolve().parent.parent
SKIPPED = {"results", "node_modules", ".git"}  # and every build folder
LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\[\]]*\])*)\]\(\s*<?([^()\s>]+(?:\([^()\s]*\))?)>?(?:\s+\"[^\"]*\")?\s*\)")
REFERENCE = re.compile(r"^ {0,3}\[[^\]]+\]:\s*<?(\S+?)>?\s*$")
PICTURE = re.compile(r"<img\s[^>]*?src=\"([^\"]+)\"")
NAMED = re.compile(r"<a\s+(?:id|name)=\"([^\"]+)\"|\(([\w-]+)\)=$")
RULE = re.compile(r"^\s*\|?\s*:?-+:?\s*(\|\s*:?-+:?\s*)*\|?\s*$")


def without_code(text):
    """The lines, those of fenced and indented code and code between backquotes blanked, as long as they were."""
    lines, fence, indented = [], "", False
    previous = ""
    for line in text.splitlines():
        mark = re.match(r"^\s*(`{3,}|~{3,})", line)
        if mark and (not fence or (line.strip().startswith(fence) and not line.strip().strip(fence[0]))):
            fence = "" if fence else mark.group(1)
            lines.append(" " * len(line))
        elif fence:
            lines.append(" " * len(line))
        else:
            starts = line.startswith("    ") and not previous.strip() and not in_list(lines)
            indented = bool(line.startswith("    ") and (indented or starts))
            lines.append(" " * len(line) if indented else line)
        previous = line
    return blank_spans("\n".join(lines)).split("\n")


def in_list(lines):
    """What is indented after an item of a list belongs to it, as long as no line begins at the margin."""
    for line in reversed(lines):
        if re.match(r"^\s*([*+-]|\d+\.)\s", line):
            return True
        if line.strip() and not line.startswith(" "):
            return False
    return False


def blank_spans(text):
    """Code between backquotes, also over a line's end, as blanks; links keep their brackets."""
    def blank(match):
        return re.sub(r"[^\n]", "x", match.group(0))

    return re.sub(r"(?<!`)(`+)(?!`)((?:(?!\n\s*\n).)+?)(?<!`)\1(?!`)", blank, text, flags=re.S)


def slug(heading, seen):
    """The anchor that a heading gets: letters, digits, hyphens; a number behind one that was there before."""
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").replace("*", "").strip().lower()
    kept = "".join(c for c in text if c in " -_" or unicodedata.category(c)[0] in "LN")
    name = kept.replace(" ", "-")
    count = seen.get(name, 0)
    seen[name] = count + 1
    return f"{name}-{count}" if count else name


def anchors(path):
    """All anchors of a page: of its headings, and those that stand in it as HTML or before a heading."""
    text = path.read_text(encoding="utf-8")
    found, seen = set(), {}
    plain = text.splitlines()
    for number, line in enumerate(without_code(text)):
        heading = re.match(r"^ {0,3}(#{1,6})\s+\S", line)
        if heading:
            found.add(slug(re.sub(r"^ {0,3}#+\s+|\s+#+\s*$", "", plain[number]), seen))
        for named in NAMED.finditer(line):
            found.add(named.group(1) or named.group(2))
    return found


def dead(path, target, pages):
    """Why a link leads nowhere; nothing where it leads somewhere, or out of the repository."""
    if re.match(r"^[a-z][a-z0-9+.-]*:", target, re.I):
        return ""
    name, _, anchor = target.partition("#")
    goal = (path.parent / name).resolve() if name else path
    if not goal.exists():
        return f"{target}: there is no {name}"
    if anchor and goal.suffix == ".md":
        if goal not in pages:
            pages[goal] = anchors(goal)
        if anchor not in pages[goal]:
            return f"{target}: no heading of {goal.name} has the anchor {anchor}"
    return ""


def links(path, lines, pages):
    """Dead links and pictures, with the line where they begin."""
    text = "\n".join(lines)
    found = [(m.start(), m.group(3)) for m in LINK.finditer(text)]
    found += [(m.start(), m.group(1)) for m in PICTURE.finditer(text)]
    for inner in re.finditer(r"\[!\[[^\]]*\]\(([^)\s]+)\)", text):
        found.append((inner.start(), inner.group(1)))
    at = 0
    for line in lines:
        match = REFERENCE.match(line)
        if match:
            found.append((at, match.group(1)))
        at += len(line) + 1
    for start, target in sorted(set(found)):
        why = dead(path, target, pages)
        if why:
            yield text.count("\n", 0, start) + 1, why


def cells(line):
    """How many columns a row has; a bar behind a backslash is no border, one in code is."""
    row = re.sub(r"\\\|", "  ", line.strip())
    return len(row.strip("|").split("|")) if row.strip("|") else 0


def tables(lines, plain):
    """Tables whose rows are not alike, or stand twice, or that are cut in two."""
    number = 0
    while number < len(lines):
        start = number
        while number < len(lines) and lines[number].lstrip().startswith("|"):
            number += 1
        if number == start:
            number += 1
            continue
        yield from table(lines[start:number], plain[start:number], start + 1)


def table(rows, plain, first):
    """One block of lines that begin with a bar."""
    if len(rows) < 2 or not RULE.match(rows[1]):
        yield first, "a row of a table that has no heading: is a blank line before it?"
        return
    columns, seen, of_name = cells(plain[0]), {}, {}
    for row in plain[2:]:
        of_name.setdefault(first_cell(row), set()).add(row.strip())
    for offset, row in enumerate(plain):
        if cells(row) != columns:
            yield first + offset, f"{cells(row)} columns in a table of {columns}"
        if offset < 2:
            continue
        name = first_cell(row)
        key = name if columns == 2 and re.fullmatch(r"`[^`]+`", name) else row.strip()
        # The same line of two groups of a table, each with its heading, may say the same by chance.
        if key in seen and (key == name or len(of_name[name]) == 1):
            yield first + offset, f"a row of {name} stands in line {seen[key]} already"
        seen.setdefault(key, first + offset)


def first_cell(row):
    return re.sub(r"\s+", " ", row.strip().strip("|").split("|")[0].strip())


def check(path, pages):
    """All faults of a page: line and words."""
    text = path.read_text(encoding="utf-8")
    lines, plain = without_code(text), text.splitlines()
    found = list(links(path, lines, pages)) + list(tables(lines, plain))
    return sorted(found)


def pages_below(root):
    """Every page of the repository; what was built or is a result is none of its pages."""
    for path in sorted(root.rglob("*.md")):
        parts = path.relative_to(root).parts[:-1]
        if parts[:1] and (parts[0] in SKIPPED or parts[0].startswith("build")):
            continue
        yield path


def main():
    parser = argparse.ArgumentParser(description="Tells dead links and broken tables of Markdown.")
    parser.add_argument("files", nargs="*", type=pathlib.Path)
    parser.add_argument("--root", type=pathlib.Path, default=SOURCE)
    asked = parser.parse_args()
    files = [f.resolve() for f in asked.files] or list(pages_below(asked.root.resolve()))
    pages, faults = {}, 0
    for path in files:
        for number, words in check(path, pages):
            faults += 1
            print(f"{path}:{number}: {words}")
    print(f"markdown: {len(files)} pages, {faults} faults")
    return 1 if faults or not files else 0


if __name__ == "__main__":
    sys.exit(main())
