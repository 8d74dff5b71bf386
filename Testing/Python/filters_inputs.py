"""What the light field takes: grids and surfaces of all kinds, values on points, defaults, aborts."""
import time

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import (VTK_QUAD, VTK_TRIANGLE, vtkCellArray,
                                           vtkMultiBlockDataSet, vtkPartitionedDataSet,
                                           vtkPartitionedDataSetCollection, vtkPolyData,
                                           vtkRectilinearGrid, vtkUnstructuredGrid)

import scenes
from scenes import add_cells, cell_array, check_close, fetch, field, image, point_array, producer

simple = scenes.load_plugin()
SIZE = (2.0, 1.0, 1.0)
CELLS = (8, 4, 4)


def lamp():
    return simple.Luminaire(Center=[1, 0.5, 0.999], Width=0.3, Height=0.3, Luminance=100)


def solve(smoke, surfaces=(), **properties):
    settings = dict(Albedo=0.5, Tolerance=0.1)
    settings.update(properties)
    return fetch(simple.SmokeLightField(
        Smoke=producer(smoke, "Smoke"), Emitters=[lamp()],
        Surfaces=[producer(data, "Surface") for data in surfaces], **settings))


def fluence(data):
    return cell_array(data.GetPartition(0, 0), "Fluence")


def rectilinear(data):
    """The same grid as a rectilinear one, with single-precision coordinates."""
    grid = vtkRectilinearGrid()
    grid.SetDimensions(data.GetDimensions())
    for axis, setter in enumerate((grid.SetXCoordinates, grid.SetYCoordinates,
                                   grid.SetZCoordinates)):
        nodes = data.GetOrigin()[axis] + data.GetSpacing()[axis] * numpy.arange(
            data.GetDimensions()[axis])
        setter(numpy_to_vtk(nodes.astype(numpy.float32), deep=True))
    grid.GetCellData().ShallowCopy(data.GetCellData())
    return grid


def check_grids():
    smoke = image(CELLS, SIZE)
    expected = fluence(solve(smoke))
    assert expected.min() > 0
    collection = vtkPartitionedDataSetCollection()
    partitions = vtkPartitionedDataSet()
    partitions.SetPartition(0, smoke)
    collection.SetPartitionedDataSet(0, partitions)
    blocks = vtkMultiBlockDataSet()
    blocks.SetBlock(0, None)
    blocks.SetBlock(1, smoke)
    shifted = image(CELLS, SIZE)
    shifted.SetExtent(4, 12, -2, 2, 0, 4)
    shifted.SetOrigin(-1.0, 0.5, 0.0)
    for same in (rectilinear(smoke), collection, partitions, blocks, shifted):
        assert numpy.array_equal(fluence(solve(same)), expected), same.GetClassName()

    for kind in (numpy.int8, numpy.uint16, numpy.int64, numpy.float32):
        typed = image(CELLS, SIZE)
        add_cells(typed, "Extinction", numpy.ones(128, dtype=kind))
        assert numpy.array_equal(fluence(solve(typed)), expected), kind

    # Point values are averaged to cells: x at the nodes is x at the cells' centres.
    points = image(CELLS, SIZE)
    points.GetCellData().RemoveArray("Extinction")
    x = numpy.array([points.GetPoint(i)[0] for i in range(points.GetNumberOfPoints())])
    array = numpy_to_vtk(x, deep=True)
    array.SetName("Extinction")
    points.GetPointData().AddArray(array)
    extinction = cell_array(solve(points).GetPartition(0, 0), "Extinction")
    assert numpy.allclose(extinction.reshape(4, 4, 8), 0.125 + 0.25 * numpy.arange(8))

    # Values of hidden cells do not count, not even impossible ones.
    hidden = image(CELLS, SIZE)
    hidden.GetCellData().GetArray("Extinction").SetComponent(0, 0, numpy.nan)
    ghosts = numpy.zeros(128, dtype=numpy.uint8)
    ghosts[0] = 32
    add_cells(hidden, "vtkGhostType", ghosts)
    assert numpy.isfinite(fluence(solve(hidden))).all()


