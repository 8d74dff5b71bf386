"""CADReader: ports, arrays and field data, the material table, errors, and a scene lit with it and FDS walls."""

import base64
import json
import math
import os
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import numpy
from scenes import (Messages, box, cell_array, check_close, fetch, field, image, load_plugin, producer,
                    tunnel_sign)
from vtkmodules.vtkCommonCore import VTK_UNSIGNED_CHAR
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersCore import vtkCellCenters, vtkMassProperties, vtkTriangleFilter
from vtkmodules.vtkIOImage import vtkPNGWriter

simple = load_plugin()
samples = os.path.join(sys.argv[2], "CAD")


def sample(name):
    return os.path.join(samples, name)


def texts(data, name):
    array = data.GetCellData().GetAbstractArray(name)
    return [array.GetValue(i) for i in range(array.GetNumberOfValues())]


def field_texts(data, name):
    array = data.GetFieldData().GetAbstractArray(name)
    return [array.GetValue(i) for i in range(array.GetNumberOfValues())]


def field_numbers(data, name):
    array = data.GetFieldData().GetArray(name)
    return [array.GetValue(i) for i in range(array.GetNumberOfValues())]


def port(reader, index):
    simple.OutputPort(reader, index).UpdatePipeline()
    return reader.GetClientSideObject().GetOutputDataObject(index)


def linear(srgb):
    """IEC 61966-2-1."""
    return srgb / 12.92 if srgb <= 0.04045 else ((srgb + 0.055) / 1.055) ** 2.4


# --- every format, as File > Open reads it ----------------------------------------------------------
for name in sorted(os.listdir(samples)):
    if not name.startswith("kiosk.") or name.endswith(".mtl"):
        continue
    kiosk = simple.CADReader(FileName=sample(name))
    walls = port(kiosk, 0)
    lights = port(kiosk, 1)
    assert lights.GetNumberOfCells() == 0, name
    transparent = field(walls, "TransparentTriangles")
    # Glass of an opacity of 0.2 is left out where the format has it.
    extension = name.split(".")[1]
    glass = extension not in ("stl", "ply", "dxf", "igs")
    assert transparent == (2 if glass else 0), (name, transparent)
    assert walls.GetNumberOfCells() == 16 - transparent, name
    bounds = field_numbers(walls, "ModelBounds")
    expected = [1, 2 if glass else 3, 1.99, 4, 0, 3]
    assert numpy.abs(numpy.subtract(bounds, expected)).max() < 2e-6, (name, bounds)
    assert numpy.abs(numpy.subtract(walls.GetBounds(), expected)).max() < 2e-6, name
    if extension in ("stl", "ply", "dxf"):
        assert (cell_array(walls, "Reflectance") == 0.5).all(), name

# --- arrays -----------------------------------------------------------------------------------------
kiosk = simple.CADReader(FileName=sample("kiosk.step"))
walls = port(kiosk, 0)
block = numpy.array(texts(walls, "Object")) == "Kiosk"
assert block.sum() == 12
reflectance = cell_array(walls, "Reflectance")[block]
for channel, srgb in enumerate((0.8, 0.7, 0.6)):
    check_close("plaster", reflectance[:, channel].max(), linear(srgb), absolute=1e-6)
assert field_texts(walls, "ObjectNames") == ["Kiosk", "ExitSign-03", "Glazing-1"]
assert field_texts(walls, "ObjectGroups") == ["Building"] * 3
assert field_texts(walls, "Format") == ["STEP"]
assert field_texts(walls, "UnitSource") == ["stated by the file"]
assert field(walls, "UnitScale") == 0.001
names = field_texts(walls, "MaterialNames")
assert [names[i] for i in cell_array(walls, "MaterialId")] == texts(walls, "Material")

# --- VTK's own measure of the block -----------------------------------------------------------------
table = os.path.join(tempfile.mkdtemp(), "block.csv")
with open(table, "w") as file:
    file.write("name,drop\nExitSign*,yes\nGlazing*,yes\n")
kiosk.MaterialTable = table
mass = vtkMassProperties()
mass.SetInputData(port(kiosk, 0))
check_close("area", mass.GetSurfaceArea(), 22.0, relative=1e-9)
check_close("volume", mass.GetVolume(), 6.0, relative=1e-9)
assert field(port(kiosk, 0), "DroppedTriangles") == 4

# --- turned and moved -------------------------------------------------------------------------------
kiosk.Rotation = [0, 0, 90]
kiosk.Translation = [10, 0, -1]
# (x, y) goes to (-y, x).
expected = [10 - 4, 10 - 2, 1, 2, -1, 2]
assert numpy.abs(numpy.subtract(port(kiosk, 0).GetBounds(), expected)).max() < 1e-9
simple.Delete(kiosk)

