"""FDSSmokeReader on the hall: pvpython reader_hall.py PLUGIN DATA_FOLDER

Every expected number is worked out from hall.fds, from other files of the same run, or from bytes
of the files read here without the reader.
"""

import os
import shutil
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import numpy as np
from reader_common import Devices, Messages, Smoke, Walls, close, equal, load_plugin, reader, true

load_plugin(sys.argv[1])
folder = os.path.join(sys.argv[2], "Hall", "fds")
hall = reader(os.path.join(folder, "hall.smv"))


def frames(name, shape):
    """Times and values of a .sf file, read without the reader: 146 bytes of header, then frames."""
    count = int(np.prod(shape))
    record = np.dtype([("m1", "<i4"), ("time", "<f4"), ("m2", "<i4", 2), ("v", "<f4", shape), ("m3", "<i4")])
    data = np.fromfile(os.path.join(folder, name), dtype=record, offset=146)
    assert (data["m3"] == 4 * count).all()
    return data["time"], data["v"]


# --- meshes, time steps, field data -------------------------------------------------------------
hall.UpdatePipelineInformation()
steps = list(hall.TimestepValues)
equal(len(steps), 11, "number of time steps")
close(steps[0], 0.0, 0.0, "first time")
close(steps[-1], 600.0, 0.0, "last time")
smoke = Smoke(hall, 600.0)
equal([m.name for m in smoke.meshes], ["west", "east"], "mesh names")
for mesh, low in zip(smoke.meshes, (-2.5, 27.5)):
    equal(mesh.dimensions, (60, 80, 12), "cells of " + mesh.name)
    for nodes, begin, end in zip(mesh.nodes, (low, -2.5, 0.0), (low + 30.0, 37.5, 6.0)):
        close(nodes[0], begin, 1e-9, "first node")
        close(nodes[-1], end, 1e-9, "last node")
        close(np.abs(np.diff(nodes) - 0.5).max(), 0.0, 1e-5, "uneven cells")
equal(smoke.field("CHID"), "hall", "CHID")
close(smoke.field("Albedo"), 0.3, 0.0, "albedo")
close(smoke.field("Time"), 600.0, 0.0, "time")
true("hall_1_1.sf" in smoke.field("ExtinctionSource"), "the source names its files")
# The hall's walls and ceiling are 0.5 m thick: ring of 56 x 36 less 55 x 35 m, 5 m high, less eight
# doors of 2 x 2 m; ceiling 56 x 36 m; fire bed 2 x 2 x 0.5 m.
solid = sum(m.volume(m.solid) for m in smoke.meshes)
close(solid, (56 * 36 - 55 * 35) * 5 - 8 * 2 * 0.5 * 2 + 56 * 36 * 0.5 + 2, 1e-3, "solid volume")
true(all((m.extinction[m.solid] == 0).all() for m in smoke.meshes), "solids hold no smoke")

# --- every cell is where it belongs -------------------------------------------------------------
# FDS wrote the plane z = 1.5 m on the nodes, each the mean over its gas cells. The same mean over
# the reader's cells must agree to single precision.
for step in (0, 3, 10):
    smoke = Smoke(hall, steps[step])
    for mesh, number in zip(smoke.meshes, (1, 2)):
        times, nodes = frames("hall_%d_3.sf" % number, (81, 61))
        close(times[step], steps[step], 0.0, "time of the plane")
        cells = mesh.extinction[2:4].astype(float)
        gas = (~mesh.solid[2:4]).astype(float)
        corners = [np.s_[k, j : 79 + j, i : 59 + i] for k in (0, 1) for j in (0, 1) for i in (0, 1)]
        weight = sum(gas[c] for c in corners)
        mean = sum((cells * gas)[c] for c in corners) / np.maximum(weight, 1)
        inner = nodes[step, 1:-1, 1:-1]
        error = np.abs(mean - inner) / np.maximum(inner, 1e-3)
        close(error.max(), 0.0, 1e-6, "%s: cells against nodes at %g s" % (mesh.name, steps[step]))

