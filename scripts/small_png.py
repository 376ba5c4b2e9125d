#!/usr/bin/env python3
"""Makes pictures small enough for the repository: averages whole squares of pixels, takes 128 colours.

    small_png.py LARGE.png SMALL.png [WIDTH]

WIDTH: pixels at most, 800 by default. Reads PNGs of 8 bits a channel, RGB or RGBA, as platen-report writes them.
"""
import struct
import sys
import zlib

COLOURS = 128


def chunks(png):
    """Type and content of every chunk."""
    if png[:8] != b"\x89PNG\r\n\x1a\n":
        raise ValueError("no PNG")
    place = 8
    while place < len(png):
        length, kind = struct.unpack(">I4s", png[place : place + 8])
        yield kind, png[place + 8 : place + 8 + length]
        place += length + 12


def unfiltered(row, above, kind, step):
    """A row as it was before the PNG filter; all are bytearrays."""
    if kind == 0:
        return row
    if kind == 2:
        return bytearray((a + b) & 255 for a, b in zip(row, above))
    for k in range(len(row)):
        left = row[k - step] if k >= step else 0
        if kind == 1:
            row[k] = (row[k] + left) & 255
        elif kind == 3:
            row[k] = (row[k] + ((left + above[k]) >> 1)) & 255
        else:  # Paeth
            corner = above[k - step] if k >= step else 0
            guess = left + above[k] - corner
            near = min((abs(guess - left), 0, left), (abs(guess - above[k]), 1, above[k]), (abs(guess - corner), 2, corner))
            row[k] = (row[k] + near[2]) & 255
    return row


def read(path):
    """Width and rows of a PNG; a row is a bytearray of RGB."""
    packed = b""
    for kind, content in chunks(open(path, "rb").read()):
        if kind == b"IHDR":
            width, height, bits, colour, _, _, interlaced = struct.unpack(">IIBBBBB", content)
            if bits != 8 or colour not in (2, 6) or interlaced:
                raise ValueError(f"{path}: only RGB or RGBA of 8 bits, not interlaced")
        elif kind == b"IDAT":
            packed += content
    step = 3 if colour == 2 else 4
    plain, stride, rows = zlib.decompress(packed), 1 + step * width, []
    above = bytearray(step * width)
    for k in range(height):
        above = unfiltered(bytearray(plain[k * stride + 1 : (k + 1) * stride]), above, plain[k * stride], step)
        rows.append(above if step == 3 else bytearray(b for i, b in enumerate(above) if i % 4 != 3))
    return width, rows


def shrunk(width, rows, factor):
    """Means over squares of `factor` pixels; what does not fill a square at the right and below is left out."""
    if factor == 1:
        return width, rows
    small, area = [], factor * factor
    for y in range(len(rows) // factor):
        sums = [sum(column) for column in zip(*rows[y * factor : (y + 1) * factor])]
        row = bytearray()
        for x in range(width // factor):
            base = 3 * factor * x
            for channel in range(3):
                row.append(sum(sums[base + channel : base + 3 * factor : 3]) // area)
        small.append(row)
    return width // factor, small


def palette_of(counts, wanted):
    """Median cut: boxes of colours, the one with the most pixels times its longest side is cut first."""

    def weight(box):
        spread = [max(c[k] for c in box) - min(c[k] for c in box) for k in range(3)]
        longest = max(range(3), key=spread.__getitem__)
        return sum(counts[c] for c in box) * spread[longest], longest

    boxes = [(*weight(list(counts)), list(counts))]
    while len(boxes) < wanted:
        boxes.sort(key=lambda box: box[0])
        most, axis, box = boxes.pop()
        if most == 0:
            boxes.append((most, axis, box))
            break
        box.sort(key=lambda c: c[axis])
        half, so_far, cut = sum(counts[c] for c in box) / 2, 0, 1
        for cut in range(1, len(box)):
            so_far += counts[box[cut - 1]]
            if so_far >= half:
                break
        boxes += [(*weight(part), part) for part in (box[:cut], box[cut:])]
    palette, index = [], {}
    for number, (_, _, box) in enumerate(boxes):
        pixels = sum(counts[c] for c in box)
        palette.append(tuple(round(sum(c[k] * counts[c] for c in box) / pixels) for k in range(3)))
        index.update((c, number) for c in box)
    return palette, index


def write(path, width, rows):
    """As a PNG with a palette of COLOURS, white kept white."""

    def coarse(row):  # steps of four, so that counting stays cheap
        return [(r & 0xFC, g & 0xFC, b & 0xFC) for r, g, b in zip(row[0::3], row[1::3], row[2::3])]

    pixels, counts = [coarse(row) for row in rows], {}
    for row in pixels:
        for colour in row:
            counts[colour] = counts.get(colour, 0) + 1
    counts.pop((252, 252, 252), None)
    palette, index = palette_of(counts, COLOURS - 1) if counts else ([], {})
    index[(252, 252, 252)] = len(palette)
    palette.append((255, 255, 255))

    def chunk(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    lines = b"".join(b"\0" + bytes(index[colour] for colour in row) for row in pixels)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        file.write(chunk(b"IHDR", struct.pack(">IIBBBBB", width, len(rows), 8, 3, 0, 0, 0)))
        file.write(chunk(b"PLTE", b"".join(bytes(colour) for colour in palette)))
        file.write(chunk(b"IDAT", zlib.compress(lines, 9)))
        file.write(chunk(b"IEND", b""))


def make_small(large, small, width=800):
    """Writes `large`, at most `width` pixels wide, to `small`."""
    wide, rows = read(large)
    write(small, *shrunk(wide, rows, -(-wide // width)))


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    make_small(sys.argv[1], sys.argv[2], *map(int, sys.argv[3:]))
