"""What the tests of the report share: folders of made-up results, and what is drawn in a picture."""
import sys
import tempfile
import unittest
from pathlib import Path

import numpy

from platen.report import house

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "browser"))
import made_up_run  # noqa: E402, F401


class InFolder(unittest.TestCase):
    def setUp(self):
        kept = tempfile.TemporaryDirectory(prefix="platen report ")
        self.addCleanup(kept.cleanup)
        self.folder = Path(kept.name)


class InRun(InFolder):
    """With the run of made_up_run."""

    def setUp(self):
        super().setUp()
        self.path = self.folder / "run"
        self.spheres, self.times = made_up_run.write_run(self.path, 0.004)


def lines_of(picture):
    """Of each chart of a picture, its curves by label: arrays n x 2."""
    return [{line.get_label(): numpy.array(line.get_xydata()) for line in axes.lines} for axes in house.figure_of(picture).axes]


def write_history(folder, columns):
    """history.csv of columns, at 0, 1, 2 ... s and 1e-3 a row of strain unless they say it; "z": the stress of both platens."""
    columns = dict(columns)
    if "z" in columns:
        z = columns.pop("z")
        columns = {"axial_stress_top_pa": [1.1 * s for s in z], "axial_stress_bottom_pa": [0.9 * s for s in z], **columns}
    rows = max(map(len, columns.values()))
    columns = {"time_s": list(range(rows)), "axial_strain_platen": [1e-3 * k for k in range(rows)], **columns}
    lines = [",".join(columns), *(",".join(map(repr, row)) for row in zip(*columns.values()))]
    (folder / "history.csv").write_text("\n".join(lines) + "\n")


def write_series(folder, name, frames):
    """NAME.pvd with frames {time: (points, {array: values}) or (points, arrays, elements)}."""

    def array(of, values, kind="Float64"):
        width = numpy.shape(values)[1] if numpy.ndim(values) > 1 else 1
        text = " ".join(map(repr, numpy.ravel(values).tolist()))
        return f'<DataArray type="{kind}" Name="{of}" NumberOfComponents="{width}" format="ascii">{text}</DataArray>'

    entries = []
    for k, (time, (points, arrays, *elements)) in enumerate(frames.items()):
        cells = numpy.array(elements[0]) if elements else numpy.arange(len(points)).reshape(-1, 1)
        ends = cells.shape[1] * numpy.arange(1, len(cells) + 1)
        (folder / f"{name}_{k}.vtu").write_text(
            f'<VTKFile type="UnstructuredGrid" byte_order="LittleEndian"><UnstructuredGrid><Piece NumberOfPoints="{len(points)}" '
            f'NumberOfCells="{len(cells)}"><Points>{array("Points", numpy.reshape(points, (-1, 3)))}</Points><PointData>'
            + "".join(array(*one) for one in arrays.items()) + f'</PointData><Cells>{array("connectivity", cells.ravel(), "Int64")}'
            f'{array("offsets", ends, "Int64")}</Cells></Piece></UnstructuredGrid></VTKFile>')
        entries.append(f'<DataSet timestep="{time}" file="{name}_{k}.vtu"/>')
    (folder / f"{name}.pvd").write_text(f'<VTKFile type="Collection"><Collection>{"".join(entries)}</Collection></VTKFile>')
