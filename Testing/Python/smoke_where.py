"""One picture of smoke, drawn by one process, by several, by a server of several, or by its client.
smoke_where.py PLUGIN DATA_FOLDER PICTURE [PORT remote|local]

The first run writes the picture, the others compare theirs with it.
"""
import os
import sys

import numpy
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy

plugin, data, path = sys.argv[1:4]
if len(sys.argv) > 4:
    simple.Connect("localhost", int(sys.argv[4]))
    simple.LoadPlugin(os.path.abspath(plugin), remote=True)
simple.LoadPlugin(os.path.abspath(plugin), remote=False)

view = simple.CreateView("RenderView")
view.ViewSize = [200, 160]
view.UseColorPaletteForBackground = 0
view.BackgroundColorMode = "Single Color"
view.Background = [1, 1, 1]
view.OrientationAxesVisibility = 0
view.CenterAxesVisibility = 0
if len(sys.argv) > 4:
    view.RemoteRenderThreshold = 0 if sys.argv[5] == "remote" else 1e9
run = simple.FDSSmokeReader(FileName=os.path.join(data, "Room", "fds", "room.smv"))
view.ViewTime = 0.0
shown = simple.Show(run, view)
assert shown.Representation == "Smoke", shown.Representation
shown.ExtinctionFactor = 0.3
shown.DiffuseColor = [0, 0, 1]
# A pillar in the smoke: half behind it, half before it.
pillar = simple.Cylinder(Height=2.4, Radius=0.3, Center=[3.2, 1.2, 1.2])
red = simple.Show(pillar, view)
# Not shaded: ParaView divides surfaces among processes, and makes their normals anew.
red.AmbientColor, red.Ambient, red.Diffuse = [1, 0, 0], 1, 0
simple.Render(view)
view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [9, -5, 3.5], [3.2, 1.2, 1.2], [0, 0, 1]
# The smoke of another time than that of the first picture.
view.ViewTime = 20.0
simple.Render(view)
image = view.CaptureWindow(1)
if servermanager.vtkProcessModule.GetProcessModule().GetPartitionId() == 0:
    width, height, _ = image.GetDimensions()
    colors = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)[..., :3].astype(int)
    dark = (colors.max(axis=2) < 200).mean()
    assert dark > 0.2, dark
    if not os.path.exists(path):
        with open(path, "wb") as file:
            numpy.save(file, colors)
    first = numpy.load(path)
    # But for the outlines, whose smooth edges are made before smoke is drawn, or after.
    smoke = numpy.maximum(colors[..., 2] - colors[..., 0], first[..., 2] - first[..., 0]) < 20
    other = numpy.abs(colors - first).max(axis=2)[smoke]
    print("%s: %.2f of the pixels are dark; of %.2f mean difference %.3f, %.4f of them differ by more than 12" % (
        " ".join(sys.argv[5:]) or "here", dark, smoke.mean(), other.mean(), (other > 12).mean()))
    # Slabs of two processes begin their steps anew: a level or two, more at the edges of the pillar.
    assert smoke.mean() > 0.9 and other.mean() < 0.5 and (other > 12).mean() < 0.005
