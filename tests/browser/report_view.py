#!/usr/bin/env python3
"""Opens the page of a report in a browser and does with the specimen what a reader does.

    report_view.py APPS                    of a made-up run, whose numbers are known, with reference pictures
    report_view.py APPS --run FOLDER       of an output folder of your own, without reference pictures
    report_view.py APPS --measure 5000 50000    seconds to open and size for so many spheres with 20 frames
    report_view.py APPS --write            draws the reference pictures anew: look at them before they are kept

APPS: folder of the programs. Exit status: 0; 1 where something does not hold; 77 without chromium and its driver.
"""

import argparse
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import zlib

import browser
import made_up_run

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent.parent / "scripts"))
import small_png  # noqa: E402

VIEW, CANVAS = "#specimen-view", "#specimen-view canvas"
SHRINK = 6  # pixels of a screenshot that become one of a reference: edges of spheres count little
FAR, MOST = 24, 0.002  # a pixel differs when a channel does by more; share of them that may
PLATEN = "const root = document.getElementById('specimen-view'), {state, meta, value} = root.platen; "

failures = []


def check(holds, what):
    print(("ok      " if holds else "FAILED  ") + what)
    if not holds:
        failures.append(what)


def make_page(apps, run, folder):
    done = subprocess.run([apps / "platen-report", run, "-o", folder], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"platen-report: status {done.returncode}: {done.stderr}")
    return folder / "report.html"


class View:
    """The specimen on an open page."""

    def __init__(self, window, scratch):
        self.window, self.file = window, scratch / "now.png"

    def state(self, word):
        return self.window.run(PLATEN + f"return state.{word};")

    def set(self, control, value, event="input"):
        """As a hand does it: the control, and then its event."""
        self.window.run("const c = document.querySelector('[data-view=' + arguments[0] + ']');"
                        "if (c.type === 'checkbox') c.checked = arguments[1]; else c.value = arguments[1];"
                        "c.dispatchEvent(new Event(arguments[2]));", control, value, event)
        self.settle()

    def put(self, **values):
        """The view itself: turned, zoomed, moved."""
        self.window.run(PLATEN + "Object.assign(state, arguments[0]); root.platen.refresh();", values)
        self.settle()

    def settle(self):
        """Draws what is waiting to be drawn."""
        self.window.run(PLATEN + "root.platen.draw();")

    def text(self, part):
        return self.window.run("return document.querySelector('#specimen-view .view-' + arguments[0]).textContent;", part)

    def pixels(self, shrink=SHRINK):
        self.settle()
        self.window.picture(CANVAS, self.file)
        return rows_of(self.file, shrink)


def rows_of(file, shrink=1):
    """Rows of a picture, each the bytes of RGB."""
    picture = small_png.shrunk(file, shrink)
    data, row = picture.tobytes(), 3 * picture.width
    return [data[k:k + row] for k in range(0, len(data), row)]


def differing(one, other):
    """Share of pixels that differ; 1 where the sizes do."""
    if len(one) != len(other) or len(one[0]) != len(other[0]):
        return 1.0
    count = 0
    for a, b in zip(one, other):
        for x in range(0, len(a), 3):
            count += max(abs(a[x + c] - b[x + c]) for c in range(3)) > FAR
    return count / (len(one) * len(one[0]) / 3)


