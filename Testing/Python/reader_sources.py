"""All sources of smoke that the room's run wrote, against each other: pvpython reader_sources.py PLUGIN DATA_FOLDER

FDS computed every one of them from the same soot, so that each must give the cell-centred extinction within
what its format rounds away. Then the flames, the 2-D slices' places, times between frames, and pieces.
"""

import csv
import os
import shutil
import struct
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import numpy as np
from paraview import servermanager, simple
from reader_common import Messages, Smoke, close, equal, load_plugin, reader, true
from vtkmodules.util.numpy_support import vtk_to_numpy

load_plugin(sys.argv[1])
folder = os.path.join(sys.argv[2], "Room", "fds")
index = os.path.join(folder, "room.smv")


def smoke(source, time, **properties):
    return Smoke(reader(index, ExtinctionSource=source, **properties), time)


def corners(array):
    """The eight shifted views of a node array that meet in each cell, or of a cell array in each inner node."""
    return [
        array[tuple(np.s_[c : c + m - 1] for c, m in zip(corner, array.shape))]
        for corner in np.ndindex(2, 2, 2)
    ]


def away_from_solids(mesh):
    """Cells whose nodes are all inside the mesh and touch gas only, and no plate (the window at x = 4.4 m)."""
    near = np.pad(mesh.solid, 1, constant_values=True)
    touched = np.zeros(mesh.solid.shape, bool)
    for shift in np.ndindex(3, 3, 3):
        touched |= near[tuple(np.s_[s : s + m] for s, m in zip(shift, mesh.solid.shape))]
    if mesh.name == "coarse":
        touched[:, :, 6:10] = True
    return ~touched


# --- cell-centred slices: the same numbers but for rounding to 4 bytes ----------------------------
for time in (10.0, 20.0, 30.0):
    exact = smoke("Extinction Slices", time)
    for source in ("Density Slices", "Optical Density Slices", "Visibility Slices"):
        other = smoke(source, time)
        close(other.field("Time"), exact.field("Time"), 0.0, source + ": time")
        for a, b in zip(exact.meshes, other.meshes):
            capped = ~a.solid & (a.extinction <= 0.1)
            use = ~a.solid if source != "Visibility Slices" else ~a.solid & ~capped
            true(use.any(), source + ": cells to compare")
            error = np.abs(b.extinction - a.extinction)[use] / np.maximum(a.extinction[use], 1e-6)
            close(error.max(), 0.0, 2e-6, "%s, %s at %g s" % (source, a.name, time))
            if source == "Visibility Slices" and capped.any():
                # At the cap of 30 m only K <= 3/30 is known: the most that this allows.
                close(np.abs(b.extinction[capped] - 0.1).max(), 0.0, 1e-7, "capped visibility")

    # --- nodes: 8-bit smoke within half a byte of the nodes' means ---------------------------------
    nodes = smoke("Density Smoke3D", time)
    true("room_1_1.s3dd" in nodes.field("ExtinctionSource"), "the twin with densities is taken")
    for number, (a, b) in enumerate(zip(exact.meshes, nodes.meshes)):
        with open(os.path.join(folder, "room_%d_1.s3d.sz" % (number + 1))) as file:
            rows = [[float(word) for word in line.split()] for line in file.readlines()[1:]]
        greatest = min(rows, key=lambda row: abs(row[0] - time))[-1]
        atNodes = sum(corners(a.extinction.astype(float))) / 8
        back = np.full(a.extinction.shape, np.nan)
        back[1:-1, 1:-1, 1:-1] = sum(corners(atNodes)) / 8
        use = away_from_solids(a)
        step = 8700 * greatest / 254
        error = np.abs(b.extinction - back)[use]
        close(error.max(), 0.0, 0.5 * step * 1.001, "density bytes, %s at %g s" % (a.name, time))
        true(error.max() > 0.05 * step, "bytes do round")

# --- opacity: the same run without its density twin ------------------------------------------------
with tempfile.TemporaryDirectory() as temporary:
    for name in os.listdir(folder):
        if not name.endswith(".s3dd"):
            os.symlink(os.path.abspath(os.path.join(folder, name)), os.path.join(temporary, name))
    opacity = Smoke(
        reader(os.path.join(temporary, "room.smv"), ExtinctionSource="Opacity Smoke3D"), 30.0
    )
    for number, (a, b) in enumerate(zip(exact.meshes, opacity.meshes)):
        width = a.nodes[0][1] - a.nodes[0][0]
        atNodes = sum(corners(a.extinction.astype(float))) / 8
        # Half a byte of opacity 1 - exp(-K width), as extinction, is more where the smoke is denser.
        half = 0.5 / 254 * np.exp(atNodes * width) / width * 1.01
        back, bound = np.full((2,) + a.extinction.shape, np.nan)
        back[1:-1, 1:-1, 1:-1] = sum(corners(atNodes)) / 8
        bound[1:-1, 1:-1, 1:-1] = sum(corners(half)) / 8
        use = away_from_solids(a)
        worst = (np.abs(b.extinction - back) / bound)[use].max()
        close(worst, 0.5, 0.5, "opacity bytes, " + a.name)

