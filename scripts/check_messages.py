#!/usr/bin/env python3
"""Each message that docs/troubleshooting.md quotes is still one of the programs. Reads the sources, runs nothing.

    scripts/check_messages.py

A message is the code of a heading of third order; `...` in it stands for anything. Its parts have to stand, in this
order and near each other, in literals of the sources. Exit status: 0; 1 where one does not.
"""

import pathlib
import re
import sys

SOURCE = pathlib.Path(__file__).resolve().parent.parent
PAGE = SOURCE / "docs/troubleshooting.md"
FOLDERS = ("apps", "coupling", "dem", "fem", "base", "dist", "python")
NEAR = 400  # characters between two parts of one message
FEWEST = 25  # messages of a page that helps


def words_of(source):
    """All literals of a file as one text, as the compiler joins them; what stands between is a blank sign."""
    text = re.sub(r"\"\s*\n?\s*\"", "", source)  # "one " "literal"
    parts = re.findall(r"\"((?:\\.|[^\"\\\n])*)\"", text)
    return "\0".join(re.sub(r"\\(.)", r"\1", p) for p in parts)


def messages(page):
    for line in page.splitlines():
        match = re.match(r"^### (`+)(.*)\1\s*$", line)
        if match:
            yield match.group(2)


def stands_in(message, words):
    """Parts of the message one after the other. What a program puts between two of them is no part."""
    parts = [re.escape(part.strip(" ")) for part in message.split("...") if part.strip(" ")]
    between = r"[\s\S]{0,%d}?" % NEAR
    return re.search(between.join(parts), words) is not None


def main():
    texts = [words_of(path.read_text(encoding="utf-8")) for folder in FOLDERS
             for path in sorted((SOURCE / folder).rglob("*")) if path.suffix in (".cc", ".h", ".py")]
    quoted = list(messages(PAGE.read_text(encoding="utf-8")))
    gone = [m for m in quoted if not any(stands_in(m, text) for text in texts)]
    for message in gone:
        print(f"no program says: {message}")
    print(f"messages: {len(quoted)} quoted, {len(gone)} gone")
    return 1 if gone or len(quoted) < FEWEST else 0


if __name__ == "__main__":
    sys.exit(main())
