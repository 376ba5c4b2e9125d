"""The interactive view of a page: frames, cracks, platens and sleeve of a run, packed with the program that draws them (viewer/viewer.js,
WebGL 2). It needs no other file and no network."""
import base64
import json
from pathlib import Path

import numpy

from ..errors import InputError
from .cracks import cracks_until
from .house import MM, MPA
from .run import nearest
from .specimen import faces_of, same
from .spheres import boxes_of, joined

HERE = Path(__file__).resolve().parent / "viewer"
MOST_FRAMES = 20


def frames_to_show(count, most, wanted):
    """Numbers of the frames that are shown when of `count` at most `most` can be: the first, the last, those of `wanted` and,
    between them, as many as there is room for, evenly."""
    if count <= most:
        return list(range(count))
    for between in range(most, 0, -1):
        shown = sorted({*wanted, 0, count - 1, *(k * (count - 1) // max(1, between - 1) for k in range(between))})
        if len(shown) <= most:
            return shown


def pack(run, most_frames=MOST_FRAMES):
    """(meta, bytes) of a page. The bytes, little-endian, one after the other: radii (2 bytes each, multiples of meta's radius_step); for
    each frame the places of all spheres (3 x 2 bytes, multiples of `step` from `origin`), their damage (1 byte, 255: all bonds
    broken) and fragment (1 byte; 0 the largest, 1 to 254 the others by size, again from 1; 255 a single sphere); then for all cracks
    places (3 x 2 bytes), normals (3 x 1 byte, 127: 1), modes (1 byte; 0 tension, 1 shear), radii of their areas (2 bytes) and the
    first frame that has them (1 byte); then, with a sleeve, the places of the corners of its outer face (3 x 2 bytes) before the
    test and in each frame. InputError where frames do not go together."""
    frames, first, extent = run.series("specimen"), run.start, run.extent
    peak, opened = (nearest(frames.times, time) for time in (run.peak_time, run.pattern_time))
    shown, (low, high) = frames_to_show(len(frames), most_frames, [peak, opened]), extent.corners
    widest, margin = (high - low).max(), 0.25  # what has flown further is drawn at that border
    origin, step = low - margin * widest, (1 + 2 * margin) * widest / 65535
    radius_step = first.radius.max() / 65535 * 4  # areas of bonds may be larger than spheres
    two = lambda steps: numpy.round(steps).clip(0, 65535).astype("<u2").tobytes()
    places = lambda p: two((p - origin) / step)

    times, parts, told = [], [two(first.radius / radius_step)], []
    platens, rows = run.series("platens"), run.h["time_s"]
    for time in frames.times[shown].tolist():
        spheres = run.spheres(time)
        if not numpy.array_equal(spheres.fields["id"], first.fields["id"]):
            raise InputError(f"{frames.path}: the frame at {time:g} s holds other spheres than the first one")
        piece = spheres.fragment
        piece = numpy.where(numpy.bincount(piece)[piece] == 1, 255, numpy.where(piece == 0, 0, 1 + (piece - 1) % 254))
        parts += [places(spheres.position), numpy.round(255 * spheres.damage).astype("u1").tobytes(), piece.astype("u1").tobytes()]
        row, at = nearest(rows, time), nearest(platens.times, time) if platens else None
        times.append(time)
        told.append({"time_s": time, "words": f"strain {run.strain[row] * MM:.2f} mm/m, stress {run.stress[row] * MPA:.1f} MPa",
                     "platens": [box for part in platens.parts(at) for box in boxes_of(part, platens.path)] if platens else []})
    count = 0
    if run.table("cracks") is not None:
        cracks = cracks_until(run, times[-1])
        count = len(cracks.time)
        parts += [places(cracks.place), numpy.round(127 * cracks.normal).astype("i1").tobytes(), (~cracks.tension).astype("u1").tobytes(),
                  two(numpy.sqrt(cracks.area / numpy.pi) / radius_step), numpy.searchsorted(times, cracks.time).astype("u1").tobytes()]
    meta = {"spheres": len(first.radius), "cracks": count, "radius_step": radius_step, "step": step, "origin": origin.tolist(),
            "low": low.tolist(), "high": high.tolist(), "plane": bool(extent.is_plane),
            "start_frame": shown.index(opened), "ids": first.fields["id"].tolist(), "frames": told}
    sleeve = run.series("sleeve")
    if sleeve:
        faces = faces_of(run.grid("sleeve", sleeve.times[0]), sleeve.path)
        _, index, number = numpy.unique(joined(faces.initial)[faces.outer], return_index=True, return_inverse=True)
        corners = faces.outer.ravel()[index]
        parts += [places(faces.initial[corners])] + [places(same(faces, sleeve.at(time), sleeve.path).points[corners]) for time in times]
        meta["sleeve"] = {"corners": len(corners), "faces": number.ravel().tolist()}
    return meta, b"".join(parts)


def element(run):
    """HTML of the interactive view of a run with frames of its specimen: canvas, controls, data, program."""
    meta, data = pack(run)
    html = (HERE / "viewer.html").read_text(encoding="utf-8")
    for name, text in (("@META@", json.dumps(meta, separators=(",", ":"))), ("@DATA@", base64.b64encode(data).decode()),
                       ("@PROGRAM@", (HERE / "viewer.js").read_text(encoding="utf-8"))):
        html = html.replace(name, text, 1)
    return html
