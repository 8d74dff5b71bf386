"""Smoke as the reader shows it: a volume that lets exp(-optical depth) of the light behind it pass.
smoke_volume.py PLUGIN DATA_FOLDER

Smoke is drawn black before white and without perspective, so that a pixel is what the smoke lets pass. The optical
depth is summed here over the cells that the reader gives. What may differ: a volume mapper sums samples half a cell of
the image apart, so that it may miss half a step at either end (STEP), and a pixel has 8 bits.
"""
import os
import sys

import numpy
import scenes
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkMultiBlockDataSet, vtkPartitionedDataSetCollection
from vtkmodules.vtkFiltersSources import vtkSphereSource

simple = scenes.load_plugin()
DATA = sys.argv[2]
#: Pixels a cell: the middle one looks through the cell's centre, where neighbours do not count.
PIXELS = 5
BITS = 1.5 / 255


def grids(data):
    """The grids of a collection: (edges along x, y, z; extinction by z, y, x)."""
    found = []
    for i in range(data.GetNumberOfPartitionedDataSets()):
        grid = data.GetPartitionedDataSet(i).GetPartition(0)
        edges = [vtk_to_numpy(getattr(grid, "Get%sCoordinates" % axis)()) for axis in "XYZ"]
        shape = [len(along) - 1 for along in reversed(edges)]
        found.append((edges, vtk_to_numpy(grid.GetCellData().GetArray("Extinction")).reshape(shape)))
    return found


def depth_along_x(meshes, centres):
    """Optical depth along x through the centres (y, z) of cells, and the extinction at its two ends."""
    depth = numpy.zeros((len(centres[1]), len(centres[0])))
    ends = []
    for edges, extinction in meshes:
        j, k = (numpy.searchsorted(edges[axis], centre) - 1 for axis, centre in zip((1, 2), centres))
        rows = extinction[k][:, j]
        depth += rows @ numpy.diff(edges[0])
        ends += [rows[..., 0], rows[..., -1]]
    return depth, numpy.maximum(ends[0], ends[-1])


def look(view, bounds, along, size):
    """A view along an axis that shows the bounds, so many cells (across, up), edge to edge."""
    # The first picture sets the camera.
    simple.Render(view)
    across, up = {0: (1, 2), 2: (0, 1)}[along]
    middle = [0.5 * (bounds[2 * i] + bounds[2 * i + 1]) for i in range(3)]
    away = list(middle)
    # From +x with z up, y goes right; from +z with y up, x goes right.
    away[along] += 2 * (bounds[2 * along + 1] - bounds[2 * along])
    view.CameraParallelProjection = 1
    view.CameraPosition, view.CameraFocalPoint = away, middle
    view.CameraViewUp = [0, 0, 1] if along == 0 else [0, 1, 0]
    view.CameraParallelScale = 0.5 * (bounds[2 * up + 1] - bounds[2 * up])
    view.ViewSize = [PIXELS * size[0], PIXELS * size[1]]


