"""Reads a VTU frame as platen-compress writes it: data appended raw, zlib."""
import array
import re
import struct
import zlib

kinds = {"Float64": "d", "Float32": "f", "Int32": "i", "Int64": "q", "UInt8": "B"}


def values(data, at):
    """One array: [blocks, size, last size, packed sizes ...] and then the packed blocks."""
    blocks = struct.unpack_from("<I", data, at)[0]
    sizes = struct.unpack_from(f"<{blocks}I", data, at + 12)
    at += 4 * (3 + blocks)
    found = b""
    for size in sizes:
        found += zlib.decompress(data[at:at + size])
        at += size
    return found


def arrays(path):
    """All arrays of a frame by name as lists, points under "Points"; vectors as tuples."""
    data = path.read_bytes()
    start = data.index(b"_", data.index(b"<AppendedData")) + 1
    found = {}
    for attributes in re.findall(r"<DataArray([^>]*)>", data[:start].decode()):
        told = dict(re.findall(r'(\w+)="([^"]*)"', attributes))
        if told["type"] not in kinds:
            continue
        numbers = array.array(kinds[told["type"]])
        numbers.frombytes(values(data, start + int(told["offset"])))
        each = int(told.get("NumberOfComponents", 1))
        found[told.get("Name", "Points")] = (
            list(zip(*(numbers[k::each] for k in range(each)))) if each > 1 else list(numbers))
    return found
