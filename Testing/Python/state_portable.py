"""States and scripts of every proxy: state_portable.py PLUGIN DATA_FOLDER

One process builds a pipeline of all proxies from files and saves it as a .pvsm state, as a Python state and as a
trace. Fresh processes open each, with the files in the same place, by paths relative to the working folder, and
copied elsewhere, where ParaView searches for them below a folder; all arrays are the same to the last bit.
"""
import hashlib
import json
import os
import shutil
import subprocess
import sys
import tempfile

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter

import scenes
from samples import IES, RESPONSE, png

TIME = 20.0  # s
PROXIES = {"FDSSmokeReader", "CADReader", "ExitSign", "Luminaire", "SmokeLightField", "VisibilityImage",
           "FloorMapOfVisibility", "JinVisibility", "VisibilityOverTime", "RouteVisibility"}


def leaves(data):
    if not data.IsA("vtkCompositeDataSet"):
        return [data]
    iterator = data.NewIterator()
    iterator.InitTraversal()
    found = []
    while not iterator.IsDoneWithTraversal():
        found.append(iterator.GetCurrentDataObject())
        iterator.GoToNextItem()
    return found


def digest(proxy):
    """How many arrays the outputs have, and a checksum of all of them."""
    sums, count = hashlib.sha256(), 0
    for port in range(proxy.GetNumberOfOutputPorts()):
        for leaf in leaves(proxy.GetClientSideObject().GetOutputDataObject(port)):
            for kind in range(leaf.NUMBER_OF_ATTRIBUTE_TYPES):
                attributes = leaf.GetAttributesAsFieldData(kind)
                for i in range(attributes.GetNumberOfArrays() if attributes else 0):
                    array = attributes.GetArray(i)
                    # How long the work took is no part of its result.
                    if array is not None and not array.GetName().startswith("WorkReport"):
                        sums.update(array.GetName().encode() + vtk_to_numpy(array).tobytes())
                        count += 1
    return "%d arrays, %s" % (count, sums.hexdigest())


def digests(simple):
    """By registration name, of all sources there are."""
    found = {}
    for (name, _), proxy in simple.GetSources().items():
        proxy.UpdatePipeline(TIME)
        found[name] = digest(proxy)
    return found


def copy_files(folder):
    """The files of the pipeline, each kind in a folder of its own."""
    os.makedirs(os.path.join(folder, "signs"))
    shutil.copytree(os.path.join(DATA, "Room", "fds"), os.path.join(folder, "run"))
    shutil.copytree(os.path.join(DATA, "CAD"), os.path.join(folder, "building"))
    for name, content in (("lamp.ies", IES.encode()), ("response.csv", RESPONSE.encode()),
                          ("picture.png", png()),
                          ("table.csv", b"id,cx,cy,cz,nx,ny,nz,width,height\n3,3,0.01,2,0,1,0,0.4,0.2\n")):
        with open(os.path.join(folder, "signs", name), "wb") as file:
            file.write(content)
    os.makedirs(os.path.join(folder, "smoke"))
    writer = vtkXMLImageDataWriter()
    writer.SetDataModeToBinary()
    for name, extinction in (("thin.vti", 0.2), ("thick.vti", 1.5)):
        writer.SetFileName(os.path.join(folder, "smoke", name))
        writer.SetInputData(scenes.image((4, 2, 2), (6.4, 2.4, 2.4), extinction))
        writer.Write()