def pixels(view):
    """Red of the pixels in the middle of the cells, from below, 0 to 1."""
    simple.Render(view)
    image = view.CaptureWindow(1)
    width, height, _ = image.GetDimensions()
    red = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)[..., 0] / 255.0
    return red[PIXELS // 2::PIXELS, PIXELS // 2::PIXELS]


def white_view():
    view = simple.CreateView("RenderView")
    view.UseColorPaletteForBackground = 0
    view.BackgroundColorMode = "Single Color"
    view.Background = [1, 1, 1]
    view.OrientationAxesVisibility = 0
    view.CenterAxesVisibility = 0
    return view


def show(source, view, time=None):
    if time is not None:
        view.ViewTime = time
    shown = simple.Show(source, view)
    assert shown.Representation == "Smoke", shown.Representation
    shown.SmokeColor = [0, 0, 0]
    return shown


def agree(seen, expected, allowed, what):
    worst = numpy.max(numpy.abs(seen - expected) - allowed)
    print("%s: pixels %.3f to %.3f, mean %.4f where %.4f is expected; %.4f within what is allowed" % (
        what, seen.min(), seen.max(), seen.mean(), expected.mean(), -worst))
    assert worst < 0, worst


# A run of two meshes, one with cells twice as large, and stretched: through both.
run = simple.FDSSmokeReader(FileName=os.path.join(DATA, "Room", "fds", "room.smv"))
run.UpdatePipeline(20.0)
view = white_view()
shown = show(run, view, 20.0)
bounds = run.GetDataInformation().GetBounds()
look(view, bounds, 0, (24, 24))
seen = pixels(view)
centres = [(numpy.arange(24) + 0.5) * 0.1] * 2
meshes = grids(run.GetClientSideObject().GetOutputDataObject(0))
depth, ends = depth_along_x(meshes, centres)
assert depth.max() > 1 and depth.min() < 0.05, (depth.min(), depth.max())
STEP = 0.5 * 0.1
passes = numpy.exp(-depth)
agree(seen, passes, passes * numpy.expm1(ends * STEP) + BITS, "Room")
assert seen.min() < 0.5, "smoke is seen"

# Thicker than it is, by a factor.
shown.ExtinctionFactor = 0.25
passes = numpy.exp(-0.25 * depth)
agree(pixels(view), passes, passes * numpy.expm1(0.25 * ends * STEP) + BITS, "Room, a quarter")
shown.ExtinctionFactor = 1

# Few cells of the image: each has the mean of what it covers, so the mean depth stays. Drawn thin, so that none is cut off.
for most, allowed in ((4000000, 0.01), (5000, 0.03)):
    shown.MaximumNumberOfCells = most
    shown.ExtinctionFactor = 0.05
    mean = -numpy.log(pixels(view)).mean() / 0.05
    print("Room, %d cells: mean depth %.3f where %.3f is expected" % (most, mean, depth.mean()))
    assert abs(mean / depth.mean() - 1) < allowed
simple.Delete(view)

# The hall, from above, at two times: the smoke follows the view's time.
hall = simple.FDSSmokeReader(FileName=os.path.join(DATA, "Hall", "fds", "hall.smv"))
hall.UpdatePipeline(0.0)
view = white_view()
shown = show(hall, view, 0.0)
shown.ExtinctionFactor = 0.01
bounds = hall.GetDataInformation().GetBounds()
cells = [round((bounds[2 * i + 1] - bounds[2 * i]) / 0.5) for i in range(3)]
look(view, bounds, 2, cells[:2])
inside = (slice(1, -1), slice(1, -1))
assert pixels(view)[inside].min() == 1.0, "no smoke at first"
view.ViewTime = 600.0
seen = pixels(view)
expected = numpy.ones_like(seen)
allowed = numpy.zeros_like(seen)
for edges, extinction in grids(hall.GetClientSideObject().GetOutputDataObject(0)):
    assert abs(numpy.diff(edges[0])[0] - 0.5) < 1e-6, edges
    column = numpy.exp(-0.01 * numpy.tensordot(numpy.diff(edges[2]), extinction, (0, 0)))
    first = [round((edges[axis][0] - bounds[2 * axis]) / 0.5) for axis in (0, 1)]
    block = tuple(slice(first[i], first[i] + column.shape[1 - i]) for i in (1, 0))
    expected[block] = column
    allowed[block] = numpy.expm1(0.01 * 0.25 * numpy.maximum(extinction[0], extinction[-1])) + BITS
# The outlines of the meshes are drawn over the pixels beside them.
lines = numpy.abs(numpy.arange(cells[0]) + 0.5 - cells[0] / 2) < 1
agree(seen[:, ~lines][inside], expected[:, ~lines][inside], allowed[:, ~lines][inside], "Hall")
simple.Delete(view)


def block(cells, low, size, extinction, array="Extinction"):
    data = scenes.image(cells, size, extinction, low)
    data.GetCellData().GetArray(0).SetName(array)
    return data


def multiblock(*blocks):
    data = vtkMultiBlockDataSet()
    for i, one in enumerate(blocks):
        data.SetBlock(i, one)
    return data


def shown_as_smoke(data, name, view):
    source = scenes.producer(data, name)
    shown = simple.Show(source, view, "SmokeRepresentation")
    shown.SetRepresentationType("Smoke")
    shown.SmokeColor = [0, 0, 0]
    return source, shown


# A fine mesh within a coarse one, one beside it that ends within a cell, far from the origin: the smoke of each once.
far = 1e6
coarse = block((4, 2, 2), (far, far, 0), (4, 2, 2), 0.2)
fine = block((10, 20, 20), (far + 1, far, 0), (1, 2, 2), 1.0)
beside = block((7, 2, 2), (far + 4, far, 0), (2.45, 2, 2), 0.3)
view = white_view()
source, shown = shown_as_smoke(multiblock(coarse, fine, beside), "Overlap", view)
look(view, (far, far + 6.45, far, far + 2, 0, 2), 0, (20, 20))
passes = numpy.exp(-(0.2 * 3 + 1.0 + 0.3 * 2.45))
for most in (4000000, 2000):
    shown.MaximumNumberOfCells = most
    step = 0.5 * 0.1 * (1 if most > 2000 else 3)
    agree(pixels(view), numpy.full((20, 20), passes), passes * numpy.expm1(0.3 * step) + BITS,
          "Meshes over each other, %d cells" % most)
simple.Hide(source, view)

# One mesh; values on points; a slab one cell thick; values that are no smoke.
for name, data, expected in (
        ("One mesh", block((10, 4, 4), (0, 0, 0), (1, 0.4, 0.4), 0.7), 0.7),
        ("One cell thick", block((1, 4, 4), (0, 0, 0), (1, 0.4, 0.4), 0.7), 0.7),
        ("No numbers", block((10, 4, 4), (0, 0, 0), (1, 0.4, 0.4), numpy.nan), 0.0),
        ("Negative", block((10, 4, 4), (0, 0, 0), (1, 0.4, 0.4), -1.0), 0.0)):
    source, shown = shown_as_smoke(data, name, view)
    look(view, (0, 1, 0, 0.4, 0, 0.4), 0, (4, 4))
    step = 0.05 if "thick" not in name else 0.5 * 0.4
    passes = numpy.exp(-expected)
    agree(pixels(view), numpy.full((4, 4), passes), passes * numpy.expm1(expected * step) + BITS, name)
    simple.Hide(source, view)

# Without smoke: outlines, never nothing and never an error.
sphere = vtkSphereSource()
sphere.Update()
empty = vtkPartitionedDataSetCollection()
for name, data, drawn in (("Another array", block((2, 2, 2), (0, 0, 0), (1, 1, 1), 1.0, "Other"), True),
                          ("A surface", sphere.GetOutput(), True), ("An image without cells", vtkImageData(), False),
                          ("Nothing", empty, False)):
    source, shown = shown_as_smoke(data, name, view)
    shown.DiffuseColor = [0, 0, 1]
    simple.Render(view)
    view.CameraParallelProjection = 0
    view.ViewSize = [100, 100]
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [3, 4, 5], [0.25, 0.25, 0.25], [0, 0, 1]
    simple.Render(view)
    red = vtk_to_numpy(view.CaptureWindow(1).GetPointData().GetScalars())[:, 0]
    assert (red.min() < 128) == drawn, (name, red.min())
    simple.Hide(source, view)
print("smoke_volume: passed")