# --- Plot3D: nodes that FDS averaged over gas cells ---------------------------------------------------
plot = smoke("Plot3D", 28.0)
close(plot.field("Time"), 28.01, 1e-6, "Plot3D's own time")
exact = smoke("Extinction Slices", 28.0)
for a, b in zip(exact.meshes, plot.meshes):
    atNodes = sum(corners(a.extinction.astype(float))) / 8
    back = np.full(a.extinction.shape, np.nan)
    back[1:-1, 1:-1, 1:-1] = sum(corners(atNodes)) / 8
    use = away_from_solids(a)
    # The slice was written at the same time step.
    error = np.abs(b.extinction - back)[use] / np.maximum(back[use], 1e-2)
    close(error.max(), 0.0, 1e-5, "Plot3D, " + a.name)

# --- FDS 6.11: version 1 of .s3d holds densities itself ---------------------------------------------
newer = os.path.join(sys.argv[2], "Room", "fds_611")
for time in (10.0, 16.0):
    exact = Smoke(reader(os.path.join(newer, "room.smv")), time)
    nodes = Smoke(
        reader(os.path.join(newer, "room.smv"), ExtinctionSource="Density Smoke3D"), time
    )
    for number, (a, b) in enumerate(zip(exact.meshes, nodes.meshes)):
        with open(os.path.join(newer, "room_%d_1.s3d.sz" % (number + 1))) as file:
            rows = [[float(word) for word in line.split()] for line in file.readlines()[1:]]
        greatest = min(rows, key=lambda row: abs(row[0] - time))[-1]
        atNodes = sum(corners(a.extinction.astype(float))) / 8
        back = np.full(a.extinction.shape, np.nan)
        back[1:-1, 1:-1, 1:-1] = sum(corners(atNodes)) / 8
        error = np.abs(b.extinction - back)[away_from_solids(a)]
        half = 0.5 * 8700 * greatest / 254
        close(error.max(), 0.0, 1.001 * half, "version 1, %s at %g s" % (a.name, time))

# --- another mass extinction coefficient --------------------------------------------------------------
for source in ("Automatic", "Density Slices", "Density Smoke3D"):
    before, after = smoke(source, 30.0), smoke(source, 30.0, MassExtinctionCoefficient=4350.0)
    for a, b in zip(before.meshes, after.meshes):
        error = np.abs(b.extinction - 0.5 * a.extinction).max()
        close(error, 0.0, 1e-6 * a.extinction.max(), source + ": half of Km")

# --- flames -------------------------------------------------------------------------------------------
def hrr(path, time):
    with open(path) as file:
        rows = [row for row in csv.reader(file)][2:]
    table = np.array([[float(row[0]), float(row[1])] for row in rows])
    return np.interp(time, table[:, 0], table[:, 1]) * 1000


def emitted(data):
    total = 0.0
    for mesh, block in zip(data.meshes, range(99)):
        grid = data.data.GetPartition(block, 0)
        luminance = vtk_to_numpy(grid.GetCellData().GetArray("EmittedLuminance"))
        absorption = mesh.extinction * (1 - data.field("Albedo"))
        total += mesh.volume(4 * np.pi * absorption * luminance.reshape(mesh.extinction.shape))
    return total


hall = os.path.join(sys.argv[2], "Hall", "fds")
for path, name, times, tolerance in (
    # The hall's bytes of 4.7 kW/m3 leave out what burns more faintly; the room's end at 1200 kW/m3, which
    # its densest flames exceed.
    (os.path.join(hall, "hall.smv"), "hall", (120.0, 300.0, 600.0), 0.05),
    (index, "room", (10.0, 20.0, 30.0), 0.08),
):
    for time in times:
        burning = Smoke(reader(path), time)
        heat = hrr(path[:-4] + "_hrr.csv", burning.field("Time"))
        close(burning.field("FlameHeatRelease"), heat, tolerance * heat, name + ": heat release")
        lumens = burning.field("FlameLumens")
        close(lumens, 0.05 * burning.field("FlameHeatRelease"), 1e-6 * lumens, "lumens")
        close(burning.field("FlameLumensPlaced"), lumens, 1e-9 * lumens, "lumens placed")
        close(emitted(burning), lumens, 1e-5 * lumens, "lumens that the cells send out")
