# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# script-version: 2.0
"""Mesh, pressure and control points of an aerofoil while it pitches: one
picture each time that Catalyst is executed, from a fixed camera, in fixed
colours."""

from paraview import catalyst
from paraview.simple import (
    ColorBy,
    CreateExtractor,
    CreateRenderView,
    GetColorTransferFunction,
    GetScalarBar,
    Show,
    Transform,
    TrivialProducer,
)

options = catalyst.Options()
options.ExtractsOutputDirectory = "."

region = TrivialProducer(registrationName="region")
controls = TrivialProducer(registrationName="controls")

view = CreateRenderView()
view.ViewSize = [900, 560]
view.UseColorPaletteForBackground = 0
view.Background = [1, 1, 1]
view.OrientationAxesVisibility = 0
view.CameraParallelProjection = 1
view.CameraFocalPoint = [0, 0, 0]
view.CameraPosition = [0, 0, 100]
view.CameraViewUp = [0, 1, 0]
view.CameraParallelScale = 22

mesh = Show(region, view)
mesh.Representation = "Surface With Edges"
mesh.EdgeColor = [0.35, 0.35, 0.4]
ColorBy(mesh, ("CELLS", "p"))
colours = GetColorTransferFunction("p")
colours.ApplyPreset("Cool to Warm (Extended)", True)
colours.RescaleTransferFunction(-900, 400)
bar = GetScalarBar(colours, view)
bar.Title, bar.ComponentTitle = "p [m2/s2]", ""
bar.TitleColor = bar.LabelColor = [0, 0, 0]
mesh.SetScalarBarVisibility(view, True)

# In front of the mesh, whose plane they are in
front = Transform(Input=controls)
front.Transform.Translate = [0, 0, 10]
points = Show(front, view)
points.Representation = "Points"
points.PointSize = 7
ColorBy(points, ("POINTS", "selected"))
kinds = GetColorTransferFunction("selected")
kinds.RGBPoints = [0, 0.6, 0.6, 0.6, 1, 0.85, 0.1, 0.1]

picture = CreateExtractor("PNG", view, registrationName="picture")
picture.Writer.FileName = "pitching_{timestep:06d}.png"
picture.Writer.ImageResolution = [900, 560]
