"""What the Tab key completes, typed into a real bash."""
import os
import pty
import select
import time
import unittest

APPS, SCRIPT = os.environ["PLATEN_APPS"], os.environ["PLATEN_COMPLETION"]
MARK = "ready> "


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
        import tempfile

        cls.folder = tempfile.TemporaryDirectory(prefix="platen completion ")
        with open(os.path.join(cls.folder.name, "mine.prm"), "w") as file:
            file.write("# a scene\n")
        with open(os.path.join(cls.folder.name, "notes.txt"), "w") as file:
            file.write("no scene\n")
        os.mkdir(os.path.join(cls.folder.name, "results"))
        cls.shell = Shell(cls.folder.name)

    @classmethod
    def tearDownClass(cls):
        cls.shell.close()
        cls.folder.cleanup()

    def completes(self, typed, becomes):
        said = self.shell.complete(typed)
        self.assertIn(becomes, said, f"typed {typed!r}")

    def lists(self, typed, *words):
        said = self.shell.complete(typed, 2)
        for word in words:
            self.assertIn(word, said, f"typed {typed!r}")
        return said

    def test_programs_of_platen(self):
        self.completes("platen comp", "platen compress ")
        self.lists("platen ", "brazilian", "study", "scenes", "--version")

    def test_scenes_that_came_with_it(self):
        self.completes("platen scenes demo_d", "platen scenes demo_dry ")

    def test_options(self):
        self.completes("platen-compress --over", "--overwrite ")
        self.completes("platen compress --dry", "--dry-run ")
        self.lists("platen-study --", "--plan", "--collect", "--resume")

    def test_scene_files_and_folders_alone(self):
        self.completes("platen-compress mi", "mine.prm ")
        said = self.lists("platen-compress ", "mine.prm", "results")
        self.assertNotIn("notes.txt", said)

    def test_kinds_of_studies(self):
        self.completes("platen-study fric", "friction ")
        self.completes("platen study acc", "accuracy ")

    def test_entries_in_quotes(self):
        self.completes('platen-compress -s "Bond/Ga', '"Bond/Gap = ')
        self.completes('platen-compress -s "Platens/Friction st', '"Platens/Friction static = ')
        self.lists('platen-compress -s "Integration/', "Integration/Safety", "Integration/Scheme")

    def test_entries_without_quotes(self):
        self.completes("platen-compress -s Bond/Ga", "Bond/Gap\\ =\\ ")
        self.completes("platen-compress -s Platens/Friction\\ st", "Platens/Friction\\ static\\ =\\ ")

    def test_entries_of_the_program_that_is_asked(self):
        self.lists('platen-study -s "Study/', "Study/Slenderness list")
        self.assertNotIn("Study/Slenderness", self.shell.complete('platen-bonds -s "Stud', 2).split("\n")[-1])

    def test_words_of_an_entry(self):
        self.completes('platen-compress -s "Effects/Bond = coh', "Effects/Bond = cohesive beam")
        self.lists('platen-compress -s "Loading/Confinement = ', "particles", "sleeve")

    def test_what_is_printed(self):
        self.completes("platen-compress --print-parameters Bond/Gap", "Bond/Gap ")

    def test_folders_of_results(self):
        self.completes("platen-report resu", "results/")
        self.completes("platen-compress mine.prm -o resu", "results/")


if __name__ == "__main__":
    unittest.main()