brighter = Smoke(reader(index, LuminousEfficacy=0.16, Albedo=0.6), 20.0)
close(emitted(brighter), 0.16 * brighter.field("FlameHeatRelease"), 0.1, "another efficacy, albedo")
close(brighter.field("Albedo"), 0.6, 0.0, "the albedo is passed on")
glowing = Smoke(reader(index, FlameModel="Temperature"), 20.0)
true("EFFECTIVE FLAME TEMPERATURE" in glowing.field("FlameSource"), "flame temperature is taken")
close(emitted(glowing), glowing.field("FlameLumens"), 1e-3, "lumens of glowing smoke")
true(1 < glowing.field("FlameLumens") < 3000, "glowing smoke is fainter than flames")
dark = Smoke(reader(index, FlameModel="None"), 20.0)
true(not dark.data.GetPartition(0, 0).GetCellData().HasArray("EmittedLuminance"), "no flames")

# --- 2-D slices: the plane, where it is, and its values against the 3-D slice --------------------------
def planes(source, time):
    port = simple.OutputPort(source, 3)
    port.UpdatePipeline(time)
    data = source.GetClientSideObject().GetOutputDataObject(3)
    names = [data.GetMetaData(i).Get(data.NAME()) for i in range(data.GetNumberOfPartitionedDataSets())]
    return {name: data.GetPartition(i, 0) for i, name in enumerate(names)}


room = reader(index)
found = planes(room, 30.0)
equal(
    sorted(found),
    sorted(
        "%s %s %s" % (quantity, mesh, place)
        for mesh, low, centre in (("fine", "z=1.7", "z=1.75"), ("coarse", "z=1.8", "z=1.7"))
        for quantity, place in (
            ("SOOT EXTINCTION COEFFICIENT", low),
            ("SOOT VISIBILITY", centre),
            ("TEMPERATURE", "y=1.2"),
            ("U-VELOCITY", "y=1.2"),
            ("V-VELOCITY", "y=1.2"),
            ("W-VELOCITY", "y=1.2"),
        )
    ),
    "names of the 2-D slices",
)
exact = smoke("Extinction Slices", 30.0)
for mesh in exact.meshes:
    shape = mesh.extinction.shape
    # A plane of cells: 3/K of the cells that the plane cuts, capped at 30 m.
    name, grid = next((n, g) for n, g in found.items() if n.startswith("SOOT VISIBILITY " + mesh.name))
    z = grid.GetZCoordinates().GetValue(0)
    layer = int(np.searchsorted(mesh.nodes[2], z)) - 1
    close(z, 0.5 * (mesh.nodes[2][layer] + mesh.nodes[2][layer + 1]), 1e-9, "half a cell up: " + name)
    equal(grid.GetDimensions(), (shape[2] + 1, shape[1] + 1, 1), name)
    values = vtk_to_numpy(grid.GetCellData().GetArray("SOOT VISIBILITY")).reshape(shape[1:])
    use = ~mesh.solid[layer]
    expected = np.minimum(3 / np.maximum(mesh.extinction[layer], 1e-6), 30.0)
    close(np.abs(values / expected - 1)[use].max(), 0.0, 1e-5, name)
    # A plane of nodes: the mean of the gas cells around, away from solids.
    name, grid = next((n, g) for n, g in found.items() if n.startswith("SOOT EXTINCTION COEFFICIENT " + mesh.name))
    z = grid.GetZCoordinates().GetValue(0)
    node = int(np.argmin(np.abs(mesh.nodes[2] - z)))
    close(z, mesh.nodes[2][node], 1e-9, "at the node: " + name)
    values = vtk_to_numpy(grid.GetPointData().GetArray("SOOT EXTINCTION COEFFICIENT"))
    values = values.reshape(shape[1] + 1, shape[2] + 1)[1:-1, 1:-1]
    atNodes = (sum(corners(mesh.extinction.astype(float))) / 8)[node - 1]
    use = (sum(corners(1.0 * mesh.solid))[node - 1] == 0) & (atNodes > 1e-3)
    if mesh.name == "coarse":
        use[:, 6:9] = False
    close(np.abs(values / np.maximum(atNodes, 1e-9) - 1)[use].max(), 0.0, 1e-5, name)
# The part-mesh 3-D slice (5 to 26 of 32 nodes) is no plane and covers its part only.
true(not any(name.startswith("TEMPERATURE fine x") for name in found), "3-D slices are no planes")
room.ReadPlaneSlices = 0
equal(planes(room, 30.0), {}, "2-D slices turned off")

