"""A copy of the sources with faults in it (mutation.py): its files, its build, what its compiler says."""

import json
import os
import pathlib
import re
import shlex
import subprocess

SOURCE = pathlib.Path(__file__).resolve().parent.parent
DATA = SOURCE / "scripts/mutation"


class Copy:
    """A copy of the sources with faults in it, its build and its test programs."""

    def __init__(self, work, programs, cores):
        self.root, self.build, self.cores, self.programs = work / "source", work / "build", cores, programs

    def write(self, path, text):
        target = self.root / path
        if target.is_file() and target.read_text() == text:
            return
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text)

    def take(self, changed):
        """All sources, those of `changed` (path: text) in its form; files that have not changed keep their time."""
        tracked = subprocess.run(["git", "-C", SOURCE, "ls-files", "-z"], check=True, capture_output=True, text=True).stdout
        paths = [SOURCE / name for name in tracked.split("\0") if (SOURCE / name).is_file()]
        wanted = set()
        for path in paths:
            name = path.relative_to(SOURCE).as_posix()
            wanted.add(name)
            if path.suffix in (".png", ".msh", ".gz", ".ico"):
                target = self.root / name
                if not target.is_file():
                    target.parent.mkdir(parents=True, exist_ok=True)
                    target.write_bytes(path.read_bytes())
                continue
            text = changed[name] if name in changed else path.read_text()
            if path.name == "CMakeLists.txt" and name.startswith("tests/"):
                for program in self.programs:
                    text = text.replace(f"target_link_libraries({program} ",
                                        f"target_sources({program} PRIVATE {DATA / 'reached.cc'})\n"
                                        f"target_link_libraries({program} ", 1)
            if name == "cmake/kernels.cmake":  # kernels compile in half of the time
                text = text.replace("platen_kernel_options -O3", "platen_kernel_options -O1")
            self.write(name, text)
        for path in self.root.rglob("*"):
            if path.is_file() and path.relative_to(self.root).as_posix() not in wanted:
                path.unlink()

    def configure(self):
        options = ["-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG", "-DPLATEN_BENCH=OFF",
                   f"-DCMAKE_CXX_FLAGS=-w -include {DATA / 'fault.h'}", "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON"]
        if subprocess.run(["which", "ccache"], capture_output=True).returncode == 0:
            options.append("-DCMAKE_CXX_COMPILER_LAUNCHER=ccache")
        subprocess.run(["cmake", "-S", self.root, "-B", self.build, "-G", "Ninja", *options], check=True,
                       stdout=subprocess.DEVNULL)
        commands = json.loads((self.build / "compile_commands.json").read_text())
        self.commands = {}
        for c in commands:
            path = pathlib.Path(c["file"])
            if path.is_relative_to(self.root):
                self.commands[path.relative_to(self.root).as_posix()] = c

    def readers_of(self, header):
        """Files that the compiler is given and that include a header, directly or not; near ones first."""
        if not hasattr(self, "includes"):
            self.includes = {}
            for path in self.root.rglob("*"):
                if path.suffix in (".h", ".cc"):
                    name = path.relative_to(self.root).as_posix()
                    self.includes[name] = re.findall(r'#include "([^"]+)"', path.read_text())
        reached, fresh = {header}, {header}
        while fresh:
            fresh = {n for n, of in self.includes.items() if n not in reached and any(f in of for f in fresh)}
            reached |= fresh
        readers = [n for n in reached if n in self.commands]
        folder = header.split("/")[0]
        return sorted(readers, key=lambda n: (header not in self.includes[n], not n.startswith(folder),
                                              "avx512" in n or "baseline" in n, n))

    def errors_of(self, name):
        command = shlex.split(self.commands[name]["command"])
        if os.path.basename(command[0]) == "ccache":
            command = command[1:]
        command = [c for k, c in enumerate(command) if c not in ("-c", "-o") and command[k - 1] != "-o"]
        run = subprocess.run(command + ["-fsyntax-only"], cwd=self.commands[name]["directory"], capture_output=True,
                             text=True)
        return run.stderr if run.returncode else ""

    def places(self, errors):
        """(file, line) of what the compiler refuses; where its places are none of ours, of what asked for them."""
        of_errors, of_others = set(), set()
        for line in errors.splitlines():
            if m := re.match(r"(\S+?):(\d+):(?:\d+:)?\s*(\w+)", line):
                path = pathlib.Path(m.group(1))
                if not path.is_absolute():
                    path = self.build / path
                path = pathlib.Path(os.path.normpath(path))
                if path.is_relative_to(self.root):
                    place = (path.relative_to(self.root).as_posix(), int(m.group(2)))
                    (of_errors if m.group(3) == "error" else of_others).add(place)
        return of_errors, of_others

    def make(self):
        run = subprocess.run(["ninja", "-C", self.build, "-k", "0", "-j", str(self.cores), *self.programs], capture_output=True, text=True)
        return run.stdout + run.stderr if run.returncode else ""
