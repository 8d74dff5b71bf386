"""Thick smoke is solved and looked at in finer cells; the output keeps the cells of the input."""
import os
import tempfile

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkRectilinearGrid

import scenes
from scenes import cell_array, fetch, field, image, producer, work_done

simple = scenes.load_plugin()
# So many metres that nodes are the same numbers whoever cuts the grid.
SIZE = (4.0, 1.0, 1.0)
COARSE = (8, 2, 2)
# White smoke of 1.5 and 2.5 mean free paths a cell.
EXTINCTIONS = (3.0, 5.0)
REFINED = "thick smoke cells refined"
ALBEDO = 0.96
# Half a mean free path of scattered light a cell: ceil(0.96 * 2.5 / 0.5), and of the first half of
# the tunnel as much along it as its own smoke asks for.
PARTS = (5, 3)


def smoke(cells_along, cells_across):
    """The tunnel's smoke; its far half is thicker."""
    data = image((2 * cells_along, cells_across, cells_across), SIZE)
    values = numpy.empty((cells_across, cells_across, 2 * cells_along))
    values[:, :, :cells_along] = EXTINCTIONS[0]
    values[:, :, cells_along:] = EXTINCTIONS[1]
    scenes.add_cells(data, "Extinction", values.ravel())
    return data


def grid_of(nodes, values):
    """A rectilinear grid; of the extinction coefficients, x varies fastest."""
    grid = vtkRectilinearGrid()
    grid.SetDimensions([len(axis) for axis in nodes])
    for axis, setter in zip(nodes, (grid.SetXCoordinates, grid.SetYCoordinates, grid.SetZCoordinates)):
        setter(numpy_to_vtk(numpy.array(axis, dtype=float), deep=True))
    scenes.add_cells(grid, "Extinction", values.ravel())
    return grid


def fine_smoke():
    """As it is to be refined: the near half has longer cells than the far one."""
    along, across = PARTS[1], PARTS[0]
    near = [i * 0.5 + j * 0.5 / along for i in range(4) for j in range(along)]
    far = [2.0 + i * 0.5 + j * 0.5 / across for i in range(4) for j in range(across)]
    nodes = [near + far + [4.0]]
    nodes += 2 * [[i * 0.5 + j * 0.5 / across for i in range(2) for j in range(across)] + [1.0]]
    values = numpy.empty([len(axis) - 1 for axis in reversed(nodes)])
    values[:, :, :len(near)] = EXTINCTIONS[0]
    values[:, :, len(near):] = EXTINCTIONS[1]
    return grid_of(nodes, values)


def light_field(data, **properties):
    settings = dict(Albedo=ALBEDO, Tolerance=0.1)
    settings.update(properties)
    walls = [producer(scenes.box(SIZE, 0.2), "Walls")]
    # A ramp that cuts cells askew.
    walls.append(simple.Plane(Origin=[0, 0, 0.1], Point1=[3, 0, 0.3], Point2=[0, 1, 0.1]))
    return simple.SmokeLightField(Smoke=producer(data, "Smoke"), Surfaces=walls,
                                  Emitters=[scenes.tunnel_sign(Color=[0.2, 1, 0.5])], **settings)


def look(source):
    view = fetch(simple.VisibilityImage(LightField=source, CameraPosition=[2.4, 0.5, 0.5], TargetSign=0,
                                        Margin=0.2, ImageSize=[32, 32]))
    return {name: field(view, name) for name in
            ("Contrast", "ContrastError", "UnlitLuminance", "MeanLuminance", "OpticalDepthToSign")}


def block_of(data):
    return data.GetPartition(0, 0)


def parents(grid):
    """The coarse cell that each cell of the fine smoke lies in."""
    bounds = numpy.array([grid.GetCell(i).GetBounds() for i in range(grid.GetNumberOfCells())])
    middles = 0.5 * (bounds[:, 0::2] + bounds[:, 1::2])
    places = numpy.floor(middles / 0.5).astype(int)
    return places[:, 0] + COARSE[0] * (places[:, 1] + COARSE[1] * places[:, 2]), \
        numpy.prod(bounds[:, 1::2] - bounds[:, 0::2], axis=1)


