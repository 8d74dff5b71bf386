"""Filters in parallel: the same bits for any number of processes, and one error for all of them.

mpiexec -np N pvbatch --symmetric filters_ranks.py PLUGIN DATA_FOLDER OUTPUT_FILE
pvpython filters_ranks.py PLUGIN DATA_FOLDER OUTPUT_FILE PORT, with a pvserver that listens there

Writes checksums of light field, image and maps to the output file, which the test compares.
"""
import hashlib
import os
import sys
import tempfile

import numpy
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy

TIME = 20.0  # s
PLUGIN, DATA, OUTPUT = sys.argv[1:4]
PORT = sys.argv[4] if len(sys.argv) > 4 else None


def build():
    run = simple.FDSSmokeReader(FileName=os.path.join(DATA, "Room", "fds", "room.smv"), FlameModel="None")
    building = simple.CADReader(FileName=os.path.join(DATA, "CAD", "kiosk.stl"), UnitScale=0.1,
                                Translation=[4.5, 0.8, 0.1])
    sign = simple.ExitSign(Center=[0.02, 1.2, 2], Pattern="Square")
    lamp = simple.Luminaire(Center=[4.8, 1.2, 2.39], Normal=[0, 0, -1], LuminousFlux=100)
    light = simple.SmokeLightField(
        Smoke=run, Surfaces=[simple.OutputPort(run, 1), building], Emitters=[sign, lamp], Albedo=0.5,
        Tolerance=0.5, PatchSize=2)
    image = simple.VisibilityImage(LightField=light, CameraPosition=[2.5, 1.2, 1.6], TargetSign=0,
                                   ImageSize=[24, 12])
    floor = simple.FloorMapOfVisibility(LightField=light, Resolution=[7, 5], EyeHeight=1.6)
    practice = simple.JinVisibility(LightField=light, FloorMap=floor)
    return light, image, floor, practice


def exr_pixels(path):
    """What follows the header of an OpenEXR file, which holds run times, and the table of places after it."""
    with open(path, "rb") as file:
        data = file.read()
    at = 8
    while data[at] != 0:  # entries: name, type, size, value
        at = data.index(b"\0", data.index(b"\0", at) + 1) + 1
        at += 4 + int.from_bytes(data[at:at + 4], "little")
    return data[int.from_bytes(data[at + 1:at + 9], "little"):]


def digest(data, lines, where):
    if data.IsA("vtkCompositeDataSet"):
        for i in range(data.GetNumberOfPartitionedDataSets()):
            for j in range(data.GetNumberOfPartitions(i)):
                digest(data.GetPartition(i, j), lines, "%s %d.%d" % (where, i, j))
        return
    for attributes in (data.GetCellData(), data.GetPointData()):
        for i in range(attributes.GetNumberOfArrays()):
            array = attributes.GetArray(i)
            if array is not None:
                values = numpy.ascontiguousarray(vtk_to_numpy(array))
                lines.append("%s %s %s" % (where, array.GetName(),
                                           hashlib.sha256(values.tobytes()).hexdigest()))


def check_server():
    """What a client gets of maps and image that several server processes made."""
    simple.Connect("localhost", int(PORT))
    assert servermanager.ActiveConnection.IsRemote()
    processes = servermanager.ActiveConnection.GetNumberOfDataPartitions()
    assert processes == 2, processes
    simple.LoadPlugin(PLUGIN, remote=True, ns=vars(simple))
    simple.LoadPlugin(PLUGIN, remote=False, ns=vars(simple))
    lines = []
    for name, proxy in zip(("image", "map", "practice"), build()[1:]):
        proxy.UpdatePipeline(TIME)
        # Shown and saved once, not once a process.
        assert proxy.GetDataInformation().GetNumberOfPoints() == (288 if name == "image" else 35)
        digest(servermanager.Fetch(proxy), lines, name)
    return lines


