"""platen-report: turns an output folder into pictures and a page, and compares several."""
import argparse
import os
import subprocess
import sys
import time
from pathlib import Path

from ..errors import InputError, OutputError, PlatenError

DONE, CHECK_FAILED, BAD_INPUT, OUTPUT_FAILED = 0, 1, 2, 4
PURPOSE = ("Turns an output folder of a run, of a study, or of a calibration into pictures (PNG) and one HTML page, and compares "
           "several.")
OPTIONS = (
    ("-h,--help", {"action": "store_true"}, "Print this and exit"),
    ("-c,--compare", {"nargs": "+", "default": [], "metavar": "FOLDER"}, "Further output folders, drawn and tabled beside the first: runs, or studies"),
    ("-o,--output", {"metavar": "DIR"}, "Folder for pictures and page [FOLDER/pictures]"),
    ("--pictures", {"metavar": "FORMS", "default": ""}, "Further files of each chart: pdf, svg, or pdf,svg"),
    ("--laboratory", {"metavar": "FILE"}, "A measured curve (CSV as a laboratory writes it), drawn beside the run's, with differences"),
    ("--columns", {"metavar": "NAMES"}, "Columns of that file where its header does not say them: \"strain=A,stress=B\""),
    ("--fields", {"action": "store_true"}, "Also write stress, strain, displacement and damage of all frames on one grid: fields.pvd for ParaView, into FOLDER"),
    ("--state", {"action": "store_true"}, "List what the newest checkpoint holds (names, units, sizes, least and largest number); draws nothing"),
    ("--state-diff", {"metavar": "FOLDER"}, "Report the first difference to the newest checkpoint of another output folder, and end with status 1 where there is one; draws nothing"),
    ("-q,--quiet", {"action": "store_true"}, "Print errors only"),
    ("--version", {"action": "store_true"}, "Print version and libraries and exit"),
    ("--json", {"action": "store_true"}, "With --version: as JSON"))


class _Parser(argparse.ArgumentParser):
    def error(self, message):
        raise InputError(message + ". See --help")


def help_text():
    """As the other programs print theirs."""
    lines = [PURPOSE, "Usage: platen-report [OPTIONS] FOLDER", "", "Positionals:", "  FOLDER                      Output folder of a run or a study",
             "", "Options:"]
    for names, how, words in OPTIONS:
        shown = names + (f" {how['metavar']}" if "metavar" in how else "") + (" ..." if "nargs" in how else "")
        lines.append(f"  {shown:<27} {words}" if len(shown) < 28 else f"  {shown}\n{'':30}{words}")
    return "\n".join(lines)


def _parse(arguments):
    parser = _Parser(add_help=False, prog="platen-report", allow_abbrev=False)
    parser.add_argument("folder", nargs="?")
    for names, how, _ in OPTIONS:
        parser.add_argument(*names.split(","), **how)
    return parser.parse_args(arguments)


def _platen(*arguments):
    """The program of that name beside this one; its status."""
    beside = Path(sys.argv[0]).resolve().parent / "platen"
    return subprocess.run([str(beside) if beside.exists() else "platen", *arguments], check=False).returncode


def forms_of(text):
    """("pdf", "svg") of "pdf,svg"."""
    forms = [form.strip() for form in text.split(",") if form.strip()]
    for form in forms:
        if form not in ("pdf", "svg", "png"):
            raise InputError(f"--pictures = {form} is not known. Allowed: pdf, svg")
    return tuple(form for form in dict.fromkeys(forms) if form != "png")


def report_on(folder, output=None, forms=(), compare=(), measured=None, say=lambda *_: None):
    """Makes the page of a folder of results. measured: (file, columns) of a laboratory's curve. Returns (path, the TestRun of the
    page or None). InputError, OutputError."""
    folder = Path(folder)
    if not folder.is_dir():
        raise InputError(f"{folder}: no such folder")
    try:
        from . import calibration, pages, programs, reports, studies
    except ImportError as error:
        raise InputError(f"{error}. Pictures need Debian's package python3-matplotlib") from None

    run, made = None, studies.page_of(folder)
    if made is not None and compare:
        made = studies.comparison([folder, *compare])
    elif made is None:
        made = calibration.page_of(folder) or programs.page_of(folder)
        if made is not None and compare:
            raise InputError(f"--compare is for runs and studies; {folder} holds neither")
    if made is not None and measured:
        raise InputError(f"--laboratory is for runs; {folder} holds none")
    if made is None:
        runs = reports.read([folder, *compare])
        run = runs[0]
        made = reports.page_of_runs(runs, reports.laboratory_of(run, *measured) if measured else None)
    return pages.write(made, output or folder / "pictures", forms, say), run


def _report(options, say):
    if options.columns and not options.laboratory:
        raise InputError("--columns needs --laboratory")
    measured = (options.laboratory, options.columns) if options.laboratory else None
    if options.fields and not (Path(options.folder) / "history.csv").is_file():
        raise InputError(f"--fields is for runs; {options.folder} holds none")
    _, run = report_on(options.folder, options.output, forms_of(options.pictures), options.compare, measured, say)
    if options.fields:
        from .reports import write_fields

        say(f"fields: {write_fields(run)}")


def main(arguments=None):
    """The program; its exit status."""
    try:
        options = _parse(sys.argv[1:] if arguments is None else arguments)
        if options.help:
            print(help_text())
            return DONE
        if options.version:
            return _platen("--version", *(["--json"] if options.json else []))
        if options.json:
            raise InputError("--json needs --version")
        if _ranks() > 1:
            raise InputError(f"mpirun has started {_ranks()} processes of platen-report, which runs in one. Allowed: without mpirun; "
                             "platen-compress and platen-brazilian run on several ranks, where they were built with MPI.")
        if not options.folder:
            raise InputError("no folder is given. See --help")
        if options.state or options.state_diff:
            listed = _platen("state", options.folder) if options.state else DONE
            return listed or (_platen("state", options.folder, options.state_diff) if options.state_diff else DONE)
        _report(options, (lambda *_: None) if options.quiet else print)
        sys.stdout.flush()
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return OUTPUT_FAILED
    except InputError as error:
        return _fail(error, BAD_INPUT)
    except (OutputError, PlatenError, OSError, MemoryError) as error:
        return _fail(error, OUTPUT_FAILED)
    return DONE


def _of_launcher(what, otherwise):
    """Of this program, as Open MPI's mpirun and MPICH's leave it in the environment."""
    of_hydra = os.environ.get(f"PMI_{what}") if "MPI_LOCALNRANKS" in os.environ else None
    return int(os.environ.get(f"OMPI_COMM_WORLD_{what}", of_hydra or otherwise))


def _ranks():
    return _of_launcher("SIZE", 1)


def _fail(error, status):
    if _ranks() > 1:  # the first reports what fails on all, before what the launcher says of it
        time.sleep(5 if _of_launcher("RANK", 0) > 0 else 0)
    sys.stdout.flush()
    text = "".join(c if c == "\n" or (ord(c) >= 32 and ord(c) != 127) else "?" for c in str(error))
    print(f"error: {text}", file=sys.stderr, flush=True)
    if _ranks() > 1:
        time.sleep(0.2)
    return status