for bands in ("Luminance", "RGB"):
    # Extinction that does not depend on the wavelength is refined alike with three bands.
    settings = dict(Bands=bands, AngstromExponent=0.0)
    refined = light_field(smoke(COARSE[0] // 2, COARSE[1]), **settings)
    by_hand = light_field(fine_smoke(), **settings)
    data, expected = fetch(refined), fetch(by_hand)
    block, fine = block_of(data), block_of(expected)
    count, why = work_done(data, REFINED)
    assert count == 32 and f"in {fine.GetNumberOfCells()} cells" in why, (count, why)
    assert work_done(expected, REFINED) == (0, "no more than a hundredth of a grid's smoke is so thick")
    # The grid that came is the grid that goes out, with means over its cells.
    assert block.GetNumberOfCells() == 32 and block.GetClassName() == "vtkImageData"
    assert cell_array(block, "Extinction")[0] == EXTINCTIONS[0]
    whole, volumes = parents(fine)
    across = cell_array(fine, "Fluence").reshape(len(whole), -1)
    means = numpy.array([numpy.bincount(whole, volumes * band) for band in across.T]).T
    means /= numpy.bincount(whole, volumes)[:, None]
    fluence = cell_array(block, "Fluence").reshape(32, -1)
    assert fluence.min() > 0.0
    assert numpy.allclose(fluence, means, rtol=0.1), (fluence, means)
    inner = numpy.arange(32)[numpy.arange(32) // 16 == 1]
    # Above the ramp no cell is cut.
    assert numpy.allclose(fluence[inner], means[inner], rtol=1e-5), (fluence[inner], means[inner])
    rest = cell_array(block, "DirectFluence") if bands == "Luminance" else None
    if rest is not None:
        rest = rest + cell_array(block, "MultipleFluence").mean(axis=1)
        assert numpy.allclose(rest, fluence[:, 0], rtol=1e-5)
    # Views see the fine cells, to the last bit.
    seen = look(refined)
    assert seen["UnlitLuminance"] > 0.0
    assert seen == look(by_hand), (seen, look(by_hand))
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "field.vtpc")
        simple.SaveData(path, proxy=refined, DataMode="Binary")
        copy = simple.XMLPartitionedDatasetCollectionReader(FileName=[path])
        assert look(copy) == seen
    # Smoke that an earlier light field gave is refined anew.
    again = simple.SmokeLightField(
        Smoke=producer(block, "Again"), Emitters=[scenes.tunnel_sign(Luminance=2.0)], Albedo=0.1,
        AngstromExponent=0.0, Tolerance=0.1)
    assert work_done(fetch(again), REFINED)[0] == 32
    parts = block_of(fetch(again)).GetFieldData().GetArray("Refinement")
    assert [parts.GetValue(i) for i in range(parts.GetNumberOfValues())] == 4 * [3] + 8 * [4]

# Off, white smoke comes out much too dark or too bright in such cells.
whole = light_field(smoke(COARSE[0] // 2, COARSE[1]), MaximumRefinedCells=0)
data = fetch(whole)
count, why = work_done(data, REFINED)
assert count == 0 and why.startswith("32 thick cells would take ") and why.endswith("more than MaximumRefinedCells"), why
assert not block_of(data).GetFieldData().HasArray("Refinement")
assert abs(look(whole)["UnlitLuminance"] / seen["UnlitLuminance"] - 1.0) > 0.1

# A cube of thicker smoke: its 12 edges and 8 corners jut out, which counts at small tolerances alone.
JUTTING = "cells that jut out of clouds refined"
values = numpy.full((5, 5, 20), 0.1)
values[1:4, 1:4, 8:11] = 2.5
cloud = image((20, 5, 5), SIZE)
scenes.add_cells(cloud, "Extinction", values.ravel())
data = fetch(light_field(cloud, Tolerance=0.02))
assert work_done(data, JUTTING)[0] == 20, work_done(data, JUTTING)
assert work_done(data, REFINED) == (0, "no more than a hundredth of a grid's smoke is so thick")
parts = block_of(data).GetFieldData().GetArray("Refinement")
assert [parts.GetValue(i) for i in range(20)] == 8 * [1] + 3 * [2] + 9 * [1]
data = fetch(light_field(cloud, Tolerance=0.02, MaximumRefinedCells=1000))
count, why = work_done(data, JUTTING)
assert count == 0 and why.endswith("more than an eighth of MaximumRefinedCells"), why
data = fetch(light_field(cloud, Tolerance=0.03))
assert not block_of(data).GetFieldData().HasArray("Refinement")

# Where a finer mesh lies over a part of a cell, its mean is that of the rest.
over = image((5, 10, 10), (0.5, 1.0, 1.0), EXTINCTIONS[1], (2.2, 0.0, 0.0))
pair = []
for coarse in (smoke(COARSE[0] // 2, COARSE[1]), fine_smoke()):
    both = simple.GroupDatasets(Input=[producer(coarse, "Coarse"), producer(over, "Over")])
    pair.append(fetch(simple.SmokeLightField(Smoke=both, Emitters=[scenes.tunnel_sign()], Albedo=ALBEDO,
                                             Tolerance=0.1)))
block, fine = (block_of(data) for data in pair)
assert block.GetNumberOfCells() == 32 and fine.GetNumberOfCells() > 32
whole, volumes = parents(fine)
middles = numpy.array([0.5 * sum(fine.GetCell(i).GetBounds()[:2]) for i in range(len(whole))])
volumes[(middles > 2.2) & (middles < 2.7)] = 0.0
means = numpy.bincount(whole, volumes * cell_array(fine, "Fluence")) / numpy.bincount(whole, volumes)
assert numpy.allclose(cell_array(block, "Fluence"), means, rtol=1e-4), (cell_array(block, "Fluence"), means)

# Another grid that is refined to the same cells is not the one before.
across = [0.0, 0.5, 1.0]
grids = [grid_of([nodes, across, across], numpy.full((2, 2, 5), 1.8))
         for nodes in ([0, 1, 2, 3, 3.5, 4.5], [0, 1, 2, 3, 4, 4.5])]
changing = producer(grids[0], "Changing")
kept, fresh = (simple.SmokeLightField(Smoke=source, Emitters=[scenes.tunnel_sign()], Albedo=ALBEDO, Tolerance=0.1)
               for source in (changing, producer(grids[1], "Fresh")))
look(kept)
changing.GetClientSideObject().SetOutput(grids[1])
changing.MarkModified(None)
assert look(kept) == look(fresh)
first, second = (cell_array(block_of(fetch(source)), "Fluence") for source in (kept, fresh))
assert numpy.array_equal(first, second), (first, second)

# A light field whose refinement does not fit its grid is refused.
broken = fetch(refined).NewInstance()
broken.DeepCopy(fetch(refined))
block_of(broken).GetFieldData().GetArray("Refinement").SetValue(0, 0)
with scenes.Messages() as messages:
    simple.VisibilityImage(LightField=producer(broken, "Broken"), TargetSign=0).UpdatePipeline()
assert messages.count("ERROR", "vtkVisibilityImage") == 1, messages.text
assert "Refinement" in messages.text and "value 0 is 0" in messages.text, messages.text
block_of(broken).GetFieldData().RemoveArray("Refinement")
with scenes.Messages() as messages:
    simple.VisibilityImage(LightField=producer(broken, "Bereft"), TargetSign=0).UpdatePipeline()
assert "it is missing beside the light of finer cells" in messages.text, messages.text
print("refined smoke: passed")