def check_ranks():
    from vtkmodules.vtkParallelCore import vtkMultiProcessController

    import scenes

    simple.LoadPlugin(PLUGIN, ns=vars(simple))
    controller = vtkMultiProcessController.GetGlobalController()
    rank, ranks = controller.GetLocalProcessId(), controller.GetNumberOfProcesses()
    lines = []
    filters = build()
    for name, proxy in zip(("light", "image", "map", "practice"), filters):
        algorithm = proxy.GetClientSideObject()
        algorithm.UpdateTimeStep(TIME, 0, 1, 0)
        data = algorithm.GetOutputDataObject(0)
        digest(data, lines, name)
        if name in ("light", "map"):
            what = data.GetFieldData().GetAbstractArray("WorkReportWhat")
            told = [what.GetValue(i) for i in range(what.GetNumberOfValues())]
            assert ("seconds of process 1" in told) == (ranks > 1), told
    # A view asks for pieces: every block is drawn once, and nothing is solved anew.
    light, image, floor, _ = (proxy.GetClientSideObject() for proxy in filters)
    starts = []
    floor.AddObserver("ProgressEvent", lambda caller, _: starts.append(caller.GetProgress()))
    for algorithm, what in ((light, "GetNumberOfCells"), (floor, "GetNumberOfPoints")):
        algorithm.UpdateTimeStep(TIME, 0, 1, 0)
        whole = getattr(algorithm.GetOutputDataObject(0), what)()
        algorithm.UpdateTimeStep(TIME, rank, ranks, 0)
        own = numpy.array([float(getattr(algorithm.GetOutputDataObject(0), what)())])
        total = numpy.zeros(1)
        result = numpy_to_vtk(total)
        controller.AllReduce(numpy_to_vtk(own), result, 2)
        assert vtk_to_numpy(result)[0] == whole, (algorithm.GetClassName(), own, whole)
    assert all(fraction in (0.0, 1.0) for fraction in starts), starts

    # Through time all processes walk together, and the first one writes the file.
    over_time = simple.VisibilityOverTime(FloorMap=filters[2], TimeRange=[18.5, 23.0])
    route = simple.RouteVisibility(
        LightField=filters[0], Route=simple.PolyLineSource(Points=[2.5, 1.2, 0, 0.5, 1.2, 0]), StartTime=20.5)
    for name, proxy in (("over", over_time), ("route", route)):
        algorithm = proxy.GetClientSideObject()
        algorithm.UpdateTimeStep(0.0, 0, 1, 0)
        assert algorithm.GetOutputDataObject(0).GetNumberOfPoints() == (35 if name == "over" else 5)
        digest(algorithm.GetOutputDataObject(0), lines, "time " + name)
    simple.SaveData(OUTPUT + ".nc", proxy=filters[2], TimeRange=[18.5, 23.0])
    filters[1].UpdatePipeline(TIME)
    simple.SaveData(OUTPUT + ".exr", proxy=filters[1])
    with scenes.Messages() as messages:
        try:
            simple.SaveData(os.path.join(OUTPUT + " is no folder", "image.exr"), proxy=filters[1])
        except RuntimeError:
            pass
    assert ("cannot be written" if rank == 0 else "another process") in messages.text, (rank, messages.text)
    if rank == 0:
        with open(OUTPUT + ".nc", "rb") as file:
            lines.append("time file %s" % hashlib.sha256(file.read()).hexdigest())
        lines.append("time image %s" % hashlib.sha256(exr_pixels(OUTPUT + ".exr")).hexdigest())

    # What one process lacks is an error for all, and nobody waits for it.
    with tempfile.TemporaryDirectory() as temporary:
        table = os.path.join(temporary, "signs.csv")
        if rank == 0:
            with open(table, "w") as file:
                file.write("id,cx,cy,cz,nx,ny,nz\n0,0.1,1.2,2,1,0,0\n")
        sign = simple.ExitSign(SignTable=table)
        smoke = simple.FindSource("FDSSmokeReader1")
        broken = simple.FloorMapOfVisibility(LightField=simple.SmokeLightField(
            Smoke=smoke, Emitters=[sign], Tolerance=0.5), Resolution=[2, 2])
        with scenes.Messages() as messages:
            broken.GetClientSideObject().UpdateTimeStep(TIME, 0, 1, 0)
        wanted = ("no such file" if rank > 0 else "another process") if ranks > 1 else ""
        assert wanted in messages.text, (rank, messages.text)
        assert broken.GetClientSideObject().GetOutputDataObject(0).GetNumberOfPoints() == (
            4 if ranks == 1 else 0)
    print("rank %d of %d: as expected" % (rank, ranks), flush=True)
    return lines if rank == 0 else None


sys.argv = sys.argv[:3]
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
found = check_server() if PORT else check_ranks()
if found:
    with open(OUTPUT, "w") as result_file:
        result_file.write("\n".join(sorted(found)) + "\n")
