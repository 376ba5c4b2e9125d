"""What the Tab key completes, typed into a real bash."""
import os
import pty
import select
import tempfile
import time
import unittest
from pathlib import Path

APPS, SCRIPT = os.environ["PLATEN_APPS"], os.environ["PLATEN_COMPLETION"]
MARK = "ready> "
COMPLETED = {  # what is typed, and what becomes of it
    "programs": {"platen comp": "platen compress "},
    "scenes that came with it": {"platen scenes demo_d": "platen scenes demo_dry "},
    "options": {"platen-compress --over": "--overwrite ", "platen compress --dry": "--dry-run "},
    "scene files": {"platen-compress mi": "mine.prm "},
    "kinds of studies": {"platen-study fric": "friction ", "platen study acc": "accuracy "},
    "entries in quotes": {'platen-compress -s "Bond/Ga': '"Bond/Gap = ', 'platen-compress -s "Platens/Friction st': '"Platens/Friction static = '},
    "entries without quotes": {"platen-compress -s Bond/Ga": "Bond/Gap\\ =\\ ",
                               "platen-compress -s Platens/Friction\\ st": "Platens/Friction\\ static\\ =\\ "},
    "words of an entry": {'platen-compress -s "Effects/Bond = coh': "Effects/Bond = cohesive beam"},
    "what is printed": {"platen-compress --print-parameters Bond/Gap": "Bond/Gap "},
    "folders of results": {"platen-report resu": "results/", "platen-compress mine.prm -o resu": "results/"}}
LISTED = {  # what is typed, words of the list, and what it must not have
    "programs": ("platen ", ("brazilian", "study", "scenes", "--version"), ""),
    "options": ("platen-study --", ("--plan", "--collect", "--resume"), ""),
    "scene files and folders alone": ("platen-compress ", ("mine.prm", "results"), "notes.txt"),
    "entries": ('platen-compress -s "Integration/', ("Integration/Safety", "Integration/Scheme"), ""),
    "entries of the program that is asked": ('platen-study -s "Study/', ("Study/Slenderness list",), ""),
    "and of no other program": ('platen-bonds -s "Stud', (), "Study/Slenderness"),
    "words of an entry": ('platen-compress -s "Loading/Confinement = ', ("particles", "sleeve"), "")}


class Shell:
    """An interactive bash behind a terminal of its own."""

    def __init__(self, folder):
        environment = {"PATH": f"{APPS}:/usr/bin:/bin", "TERM": "dumb", "HOME": folder, "INPUTRC": "/dev/null", "PS1": MARK, "COLUMNS": "400",
                       "LC_ALL": "C"}
        self.process, self.terminal = pty.fork()
        if self.process == 0:
            os.chdir(folder)
            os.execve("/bin/bash", ["bash", "--norc", "--noprofile", "-i"], environment)
        self.read()
        self.send("stty -echoctl cols 400; bind 'set enable-bracketed-paste off'; bind 'set completion-query-items 0'; "
                  f"bind 'set page-completions off'; bind 'set bell-style none'; source '{SCRIPT}'\n")
        self.read()

    def send(self, text):
        os.write(self.terminal, text.encode())

    def read(self, quiet=0.7):
        """All that comes until nothing has come for so many seconds."""
        said = b""
        last = time.time()
        while time.time() - last < quiet:
            if select.select([self.terminal], [], [], 0.05)[0]:
                try:
                    said += os.read(self.terminal, 65536)
                except OSError:
                    break
                last = time.time()
        return said.decode(errors="replace")

    def complete(self, text, tabs=1):
        """The line as it stands after Tab, and what was listed."""
        self.send(text + "\t" * tabs)
        said = self.read()
        self.send("\x15")  # takes the line away
        self.read(0.2)
        return said.replace("\r", "").replace("\x07", "")

    def close(self):
        self.send("\x15exit\n")
        os.close(self.terminal)
        os.waitpid(self.process, 0)


class Completion(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        kept = tempfile.TemporaryDirectory(prefix="platen completion ")
        cls.addClassCleanup(kept.cleanup)
        for name in ("mine.prm", "notes.txt"):
            Path(kept.name, name).write_text("# a scene\n")
        Path(kept.name, "results").mkdir()
        cls.shell = Shell(kept.name)
        cls.addClassCleanup(cls.shell.close)

    def test_a_word_becomes_what_it_begins(self):
        for what, words in COMPLETED.items():
            for typed, becomes in words.items():
                self.assertIn(becomes, self.shell.complete(typed), f"{what}: typed {typed!r}")

    def test_choices_are_listed_and_nothing_else(self):
        for what, (typed, words, absent) in LISTED.items():
            said = self.shell.complete(typed, 2)
            for word in words:
                self.assertIn(word, said, f"{what}: typed {typed!r}")
            if absent:
                self.assertNotIn(absent, said.split("\n")[-1] if not words else said, f"{what}: typed {typed!r}")


if __name__ == "__main__":
    unittest.main()