def check_flames():
    """Smoke that glows is light enough without any emitter."""
    smoke = image(CELLS, SIZE)
    add_cells(smoke, "EmittedLuminance", numpy.full(128, 50.0))
    light = simple.SmokeLightField(Smoke=producer(smoke, "Flames"), Albedo=0.5,
                                   Surfaces=[producer(scenes.box(SIZE, 1.0), "Mirror")])
    # In a closed white room the light is that of a black body everywhere: phi = 4 pi L.
    check_close("fluence", fluence(fetch(light)).mean(), 4 * numpy.pi * 50, 0.01)
    image_ = fetch(simple.VisibilityImage(
        LightField=light, CameraPosition=[0.3, 0.4, 0.5], CameraFocalPoint=[2, 0.6, 0.4],
        ImageSize=[8, 8]))
    assert numpy.allclose(point_array(image_, "Luminance"), 50, rtol=0.02)


def polydata(points, polys=(), strips=(), lines=()):
    data = vtkPolyData()
    coordinates = vtkPoints()
    for point in points:
        coordinates.InsertNextPoint(point)
    data.SetPoints(coordinates)
    for cells, setter in ((polys, data.SetPolys), (strips, data.SetStrips), (lines, data.SetLines)):
        array = vtkCellArray()
        for cell in cells:
            array.InsertNextCell(len(cell), cell)
        if cells:
            setter(array)
    return data


def areas(data):
    total = numpy.zeros(data.GetNumberOfCells())
    for i in range(data.GetNumberOfCells()):
        points = data.GetCell(i).GetPoints()
        corners = numpy.array([points.GetPoint(j) for j in range(points.GetNumberOfPoints())])
        vector = sum(numpy.cross(corners[j] - corners[0], corners[j + 1] - corners[0])
                     for j in range(1, len(corners) - 1))
        total[i] = 0.5 * numpy.linalg.norm(vector)
    return total


def longest_edge(data):
    longest = 0
    for i in range(data.GetNumberOfCells()):
        points = data.GetCell(i).GetPoints()
        corners = numpy.array([points.GetPoint(j) for j in range(points.GetNumberOfPoints())])
        longest = max(longest, numpy.linalg.norm(corners - numpy.roll(corners, 1, 0), axis=1).max())
    return longest


