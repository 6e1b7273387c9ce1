# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The tutorial's pictures, in results/: blade and hub, and the mesh on the
cylinder through the tip gap, before and after."""

from pathlib import Path

from paraview import simple as pv

here = Path(__file__).resolve().parent
pv._DisableFirstRenderCameraReset()


def show(source, view, colour):
    display = pv.Show(source, view)
    display.Representation = "Surface With Edges"
    display.SetScalarColoring(None, 0)
    display.AmbientColor = display.DiffuseColor = colour
    display.EdgeColor = [0.1, 0.2, 0.4]
    display.Ambient, display.Diffuse, display.Specular = 0.3, 0.7, 0


def opened(case, regions):
    marker = case / "case.foam"
    marker.touch()
    reader = pv.OpenFOAMReader(FileName=str(marker), MeshRegions=regions)
    reader.UpdatePipelineInformation()
    times = list(reader.TimestepValues)
    pv.GetAnimationScene().AnimationTime = times[-1] if times else 0
    pv.UpdatePipeline(time=times[-1] if times else 0, proxy=reader)
    return reader


def save(name, parts, position, focus, up, scale, size):
    view = pv.CreateView("RenderView")
    view.ViewSize = size
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.OrientationAxesVisibility = 0
    for source, colour in parts:
        show(source, view, colour)
    view.CameraParallelProjection = 1
    view.CameraPosition, view.CameraFocalPoint = position, focus
    view.CameraViewUp = up
    view.CameraParallelScale = scale
    pv.Render(view)
    pv.SaveScreenshot(
        str(here / f"results/{name}.png"), view, ImageResolution=size
    )
    pv.Delete(view)


def pictures(name, case):
    walls = [
        (opened(case, ["patch/blade"]), [0.85, 0.7, 0.45]),
        (opened(case, ["patch/hub"]), [0.8, 0.86, 0.93]),
    ]
    save(
        f"blade.{name}",
        walls,
        [1.2, -1.6, 1.6],
        [0.2, 0, 0.68],
        [0, 0, 1],
        0.36,
        [1200, 900],
    )

    for radius, part in ((0.995, "gap"), (0.75, "middle")):
        cut = pv.Slice(
            Input=opened(case, ["internalMesh"]), SliceType="Cylinder"
        )
        cut.SliceType.Center = [0, 0, 0]
        cut.SliceType.Axis = [1, 0, 0]
        cut.SliceType.Radius = radius
        cut.Triangulatetheslice = 0
        save(
            f"{part}.{name}",
            [(cut, [0.93, 0.95, 0.98])],
            [0.2, 0.05, 5],
            [0.2, 0.05, 0],
            [0, 1, 0],
            0.33,
            [1600, 850],
        )


pictures("before", here)
for images in ("auto", "no"):
    pictures(f"images.{images}", here / f"runs/images.{images}")