def build(simple, folder):
    def path(*names):
        return os.path.join(folder, *names)

    # The run's own smoke would take long for so small a question.
    smoke = simple.XMLImageDataReader(
        registrationName="Smoke", FileName=[path("smoke", name) for name in ("thin.vti", "thick.vti")])
    run = simple.FDSSmokeReader(registrationName="Run", FileName=path("run", "room.smv"),
                                FlameModel="None", TimeInterpolation="Linear")
    building = simple.CADReader(
        registrationName="Building", FileName=path("building", "kiosk.obj"), UnitScale=0.2,
        Translation=[4.5, 0.8, 0.1], MaterialTable=path("building", "materials.csv"))
    table = simple.ExitSign(registrationName="Table of signs", SignTable=path("signs", "table.csv"))
    picture = simple.ExitSign(registrationName="Sign with a picture", Center=[0.01, 1.2, 1.5],
                              Pattern="Image", PatternFile=path("signs", "picture.png"), SignId=5)
    text = simple.ExitSign(registrationName="Sign with letters", Center=[6.39, 1.8, 2], SignId=7,
                           Normal=[-1, 0, 0], Pattern="Text", Text="A & B",
                           Luminance=120, Color=[0.1, 1, 0.2])
    lamps = simple.Luminaire(registrationName="Lamps", Center=[1.6, 1.2, 2.39], Normal=[0, 0, -1],
                             PhotometricFile=path("signs", "lamp.ies"), Count=[2, 1], Spacing=[1, 1])
    light = simple.SmokeLightField(
        registrationName="Light", Smoke=smoke, Tolerance=0.5, PatchSize=3, Seed=3, Albedo=0,
        Surfaces=[simple.OutputPort(run, 1), simple.OutputPort(building, 0)],
        Emitters=[table, picture, text, lamps])
    simple.VisibilityImage(
        registrationName="Image", LightField=light, CameraPosition=[1.5, 1.2, 1.5], TargetSign=5,
        Margin=0.2, ImageSize=[16, 8], ResponseFile=path("signs", "response.csv"))
    floor = simple.FloorMapOfVisibility(registrationName="Map", LightField=light, Resolution=[4, 3],
                                        EyeHeight=1.6, ContrastThreshold=0.25)
    simple.JinVisibility(registrationName="Practice", LightField=light, FloorMap=floor)
    simple.VisibilityOverTime(registrationName="Over time", FloorMap=floor, TimeRange=[0, 1])
    way = simple.Line(registrationName="Way", Point1=[2.5, 1.2, 0], Point2=[1, 1.2, 0], Resolution=2)
    simple.RouteVisibility(registrationName="Walk", LightField=light, Route=way, SpeedLaw="Fridolf",
                           SampleSpacing=1, StartTime=0.25)
    assert {proxy.GetXMLName() for proxy in simple.GetSources().values()} >= PROXIES


def run_script(path):
    with open(path) as file:
        exec(compile(file.read(), path, "exec"), {"__name__": "__main__"})


def open_one(simple, how, path, folder, result):
    if how == "state":
        simple.LoadState(path)
    elif how == "searched":
        simple.LoadState(path, data_directory=folder, restrict_to_data_directory=True)
    else:
        run_script(path)
    with open(result, "w") as file:
        json.dump(digests(simple), file)


def fresh_process(how, path, folder="-", where=None):
    """What a process that knows nothing but a file and a folder makes of it."""
    result = path + "." + how + ".json"
    subprocess.run([shutil.which("pvpython"), "--force-offscreen-rendering", os.path.abspath(__file__),
                    os.path.abspath(sys.argv[1]), DATA, how, path, folder, result],
                   check=True, cwd=where)
    with open(result) as file:
        return json.load(file)


DATA = os.path.abspath(sys.argv[2])
paraview = scenes.load_plugin()
if len(sys.argv) > 3:
    open_one(paraview, *sys.argv[3:])
    sys.exit(0)

from paraview import smstate, smtrace  # noqa: E402

with tempfile.TemporaryDirectory() as temporary:
    here, there = (os.path.join(temporary, name) for name in ("here", "there"))
    copy_files(here)
    smtrace.start_trace()
    build(paraview, here)
    trace = smtrace.stop_trace()
    expected = digests(paraview)
    assert len(expected) == 14 and all(not text.startswith("0 ") for text in expected.values()), expected

    def write(name, content):
        with open(os.path.join(temporary, name), "w") as file:
            file.write(content)
        return os.path.join(temporary, name)

    state = os.path.join(temporary, "all.pvsm")
    paraview.SaveState(state)
    script = write("state.py", smstate.get_state())
    traced = write("trace.py", trace)
    with open(state) as opened:
        text = opened.read()
    assert text.count(here) >= 9, text.count(here)
    relative = write("relative.pvsm", text.replace(here + "/", ""))

    def same(what, found):
        assert found == expected, (what, {
            name: (found.get(name), value) for name, value in expected.items()
            if found.get(name) != value})

    same("state", fresh_process("state", state))
    same("Python state", fresh_process("script", script))
    same("trace", fresh_process("script", traced))
    os.rename(here, there)
    same("relative paths", fresh_process("state", relative, where=there))
    same("search files under", fresh_process("searched", state, there))
print("portable states: passed")
