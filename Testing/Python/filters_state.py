"""A state file that is loaded by a fresh process gives the same floor map to the last bit."""
import os
import shutil
import subprocess
import sys
import tempfile

import numpy
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter, vtkXMLPolyDataWriter

import scenes
from scenes import fetch, point_array

simple = scenes.load_plugin()
PROPERTIES = dict(EyeHeight=0.6, Resolution=[6, 3], Bounds=[0, 4, 0, 1, 0, 1], DarkLuminance=0.02,
                  ContrastThreshold=0.3, CutOff=0.001, Acuity=2.0)


def arrays(floor):
    data = fetch(floor)
    points = data.GetPointData()
    return {points.GetArrayName(i): point_array(data, points.GetArrayName(i))
            for i in range(points.GetNumberOfArrays())}


def write(data, writer, path):
    writer.SetInputData(data)
    writer.SetFileName(path)
    writer.SetDataModeToBinary()
    writer.Write()


def save(folder):
    """Builds a pipeline from files, saves its state, and returns its floor map."""
    smoke, walls = [os.path.join(folder, name) for name in ("smoke.vti", "walls.vtp")]
    write(scenes.image((20, 5, 5), (4.0, 1.0, 1.0), 1.2), vtkXMLImageDataWriter(), smoke)
    write(scenes.box((4.0, 1.0, 1.0), 0.2), vtkXMLPolyDataWriter(), walls)
    light = simple.SmokeLightField(
        Smoke=simple.XMLImageDataReader(FileName=[smoke]),
        Surfaces=[simple.XMLPolyDataReader(FileName=[walls])],
        Emitters=[scenes.tunnel_sign(Bars=5, SignId=2),
                  simple.ExitSign(Center=[2, 1, 0.6], Normal=[0, -1, 0], Width=0.4, Height=0.2,
                                  Pattern="Square", SquareFraction=0.7, SignId=5),
                  simple.Luminaire(Center=[1, 0.5, 1], Count=[2, 1], Spacing=[1.5, 1],
                                   LuminousFlux=5)],
        Albedo=0.8, Tolerance=0.03, Seed=7, PatchSize=0.2, DefaultReflectance=0.4)
    floor = simple.FloorMapOfVisibility(LightField=light, registrationName="Floor", **PROPERTIES)
    result = arrays(floor)
    simple.SaveState(os.path.join(folder, "scene.pvsm"))
    return result


def load(state, result):
    simple.LoadState(state)
    floor = simple.FindSource("Floor")
    for name, value in PROPERTIES.items():
        loaded = floor.GetPropertyValue(name)
        assert numpy.allclose(numpy.array(loaded, float), value), (name, loaded)
    numpy.savez(result, **arrays(floor))


if len(sys.argv) > 4:
    load(sys.argv[3], sys.argv[4])
    sys.exit(0)
with tempfile.TemporaryDirectory() as temporary:
    expected = save(temporary)
    target = os.path.join(temporary, "map.npz")
    subprocess.run([shutil.which("pvpython"), "--force-offscreen-rendering", __file__, sys.argv[1],
                    "-", os.path.join(temporary, "scene.pvsm"), target], check=True)
    loaded_map = numpy.load(target)
    assert set(loaded_map.files) == set(expected) and len(expected) == 13, loaded_map.files
    for key, array in expected.items():
        assert numpy.array_equal(loaded_map[key], array), key
    assert expected["Visibility"].max() > 0.1
print("state file: passed")