# --- devices ------------------------------------------------------------------------------------
devices = Devices(hall)
equal(devices.names(), ["Time", "K_A", "V_A", "K_B", "V_B", "K_C", "V_C", "OD beam"], "columns")
equal(devices.data.GetNumberOfRows(), 61, "rows")
equal([devices.unit(n) for n in ("Time", "K_A", "V_A", "OD beam")], ["s", "1/m", "m", "%"], "units")
equal(devices.position("K_B"), (40.5, 26.5, 1.7), "position")
close(devices.column("K_A")[60], 0.87760793, 0.0, "K_A at the end, as in the file")
close(devices.column("K_A")[1], 3.362945e-102, 1e-108, "K_A with a three-digit exponent")
# A device's row is the mean over the 10 s before it, as FDS does by default (hence V > 3/K, mean of the
# inverse against inverse of the mean); the frame is a moment. Smoke at a point swings by a few
# hundredths of 1/m within 10 s: neighbouring rows bound it.
for name in ("K_A", "K_B", "K_C"):
    true(devices.column("V" + name[1:])[60] > 3 / devices.column(name)[60], "means over 10 s")
    for step in (3, 5, 8, 10):
        smoke = Smoke(hall, steps[step])
        row = int(np.argmin(np.abs(devices.column("Time") - steps[step])))
        near = devices.column(name)[max(row - 2, 0) : row + 3]
        swing = max(near.max() - near.min(), 0.02)
        value = smoke.at(devices.position(name))
        true(near.min() - swing <= value <= near.max() + swing, "%s at %g s" % (name, steps[step]))

# --- time: the nearest frame --------------------------------------------------------------------
close(Smoke(hall, 589.0).field("Time"), 600.0, 0.0, "nearest frame of 589 s")
close(Smoke(hall, -50.0).field("Time"), 0.0, 0.0, "nearest frame of -50 s")
close(Smoke(hall, 70.0).field("Time"), steps[1], 0.0, "nearest frame of 70 s")
true(max(m.extinction.max() for m in Smoke(hall, 0.0).meshes) == 0.0, "no smoke at the beginning")

# --- walls --------------------------------------------------------------------------------------
walls = Walls(hall, 600.0)
door = 2.0 * 2.0
# Inside: each wall less its doors; the ceiling; the floor with its own surface less the fire bed.
close(walls.total(walls.at("+x", 0.0)), 35 * 5 - 2 * door, 1e-3, "west wall inside")
close(walls.total(walls.at("-x", 55.0)), 35 * 5 - 2 * door, 1e-3, "east wall inside")
close(walls.total(walls.at("+y", 0.0)), 55 * 5 - 2 * door, 1e-3, "south wall inside")
close(walls.total(walls.at("-y", 35.0)), 55 * 5 - 2 * door, 1e-3, "north wall inside")
close(walls.total(walls.at("-z", 5.0)), 55 * 35, 1e-3, "ceiling")
close(walls.total(walls.surface == "FLOOR"), 55 * 35 - 4, 1e-3, "floor")
close(walls.total(walls.surface == "BURNER"), 4.0, 1e-3, "burner")
# Outside: walls up to the roof's top at 5.5 m; the ground around the hall and in the doors.
close(walls.total(walls.at("-x", -0.5)), 36 * 5.5 - 2 * door, 1e-3, "west wall outside")
close(walls.total(walls.at("+z", 5.5)), 56 * 36, 1e-3, "roof")
ring = 56 * 36 - 55 * 35 - 8 * 2 * 0.5
close(
    walls.total(walls.at("+z", 0.0) & (walls.surface == "WALL")), 60 * 40 - 55 * 35 - ring, 1e-3, "ground"
)
# Doors' reveals: two jambs and a lintel each, 0.5 m deep.
close(walls.total(walls.at("-z", 2.0)), 8 * 2 * 0.5, 1e-3, "lintels")
# The outer boundary is open except for the ground, and where the meshes meet there is nothing.
for direction, coordinate in (("+x", -2.5), ("-x", 57.5), ("+y", -2.5), ("-y", 37.5), ("-z", 6.0)):
    close(walls.total(walls.at(direction, coordinate)), 0.0, 0.0, "open boundary " + direction)
