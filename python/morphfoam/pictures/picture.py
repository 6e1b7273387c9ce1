# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Pictures of a case's mesh and fields, made with ParaView without a display.

    withDisplay $(python3With paraview.simple) -m morphfoam.pictures.picture
        CASE OUTPUT.png [-time T] [-box X0 X1 Y0 Y1] [-field NAME]
        [-range LOW HIGH] [-noLines] [-width PIXELS] [-regions NAME...]

or picture(...) from a script run so; not by pvbatch, which takes options for
its own. The view is along -z on the
box, which the picture shows exactly; without it, on the whole mesh.
"""

import argparse
from pathlib import Path

from paraview import simple as pv

# The camera is where picture() puts it, in the first picture as well
pv._DisableFirstRenderCameraReset()


def open_case(case, time=None, regions=()):
    """The internal mesh and its cell fields at that time (default: last), or
    the meshes of regions.

    ParaView's reader passes over time 0, which a case without other times
    shows all the same."""
    case = Path(case).resolve()
    if not (case / "constant/polyMesh/faces").exists():
        raise FileNotFoundError(f"{case} has no mesh (constant/polyMesh)")
    marker = case / (case.name + ".foam")
    marker.touch()
    reader = pv.OpenFOAMReader(
        FileName=str(marker),
        MeshRegions=[f"/{region}/internalMesh" for region in regions]
        or ["internalMesh"],
    )
    reader.UpdatePipelineInformation()
    times = list(reader.TimestepValues)
    if time is None:
        time = times[-1] if times else 0.0
    elif times and min(abs(t - time) for t in times) > 1e-6 * max(
        1, abs(time)
    ):
        raise ValueError(f"{case} has no time {time:g}, but {times}")
    pv.GetAnimationScene().AnimationTime = time
    pv.UpdatePipeline(time=time, proxy=reader)
    return reader


def picture(
    case,
    output,
    time=None,
    box=None,
    field=None,
    range=None,
    lines=True,
    width=1200,
    component=None,
    towards=(0, 0, -1),
    up=(0, 1, 0),
    regions=(),
    plane=None,
):
    """Writes one picture: the mesh's lines and, if named, a field's colours.

    box     (xMin, xMax, yMin, yMax) [m]: what the picture shows
    towards, up  unit vectors: where one looks and what is up there, if that is
            not along -z; box is then along the picture's own axes
    range   (low, high) of the colours; default: the field's own in the box
    component  of a vector: "X", "Y" or "Z"; default: its magnitude
    regions of a case that has several; default: its mesh without a name
    plane   (origin, normal): a section through the mesh instead of its surface
    """
    view = pv.CreateView("RenderView")
    mesh = open_case(case, time, regions)
    if plane is not None:
        mesh = section(mesh, *plane)
    if box is None:
        box = mesh.GetDataInformation().GetBounds()[:4]
    x_min, x_max, y_min, y_max = box
    height = round(width * (y_max - y_min) / (x_max - x_min))

    view.ViewSize = [width, height]
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.OrientationAxesVisibility = 0

    display = pv.Show(mesh, view)
    display.Representation = "Surface With Edges" if lines else "Surface"
    display.Ambient, display.Diffuse, display.Specular = 1, 0, 0
    display.EdgeColor = [0.1, 0.2, 0.4] if field is None else [0.3, 0.3, 0.3]
    display.LineWidth = 1
    if field is None:
        display.SetScalarColoring(None, 0)
        display.AmbientColor = display.DiffuseColor = [0.93, 0.95, 0.98]
    else:
        colour(
            display,
            view,
            mesh,
            field,
            range or visible_range(mesh, field, box),
            component,
        )

    view.CameraParallelProjection = 1
    across = [
        towards[i - 2] * up[i - 1] - towards[i - 1] * up[i - 2]
        for i in (0, 1, 2)
    ]
    centre = [
        a * (x_min + x_max) / 2 + b * (y_min + y_max) / 2
        for a, b in zip(across, up)
    ]
    view.CameraFocalPoint = centre
    view.CameraPosition = [
        c - 10 * (x_max - x_min) * t for c, t in zip(centre, towards)
    ]
    view.CameraViewUp = list(up)
    view.CameraParallelScale = (y_max - y_min) / 2

    Path(output).resolve().parent.mkdir(parents=True, exist_ok=True)
    pv.Render(view)
    pv.SaveScreenshot(str(output), view, ImageResolution=[width, height])
    pv.Delete(view)


def section(mesh, origin, normal):
    cut = pv.Slice(Input=mesh, SliceType="Plane")
    cut.SliceType.Origin = list(origin)
    cut.SliceType.Normal = list(normal)
    cut.UpdatePipeline()
    return cut


def visible_range(mesh, field, box):
    """Of the field in the cells the picture shows"""
    x_min, x_max, y_min, y_max = box
    cut = pv.Clip(Input=mesh, ClipType="Box")
    cut.ClipType.Position = [x_min, y_min, -1e9]
    cut.ClipType.Length = [x_max - x_min, y_max - y_min, 2e9]
    cut.UpdatePipeline()
    array = cut.GetCellDataInformation().GetArray(field)
    if array is None:
        raise ValueError(f"there is no cell field '{field}'")
    limits = array.GetRange(-1 if array.GetNumberOfComponents() > 1 else 0)
    pv.Delete(cut)
    return limits


def colour(display, view, mesh, field, limits, component=None):
    pv.ColorBy(
        display, ("POINTS", field) + ((component,) if component else ())
    )
    table = pv.GetColorTransferFunction(field)
    table.ApplyPreset("Cool to Warm (Extended)", True)
    table.RescaleTransferFunction(*limits)
    bar = pv.GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle = field, ""
    bar.TitleColor = bar.LabelColor = [0, 0, 0]
    bar.TitleFontSize = bar.LabelFontSize = 20
    bar.WindowLocation = "Lower Right Corner"
    bar.ScalarBarLength = 0.35
    display.SetScalarBarVisibility(view, True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("case")
    parser.add_argument("output")
    parser.add_argument("-time", type=float)
    parser.add_argument("-box", type=float, nargs=4)
    parser.add_argument("-field")
    parser.add_argument("-range", type=float, nargs=2)
    parser.add_argument("-noLines", dest="lines", action="store_false")
    parser.add_argument("-width", type=int, default=1200)
    parser.add_argument("-regions", nargs="+", default=())
    arguments = vars(parser.parse_args())
    picture(**arguments)


if __name__ == "__main__":
    main()
