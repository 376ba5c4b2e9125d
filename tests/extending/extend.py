#!/usr/bin/env python3
"""Adds two bond laws and a contact law to a copy of the sources, as docs/extending.md says, builds and runs it.

    tests/extending/extend.py SOURCE FOLDER [COMPILER]

SOURCE is the project, FOLDER a folder to work in. Prints what each addition touched: files outside tests and docs, its own
included, and lines outside its own file. Exit status: 0; 1 where something does not build or hold, or touches more than
docs/extending.md allows (a bond law: 3 files and 10 lines, a contact law: 3 files).
"""

import pathlib
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
COPIED = ["CMakeLists.txt", "cmake", "debian", "base", "dem", "dist"]
# Of each law: its own file, where that goes, and (file, text, text in its place) elsewhere.
ADDITIONS = {
    "bond law": ("spring_bond.h", "dem/laws/spring_bond.h", [
        ("dem/laws/bond_law.h", '#include "dem/laws/parallel_bond.h"\n',
         '#include "dem/laws/parallel_bond.h"\n#include "dem/laws/spring_bond.h"\n'),
        ("dem/laws/bond_law.h", "ParallelBond, CohesiveBeam,", "ParallelBond, SpringBond, CohesiveBeam,"),
    ]),
    "bond law that remembers": ("yielding_bond.h", "dem/laws/yielding_bond.h", [
        ("dem/laws/bond_law.h", '#include "dem/laws/spring_bond.h"\n',
         '#include "dem/laws/spring_bond.h"\n#include "dem/laws/yielding_bond.h"\n'),
        ("dem/laws/bond_law.h", "SpringBond,", "SpringBond, YieldingBond,"),
    ]),
    "contact law": ("cone_contact.h", "dem/laws/cone_contact.h", [
        ("dem/laws/contact_settings.h", "enum class NormalContact { linear, hertz };",
         "enum class NormalContact { linear, hertz, cone };"),
        ("dem/laws/normal_contact.h", '#include "dem/laws/hertz_contact.h"\n',
         '#include "dem/laws/cone_contact.h"\n#include "dem/laws/hertz_contact.h"\n'),
        ("dem/laws/normal_contact.h", "<LinearContact, HertzContact>;", "<LinearContact, HertzContact, ConeContact>;"),
    ]),
}
MOST_FILES, MOST_LINES = 3, 10


def copy_of(source, folder, names):
    """The sources that are needed, in a new folder. Copies keep their times, so a build of an earlier copy would not follow them."""
    shutil.rmtree(folder, ignore_errors=True)
    copy = folder / "sources"
    copy.mkdir(parents=True)
    for name in names:
        (shutil.copytree if (source / name).is_dir() else shutil.copy)(source / name, copy / name)
    return copy


def add(folder, what, changes, own=None):
    """Makes the changes (file, text, text in its place) and copies a file of its own (from, to); the files that they touch."""
    if own is not None:
        shutil.copy(own[0], folder / own[1])
    for name, old, new in changes:
        text = (folder / name).read_text()
        if text.count(old) != 1:
            sys.exit(f"{name}: {old!r} stands there {text.count(old)} times; docs/extending.md and this test want looking at")
        (folder / name).write_text(text.replace(old, new))
    files = {name for name, _, _ in changes} | ({own[1]} if own else set())
    print(f"{what}: {len(files)} files, {len(changes)} places")
    return files


def run(*command, status=0):
    """Output and messages of a command; ends the test where its status is another."""
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    if done.returncode != status:
        sys.exit(f"{' '.join(map(str, command))}: status {done.returncode}, expected {status}\n{done.stdout[-3000:]}{done.stderr[-3000:]}")
    return done.stdout + done.stderr


def build(copy, target, *options):
    """Builds a target of the copy; where it is built."""
    run("cmake", "-S", copy, "-B", copy.parent / "build", "-DCMAKE_BUILD_TYPE=Release", "-DPLATEN_TESTS=OFF", "-DPLATEN_BENCH=OFF", *options)
    run("cmake", "--build", copy.parent / "build", "--target", target, "-j2")
    return copy.parent / "build"


def main():
    """The whole test."""
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    source, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    copy = copy_of(source, folder, COPIED)
    small = all([len(add(copy, what, changes, (HERE / own, place))) <= MOST_FILES and len(changes) <= MOST_LINES
                 for what, (own, place, changes) in ADDITIONS.items()])
    shutil.copy(HERE / "check_laws.cc", copy / "dem/laws/check_laws.cc")
    with open(copy / "dem/CMakeLists.txt", "a", encoding="utf-8") as cmake:
        cmake.write("add_executable(check_laws laws/check_laws.cc)\ntarget_link_libraries(check_laws PRIVATE platen_dem)\n")
    built = build(copy, "check_laws", "-DPLATEN_APPS=OFF", *(f"-DCMAKE_CXX_COMPILER={name}" for name in sys.argv[3:]))
    print(run(built / "bin/check_laws").strip())
    return 0 if small else 1


if __name__ == "__main__":
    sys.exit(main())