# --- the material table -----------------------------------------------------------------------------
for name in ("materials.csv", "materials.json"):
    kiosk = simple.CADReader(FileName=sample("kiosk.ifc"), MaterialTable=sample(name))
    with Messages() as messages:
        walls = port(kiosk, 0)
        lights = port(kiosk, 1)
    assert messages.count("Warning", "vtkCADReader") == 0, messages.text
    assert set(texts(walls, "Object")) == {"Kiosk"}
    check_close("table", cell_array(walls, "Reflectance").max(), 0.62, absolute=1e-6)
    assert field(walls, "DroppedTriangles") == 2
    assert set(texts(lights, "Object")) == {"ExitSign-03"}
    assert set(texts(lights, "SignName")) == {"East exit"}
    assert (cell_array(lights, "Luminance") == 300.0).all()
    assert (cell_array(lights, "SignId") == 3).all()

with tempfile.TemporaryDirectory() as folder:
    table = os.path.join(folder, "typo.csv")
    with open(table, "w") as file:
        file.write("name,drop\nGlassing*,yes\n")
    kiosk.MaterialTable = table
    with Messages() as messages:
        port(kiosk, 0)
    assert messages.count("Warning", "vtkCADReader") == 1, messages.text
    assert "line 2, pattern 'Glassing*'" in messages.text, messages.text

    # --- errors: one, that names the file ---------------------------------------------------------------
    def refused(remedy, **properties):
        broken = simple.CADReader(**properties)
        with Messages() as failed:
            try:
                port(broken, 0)
            except RuntimeError:
                pass
        assert failed.count("ERROR", "vtkCADReader") == 1, failed.text
        assert remedy in failed.text, failed.text
        assert os.path.basename(properties["FileName"]) in failed.text, failed.text
        assert broken.GetClientSideObject().GetOutputDataObject(0).GetNumberOfCells() == 0
        simple.Delete(broken)

    with open(os.path.join(folder, "broken.step"), "w") as file:
        file.write("ISO-10303-21;\nHEADER;\n")
    with open(os.path.join(folder, "model.dwg"), "w") as file:
        file.write("AC1027")
    refused("Check the path", FileName=os.path.join(folder, "missing.ifc"))
    refused("export it again", FileName=os.path.join(folder, "broken.step"))
    refused("Convert it", FileName=os.path.join(folder, "model.dwg"))
    # Numbers that are none: the error names the property instead of the file.
    for name in ("UnitScale", "LinearTolerance", "AngularTolerance", "DefaultReflectance",
                 "TransparencyThreshold", "Translation", "Rotation"):
        for value in (math.nan, math.inf, -math.inf):
            strange = simple.CADReader(FileName=sample("kiosk.step"))
            good = getattr(strange, name)
            good = list(good) if name in ("Translation", "Rotation") else good
            setattr(strange, name, [0, value, 0] if name in ("Translation", "Rotation") else value)
            with Messages() as failed:
                port(strange, 0)
            assert failed.count("ERROR", "vtkCADReader") == 1, (name, value, failed.text)
            assert name + ": it is " in failed.text, (name, value, failed.text)
            assert strange.GetClientSideObject().GetOutputDataObject(0).GetNumberOfCells() == 0
            setattr(strange, name, 1.0 if name == "UnitScale" else good)
            with Messages() as failed:
                assert port(strange, 0).GetNumberOfCells() == 14, (name, value)
            assert failed.text == "", failed.text
            simple.Delete(strange)
    with open(table, "w") as file:
        file.write("name,drop\n*,yes\n")
    refused("change the table", FileName=sample("kiosk.obj"), MaterialTable=table)

# --- images as colours ------------------------------------------------------------------------------------
pixels = vtkImageData()
pixels.SetDimensions(2, 1, 1)
pixels.AllocateScalars(VTK_UNSIGNED_CHAR, 3)
for column, value in enumerate((0, 255)):
    for channel in range(3):
        pixels.SetScalarComponentFromFloat(column, 0, 0, channel, value if channel < 2 else 128)
