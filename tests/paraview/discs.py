# SPDX-License-Identifier: BSD-3-Clause
"""The representation of points as discs, in ParaView's own view.

usage: pvbatch discs.py PclUvol.so torus.vtp
"""
import sys

from paraview.simple import *
from vtkmodules.vtkIOImage import vtkPNGReader

plugin, samples_file = sys.argv[1:]
LoadPlugin(plugin, remote=False, ns=globals())
background = (0, 0, 255)  # no colour of a surface

view = CreateRenderView(
    ViewSize=[300, 300], UseColorPaletteForBackground=0, Background=[0, 0, 1], OrientationAxesVisibility=0
)
samples = XMLPolyDataReader(FileName=[samples_file])
surface = UvolIsosurface(Input=samples, Scalars=["POINTS", "torus"], Isovalues=[0.0])


def look():
    """The pixels of the view."""
    SaveScreenshot("view.png", view)
    reader = vtkPNGReader()
    reader.SetFileName("view.png")
    reader.Update()
    values = bytes(memoryview(reader.GetOutput().GetPointData().GetScalars()))
    return [tuple(values[i : i + 3]) for i in range(0, len(values), 3)]


def covered(pixels):
    return [pixel != background for pixel in pixels]

# Borders of discs are blended with the background, and stand out a little.
outline = 0.06


def count_differences(some, others):
    return sum(a != b for a, b in zip(some, others))


def expect(fact, words):
    assert fact, "not: " + words
    print("ok:", words, flush=True)


display = Show(surface, view)
expect(display.Representation == "Uvol Discs", "isosurfaces are shown as discs unasked")
display.ColorArrayName = ["POINTS", ""]
ResetCamera(view)
discs = look()
size = sum(covered(discs))
expect(size > 0.1 * len(discs), "discs cover a part of the picture")

display.Representation = "Points"
expect(sum(covered(look())) < 0.8 * size, "bare dots cover less")

surface.Mesh = 1
display.Representation = "Surface"
mesh = look()
expect(count_differences(covered(discs), covered(mesh)) < outline * size, "discs cover what a mesh covers")
display.Representation = "Uvol Discs"
expect(count_differences(look(), mesh) == 0, "a mesh is drawn as it was")

display.Position, display.Scale = [0.2, 0.1, 0.0], [0.7, 0.7, 0.7]
moved_mesh = look()
surface.Mesh = 0
moved = look()
expect(
    count_differences(covered(moved), covered(moved_mesh)) < outline * size
    and count_differences(covered(moved), covered(discs)) > 0.1 * size,
    "discs are moved and scaled as a mesh",
)
display.Position, display.Scale = [0.0, 0.0, 0.0], [1.0, 1.0, 1.0]
expect(count_differences(look(), discs) == 0, "and come back")

ball = Sphere(Center=[0.65, 0.0, 0.0], Radius=0.1)
ball_display = Show(ball, view)
ball_display.DiffuseColor = [0.0, 1.0, 0.0]
expect(count_differences(look(), discs) == 0, "they hide what is inside")
ball.Center = [0.65, 0.0, 1.0]
ahead = look()
expect(0 < count_differences(ahead, discs) < 0.2 * size, "and are hidden by what is in front")
Hide(ball, view)

display.Opacity = 0.3
expect(count_differences(covered(look()), covered(discs)) < outline * size, "they let light through")
display.Opacity = 1.0

display.DiffuseColor = [1.0, 0.0, 0.0]
red = look()
expect(all(g <= r for r, g, b in red), "they have the colour of the display")
ColorBy(display, ("POINTS", "isovalue"))
colors = GetColorTransferFunction("isovalue")
colors.RGBPoints = [0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0]
green = look()
expect(all(r <= g for r, g, b in green if (r, g, b) != background), "or those of an array")
colors.RGBPoints = [0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0]
expect(count_differences(look(), red) < outline * size, "and follow its map")

SelectSurfacePoints(Rectangle=[0, 0, 300, 300], View=view)
chosen = ExtractSelection(Input=surface)
chosen.UpdatePipeline()
points = chosen.GetDataInformation().GetNumberOfPoints()
expect(0 < points <= surface.GetDataInformation().GetNumberOfPoints(), "points are selected")