# --- boundary files: where they are, and the screen that goes --------------------------------------------
def boundary(source, time):
    port = simple.OutputPort(source, 4)
    port.UpdatePipeline(time)
    data = source.GetClientSideObject().GetOutputDataObject(4)
    return {data.GetMetaData(i).Get(data.NAME()): data.GetPartition(i, 0)
            for i in range(data.GetNumberOfPartitionedDataSets())}


equal(sorted(boundary(room, 8.0)), ["WALL TEMPERATURE coarse", "WALL TEMPERATURE fine"], "boundary files")
for time, screen in ((8.0, True), (28.0, False)):
    walls = boundary(room, time)["WALL TEMPERATURE coarse"]
    close(np.abs(np.array(walls.GetBounds()) - (3.2, 6.4, 0.0, 2.4, 0.0, 2.4)).max(), 0.0, 1e-5, "their bounds")
    temperature = vtk_to_numpy(walls.GetPointData().GetArray("WALL TEMPERATURE"))
    true(19.9 < temperature.min() and 20.01 < temperature.max() < 200, "walls warm up")
    points = vtk_to_numpy(walls.GetPoints().GetData())
    # The middle of the screen's top, where there is no other wall.
    top = np.abs(points - (5.65, 0.6, 1.2)).max(axis=1) < 1e-4
    equal(bool(top.any()), screen, "the screen at %g s" % time)
    equal(walls.GetFieldData().GetAbstractArray("Unit").GetValue(0), "C", "unit")
hot = vtk_to_numpy(boundary(room, 8.0)["WALL TEMPERATURE fine"].GetPointData().GetArray(0))
close(hot.max(), 39.0747, 1e-3, "hottest wall at 8 s")
room.ReadBoundary = 0
equal(boundary(room, 8.0), {}, "boundary files turned off")

# --- between frames --------------------------------------------------------------------------------------
steps = list(room.TimestepValues)
early, late = steps[5], steps[6]
middle = early + 0.25 * (late - early)
mixed = Smoke(reader(index, TimeInterpolation="Linear"), middle)
close(mixed.field("Time"), middle, 0.0, "time between frames")
for a, b, c in zip(Smoke(room, early).meshes, Smoke(room, late).meshes, mixed.meshes):
    expected = 0.75 * a.extinction.astype(float) + 0.25 * b.extinction
    close(np.abs(c.extinction - expected).max(), 0.0, 1e-6 * expected.max(), "between frames")
close(Smoke(room, middle).field("Time"), early, 0.0, "the nearest frame")

# --- a run that goes on ------------------------------------------------------------------------------------
with tempfile.TemporaryDirectory() as temporary:
    for name in ("room.smv", "room_2_2.sf", "room_devc.csv", "room_1_2.s3d", "room_2_2.s3d"):
        shutil.copy(os.path.join(folder, name), temporary)
    with open(os.path.join(folder, "room_1_2.sf"), "rb") as file:
        whole = file.read()
    frame = 12 + 8 + 4 * struct.unpack_from("<i", whole, 146 + 12)[0] // 4
    growing = os.path.join(temporary, "room_1_2.sf")
    with open(growing, "wb") as file:
        file.write(whole[: 146 + 3 * frame + 100])
    with open(os.path.join(temporary, "room_2_2.sf"), "r+b") as file:
        short = struct.unpack_from("<i", file.read(162), 158)[0] + 20
        file.truncate(146 + 3 * short)
    live = reader(os.path.join(temporary, "room.smv"))
    with Messages() as messages:
        close(Smoke(live, 30.0).field("Time"), steps[2], 0.0, "the last frame so far")
    true("room_1_2.sf: frame 4 at byte" in messages.text, "the frame being written is named")
    with open(growing, "wb") as file:
        file.write(whole)
    shutil.copy(os.path.join(folder, "room_2_2.sf"), temporary)
    # What "Reload Files" does; live.Refresh() does it in scripts.
    helper = servermanager.vtkSMReaderReloadHelper()
    true(helper.SupportsReload(live.SMProxy), "the reader can be reloaded")
    true(helper.ReloadFiles(live.SMProxy), "the reader reloads")
    live.UpdatePipelineInformation()
    equal(list(live.TimestepValues), steps, "frames after the refresh")
    close(Smoke(live, 30.0).field("Time"), 30.0, 0.0, "the last frame after the refresh")

# --- pieces ------------------------------------------------------------------------------------------------
names = []
for piece in range(2):
    alone = reader(index).GetClientSideObject()
    alone.UpdatePiece(piece, 2, 0)
    data = alone.GetOutputDataObject(0)
    for block in range(2):
        grid = data.GetPartition(block, 0)
        if grid:
            names.append((piece, data.GetMetaData(block).Get(data.NAME())))
equal(names, [(0, "fine"), (1, "coarse")], "a mesh each piece")

print("reader_sources: all as expected")
