"""The reader against the bytes themselves: pvpython reader_bytes.py PLUGIN DATA_FOLDER

A second, slow reading of the room's files in numpy, written from FDS's file formats and nothing of the plugin: Plot3D,
8-bit heat release and flame temperature, and the light of flames that follows from them, cell by cell.
"""

import os
import struct
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import numpy as np
from reader_common import Smoke, close, load_plugin, reader, true
from vtkmodules.util.numpy_support import vtk_to_numpy

load_plugin(sys.argv[1])
folder = os.path.join(sys.argv[2], "Room", "fds")
index = os.path.join(folder, "room.smv")

# The photopic eye, CIE 1924, from 380 nm in steps of 10 nm.
PHOTOPIC = np.array(
    """0 .0001 .0004 .0012 .0040 .0116 .023 .038 .060 .091 .139 .208 .323 .503 .710 .862 .954 .995 .995 .952 .870 .757
    .631 .503 .381 .265 .175 .107 .061 .032 .017 .0082 .0041 .0021 .00105 .00052 .00025 .00012 .00006 .00003""".split(),
    float,
)


def records(name):
    """The records of a Fortran file."""
    with open(os.path.join(folder, name), "rb") as file:
        data = file.read()
    place, found = 0, []
    while place < len(data):
        (length,) = struct.unpack_from("<i", data, place)
        found.append(data[place + 4 : place + 4 + length])
        place += length + 8
    return found


def plot3d(name):
    """The five quantities of a file, each as [k, j, i] over the nodes."""
    nodes, _, values = records(name)
    shape = struct.unpack("<3i", nodes)[::-1]
    return np.frombuffer(values, "<f4").astype(float).reshape((5,) + shape)


def bytes3d(name, time):
    """The bytes over the nodes of the frame nearest to a time."""
    header, *rest = records(name)
    counts = struct.unpack("<8i", header)[3::2]
    times = np.array([struct.unpack("<f", one)[0] for one in rest[0::3]])
    coded, out, i = rest[2 :: 3][int(np.argmin(np.abs(times - time)))], bytearray(), 0
    while i < len(coded):
        if coded[i] == 255:
            out += bytes([coded[i + 1]]) * coded[i + 2]
            i += 3
        else:
            out.append(coded[i])
            i += 1
    return np.frombuffer(out, np.uint8).reshape([n + 1 for n in counts[::-1]]).astype(float)


def of_cells(nodes):
    """The mean of each cell's eight nodes."""
    for axis in range(3):
        nodes = 0.5 * (np.delete(nodes, 0, axis) + np.delete(nodes, -1, axis))
    return nodes


def from_bytes(codes, low, high, solid):
    """What bytes that FDS rounded down mean: the middle of a step, without solid cells, which it took for clear ones."""
    values = low + np.where((codes == 0) | (codes >= 254), codes, codes + 0.5) / 254 * (high - low)
    beside = np.pad(~solid, 1, mode="edge")
    gas = sum(beside[tuple(np.s_[c : c + n + 1] for c, n in zip(corner, solid.shape))].astype(int)
              for corner in np.ndindex(2, 2, 2))
    return np.where(gas > 0, low + (values - low) * 8 / np.maximum(gas, 1), low)


def emitted(smoke, number):
    grid = smoke.data.GetPartition(number, 0)
    return vtk_to_numpy(grid.GetCellData().GetArray("EmittedLuminance")).reshape(smoke.meshes[number].solid.shape)


def black_body(celsius):
    """Luminance [cd/m2] by Planck's law, the sum over wavelengths by the trapezoidal rule."""
    wavelength = 1e-9 * np.arange(380, 775, 10)[: len(PHOTOPIC)]
    kelvin = np.asarray(celsius, float)[..., None] + 273.15
    radiance = 1.191042972e-16 / wavelength**5 / np.expm1(1.438776877e-2 / (wavelength * kelvin))
    return 683.002 * (PHOTOPIC * radiance).sum(-1) * 10e-9


