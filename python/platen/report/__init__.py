"""Pictures and pages from results, as platen-report makes them; needs matplotlib.

    from platen import report
    report.page("results/demo_dry")                       # or of a platen.Run: pictures/report.html in its folder
    run = report.TestRun("results/demo_dry")              # a platen.Run with the moments of its test
    report.curves.stress(axes, [run])                     # each chart draws on axes of yours
    report.specimen.outward_displacement(axes, run, run.peak_time)

Modules: curves, comparison, envelope (charts of runs), laboratory (measured curves), specimen, cracks, platens, fields (pictures),
standard (the test report by a standard), studies, precision, programs (pages of other results), house (how pictures are made), pages.
"""
import importlib
from pathlib import Path

from ..errors import InputError

_MODULES = ("comparison", "cracks", "curves", "envelope", "fields", "house", "laboratory", "laboratory_list", "laboratory_study", "pages", "platens", "precision", "programs",
            "specimen", "standard", "studies", "words")


def page(run, output=None, forms=(), compare=(), measured=None, write_fields=False, say=lambda *_: None, by_standard=False):
    """Draws the page of a run, a study, a calibration or another program's results into `output` (FOLDER/pictures), from a
    folder or a platen.Run; forms: further files of each chart ("pdf", "svg"); measured: (file, columns) of a laboratory's curve, of a study of its list;
    write_fields: fields.write_fields too; by_standard: instead the test report by Scene/Standard, test_report.html. Returns the path of
    the page. InputError, OutputError."""
    from . import comparison, fields, laboratory, laboratory_study, pages, programs, standard, studies
    from .run import TestRun

    folder = Path(getattr(run, "folder", run))
    if not folder.is_dir():
        raise InputError(f"{folder}: no such folder")
    of_study = (folder / "study.json").exists()
    made = studies.page_of(folder, *compare) if of_study else programs.page_of(folder)
    for option, what, asked in (("--compare", "runs and studies", compare and not of_study), ("--laboratory", "runs and studies", measured and not of_study),
                                ("--fields", "runs", write_fields), ("--standard", "runs", by_standard)):
        if made is not None and asked:
            raise InputError(f"{option} is for {what}; {folder} holds none")
    if by_standard:
        for option, asked in (("--compare", compare), ("--laboratory", measured), ("--fields", write_fields)):
            if asked:
                raise InputError(f"--standard is the report of one run alone. Allowed: without {option}")
        return pages.write(standard.page_of(folder), output or folder / "pictures", forms, say, "test_report.html")
    if made is None:
        tests = [TestRun(each) for each in (folder, *compare)]
        for test in tests:
            test.read_all()
        made = comparison.page_of_runs(tests, laboratory.of_specimen(tests[0], *measured) if measured else None)
    elif of_study and measured:
        if compare:
            raise InputError("--laboratory is for one study alone. Allowed: without --compare")
        made = laboratory_study.added(made, folder, *measured)
    path = pages.write(made, output or folder / "pictures", forms, say)
    if write_fields:
        say(f"fields: {fields.write_fields(tests[0])}")
    return path


def __getattr__(name):
    # Loaded when asked for: matplotlib takes half a second.
    if name == "TestRun":
        return importlib.import_module(".run", __name__).TestRun
    if name in _MODULES:
        return importlib.import_module("." + name, __name__)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