def check_surfaces():
    # An L that is not convex, a triangle, a sliver, a point twice, and a line that is no surface.
    letter = polydata([(0, 0, 0), (2, 0, 0), (2, 0.5, 0), (0.5, 0.5, 0), (0.5, 1, 0), (0, 1, 0),
                       (0, 0, 0.2), (2, 0, 0.2), (1, 1, 0.2), (1, 1e-9, 0.3)],
                      polys=[(0, 1, 2, 3, 4, 5), (6, 7, 8), (6, 7, 9), (6, 6, 7)], lines=[(0, 1)])
    add_cells(letter, "Reflectance", numpy.array([0.9, 0.1, 0.2, 0.3, 0.4]))
    add_cells(letter, "Material", numpy.arange(5))
    data = solve(image(CELLS, SIZE), [letter], PatchSize=0.15).GetPartition(1, 0)
    assert longest_edge(data) <= 0.15 + 1e-12
    parents = cell_array(data, "ParentCell")
    assert set(parents) == {1, 2, 3}
    check_close("L", areas(data)[parents == 1].sum(), 1.25, 1e-9)
    check_close("triangle", areas(data)[parents == 2].sum(), 1.0, 1e-9)
    assert numpy.array_equal(cell_array(data, "Material"), parents)
    assert numpy.allclose(cell_array(data, "Reflectance"),
                          numpy.choose(parents, [0.9, 0.1, 0.2, 0.3]))

    strip = polydata([(0, 0, 0), (2, 0, 0), (0, 1, 0), (2, 1, 0)], strips=[(0, 1, 2, 3)])
    data = solve(image(CELLS, SIZE), [strip], DefaultReflectance=0.7).GetPartition(1, 0)
    check_close("strip", areas(data).sum(), 2.0, 1e-9)
    assert numpy.all(cell_array(data, "Reflectance") == 0.7)

    shell = vtkUnstructuredGrid()
    shell.SetPoints(letter.GetPoints())
    shell.InsertNextCell(VTK_QUAD, 4, (0, 1, 7, 6))
    shell.InsertNextCell(VTK_TRIANGLE, 3, (6, 7, 8))
    add_cells(shell, "Reflectance", numpy.array([[0.1, 0.2, 0.3], [0.4, 0.5, 0.6]]))
    data = solve(image(CELLS, SIZE), [shell, strip])
    first, second = data.GetPartition(1, 0), data.GetPartition(1, 1)
    check_close("shell", areas(first).sum(), 2 * 0.2 + 1.0, 1e-6)
    # All blocks have as many components as one of them needs.
    assert cell_array(second, "Reflectance").shape[1] == 3

    names = simple.GroupDatasets(Input=[producer(strip, "a"), producer(scenes.box(SIZE, 0.2), "b")],
                                 BlockNames=["floor", "box"])
    data = fetch(simple.SmokeLightField(Smoke=producer(image(CELLS, SIZE), "Smoke"),
                                        Surfaces=[names], Emitters=[lamp()], Tolerance=0.1))
    walls = data.GetPartitionedDataSet(1)
    assert [walls.GetMetaData(i).Get(walls.NAME()) for i in range(2)] == ["floor", "box"]


def check_albedo():
    smoke = image(CELLS, SIZE)
    data = solve(smoke, Albedo=-1)
    assert field(data, "Albedo") == 0.3
    albedo = numpy_to_vtk(numpy.array([0.6]), deep=True)
    albedo.SetName("Albedo")
    smoke.GetFieldData().AddArray(albedo)
    assert field(solve(smoke, Albedo=-1), "Albedo") == 0.6
    assert field(solve(smoke, Albedo=0.2), "Albedo") == 0.2


def check_threads_and_seed():
    smoke = image(CELLS, SIZE)
    walls = scenes.box(SIZE, 0.5)
    first, second, other = [fluence(solve(smoke, [walls], **properties))
                            for properties in (dict(Threads=1), dict(Threads=3), dict(Seed=2))]
    assert numpy.array_equal(first, second)
    assert not numpy.array_equal(first, other)


def check_abort():
    """Stopped work leaves nothing behind, raises no error, and is done when asked for again."""
    light = simple.SmokeLightField(
        Smoke=producer(image((60, 30, 30), SIZE), "Smoke"), Emitters=[lamp()],
        Surfaces=[producer(scenes.box(SIZE, 0.8), "Walls")], Albedo=0.9, Tolerance=0.001)
    filter_ = light.GetClientSideObject()
    times = []

    def stop(caller, _):
        if caller.GetProgress() > 0.02 and not times:
            caller.SetAbortExecuteAndUpdateTime()
            times.append(time.perf_counter())

    observer = filter_.AddObserver("ProgressEvent", stop)
    with scenes.Messages() as messages:
        data = fetch(light)
    assert times, "no progress was reported"
    taken = time.perf_counter() - times[0]
    assert taken < 1.0, taken
    assert data.GetNumberOfPartitionedDataSets() == 0
    assert "ERROR" not in messages.text, messages.text
    filter_.RemoveObserver(observer)
    filter_.SetAbortExecute(0)
    light.Tolerance = 0.5
    assert fetch(light).GetNumberOfPartitionedDataSets() == 3


check_grids()
check_flames()
check_surfaces()
check_albedo()
check_threads_and_seed()
check_abort()
print("inputs: passed")
