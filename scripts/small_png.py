#!/usr/bin/env python3
"""Makes pictures small enough for the repository: averages whole squares of pixels, takes 128 colours.

    small_png.py LARGE.png SMALL.png [WIDTH]

WIDTH: pixels at most, 800 by default.
"""
import sys

COLOURS = 128


def shrunk(path, factor=1):
    """The picture as RGB, means over squares of `factor` pixels; what does not fill a square at the right and below is left out."""
    from PIL import Image  # comes with matplotlib; only checks need no pictures

    picture = Image.open(path).convert("RGB")
    width, height = (side // factor * factor for side in picture.size)
    return picture.crop((0, 0, width, height)).reduce(factor)


def make_small(large, small, width=800):
    """Writes `large`, at most `width` pixels wide, to `small`, with a palette of COLOURS, white kept white."""
    picture = shrunk(large)
    picture = shrunk(large, -(-picture.width // width)).quantize(COLOURS, method=0, dither=0)
    palette = picture.getpalette()[: 3 * COLOURS]
    for k in range(0, len(palette), 3):
        if min(palette[k : k + 3]) >= 252:
            palette[k : k + 3] = 255, 255, 255
    picture.putpalette(palette)
    picture.save(small, optimize=True)


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    make_small(sys.argv[1], sys.argv[2], *map(int, sys.argv[3:]))
