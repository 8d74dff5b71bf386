"""FDSSmokeReader on the room: pvpython reader_room.py PLUGIN DATA_FOLDER

Two meshes of different resolution, one stretched; a clock that starts below zero; glass; a screen that is
removed; node-centred slices where there are no cell-centred ones.
"""

import os
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import numpy as np
from paraview import simple
from reader_common import (
    Devices, Messages, Smoke, Walls, close, equal, link, load_plugin, reader, true, write_nan_in_room)
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_UNSIGNED_CHAR
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter
from vtkmodules.vtkIOImage import vtkPNGWriter

load_plugin(sys.argv[1])
folder = os.path.join(sys.argv[2], "Room", "fds")
room = reader(os.path.join(folder, "room.smv"))

# --- meshes and times ---------------------------------------------------------------------------
smoke = Smoke(room, 30.0)
fine, coarse = smoke.meshes
equal((fine.name, fine.dimensions), ("fine", (32, 24, 24)), "fine mesh")
equal((coarse.name, coarse.dimensions), ("coarse", (16, 12, 12)), "coarse mesh")
# TRNX of the input: the first half of the cells is squeezed into 1.2 m, the second fills 2.0 m.
close(coarse.nodes[0][8], 4.4, 1e-5, "middle node of the stretched mesh")
close(np.abs(np.diff(coarse.nodes[0])[:8] - 0.15).max(), 0.0, 2e-5, "narrow cells")
close(np.abs(np.diff(coarse.nodes[0])[8:] - 0.25).max(), 0.0, 2e-5, "wide cells")
steps = list(room.TimestepValues)
close(steps[0], -2.0, 0.0, "the clock's begin")
equal(len(steps), 17, "number of time steps")

# --- cells against nodes ------------------------------------------------------------------------
# An index without the cell-centred slices makes the reader take the nodes. A node is the mean over its gas
# cells, a cell then the mean over its eight nodes: away from solids that is a fixed blur of the cells.
with tempfile.TemporaryDirectory() as temporary:
    with open(os.path.join(folder, "room.smv")) as file:
        lines = file.read().splitlines(keepends=True)
    kept = []
    skip = 0
    for line in lines:
        skip = 5 if line.startswith("SLCC") else max(skip - 1, 0)
        if skip == 0:
            kept.append(line)
    with open(os.path.join(temporary, "room.smv"), "w") as file:
        file.writelines(kept)
    link(folder, temporary, ("room_1_1.sf", "room_2_1.sf", "room_devc.csv"))
    nodes = Smoke(reader(os.path.join(temporary, "room.smv")), 30.0)
    true("node-centred" in nodes.field("ExtinctionSource"), "nodes are taken without cells")
    true("room_1_1.sf" in nodes.field("ExtinctionSource"), "the nodes' file is named")
    for exact, blurred in zip(smoke.meshes, nodes.meshes):
        equal(blurred.dimensions, exact.dimensions, "cells from nodes")
        value = np.where(exact.solid, 0.0, exact.extinction.astype(float))
        gas = (~exact.solid).astype(float)
        n = exact.extinction.shape
        eight = [(k, j, i) for k in (0, 1) for j in (0, 1) for i in (0, 1)]

        def pick(array, corner):
            return array[tuple(np.s_[c : c + m - 1] for c, m in zip(corner, array.shape))]

        weight = sum(pick(gas, c) for c in eight)
        atNodes = sum(pick(value, c) for c in eight) / np.maximum(weight, 1)
        back = sum(pick(atNodes, c) for c in eight) / 8
        # Cells whose nodes are all inside the mesh, and no plates near: leave out the window's.
        inner = tuple(np.s_[1 : m - 1] for m in n)
        use = ~exact.solid[inner]
        error = np.abs(back - blurred.extinction[inner]) / np.maximum(back, 1e-2)
        if exact.name == "coarse":
            use[:, :, 5:9] = False
        close(error[use].max(), 0.0, 2e-6, exact.name + ": cells from nodes")
        true((blurred.extinction[blurred.solid] == 0).all(), "solids hold no smoke")

# --- devices ------------------------------------------------------------------------------------
# Rows are means over the second before; neighbouring rows bound the swing.
devices = Devices(room)
equal(devices.names(), ["Time", "K1", "K2", "beam"], "columns")
for name in ("K1", "K2"):
    for time in (24.0, 26.0, 28.0, 30.0):
        now = Smoke(room, time)
        row = int(np.argmin(np.abs(devices.column("Time") - now.field("Time"))))
        near = devices.column(name)[row - 2 : row + 3]
        swing = near.max() - near.min()
        value = now.at(devices.position(name))
        true(near.min() - swing <= value <= near.max() + swing, "%s at %g s" % (name, time))

