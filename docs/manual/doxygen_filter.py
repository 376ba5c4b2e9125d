#!/usr/bin/env python3
"""A header as Doxygen wants it: its plain comments become documentation. The first one is of the file, one on a
line of its own is of what follows, one behind code is of that code."""

import re
import sys


def documented(lines):
    at = 0
    head = []
    while at < len(lines) and lines[at].startswith("//"):
        head.append(lines[at])
        at += 1
    if head:
        yield "/** @file\n"
        for line in head:
            yield " * " + verbatim(line[2:].strip("\n").removeprefix(" ")) + "\n"
        yield " */\n"
    behind = False  # the comment goes on below that of a line of code
    for line in lines[at:]:
        alone = re.match(r"^(\s*)//(?!/)\s?(.*)$", line)
        after = re.match(r"^(.*[;,{)(\w]\s*)//(?!/)\s?(.*)$", line)
        if alone:
            yield f"{alone.group(1)}///{'<' if behind else ''} {verbatim(alone.group(2))}\n"
        elif after and after.group(1).count('"') % 2 == 0 and not re.search(r"[{(]\s*$", after.group(1)):
            behind = True
            yield f"{after.group(1)}///< {verbatim(after.group(2))}\n"
        else:
            behind = False
            yield line


def verbatim(text):
    """Signs that Doxygen would take for commands, as they are."""
    return re.sub(r"([\\@<>#%&])", r"\\\1", text)


if __name__ == "__main__":
    with open(sys.argv[1], encoding="utf-8") as file:
        sys.stdout.writelines(documented(file.readlines()))
