#!/usr/bin/env python3
"""Draws the sketches of docs/glossary.md.

    docs/sketches/draw.py           writes docs/images/glossary/*.svg
    docs/sketches/draw.py --check   writes none: says which are not as they would be drawn, with status 1
"""

import pathlib
import sys

sys.dont_write_bytecode = True

from sketches_of_bonds import BONDS  # noqa: E402
from sketches_of_failure import FAILURE  # noqa: E402
from sketches_of_tests import TESTS  # noqa: E402

IMAGES = pathlib.Path(__file__).resolve().parent.parent / "images/glossary"
SHEETS = {**TESTS, **BONDS, **FAILURE}


def main():
    check, changed = "--check" in sys.argv[1:], []
    IMAGES.mkdir(parents=True, exist_ok=True)
    for name, draw in SHEETS.items():
        path, text = IMAGES / f"{name}.svg", draw().text()
        if check and (not path.exists() or path.read_text(encoding="utf-8") != text):
            changed.append(path.name)
        elif not check:
            path.write_text(text, encoding="utf-8")
    for name in changed:
        print(f"{name} is not as docs/sketches/draw.py draws it")
    print(f"sketches: {len(SHEETS)}, {len(changed)} not as drawn")
    return 1 if changed else 0


if __name__ == "__main__":
    sys.exit(main())
