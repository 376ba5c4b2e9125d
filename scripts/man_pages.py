#!/usr/bin/env python3
"""Writes the man pages of all programs, from what the programs say of themselves.

    scripts/man_pages.py BUILD OUT     OUT/man1/platen.1, OUT/man1/platen-compress.1, ...
    scripts/man_pages.py --lint OUT    checks those by man, groff and mandoc, whichever are there

Options are those of --help, entries those of --print-parameters --json. What else they say is in man_texts.py.
Exit status: 0; 1 where a checker finds fault; 2 on bad input.
"""

import argparse
import json
import pathlib
import re
import shutil
import subprocess
import sys

from man_texts import COMMANDS_OF_PLATEN, ENVIRONMENT, EXAMPLES, EXIT, FILES, MORE, SHORT
from manual_reference import PROGRAMS, WITH_SCENES, entries_of, said

FOLDER = "man1"


def roff(text):
    """Text as roff wants it."""
    safe = text.replace("\\", "\\e").replace("-", "\\-")
    return re.sub(r"^([.'])", r"\\&\1", safe, flags=re.M)


def bold(text):
    return f"\\fB{roff(text)}\\fR"


def tagged(tag, text):
    return f".TP\n{tag}\n{roff(text)}\n"


def options_of(text):
    """Names and meaning of each option that --help lists."""
    options = []
    for line in text.splitlines():
        start = re.match(r"^  (-\S.*?)(?:\s{2,}(.*))?$", line)
        if start:
            options.append([start.group(1), start.group(2) or ""])
        elif options and re.match(r"^\s{10,}\S", line):
            options[-1][1] = (options[-1][1] + " " + line.strip()).strip()
        elif not line.strip():
            options.append(["", ""])
    return [(names, meaning) for names, meaning in options if names]


def option_tag(names):
    """`-o,--output DIR` as bold names, the rest upright."""
    words = names.split(" ", 1)
    tag = ", ".join(bold(name) for name in words[0].split(","))
    return tag + (f" \\fI{roff(words[1])}\\fR" if len(words) > 1 else "")


def synopsis_of(program):
    if program == "platen":
        return [f"{bold('platen')} \\fIPROGRAM\\fR [\\fIARGUMENTS\\fR]", f"{bold('platen scenes')} [\\fINAME\\fR]",
                f"{bold('platen')} {bold('--version')} [{bold('--json')}]", f"{bold('platen')} {bold('--help')}"]
    words = {"platen-study": "\\fIKIND\\fR \\fISCENE\\fR", "platen-report": "\\fIFOLDER\\fR"}.get(program, "\\fISCENE\\fR")
    return [f"{bold(program)} {words} [\\fIOPTIONS\\fR]", f"{bold(program)} {bold('--version')}"] + (
        [f"{bold(program)} {bold('--print-parameters')} [\\fISECTION\\fR[/\\fIKEY\\fR]] [{bold('--json')}]"]
        if program in WITH_SCENES else [])


def entries_text(apps, program):
    """Keys that the program reads, a paragraph for each section."""
    sections = {}
    for path, _ in entries_of(json.loads(said(apps / program, "--print-parameters", "--json"))):
        sections.setdefault(path[0], []).append("/".join(path[1:]))
    lines = [".SH SCENE\n", roff("Entries that this program reads, by section. ") + bold("--print-parameters") +
             roff(" tells default, unit, range and meaning of each.") + "\n"]
    for section, keys in sections.items():
        lines.append(tagged(bold(section), ", ".join(keys) + "."))
    return "".join(lines)


def page(apps, program, version, date):
    help_text = said(apps / program, "--help")
    purpose = help_text.strip().split("\n")[0]
    parts = [f'.TH "{program.upper()}" "1" "{date}" "{version}" "Platen"\n', ".SH NAME\n",
             f"{roff(program)} \\- {roff(SHORT[program])}\n", ".SH SYNOPSIS\n",
             "\n.br\n".join(synopsis_of(program)) + "\n", ".SH DESCRIPTION\n", roff(purpose) + "\n"]
    for paragraph in MORE.get(program, []):
        parts += [".PP\n", roff(paragraph) + "\n"]
    options = COMMANDS_OF_PLATEN if program == "platen" else options_of(help_text)
    parts.append(".SH COMMANDS\n" if program == "platen" else ".SH OPTIONS\n")
    parts += [tagged(option_tag(names), meaning) for names, meaning in options]
    if program in WITH_SCENES:
        parts.append(entries_text(apps, program))
    parts.append(".SH EXIT STATUS\n")
    parts += [tagged(bold(status), meaning) for status, meaning in EXIT.get(program, EXIT["all"])]
    if FILES.get(program):
        parts.append(".SH FILES\n")
        parts += [tagged(f"\\fI{roff(name)}\\fR", meaning) for name, meaning in FILES[program]]
    parts.append(".SH ENVIRONMENT\n")
    parts += [tagged(bold(name), meaning) for name, meaning in ENVIRONMENT]
    parts.append(".SH EXAMPLES\n")
    for number, (command, meaning) in enumerate(EXAMPLES[program]):
        parts.append((".PP\n" if number else "") + f"{roff(meaning)}\n.PP\n.RS 4\n.nf\n{roff(command)}\n.fi\n.RE\n")
    others = [p for p in ("platen", *PROGRAMS) if p != program]
    parts += [".SH SEE ALSO\n", ",\n".join(f"\\fB{roff(p)}\\fR(1)" for p in others) + ".\n"]
    return "".join(parts)


def write(build, out):
    apps = build / "apps"
    told = json.loads(said(apps / "platen", "--version", "--json"))
    folder = out / FOLDER
    folder.mkdir(parents=True, exist_ok=True)
    changed = subprocess.run(["git", "-C", str(pathlib.Path(__file__).parent), "log", "-1", "--format=%cs"],
                             capture_output=True, text=True, check=False).stdout.strip()
    for program in ("platen", *PROGRAMS):
        text = page(apps, program, f"Platen {told['version']}", changed)
        (folder / f"{program}.1").write_text(text, encoding="utf-8")
    print(f"man pages: {len(PROGRAMS) + 1} in {folder}")
    return 0


def lint(out):
    """What the formatters say against a page."""
    pages = sorted((out / FOLDER).glob("*.1"))
    checkers = [c for c in (["man", "--warnings", "-l"], ["groff", "-man", "-ww", "-Tutf8", "-z"],
                            ["mandoc", "-T", "lint", "-W", "warning"]) if shutil.which(c[0])]
    faults = 0
    for path in pages:
        for checker in checkers:
            done = subprocess.run([*checker, str(path)], capture_output=True, text=True, check=False)
            told = done.stderr + (done.stdout if checker[0] == "mandoc" else "")
            if told.strip() or done.returncode != 0 and checker[0] != "mandoc":
                faults += 1
                print(f"{path}: {checker[0]}: {told.strip() or done.returncode}")
    print(f"man pages: {len(pages)}, checked by {', '.join(c[0] for c in checkers) or 'nothing'}; {faults} faults")
    return 1 if faults or not pages else 0


def main():
    parser = argparse.ArgumentParser(description="Writes or checks the man pages of all programs.")
    parser.add_argument("--lint", action="store_true", help="check the pages of OUT")
    parser.add_argument("folders", nargs="+", type=pathlib.Path, help="BUILD OUT, or OUT")
    asked = parser.parse_args()
    if len(asked.folders) != (1 if asked.lint else 2):
        parser.error("BUILD OUT, or --lint OUT")
    return lint(asked.folders[0]) if asked.lint else write(*asked.folders)


if __name__ == "__main__":
    sys.exit(main())
