"""A browser without a screen that does what a reader of a page does: clicks, drags, turns the wheel, presses keys. Debian's chromium,
led by its chromium-driver over the WebDriver protocol (W3C 2018)."""

import base64
import json
import pathlib
import re
import shutil
import subprocess
import tempfile
import urllib.error
import urllib.request

# WebGL without a graphics card, and nothing asked of the network.
FLAGS = ("--headless --no-sandbox --disable-quic --no-first-run --disable-background-networking --disable-component-update "
         "--disable-sync --use-angle=swiftshader --enable-unsafe-swiftshader --ignore-gpu-blocklist --hide-scrollbars "
         "--force-device-scale-factor=1").split()
ELEMENT = "element-6066-11e4-a52e-4f735466cecf"  # key of the protocol
KEYS = {"left": "\ue012", "up": "\ue013", "right": "\ue014", "down": "\ue015", "tab": "\ue004", "home": "\ue011",
        "page up": "\ue00e", "page down": "\ue00f"}


def is_there():
    """Whether browser and driver are installed."""
    return bool(shutil.which("chromium") and shutil.which("chromedriver"))


class Browser:
    """One window; to be used in a with statement."""

    def __init__(self, width=1000, height=1200):
        self._folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        self._driver = subprocess.Popen(["chromedriver", "--port=0"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        port = None
        for line in self._driver.stdout:
            if found := re.search(r"started successfully on port (\d+)", line):
                port = found[1]
                break
        self._base = f"http://127.0.0.1:{port}/session"
        flags = [*FLAGS, f"--user-data-dir={self._folder.name}", f"--window-size={width},{height}"]
        asked = {"browserName": "chrome", "goog:chromeOptions": {"args": flags, "binary": shutil.which("chromium")},
                 "goog:loggingPrefs": {"browser": "ALL"}, "timeouts": {"script": 300000, "pageLoad": 300000}}
        self._base += "/" + self._ask("POST", "", {"capabilities": {"alwaysMatch": asked}})["sessionId"]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        try:
            self._ask("DELETE", "")
        except OSError:
            pass
        self._driver.terminate()
        self._driver.wait()
        self._folder.cleanup()

    def _ask(self, method, path, content=None):
        data = None if content is None else json.dumps(content).encode()
        request = urllib.request.Request(self._base + path, data, {"Content-Type": "application/json"}, method=method)
        try:
            with urllib.request.urlopen(request, timeout=600) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            raise RuntimeError(f"{path}: {json.load(error)['value']['message']}") from error

    def open(self, page):
        self._ask("POST", "/url", {"url": pathlib.Path(page).resolve().as_uri()})

    def run(self, script, *values):
        """What a script returns."""
        return self._ask("POST", "/execute/sync", {"script": script, "args": list(values)})

    def find(self, selector):
        return self._ask("POST", "/element", {"using": "css selector", "value": selector})[ELEMENT]

    def faults(self):
        """What the page has said of errors since this was asked before."""
        return [entry["message"] for entry in self._ask("POST", "/se/log", {"type": "browser"}) if entry["level"] == "SEVERE"]

    def picture(self, selector, file):
        """An element as PNG."""
        png = base64.b64decode(self._ask("GET", f"/element/{self.find(selector)}/screenshot"))
        pathlib.Path(file).write_bytes(png)

    def _act(self, kind, actions, **more):
        self._ask("POST", "/actions", {"actions": [{"type": kind, "id": kind, "actions": actions, **more}]})

    def drag(self, selector, start, end):
        """From one place to another in pixels from the element's middle; no way: a click."""
        origin = {ELEMENT: self.find(selector)}
        move = [{"type": "pointerMove", "duration": 50, "origin": origin, "x": x, "y": y} for x, y in (start, end)]
        down, up = ({"type": kind, "button": 0} for kind in ("pointerDown", "pointerUp"))
        self._act("pointer", [move[0], down, *(move[1:] if start != end else []), up], parameters={"pointerType": "mouse"})

    def turn_wheel(self, selector, pixels):
        self._act("wheel", [{"type": "scroll", "origin": {ELEMENT: self.find(selector)}, "x": 0, "y": 0, "deltaX": 0, "deltaY": pixels}])

    def press(self, key):
        """A key of KEYS, or a letter, where the focus is."""
        key = KEYS.get(key, key)
        self._act("key", [{"type": "keyDown", "value": key}, {"type": "keyUp", "value": key}])

    def be_phone(self, width=360, height=740):
        """As wide as a phone, fingers for a mouse."""
        self._ask("POST", "/goog/cdp/execute", {"cmd": "Emulation.setDeviceMetricsOverride", "params": {
            "width": width, "height": height, "deviceScaleFactor": 2, "mobile": True}})