close(walls.total(walls.at("+x", 27.5) | walls.at("-x", 27.5)), 0.0, 0.0, "faces where meshes meet")
# Solids are closed: the normals of all faces but the ground's add up to the ground they cover.
flux = (walls.normal * walls.area[:, None]).sum(axis=0)
for part, expected in zip(flux, (0.0, 0.0, 60 * 40)):
    close(part, expected, 1e-2, "sum of the normals")
# sRGB (200, 196, 186), (120, 92, 60), (255, 80, 0) in linear light, IEC 61966-2-1; the index has 5 digits.
for surface, rgb in (("WALL", (200, 196, 186)), ("FLOOR", (120, 92, 60)), ("BURNER", (255, 80, 0))):
    srgb = np.array(rgb) / 255.0
    linear = np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)
    error = np.abs(walls.reflectance[walls.surface == surface] - linear).max()
    close(error, 0.0, 2e-5, "reflectance of " + surface)

# --- broken runs: one error or warning, and what is whole still works -----------------------------
with tempfile.TemporaryDirectory() as temporary:
    copy = os.path.join(temporary, "hall.smv")
    shutil.copy(os.path.join(folder, "hall.smv"), copy)
    broken = reader(copy)
    with Messages() as messages:
        broken.UpdatePipeline(600.0)
    true("hall_1_1.sf: the slice of SOOT EXTINCTION COEFFICIENT of mesh 'west' cannot be opened" in messages.text, "the missing slice is named")
    equal(messages.count("ERROR"), 1, "errors of a missing slice")
    true("hall_devc.csv" in messages.text, "the missing device table is named")
    equal(messages.count("Warning"), 1, "warnings of a missing device table")
    data = broken.GetClientSideObject().GetOutputDataObject(0)
    equal(data.GetNumberOfPartitionedDataSets(), 0, "meshes of a failed read")
    # Asked of the pipeline itself, the walls need no slice (a proxy updates all its outputs).
    alone = reader(copy).GetClientSideObject()
    with Messages() as messages:
        alone.Update(1)
    equal(messages.text, "", "messages of the walls alone")
    count = alone.GetOutputDataObject(1).GetNumberOfCells()
    equal(count, len(walls.area), "walls without the slices")
    equal(alone.GetOutputDataObject(2).GetNumberOfColumns(), 0, "devices that nobody asked for")

    for name in ("hall_1_1.sf", "hall_2_1.sf", "hall_1_2.s3d", "hall_2_2.s3d", "hall_devc.csv"):
        shutil.copy(os.path.join(folder, name), temporary)
    cut = os.path.join(temporary, "hall_2_1.sf")
    os.chmod(cut, 0o644)
    os.truncate(cut, os.path.getsize(cut) - 1000)
    shorter = reader(copy)
    with Messages() as messages:
        earlier = Smoke(shorter, 540.0)
    equal((messages.count("ERROR"), messages.count("Warning")), (0, 1), "messages of a cut slice")
    true("hall_2_1.sf: frame 11" in messages.text, "the frame cut short is named")
    close(earlier.field("Time"), steps[9], 0.0, "a frame before the cut")
    with Messages() as messages:
        Smoke(shorter, 600.0)
    true("Mesh 'east' has no frame at 600 s" in messages.text, "a mesh without the frame is named")

    with open(copy, "w") as file:
        file.write("")
    with Messages() as messages:
        reader(copy).UpdatePipeline(0.0)
    true("the FDS index is empty" in messages.text, "an empty index is said to be")

print("reader_hall: all as expected")