def write_png(file, rows):
    def chunk(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    head = struct.pack(">IIBBBBB", len(rows[0]) // 3, len(rows), 8, 2, 0, 0, 0)
    lines = zlib.compress(b"".join(b"\0" + row for row in rows), 9)
    file.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", lines) + chunk(b"IEND", b""))


def coloured(rows, is_it):
    return sum(is_it(*row[x:x + 3]) for row in rows for x in range(0, len(row), 3))


def is_orange(r, g, b):
    """Of a crack in tension, which has no shade."""
    return abs(r - 214) < 10 and abs(g - 94) < 10 and b < 10


def opens(view):
    ready = view.window.run("return document.getElementById('specimen-view').dataset.ready;")
    check(ready is not None, f"it is drawn {ready} ms after its program starts")
    said = view.window.faults()
    check(not said, f"no error is told {said}")


def drags_and_zooms(view):
    before, yaw = view.pixels(), view.state("yaw")
    view.window.drag(CANVAS, (0, 0), (120, 30))
    check(abs(view.state("yaw") - yaw) > 0.5 and differing(view.pixels(), before) > 0.05, "a drag turns it")
    zoom, before = view.state("zoom"), view.pixels()
    view.window.turn_wheel(CANVAS, -300)
    check(view.state("zoom") > 1.2 * zoom and differing(view.pixels(), before) > 0.05, "the wheel zooms")
    view.set("reset", "", "click")
    check(abs(view.state("yaw") - yaw) < 1e-9 and view.state("zoom") == 1, "reset goes back")


def obeys_keys(view):
    view.window.run("document.querySelector(arguments[0]).focus();", CANVAS)
    yaw, frame, zoom = view.state("yaw"), view.state("frame"), view.state("zoom")
    for key in ("left", "+", "page up"):
        view.window.press(key)
    check(view.state("yaw") > yaw and view.state("zoom") > zoom and view.state("frame") == frame - 1,
          "keys turn it, zoom and change the frame")
    view.window.press("home")
    view.window.press("page down")
    check(view.state("yaw") == yaw and view.state("zoom") == zoom and view.state("frame") == frame, "and back")
    reached = []
    for _ in range(12):
        view.window.press("tab")
        reached.append(view.window.run("return document.activeElement.dataset.view || '';"))
    missing = {"frame", "play", "quantity", "cut", "depth", "magnify", "reset"} - set(reached)
    check(not missing, f"the tab key comes to every control {sorted(missing)}")
    untitled = view.window.run("return [...document.querySelectorAll('#specimen-view .view-controls > *')]"
                               ".filter((e) => !e.title).map((e) => e.outerHTML);")
    check(not untitled, f"every control says what it does {untitled}")


def changes_frames(view):
    seen = set()
    for frame in range(view.window.run(PLATEN + "return meta.frames.length;")):
        view.set("frame", frame)
        seen.add(view.text("caption"))
        check(view.state("frame") == frame and f"frame {frame + 1} of" in view.text("caption"), f"frame {frame + 1} is told")
    check(len(seen) == frame + 1, "every frame has words of its own")
    view.set("frame", 0)
    first = view.pixels()
    view.set("frame", frame)
    check(differing(view.pixels(), first) > 0.02, "the last frame looks otherwise than the first")


def changes_colours(view):
    drawn = {}
    for word in view.window.run(PLATEN + "return [...root.querySelector('[data-view=quantity]').options].map((o) => o.value);"):
        view.set("quantity", word, "change")
        drawn[word] = view.pixels()
    alike = [(a, b) for a in drawn for b in drawn if a < b and differing(drawn[a], drawn[b]) < 0.02]
    check(len(drawn) >= 3 and not alike, f"every quantity has a picture of its own: {', '.join(drawn)} {alike}")
    view.set("quantity", "damage", "change")


def cuts(view):
    view.set("sleeve", False, "change")
    shown = {}
    for cut, depth in (("none", 0.5), ("x", 0.9), ("x", 0.5), ("x", 0.1)):
        view.set("cut", cut, "change")
        view.set("depth", depth)
        shown[cut, depth] = coloured(view.pixels(), lambda r, g, b: min(r, g, b) < 235)
    counts = list(shown.values())
    check(counts == sorted(counts, reverse=True) and counts[-1] < 0.7 * counts[0], f"the cut takes spheres away: {counts} pixels")
    view.set("cut", "y", "change")
    view.set("depth", 0.5)
    view.set("sleeve", True, "change")


def shows_cracks(view):
    view.set("frame", view.window.run(PLATEN + "return meta.frames.length - 1;"))
    view.set("quantity", "displacement", "change")
    counts = []
    for shown in (False, True):
        view.set("tension", shown, "change")
        counts.append(coloured(view.pixels(1), is_orange))
    check(counts[1] > counts[0] + 500, f"cracks in tension are orange: {counts} pixels")
    view.set("frame", 0)
    check(coloured(view.pixels(1), is_orange) <= counts[0], "and not there before the test")
    view.set("tension", False, "change")
    view.set("quantity", "damage", "change")


def shows_the_sleeve(view):
    if not view.window.run(PLATEN + "return Boolean(meta.sleeve);"):
        return
    view.set("cut", "none", "change")
    with_it = view.pixels()
    view.set("sleeve", False, "change")
    without = view.pixels()
    view.set("sleeve", True, "change")
    shares = differing(with_it, without), differing(with_it, view.pixels())
    check(shares[0] > 0.02 and shares[1] == 0, f"the sleeve goes and comes: {shares}")
    view.set("cut", "y", "change")


def click(view):
    """On what is in the middle of the picture; gives the number that is told and the numbers that the page holds for it."""
    view.window.drag(CANVAS, (0, 0), (0, 0))
    told = view.text("message")
    found = re.match(r"sphere (\d+): radius ([\d.]+) mm, broken fraction of bonds ([\d.]+), displacement ([\d.e-]+) mm, "
                     r"outward displacement (-?[\d.e-]+) mm", told)
    check(found is not None, f"a click tells of a sphere: {told}")
    return found and [float(x) for x in found.groups()]


def knows_the_numbers(view, spheres, times):
    """What is told of the sphere that is clicked on, beside the numbers of the run."""
    by_id = {s.id: s for s in spheres}
    for frame, time in enumerate(times):
        view.set("frame", frame)
        told = click(view)
        if told is None or told[0] not in by_id:
            return check(False, f"that sphere is of the run: {told}")
        sphere = by_id[told[0]]
        u = sphere.displacement(time)
        x, y = sphere.place[:2]
        size, outward = sum(c * c for c in u) ** 0.5, (u[0] * x + u[1] * y) / (x * x + y * y) ** 0.5
        near = (abs(told[1] - 1e3 * sphere.radius) < 0.01 and abs(told[2] - sphere.broken(time) / 10) < 0.006
                and abs(told[3] - 1e3 * size) < 0.01 and abs(told[4] - 1e3 * outward) < 0.01)
        check(near, f"frame {frame + 1}: radius, damage and displacements of sphere {sphere.id} are those of the run")
    stops = view.window.run(PLATEN + "return meta.frames[0].platens.length;")
    check(stops == 3, f"three blocks of two platens are three: {stops}")


SCENES = {  # reference pictures: frame and state
    "before": (0, {"cut": "none", "sleeve": False}),
    "half": (2, {"cut": "y", "depth": 0.5, "sleeve": False, "tension": True, "shear": True}),
    "end": (4, {"cut": "x", "depth": 0.3, "sleeve": True, "quantity": "displacement", "yaw": -0.7, "magnify": 5}),
}


def beside_references(view, write):
    start = view.window.run(PLATEN + "return {...state};")
    for name, (frame, changes) in SCENES.items():
        view.put(**{**start, "picked": -1, "frame": frame, **changes})
        now, file = view.pixels(), HERE / f"report_view_{name}.png"
        if write:
            write_png(file, now)
        share = differing(now, rows_of(file))
        check(share <= MOST, f"{file.name}: {100 * share:.2f} % of the pixels differ (<= {100 * MOST} %)")
    view.put(**start)


def fits_a_phone(view, page):
    view.window.be_phone()
    view.window.open(page)
    wide = view.window.run("return [document.documentElement.scrollWidth, window.innerWidth, "
                           "document.querySelector(arguments[0]).getBoundingClientRect().height / window.innerHeight];", CANVAS)
    check(wide[0] <= wide[1] and 0.4 < wide[2] < 0.8, f"on a phone nothing is wider than the screen: {wide}")
    opens(view)


def measure(apps, scratch, count):
    radius = 0.0022 * (2625 / count) ** (1 / 3)  # about
    spheres, _ = made_up_run.write_run(scratch / f"run_{count}", radius, 20)
    page = make_page(apps, scratch / f"run_{count}", scratch / f"page_{count}")
    html = page.read_text()
    element = html[html.index('<figure id="specimen-view">'):html.index("</script>\n</figure>")]
    times = []
    for _ in range(3):
        with browser.Browser() as window:
            window.open(page)
            times.append(window.run("return [Number(document.getElementById('specimen-view').dataset.ready), "
                                    "performance.timing.loadEventEnd - performance.timing.navigationStart, performance.now()];"))
            turns = window.run(PLATEN + "const start = performance.now(), pixel = new Uint8Array(4), gl = root.querySelector('canvas')"
                               ".getContext('webgl2'); for (let k = 0; k < 10; ++k) { state.yaw += 0.1; root.platen.draw();"
                               "gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel); } return (performance.now() - start) / 10;")
    drawn, loaded = (sorted(t[k] for t in times)[1] for k in (0, 1))
    print(f"{len(spheres)} spheres, 20 frames: element {len(element) / 1e6:.2f} MB, first picture {drawn:.0f} ms after the program "
          f"starts, page open after {loaded:.0f} ms (medians of three), a turn {turns:.0f} ms")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("apps", type=pathlib.Path)
    parser.add_argument("--run", type=pathlib.Path)
    parser.add_argument("--measure", type=int, nargs="+", default=[])
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    if not browser.is_there():
        print("chromium and chromium-driver are not installed")
        return 77
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        for count in options.measure:
            measure(options.apps, scratch, count)
        if options.measure:
            return 0
        run, spheres = options.run, None
        if run is None:
            run = scratch / "run"
            spheres, times = made_up_run.write_run(run)
        page = make_page(options.apps, run, scratch / "page")
        with browser.Browser() as window:
            view = View(window, scratch)
            window.open(page)
            opens(view)
            for act in (drags_and_zooms, obeys_keys, changes_frames, changes_colours, cuts, shows_cracks, shows_the_sleeve):
                act(view)
            if spheres:
                knows_the_numbers(view, spheres, times)
                beside_references(view, options.write)
            else:
                click(view)
            fits_a_phone(view, page)
            said = window.faults()
            check(not said, f"no error is told to the end {said}")
    print(f"{len(failures)} checks failed" if failures else "all checks hold")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