# --- walls --------------------------------------------------------------------------------------
walls = Walls(room, 0.0)
close(walls.total(walls.at("+x", 0.0)), 2.4 * 2.4, 1e-4, "west wall")
# Opening in the east wall: 1.6 x 2.0 m; doorway in the partition: 0.8 x 2.0 m.
close(walls.total(walls.at("-x", 6.4)), 2.4 * 2.4 - 1.6 * 2.0, 1e-4, "east wall")
close(walls.total(walls.at("-x", 3.0)), 2.4 * 2.4 - 0.8 * 2.0, 1e-4, "partition, fine side")
# The partition ends where the meshes meet: its other side is the coarse mesh's, once.
close(walls.total(walls.at("+x", 3.2)), 2.4 * 2.4 - 0.8 * 2.0, 1e-4, "partition, coarse side")
close(walls.total(walls.at("-x", 3.2)), 0.0, 0.0, "faces inside the partition")
close(walls.total(walls.at("-z", 2.4)), 6.4 * 2.4 - 0.2 * 2.4, 1e-4, "ceiling")
# FDS moves the screen (5.2 to 5.6 m) to the nearest planes of the stretched mesh, 5.15 and 5.65 m.
screen = np.abs(walls.reflectance - walls.reflectance[walls.at("-x", 5.15)][0]).max(axis=1) < 1e-6
close(walls.total(screen), 2 * 1.2 * 1.2 + 2 * 0.5 * 1.2, 1e-4, "screen: two sides, front and top")
linear = ((60 / 255 + 0.055) / 1.055) ** 2.4, ((180 / 255 + 0.055) / 1.055) ** 2.4
for part, expected in zip(walls.reflectance[screen][0], (linear[0], linear[0], linear[1])):
    close(part, expected, 2e-5, "the screen's own colour")
floor = 6.4 * 2.4 - 2 * 0.2 * 0.8 - 0.4 * 0.4
close(walls.total(walls.at("+z", 0.0)), floor - 0.5 * 1.2, 1e-4, "floor with the screen")

# The screen is removed at 15.03 s: the frame at 14.0 s has it, that at 16.0 s does not.
close(walls.total(screen), Walls(room, 14.0).total(screen), 1e-9, "screen at 14 s")
later = Walls(room, 16.0)
close(later.total(later.at("+z", 0.0)), floor, 1e-4, "floor without the screen")
close(later.total(later.at("-x", 5.15)), 0.0, 0.0, "no screen at 16 s")
solid = [Smoke(room, time).meshes[1].solid.sum() for time in (14.0, 16.0)]
equal(solid, [2 * 6 * 6, 0], "solid cells of the coarse mesh")

# The window (alpha 0.4, no thickness) lets light through unless all is to be opaque.
close(walls.total(walls.surface == "GLASS"), 0.0, 0.0, "glass at the default threshold")
room.TransparencyThreshold = 0.3
opaque = Walls(room, 0.0)
# 1.6 x 0.9 m in the input; on planes of the mesh 0.4 to 2.0 and 1.0 to 1.8 m.
close(opaque.total(opaque.surface == "GLASS"), 1.6 * 0.8, 1e-4, "glass as one quad")

# --- complex geometry and textures ---------------------------------------------------------------
# FDS writes GEOM only where it was built with a solver library that this run's lacked, so the file is
# built here from the format: a tetrahedron of 0.5 m legs, its faces outwards, of surface 3 (BURNER).
def record(values):
    raw = values.tobytes()
    size = np.int32(len(raw)).tobytes()
    return size + raw + size