with tempfile.TemporaryDirectory() as folder:
    writer = vtkPNGWriter()
    writer.SetInputData(pixels)
    writer.SetFileName(os.path.join(folder, "wall.png"))
    writer.Write()
    with open(os.path.join(folder, "wall.obj"), "w") as file:
        file.write("mtllib wall.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl Brick\n"
                   "f 1/1 2/2 3/3\n")
    with open(os.path.join(folder, "wall.mtl"), "w") as file:
        file.write("newmtl Brick\nKd 0.5 1 1\nmap_Kd wall.png\n")
    wall = simple.CADReader(FileName=os.path.join(folder, "wall.obj"))
    found = cell_array(port(wall, 0), "Reflectance")[0]
    # Half black, half white; blue is the same everywhere.
    expected = [0.5 * linear(0.5), 0.5, linear(128 / 255)]
    assert numpy.abs(found - expected).max() < 1e-6, (found, expected)

    # The same image within a glTF file, whose colours are linear.
    with open(os.path.join(folder, "wall.png"), "rb") as file:
        image_uri = "data:image/png;base64," + base64.b64encode(file.read()).decode()
    corners = numpy.array([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1], "<f4").tobytes()
    with open(os.path.join(folder, "wall.gltf"), "w") as file:
        json.dump({
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [
                {"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}],
            "materials": [{"name": "Brick", "pbrMetallicRoughness": {
                "baseColorFactor": [0.5, 1, 1, 1], "baseColorTexture": {"index": 0}}}],
            "textures": [{"source": 0}], "images": [{"uri": image_uri}],
            "buffers": [{"byteLength": 60, "uri": "data:application/octet-stream;base64,"
                         + base64.b64encode(corners).decode()}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24}],
            "accessors": [
                {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                 "min": [0, 0, 0], "max": [1, 1, 0]},
                {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"}]}, file)
    found = cell_array(port(simple.CADReader(FileName=os.path.join(folder, "wall.gltf")), 0), "Reflectance")[0]
    expected[0] = 0.25
    assert numpy.abs(found - expected).max() < 1e-6, (found, expected)

    # Without the image there is a warning and the default reflectance.
    os.remove(os.path.join(folder, "wall.png"))
    with Messages() as messages:
        bare = port(simple.CADReader(FileName=os.path.join(folder, "wall.obj")), 0)
    assert messages.count("Warning", "vtkCADReader") == 1 and "Brick" in messages.text, messages.text
    assert (cell_array(bare, "Reflectance") == 0.5).all()

# --- CAD and other surfaces in one scene ----------------------------------------------------------------
# The sign of the model, 300 cd/m2, looks along -y into clear air; the illuminance that it gives to the floor
# of a room around it is a closed form, far from it that of a small plane source.
kiosk = simple.CADReader(FileName=sample("kiosk.gltf"), MaterialTable=sample("materials.csv"))
air = producer(image((10, 10, 5), (10.0, 10.0, 5.0), 0.0, (-3.0, -6.0, 0.0)), "Air")
room = producer(box((10.0, 10.0, 5.0), 0.0, (-3.0, -6.0, 0.0)), "Room")
with Messages() as messages:
    light = simple.SmokeLightField(
        Smoke=air, Surfaces=[kiosk, room], Emitters=[simple.OutputPort(kiosk, 1)], PatchSize=1.0)
    result = fetch(light)
assert messages.text == "", messages.text
surfaces = result.GetPartitionedDataSet(1)
assert surfaces.GetNumberOfPartitions() == 2
emitter = result.GetPartition(2, 0)
assert set(texts(emitter, "SignName")) == {"East exit"}
centers = vtkCellCenters()
centers.SetInputData(surfaces.GetPartition(1))
centers.Update()
points = centers.GetOutput().GetPoints()
found = cell_array(surfaces.GetPartition(1), "Illuminance")
checked = 0
for i in range(points.GetNumberOfPoints()):
    x, y, z = points.GetPoint(i)
    # Patches of the wall y = -6, which the sign faces.
    if y < -5.999:
        d = numpy.array([x, y, z]) - [1.5, 1.99, 2.275]
        distance = numpy.sqrt(d @ d)
        # E = L A cos cos' / r^2; the patch is 1/8 of the distance across, which changes its mean by less than
        # 1/2 % (second-order, (1/8)^2 / 6), and the tolerance of the light is 1 %.
        expected = 300.0 * 0.045 * d[1] ** 2 / distance**4
        check_close("illuminance at %g %g" % (x, z), found[i], expected, relative=0.015)
        checked += 1
assert checked >= 50, checked

# --- CAD and FDS geometry together ------------------------------------------------------------------------
run = simple.FDSSmokeReader(FileName=os.path.join(sys.argv[2], "Room", "fds", "room.smv"))
pillar = simple.CADReader(FileName=sample("kiosk.step"), MaterialTable=sample("materials.json"))
both = simple.SmokeLightField(
    Smoke=run, Surfaces=[simple.OutputPort(run, 1), pillar],
    Emitters=[simple.OutputPort(pillar, 1)], Tolerance=0.1, PatchSize=0.5)
both.UpdatePipeline(10.0)
surfaces = both.GetClientSideObject().GetOutputDataObject(0).GetPartitionedDataSet(1)
assert surfaces.GetNumberOfPartitions() == 2
walls, block = (surfaces.GetPartition(i) for i in range(2))
assert walls.GetCellData().GetAbstractArray("SurfaceName") is not None
assert set(texts(block, "Object")) == {"Kiosk"}
# Cut into patches, the block is as large as before and in its place, and light reaches both.
mass = vtkMassProperties()
triangles = vtkTriangleFilter()
triangles.SetInputData(block)
mass.SetInputConnection(triangles.GetOutputPort())
check_close("area", mass.GetSurfaceArea(), 22.0, relative=1e-6)
assert numpy.abs(numpy.subtract(block.GetBounds(), [1, 2, 2, 4, 0, 3])).max() < 1e-9
for part in (walls, block):
    assert cell_array(part, "Illuminance").max() > 0.0

# --- millimetres for metres -------------------------------------------------------------------------------
huge = simple.CADReader(FileName=sample("kiosk.stl"), UnitScale=1000.0)
with Messages() as messages:
    fetch(simple.SmokeLightField(Smoke=air, Surfaces=[huge], Emitters=[tunnel_sign()], PatchSize=1e4))
assert messages.count("Warning", "vtkSmokeLightField") == 1, messages.text
assert "millimetres" in messages.text