# The old candela, by which platinum that freezes at 2042 K has 6e5 cd/m2, holds of this table, too.
close(black_body(2042 - 273.15) / 6e5, 1.0, 0.01, "the table of the photopic eye")

# --- Plot3D: extinction, the fourth quantity of the room's files --------------------------------------------
smoke = Smoke(reader(index, ExtinctionSource="Plot3D"), 28.0)
heat = 0.0
for number, mesh in enumerate(smoke.meshes):
    values = plot3d("room_%d_28p01.q" % (number + 1))
    expected = np.where(mesh.solid, 0.0, of_cells(values[3]))
    close(np.abs(mesh.extinction - expected).max(), 0.0, 1e-6 * expected.max(), "Plot3D of " + mesh.name)
    true(expected.max() > 1.0 and (expected > 0.0).mean() > 0.2, "there is smoke in " + mesh.name)
    heat += mesh.volume(np.where(mesh.solid, 0.0, of_cells(values[4]))) * 1000

# --- heat release to light -------------------------------------------------------------------------------------
efficacy, albedo, least = 0.05, 0.3, 0.001
for time in (10.0, 20.0, 28.0):
    burning = Smoke(reader(index), time)
    total = 0.0
    for number, mesh in enumerate(burning.meshes):
        codes = bytes3d("room_%d_2.s3d" % (number + 1), time)
        rate = np.where(mesh.solid, 0.0, of_cells(from_bytes(codes, 0.0, 1200.0, mesh.solid))) * 1000
        total += mesh.volume(rate)
        absorption = (1 - albedo) * mesh.extinction.astype(float)
        emits = (rate > 0) & (absorption >= least)
        # What clear burning cells have to give goes to those with smoke.
        smoky = mesh.volume(np.where(emits, rate, 0.0))
        share = mesh.volume(rate) / smoky if smoky > 0 else 0.0
        expected = np.where(emits, share * efficacy * rate / (4 * np.pi * np.where(emits, absorption, 1.0)), 0.0)
        found = emitted(burning, number)
        close(np.abs(found - expected).max(), 0.0, 2e-5 * expected.max() + 1e-9, "light of %s at %g s" % (mesh.name, time))
    close(burning.field("FlameHeatRelease"), total, 1e-5 * total, "heat release at %g s" % time)
    close(burning.field("FlameLumens"), efficacy * total, 1e-5 * total, "lumens at %g s" % time)
    if time == 28.0:
        # Two files of the same moment: the bytes end at 1200 kW/m3 and were rounded down.
        close(total, heat, 0.08 * heat, "heat release in bytes and in Plot3D")

# --- temperature to light ----------------------------------------------------------------------------------------
glowing = Smoke(reader(index, FlameModel="Temperature"), 20.0)
total = 0.0
for number, mesh in enumerate(glowing.meshes):
    codes = bytes3d("room_%d_3.s3d" % (number + 1), 20.0)
    celsius = of_cells(from_bytes(codes, 20.0, 2000.0, mesh.solid))
    expected = np.where(mesh.solid | (celsius < 500.0), 0.0, black_body(celsius))
    found = emitted(glowing, number)
    if number == 0:
        true(celsius[~mesh.solid].max() > 600.0, "it burns at %g C" % celsius[~mesh.solid].max())
    # The reader has the eye as a sum of two lobes, which in the red, where soot glows, is a percent above the table.
    hot = expected > 0
    close(np.abs(found[hot] / expected[hot] - 1).max() if hot.any() else 0.0, 0.0, 0.015, "glow of " + mesh.name)
    close(np.abs(found[~hot]).max(), 0.0, 0.0, "what is cold is dark in " + mesh.name)
    total += mesh.volume(4 * np.pi * (1 - albedo) * mesh.extinction * expected)
close(glowing.field("FlameLumens") / total, 1.0, 0.015, "lumens of the glow")

print("reader_bytes: all as expected")