with tempfile.TemporaryDirectory() as temporary:
    with open(os.path.join(folder, "room.smv")) as file:
        text = file.read()
    # FDS gives the burner a picture: half of it black, half white.
    burner = " BURNER\n 5000.00    1.00\n 0      1.00000      1.00000      0.52941      0.14902      0.34118      1.00000\n null"
    true(burner in text, "the burner's surface")
    text = text.replace(burner, burner[:-4] + "half white.png")
    with open(os.path.join(temporary, "room.smv"), "w") as file:
        file.write(text + "GEOM     1\n room.ge\n box\n")
    picture = vtkImageData()
    picture.SetDimensions(4, 2, 1)
    picture.AllocateScalars(VTK_UNSIGNED_CHAR, 3)
    vtk_to_numpy(picture.GetPointData().GetScalars())[:] = np.repeat([0, 255], 4)[:, None]
    writer = vtkPNGWriter()
    writer.SetFileName(os.path.join(temporary, "half white.png"))
    writer.SetInputData(picture)
    writer.Write()
    ints, floats = (lambda *v: np.array(v, np.int32)), (lambda *v: np.array(v, np.float32))
    body = record(ints(1)) + record(ints(2)) + record(ints(0, 0, 1)) + record(floats(0.0))
    body += record(ints(4, 4, 0)) + record(0.5 * np.eye(4, 3, -1, np.float32) + floats(2.0, 1.0, 1.0))
    body += record(ints(1, 3, 2, 1, 2, 4, 1, 4, 3, 2, 3, 4)) + record(ints(3, 3, 3, 3))
    body += record(np.zeros(24, np.float32))
    with open(os.path.join(temporary, "room.ge"), "wb") as file:
        file.write(body)
    link(folder, temporary, ("room_1_2.sf", "room_2_2.sf", "room_1_2.s3d", "room_2_2.s3d", "room_devc.csv"))
    solid = reader(os.path.join(temporary, "room.smv"))
    simple.OutputPort(solid, 1).UpdatePipeline(0.0)
    data = solid.GetClientSideObject().GetOutputDataObject(1)
    sizes = vtkCellSizeFilter()
    sizes.SetInputData(data)
    sizes.Update()
    area = vtk_to_numpy(sizes.GetOutput().GetCellData().GetArray("Area"))
    names = data.GetCellData().GetAbstractArray("SurfaceName")
    triangles = [i for i in range(data.GetNumberOfCells()) if data.GetCell(i).GetNumberOfPoints() == 3]
    equal([names.GetValue(i) for i in triangles], 4 * ["BURNER"], "triangles of the geometry")
    close(area[triangles].sum(), 3 * 0.125 + np.sqrt(3) / 4 * 0.5, 1e-6, "area of the tetrahedron")
    close(data.GetBounds()[1], 6.4, 1e-5, "walls are still there")
    # The mean of black and white in linear light, on the triangles and on the burner itself.
    mean = vtk_to_numpy(data.GetCellData().GetArray("Reflectance"))[
        [names.GetValue(i) == "BURNER" for i in range(data.GetNumberOfCells())]
    ]
    true(len(mean) > 4, "the burner's own top has the texture, too")
    close(np.abs(mean - 0.5).max(), 0.0, 1e-6, "reflectance of the texture")
    # Corners in the other order than the normal of the outside would give a negative volume.
    volume = 0.0
    for i in triangles:
        a, b, c = (np.array(data.GetCell(i).GetPoints().GetPoint(k)) - (2, 1, 1) for k in range(3))
        volume += np.dot(np.cross(a, b), c) / 6
    close(volume, 0.5**3 / 6, 1e-7, "volume of the tetrahedron")
    os.truncate(os.path.join(temporary, "room.ge"), len(body) - 1)
    solid.Refresh()
    with Messages() as messages:
        simple.OutputPort(solid, 1).UpdatePipeline(0.0)
    true("room.ge: the geometry file holds no whole frame" in messages.text, "a cut geometry is named")

# --- a NaN in the gas ---------------------------------------------------------------------------
with tempfile.TemporaryDirectory() as temporary:
    link(folder, temporary, ("room.smv", "room_1_2.sf", "room_1_2.s3d", "room_2_2.s3d", "room_devc.csv"))
    write_nan_in_room(folder, temporary)
    bad = reader(os.path.join(temporary, "room.smv"))
    with Messages() as messages:
        bad.UpdatePipeline(-2.0)
    true("room_2_2.sf" in messages.text, "the file with the NaN is named")
    true("cell (3, 4, 5) of mesh 'coarse' at -2 s" in messages.text, "the cell with the NaN is named")
    equal((messages.count("ERROR"), messages.count("Warning")), (1, 0), "messages of a NaN")
    data = bad.GetClientSideObject().GetOutputDataObject(0)
    equal(data.GetNumberOfPartitionedDataSets(), 0, "meshes of a failed read")
    close(Smoke(bad, 30.0).field("Time"), 30.0, 0.0, "another frame still reads")

print("reader_room: all as expected")
