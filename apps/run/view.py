"""Shows this folder in ParaView: spheres by damage and cut in half, broken bonds in red, the pressure on the platens, the
sleeve, the time.

  pvpython view.py [--png FILE] [--time SECONDS] [--by ARRAY]    draws one picture (view.png; xvfb-run without a display)
  paraview --script=view.py                                       opens the same to look around
"""
import argparse
import os
import sys

from paraview import simple as pv

FOLDER = os.path.dirname(os.path.abspath(globals().get("__file__", "view.py")))
BONDS_BROKEN = 2  # state of bonds.pvd from which on a bond is broken


def series(name):
    """The time series `name`, or None where the run wrote none."""
    path = os.path.join(FOLDER, name + ".pvd")
    return pv.PVDReader(registrationName=name, FileName=path) if os.path.exists(path) else None


def half(source, name):
    """What lies behind the plane y = 0: whole cells or points."""
    cut = pv.ExtractCellsByRegion(registrationName=name, Input=source)
    cut.IntersectWith = "Plane"
    cut.IntersectWith.Origin = [0, 0, 0]
    cut.IntersectWith.Normal = [0, -1, 0]
    cut.Extractintersected = 1
    return cut


def coloured(display, where, array, title, view, preset, place):
    pv.ColorBy(display, (where, array))
    display.RescaleTransferFunctionToDataRange(False, True)  # at the view's time
    colours = pv.GetColorTransferFunction(array)
    colours.ApplyPreset(preset, True)
    bar = pv.GetScalarBar(colours, view)
    bar.Title, bar.ComponentTitle = title, ""
    bar.WindowLocation, bar.Position = "Any Location", place
    bar.TitleColor = bar.LabelColor = [0, 0, 0]
    bar.ScalarBarLength = 0.3
    display.SetScalarBarVisibility(view, True)


def show_specimen(view, array):
    spheres = series("specimen")
    if spheres is None:
        return
    display = pv.Show(half(spheres, "half of the specimen"), view)
    display.SetRepresentationType("Point Gaussian")
    display.ShaderPreset = "Sphere"
    display.GaussianRadius = 1
    display.ScaleByArray = 1
    display.SetScaleArray = ["POINTS", "radius"]
    display.UseScaleFunction = 0
    title = {"damage": "Damage (share of a sphere's bonds)", "displacement": "Displacement (m)"}.get(array, array)
    coloured(display, "POINTS", array, title, view, "Cividis", [0.85, 0.58])


def show_broken_bonds(view):
    bonds = series("bonds")
    if bonds is None:
        return
    broken = pv.Threshold(registrationName="broken bonds", Input=bonds)
    broken.Scalars = ["CELLS", "state"]
    broken.ThresholdMethod = "Above Upper Threshold"
    broken.UpperThreshold = BONDS_BROKEN
    display = pv.Show(half(broken, "half of the broken bonds"), view)
    display.ColorArrayName = ["POINTS", ""]
    display.AmbientColor = display.DiffuseColor = [0.8, 0.1, 0.1]
    display.LineWidth = 2


def show_bodies(view):
    platens = pv.FindSource("platens")
    cut = pv.Clip(registrationName="half of the platens", Input=platens)
    cut.ClipType.Origin, cut.ClipType.Normal, cut.Invert = [0, 0, 0], [0, 1, 0], 0
    display = pv.Show(cut, view)
    coloured(display, "POINTS", "contact_pressure", "Pressure on the platens (Pa)", view, "Viridis (matplotlib)", [0.85, 0.1])
    sleeve = series("sleeve")
    if sleeve is not None:
        display = pv.Show(sleeve, view)
        display.ColorArrayName = ["POINTS", ""]
        display.Opacity = 0.15
        display.AmbientColor = display.DiffuseColor = [0.3, 0.3, 0.3]


def show_time(view):
    time = pv.AnnotateTimeFilter(registrationName="time", Input=pv.FindSource("platens"))
    time.Format = "Time: {time:.6f} s"
    display = pv.Show(time, view)
    display.Color = [0, 0, 0]


def main(arguments):
    parser = argparse.ArgumentParser(prog="pvpython view.py")
    parser.add_argument("--png", default=os.path.join(FOLDER, "view.png"), help="picture to write")
    parser.add_argument("--time", type=float, help="s; default: the last frame")
    parser.add_argument("--by", default="damage", help="point array of specimen.pvd that colours the spheres")
    options = parser.parse_args(arguments)
    view = pv.GetActiveViewOrCreate("RenderView")
    view.ViewSize = [1200, 1200]
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.OrientationAxesLabelColor = [0, 0, 0]
    scene = pv.GetAnimationScene()
    times = series("platens").TimestepValues
    view.ViewTime = times[-1] if options.time is None else min(times, key=lambda t: abs(t - options.time))
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.AnimationTime = view.ViewTime
    show_specimen(view, options.by)
    show_broken_bonds(view)
    show_bodies(view)
    show_time(view)
    pv.ResetCamera(view)
    view.CameraViewUp = [0, 0, 1]
    focus = view.CameraFocalPoint
    far = 3.7 * view.CameraParallelScale
    view.CameraPosition = [focus[0] + 0.35 * far, focus[1] - far, focus[2] + 0.2 * far]
    pv.Render(view)
    if os.path.basename(sys.executable or "").startswith("paraview") or "PARAVIEW_GUI" in os.environ:
        return
    pv.SaveScreenshot(options.png, view)
    print("wrote", options.png)


if __name__ == "__main__":
    main(sys.argv[1:])
