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
        ("dem/laws/bond_law.h", "YieldingParallelBond>;", "YieldingParallelBond, SpringBond>;"),
    ]),
    "bond law that remembers": ("yielding_bond.h", "dem/laws/yielding_bond.h", [
        ("dem/laws/bond_law.h", '#include "dem/laws/spring_bond.h"\n',
         '#include "dem/laws/spring_bond.h"\n#include "dem/laws/yielding_bond.h"\n'),
        ("dem/laws/bond_law.h", "SpringBond>;", "SpringBond, YieldingBond>;"),
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


def copy_of(source, folder):
    """The sources that the particle library needs, in a new folder."""
    folder.mkdir(parents=True)
    for name in COPIED:
        if (source / name).is_dir():
            shutil.copytree(source / name, folder / name)
        else:
            shutil.copy(source / name, folder / name)


def add(folder, what):
    """Makes one addition; the files and lines that it took."""
    own, place, changes = ADDITIONS[what]
    shutil.copy(HERE / own, folder / place)
    touched, lines = {place}, 0
    for name, old, new in changes:
        path = folder / name
        text = path.read_text()
        if text.count(old) != 1:
            sys.exit(f"{name}: {old!r} stands there {text.count(old)} times; docs/extending.md and this test want looking at")
        path.write_text(text.replace(old, new))
        touched.add(name)
        lines += 1
    print(f"{what}: {len(touched)} files, {lines} lines outside its own")
    return len(touched) <= MOST_FILES and lines <= MOST_LINES


def run(*command):
    """Ends the test where a command fails."""
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}: status {done.returncode}\n{done.stdout[-3000:]}{done.stderr[-3000:]}")
    return done.stdout


def main():
    """The whole test."""
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    source, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    compiler = [f"-DCMAKE_CXX_COMPILER={sys.argv[3]}"] if len(sys.argv) > 3 else []
    # Copies keep their times, so a build of an earlier copy would not follow them.
    shutil.rmtree(folder, ignore_errors=True)
    copy = folder / "sources"
    copy_of(source, copy)
    small = all([add(copy, what) for what in ADDITIONS])
    shutil.copy(HERE / "check_laws.cc", copy / "dem/laws/check_laws.cc")
    with open(copy / "dem/CMakeLists.txt", "a", encoding="utf-8") as cmake:
        cmake.write("add_executable(check_laws laws/check_laws.cc)\ntarget_link_libraries(check_laws PRIVATE platen_dem)\n")
    build = folder / "build"
    run("cmake", "-S", copy, "-B", build, "-DCMAKE_BUILD_TYPE=Release", "-DPLATEN_APPS=OFF", "-DPLATEN_TESTS=OFF",
        "-DPLATEN_BENCH=OFF", *compiler)
    run("cmake", "--build", build, "--target", "check_laws", "-j2")
    print(run(build / "bin/check_laws").strip())
    return 0 if small else 1


if __name__ == "__main__":
    sys.exit(main())
