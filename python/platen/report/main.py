"""platen-report: turns an output folder into pictures and a page, and compares several."""
import argparse
import logging
import os
import subprocess
import sys
import time

from . import page
from ..errors import InputError, OutputError, PlatenError
from ..programs import program

DONE, BAD_INPUT, OUTPUT_FAILED = 0, 2, 4
HELP = """Turns an output folder of a run, of a study, or of a calibration into pictures (PNG) and one HTML page, and compares several.
Usage: platen-report [OPTIONS] FOLDER

Positionals:
  FOLDER                      Output folder of a run or a study

Options:
"""
FLAG = {"action": "store_true"}
OPTIONS = (
    ("-h,--help", FLAG, "Print this and exit"),
    ("-c,--compare", {"nargs": "+", "default": [], "metavar": "FOLDER"},
     "Further output folders in the same charts and tables: runs, or studies"),
    ("-o,--output", {"metavar": "DIR"}, "Folder for pictures and page [FOLDER/pictures]"),
    ("--pictures", {"metavar": "FORMS", "default": ""}, "Further files of each chart: pdf, svg, or pdf,svg"),
    ("--laboratory", {"metavar": "FILE"}, "A measured curve (CSV as a laboratory writes it), drawn with that of the run, with differences; of a study "
     "a list of measured figures by case"),
    ("--columns", {"metavar": "NAMES"}, "Columns of that file where its header does not name them: \"strain=A,stress=B\""),
    ("--curve", {"metavar": "FILE"}, "Write that curve as platen-calibrate reads it (Calibrate/Curve 1); draws nothing. FOLDER may be left "
     "out where the file has strains and stresses"),
    ("--targets", FLAG, "Print such a list, FOLDER, as targets of platen-calibrate (a section Calibrate); draws nothing"),
    ("--standard", FLAG, "Write test_report.html instead: the test report by the standard that Scene/Standard names, for two A4 sheets"),
    ("--fields", FLAG, "Also write stress, strain, displacement and damage of all frames on one grid: "
     "fields.pvd for ParaView, into FOLDER"),
    ("--state", FLAG, "List the content of the newest checkpoint (names, units, sizes, least and largest number); draws nothing"),
    ("--state-diff", {"metavar": "FOLDER"}, "Report the first difference to the newest checkpoint of another output folder, and end with "
     "status 1 where there is one; draws nothing"),
    ("-q,--quiet", FLAG, "Print errors only"),
    ("--version", FLAG, "Print version and libraries and exit"),
    ("--json", FLAG, "With --version: as JSON"))


class _Parser(argparse.ArgumentParser):
    def error(self, message):
        raise InputError(message + ". See --help")


def help_text():
    """As the other programs print theirs."""
    lines = []
    for names, how, words in OPTIONS:
        shown = names + (f" {how['metavar']}" if "metavar" in how else "") + (" ..." if "nargs" in how else "")
        lines.append(f"  {shown:<27} {words}" if len(shown) < 28 else f"  {shown}\n{'':30}{words}")
    return HELP + "\n".join(lines)


def _platen(*arguments):
    """The exit status of `platen`, which prints."""
    return subprocess.run([program("platen"), *arguments], check=False).returncode


def _draw(options):
    forms = [form.strip() for form in options.pictures.split(",") if form.strip()]
    for form in forms:
        if form not in ("pdf", "svg", "png"):
            raise InputError(f"--pictures = {form} is not known. Allowed: pdf, svg")
    if options.columns and not options.laboratory:
        raise InputError("--columns needs --laboratory")
    measured, say = (options.laboratory, options.columns) if options.laboratory else None, (lambda *_: None) if options.quiet else print
    forms = [form for form in dict.fromkeys(forms) if form != "png"]
    try:
        page(options.folder, options.output, forms, options.compare, measured, options.fields, say, options.standard)
    except ImportError as error:
        raise InputError(f"{error}. Pictures need Debian's package python3-matplotlib") from None
    sys.stdout.flush()


def _write_curve(options):
    """The measured curve, over the specimen of the run where one is given; nothing that is there is overwritten."""
    from .laboratory import of_specimen, read
    from .run import TestRun
    if not options.laboratory:
        raise InputError("--curve needs --laboratory")
    if os.path.lexists(options.curve):
        raise InputError(f"--curve = {options.curve} is there already. Allowed: a new file")
    file, columns = options.laboratory, options.columns
    curve = of_specimen(TestRun(options.folder), file, columns) if options.folder else read(file, columns)
    rises = [k for k in range(len(curve.strain)) if curve.strain[k] > max([0, *curve.strain[:k]])]  # each strain once, from 0 on
    with open(options.curve, "x", encoding="utf-8") as out:
        out.writelines(["strain_platen,stress_pa\n", *(f"{curve.strain[k]:.9g},{curve.stress[k]:.9g}\n" for k in rises)])
    if not options.quiet:
        print(*curve.remarks, f"{len(rises)} points are in {options.curve}", sep="\n")


def main(arguments=None):
    """The program; its exit status."""
    logging.getLogger("matplotlib").setLevel(logging.ERROR)  # it tells of its cache of fonts
    parser = _Parser(add_help=False, prog="platen-report", allow_abbrev=False)
    parser.add_argument("folder", nargs="?")
    for names, how, _ in OPTIONS:
        parser.add_argument(*names.split(","), **how)
    try:
        options, ranks = parser.parse_args(arguments), _of_launcher("SIZE")
        if options.help:
            print(help_text())
            return DONE
        if options.version:
            return _platen("--version", *(["--json"] if options.json else []))
        if options.json:
            raise InputError("--json needs --version")
        if ranks > 1:
            raise InputError(f"mpirun has started {ranks} processes of platen-report, which runs in one. Allowed: without mpirun; "
                             "platen-compress and platen-brazilian run on several ranks, where they were built with MPI.")
        if options.curve:
            _write_curve(options)
            return DONE
        if not options.folder:
            raise InputError("no folder is given. See --help")
        if options.targets:
            from .laboratory_list import targets
            if options.output or options.laboratory or options.compare or options.pictures or options.standard or options.fields:
                raise InputError("--targets prints a list and draws nothing. Allowed: without options of pages")
            print(targets(options.folder), end="")
            return DONE
        if options.state or options.state_diff:
            listed = _platen("state", options.folder) if options.state else DONE
            return listed or (_platen("state", options.folder, options.state_diff) if options.state_diff else DONE)
        _draw(options)
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return OUTPUT_FAILED
    except InputError as error:
        return _fail(error, BAD_INPUT)
    except (OutputError, PlatenError, OSError, MemoryError) as error:
        return _fail(error, OUTPUT_FAILED)
    return DONE


def _of_launcher(what):
    """SIZE or RANK of this program, as Open MPI's mpirun and MPICH's leave it in the environment; 0 without them."""
    of_hydra = os.environ.get(f"PMI_{what}", 0) if "MPI_LOCALNRANKS" in os.environ else 0
    return int(os.environ.get(f"OMPI_COMM_WORLD_{what}", of_hydra))


def _fail(error, status):
    several = _of_launcher("SIZE") > 1
    if several and _of_launcher("RANK") > 0:  # the first reports what fails on all, before what the launcher says of it
        time.sleep(5)
    sys.stdout.flush()
    text = "".join(c if c == "\n" or (ord(c) >= 32 and ord(c) != 127) else "?" for c in str(error))
    print(f"error: {text}", file=sys.stderr, flush=True)
    time.sleep(0.2 * several)
    return status
