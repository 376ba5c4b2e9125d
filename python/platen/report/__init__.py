"""Pictures and pages from results, as platen-report makes them; needs matplotlib.

    from platen import report
    report.page("results/demo_dry")                       # or of a platen.Run: pictures/report.html in its folder
    run = report.TestRun("results/demo_dry")              # a platen.Run with the moments of its test
    report.curves.stress(axes, [run])                     # each chart draws on axes of yours
    report.specimen.outward(axes, run, run.peak_time)

Modules: curves, stages, comparison, envelope (charts of runs), laboratory (measured curves), specimen, cracks, sleeve, platens,
fields (pictures), studies, precision, calibration, programs (pages of other results), house (how pictures are made), pages.
"""
import importlib

_MODULES = ("calibration", "comparison", "cracks", "curves", "envelope", "fields", "house", "laboratory", "pages", "platens", "precision",
            "programs", "sleeve", "specimen", "stages", "studies", "words")


def page(run, output=None, forms=(), compare=()):
    """Draws the page of a run, a study, a calibration or another program's results into `output` (FOLDER/pictures), from a
    folder or a platen.Run; forms: further files of each chart ("pdf", "svg"). Returns the path of report.html. InputError,
    OutputError."""
    from .main import report_on

    return report_on(getattr(run, "folder", run), output, forms, compare)[0]


def __getattr__(name):
    # Loaded when asked for: matplotlib takes half a second.
    if name == "TestRun":
        return importlib.import_module(".run", __name__).TestRun
    if name in _MODULES:
        return importlib.import_module("." + name, __name__)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
