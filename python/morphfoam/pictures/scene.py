# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Three-dimensional pictures: surfaces, patches, cuts through a mesh, lattices.

    withDisplay $(python3With paraview.simple) -m morphfoam.pictures.scene
        OUTPUT.png [-surface FILE ...] [-lattice FILE ...] [-case CASE [-time T]
        [-patches NAME ...] [-cut x|y|z [-at X]]] [-direction X Y Z] [-zoom F]

or scene(...) from a script run so.
"""

import argparse
from pathlib import Path

from paraview import simple as pv

from morphfoam.pictures.picture import open_case

pv._DisableFirstRenderCameraReset()

NORMALS = {"x": [1, 0, 0], "y": [0, 1, 0], "z": [0, 0, 1]}


def open_patches(case, patches, time=None):
    """Patches of a case as surfaces"""
    case = Path(case).resolve()
    marker = case / (case.name + ".foam")
    marker.touch()
    reader = pv.OpenFOAMReader(
        FileName=str(marker), MeshRegions=[f"patch/{name}" for name in patches]
    )
    pv.UpdatePipeline(time=0.0 if time is None else time, proxy=reader)
    return reader


def scene(
    output,
    surfaces=(),
    lattices=(),
    cases=(),
    patches=(),
    cut=None,
    at=None,
    direction=(-2, -3, 1.5),
    zoom=1.0,
    field=None,
    range=None,
    lines=False,
    width=1200,
    height=800,
    box=None,
):
    """Writes one picture.

    surfaces, lattices  files that ParaView reads (stl, obj, vtk, vtp)
    cases       (case, time) pairs; of each the patches, and the cells that the
                plane through `at` (default: the middle) normal to axis `cut`
                goes through
    direction   from which one looks; None: along the normal of the cut
    zoom        larger than one: nearer than what shows everything
    box         bounds (x0 x1 y0 y1 z0 z1) to show instead of everything
    """
    view = pv.CreateView("RenderView")
    view.ViewSize = [width, height]
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.OrientationAxesVisibility = 0
    view.CameraParallelProjection = 1

    shown = []
    towards = direction
    if direction is None:
        towards = [-n if cut == "y" else n for n in NORMALS[cut]]

    def show(source, colour, edges=False, opacity=1.0, line=1):
        display = pv.Show(source, view)
        display.Representation = "Surface With Edges" if edges else "Surface"
        display.SetScalarColoring(None, 0)
        display.AmbientColor = display.DiffuseColor = colour
        display.EdgeColor = [0.1, 0.2, 0.4]
        display.Opacity = opacity
        display.LineWidth = line
        shown.append(source)
        return display

    for file in surfaces:
        show(pv.OpenDataFile(str(file)), [0.75, 0.78, 0.85], lines)
    for file in lattices:
        lattice = pv.OpenDataFile(str(file))
        if direction is None:
            # In front of the cut that it lies in
            lattice.UpdatePipeline()
            extent = lattice.GetDataInformation().GetBounds()
            reach = max(extent[i + 1] - extent[i] for i in (0, 2, 4))
            lattice = pv.Transform(Input=lattice)
            lattice.Transform.Translate = [reach * n for n in towards]
        show(lattice, [0.8, 0.25, 0.1], line=1)
        knots = pv.Glyph(Input=lattice, GlyphType="Sphere")
        knots.ScaleArray = ["POINTS", "No scale array"]
        knots.OrientationArray = ["POINTS", "No orientation array"]
        knots.GlyphMode = "All Points"
        bounds = lattice.GetDataInformation().GetBounds()
        knots.ScaleFactor = 0.012 * max(
            bounds[i + 1] - bounds[i] for i in (0, 2, 4)
        )
        show(knots, [0.8, 0.25, 0.1])
    for case, time in cases:
        if patches:
            show(open_patches(case, patches, time), [0.75, 0.78, 0.85], lines)
        if cut:
            mesh = open_case(case, time)
            bounds = mesh.GetDataInformation().GetBounds()
            middle = [(bounds[i] + bounds[i + 1]) / 2 for i in (0, 2, 4)]
            if at is not None:
                middle["xyz".index(cut)] = at
            # Whole cells, as they are
            cells = (
                pv.Slice(Input=mesh, SliceType="Plane")
                if field
                else pv.ExtractCellsByRegion(Input=mesh)
            )
            if field:
                cells.SliceType.Origin = middle
                cells.SliceType.Normal = NORMALS[cut]
            else:
                cells.IntersectWith = "Plane"
                cells.IntersectWith.Origin = middle
                cells.IntersectWith.Normal = NORMALS[cut]
                cells.Extractonlyintersected = 1
                cells.Extractintersected = 1
            display = show(cells, [0.93, 0.95, 0.98], field is None)
            if field:
                colour_by(display, view, field, range)

    look(view, shown, towards, zoom, box)
    Path(output).resolve().parent.mkdir(parents=True, exist_ok=True)
    pv.Render(view)
    pv.SaveScreenshot(str(output), view, ImageResolution=[width, height])
    for source in shown:
        pv.Hide(source, view)
    pv.Delete(view)


def colour_by(display, view, field, limits):
    pv.ColorBy(display, ("CELLS", field))
    table = pv.GetColorTransferFunction(field)
    table.ApplyPreset("Cool to Warm (Extended)", True)
    if limits:
        table.RescaleTransferFunction(*limits)
    display.SetScalarBarVisibility(view, True)


def look(view, shown, direction, zoom, box):
    """The camera, so that everything shown (or the box) is in the picture"""
    if box is None:
        all_bounds = []
        for source in shown:
            source.UpdatePipeline()
            all_bounds.append(source.GetDataInformation().GetBounds())
        box = [
            f(b[i] for b in all_bounds)
            for i in (0, 1, 2, 3, 4, 5)
            for f in [min if i % 2 == 0 else max]
        ]
    centre = [(box[i] + box[i + 1]) / 2 for i in (0, 2, 4)]
    size = sum((box[i + 1] - box[i]) ** 2 for i in (0, 2, 4)) ** 0.5
    length = sum(d * d for d in direction) ** 0.5
    view.CameraFocalPoint = centre
    view.CameraPosition = [
        c + 3 * size * d / length for c, d in zip(centre, direction)
    ]
    vertical = abs(direction[2]) > 0.9 * length
    view.CameraViewUp = [0, 1, 0] if vertical else [0, 0, 1]
    view.CameraParallelScale = 0.45 * size / zoom


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("output")
    parser.add_argument("-surface", nargs="+", default=[], dest="surfaces")
    parser.add_argument("-lattice", nargs="+", default=[], dest="lattices")
    parser.add_argument("-case")
    parser.add_argument("-time", type=float)
    parser.add_argument("-patches", nargs="+", default=[])
    parser.add_argument("-cut", choices=NORMALS)
    parser.add_argument("-at", type=float)
    parser.add_argument("-direction", type=float, nargs=3)
    parser.add_argument("-zoom", type=float, default=1)
    arguments = vars(parser.parse_args())
    case, time = arguments.pop("case"), arguments.pop("time")
    if case:
        arguments["cases"] = [(case, time)]
    if not arguments["direction"] and not arguments["cut"]:
        arguments["direction"] = (-2, -3, 1.5)
    scene(**arguments)


if __name__ == "__main__":
    main()
