"""Parallel reading: mpiexec -np N pvbatch --symmetric reader_pieces.py PLUGIN DATA_FOLDER OUTPUT_FILE

Each process reads its share of the hall's and the room's meshes; who asks for the whole gets the same bits as one
process does. Writes checksums of all arrays to the output file, which the test compares over N.
"""

import hashlib
import os
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import numpy as np
from reader_common import Messages, equal, link, load_plugin, reader, true, write_nan_in_room
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkParallelCore import vtkMultiProcessController

load_plugin(sys.argv[1])
controller = vtkMultiProcessController.GetGlobalController()
rank, ranks = controller.GetLocalProcessId(), controller.GetNumberOfProcesses()


def digest(data):
    """A line a block: its name and a checksum of its numbers."""
    lines = []
    for block in range(data.GetNumberOfPartitionedDataSets()):
        grid = data.GetPartition(block, 0)
        name = data.GetMetaData(block).Get(data.NAME())
        if grid is None:
            lines.append("%s: not here" % name)
            continue
        sums = hashlib.sha256()
        for arrays in (grid.GetCellData(), grid.GetPointData()):
            for i in range(arrays.GetNumberOfArrays()):
                sums.update(arrays.GetArrayName(i).encode())
                sums.update(np.ascontiguousarray(vtk_to_numpy(arrays.GetArray(i))).tobytes())
        places = [grid.GetPoints().GetData()] if grid.IsA("vtkPolyData") else [
            grid.GetXCoordinates(), grid.GetYCoordinates(), grid.GetZCoordinates()]
        for array in places:
            sums.update(vtk_to_numpy(array).tobytes())
        fields = grid.GetFieldData()
        for i in range(fields.GetNumberOfArrays()):
            array = fields.GetAbstractArray(i)
            sums.update(("%s=%s" % (array.GetName(), array.GetValue(0))).encode())
        lines.append("%s: %s" % (name, sums.hexdigest()))
    return lines


def report(data, pieces, what):
    """The bytes that each process read, from the work report, which also has their time."""
    fields = data.GetFieldData()
    told = fields.GetAbstractArray("WorkReportWhat")
    count = vtk_to_numpy(fields.GetArray("WorkReportCount"))
    rows = {told.GetValue(i): count[i] for i in range(told.GetNumberOfValues())}
    names = ["%s of process %d" % (unit, r) for unit in ("seconds", "bytes") for r in range(pieces)]
    equal(sorted(rows), sorted(names), what + ": rows of the report")
    equal(fields.GetAbstractArray("WorkReportWhy").GetNumberOfValues(), len(names), what + ": reasons")
    seconds, read = np.array([rows[name] for name in names]).reshape(2, pieces)
    true(((seconds > 0.0) & (seconds < 60.0)).all(), "%s: seconds %s" % (what, seconds))
    return read


def stored_bytes(data, pieces):
    """What a frame of a cell-centred slice takes of the meshes of each process: its layers of cells have ghosts."""
    grids = [data.GetPartition(i, 0) for i in range(data.GetNumberOfPartitionedDataSets())]
    cells = np.array([grid.GetNumberOfCells() for grid in grids], float)
    layers = [4 * x * y * (z - 1) for x, y, z in (grid.GetDimensions() for grid in grids)]
    # A mesh is read where its middle lies.
    owners = np.ceil((np.cumsum(cells) - 0.5 * cells) / cells.sum() * pieces).astype(int) - 1
    return np.bincount(owners, layers, pieces)


lines = []
for case, time in (("Room/fds/room.smv", 20.0), ("Hall/fds/hall.smv", 600.0)):
    path = os.path.join(sys.argv[2], case)
    # The whole, as filters ask for it.
    whole = reader(path).GetClientSideObject()
    whole.UpdateInformation()
    for port in (0, 3, 4):
        whole.UpdateTimeStep(time, 0, 1, 0) if port == 0 else whole.Update(port)
        lines += digest(whole.GetOutputDataObject(port))
        read = report(whole.GetOutputDataObject(port), ranks, "%s, output %d" % (case, port))
        # All processes together read what one does, whoever reads it; slices' headers are read once a mesh.
        lines.append("bytes of output %d: %d" % (port, read.sum()))
        if port == 0:
            # The extinction, and the heat release rate that the flames come from, packed or as a slice.
            frame = stored_bytes(whole.GetOutputDataObject(port), ranks)
            true((read >= frame).all() and (read <= 2.01 * frame + 100).all(), "bytes %s of %s" % (read, frame))
    # A piece, as a view asks for it: no mesh is read twice.
    part = reader(path).GetClientSideObject()
    part.UpdateTimeStep(time, rank, ranks, 0)
    mine = [line for line in digest(part.GetOutputDataObject(0)) if not line.endswith("not here")]
    if ranks <= 2:
        equal(len(mine), 2 // ranks, "meshes of rank %d" % rank)
    fields = part.GetOutputDataObject(0).GetFieldData()
    lines.append("lumens %r" % fields.GetArray("FlameLumens").GetValue(0))

# What one process cannot read is an error for all, and nobody waits for it: a NaN in the second mesh.
folder = os.path.join(sys.argv[2], "Room", "fds")
with tempfile.TemporaryDirectory() as temporary:
    names = ("room.smv", "room_1_2.sf", "room_1_2.s3d", "room_2_2.s3d", "room_devc.csv")
    link(folder, temporary, names)
    write_nan_in_room(folder, temporary)
    with Messages() as messages:
        bad = reader(os.path.join(temporary, "room.smv")).GetClientSideObject()
        bad.UpdateTimeStep(-2.0, 0, 1, 0)
    text = "room_2_2.sf" if rank == ranks - 1 else "Another process could not read its meshes"
    if ranks <= 2:
        true(text in messages.text, "the error on rank %d" % rank)
    equal(messages.count("ERROR"), 1, "errors on rank %d" % rank)
    equal(bad.GetOutputDataObject(0).GetNumberOfPartitionedDataSets(), 0, "meshes of a failed read")

if rank == 0:
    with open(sys.argv[3], "w") as file:
        file.write("\n".join(lines) + "\n")
true(not any("not here" in line for line in lines if line.startswith(("fine", "coarse", "west", "east"))),
     "all meshes of the whole")
print("rank %d of %d: as expected" % (rank, ranks), flush=True)
