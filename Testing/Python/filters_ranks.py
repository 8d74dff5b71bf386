"""Filters in parallel: the same bits for any number of processes, and one error for all of them.

mpiexec -np N pvbatch --symmetric filters_ranks.py PLUGIN DATA_FOLDER OUTPUT_FILE
pvpython filters_ranks.py PLUGIN DATA_FOLDER OUTPUT_FILE PORT, with a pvserver that listens there

Writes checksums of light field, image and maps to the output file, which the test compares.
"""
import hashlib
import os
import sys
import tempfile
import time
import traceback

import numpy
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import scenes  # noqa: E402

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
        Bands="RGB", Tolerance=0.5, PatchSize=2)
    image = simple.VisibilityImage(LightField=light, CameraPosition=[2.5, 1.2, 1.6], TargetSign=0,
                                   ImageSize=[80, 40])
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


def work_report(data):
    what, count = (data.GetFieldData().GetAbstractArray("WorkReport" + name) for name in ("What", "Count"))
    return {what.GetValue(i): count.GetValue(i) for i in range(what.GetNumberOfValues())}


def check_shares(told, ranks):
    """Sixteen batches of lines are dealt out; all processes together do the work of one."""
    for band in range(3):
        lines = told[f"band {band}: lines of a batch in all"]
        shares = [told.get(f"band {band}: lines of process {rank}", 16 * lines) / lines
                  for rank in range(ranks)]
        assert shares == [(16 + ranks - 1 - rank) // ranks for rank in range(ranks)], shares


def set_own(proxy, **values):
    """Sets properties of this process's filter."""
    for name, value in values.items():
        setattr(proxy, name, value)
    proxy.SMProxy.UpdateVTKObjects()


def check_abort(proxy, rank, ranks, lines):
    """An abort on the last process leaves all of them with the field they had, at once."""
    light = proxy.GetClientSideObject()
    before, after = [], []
    digest(light.GetOutputDataObject(0), before, "light")
    for share in (None, 0.05, 0.3):
        # Long enough to be stopped on its way.
        set_own(proxy, Seed=proxy.Seed + 1, Tolerance=0.01)
        stopped = []

        def stop(caller, _):
            if not stopped and caller.GetProgress() >= share:
                stopped.append(time.monotonic())
                caller.SetAbortExecute(1)

        tag = None
        if rank == ranks - 1:
            if share is None:
                light.SetAbortExecute(1)
            else:
                tag = light.AddObserver("ProgressEvent", stop)
        with scenes.Messages() as messages:
            light.UpdateTimeStep(TIME, 0, 1, 0)
        assert not messages.text, messages.text
        if tag is not None:
            # Half a second is promised; the machine that tests may be busy.
            assert stopped and time.monotonic() - stopped[0] < 5.0, (share, stopped)
            light.RemoveObserver(tag)
        light.SetAbortExecute(0)
        after = []
        digest(light.GetOutputDataObject(0), after, "light")
        assert after == before, (rank, share)
    set_own(proxy, Tolerance=0.5)
    fractions = []
    tag = light.AddObserver("ProgressEvent", lambda caller, _: fractions.append(caller.GetProgress()))
    light.UpdateTimeStep(TIME, 0, 1, 0)
    light.RemoveObserver(tag)
    assert fractions == sorted(fractions) and fractions[-1] == 1.0, fractions
    after = []
    digest(light.GetOutputDataObject(0), after, "light")
    assert after != before
    lines += ["after an abort " + line for line in after]


def check_disagreement(proxy, rank, ranks, lines):
    """Processes that were given different things to do say so, and none waits for the others."""
    light = proxy.GetClientSideObject()

    def check(name):
        with scenes.Messages() as messages:
            light.UpdateTimeStep(TIME, 0, 1, 0)
        said = "the processes were not given the same: %s differ" % name in messages.text
        assert said == (ranks > 1), (rank, messages.text)
        assert (light.GetOutputDataObject(0).GetNumberOfCells() == 0) == (ranks > 1)

    # Of the same size, or not: patches; a seed; smoke and a sign of other values in as many cells.
    for name, first, others in (("PatchSize", 0.9, 0.8), ("Seed", 7, 8)):
        usual = getattr(proxy, name)
        set_own(proxy, **{name: first if rank == 0 else others})
        check(name)
        set_own(proxy, **{name: usual})
    run, sign = simple.FindSource("FDSSmokeReader1"), simple.FindSource("ExitSign1")
    for name, source, values in (("Smoke", run, {"MassExtinctionCoefficient": 8000 + rank}),
                                 ("Emitters", sign, {"Luminance": 400 + rank})):
        usual = {key: getattr(source, key) for key in values}
        set_own(source, **values)
        check(name)
        set_own(source, **usual)
    light.UpdateTimeStep(TIME, 0, 1, 0)
    digest(light.GetOutputDataObject(0), lines, "after an error light")


def check_errors(rank, ranks):
    """What one process lacks, or cannot solve, is an error for all, and nobody waits for it."""
    smoke = simple.FindSource("FDSSmokeReader1")
    with tempfile.TemporaryDirectory() as temporary:
        # One process lacks a file, or has one with another number in it.
        for case in ("lacks", "dark"):
            table = os.path.join(temporary, case + ".csv")
            if rank == 0 or case == "dark":
                with open(table, "w") as file:
                    file.write("id,cx,cy,cz,nx,ny,nz,luminance\n0,0.1,1.2,2,1,0,0,%d\n" % (rank == 0))
            broken = simple.FloorMapOfVisibility(LightField=simple.SmokeLightField(
                Smoke=smoke, Emitters=[simple.ExitSign(SignTable=table)], Tolerance=0.5), Resolution=[2, 2])
            with scenes.Messages() as messages:
                broken.GetClientSideObject().UpdateTimeStep(TIME, 0, 1, 0)
            wanted = "Emitters differ" if case == "dark" else "no such file" if rank > 0 else "another process"
            wanted = wanted if ranks > 1 else ""
            assert wanted in messages.text, (rank, messages.text)
            assert broken.GetClientSideObject().GetOutputDataObject(0).GetNumberOfPoints() == (
                4 if ranks == 1 else 0)


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
        assert proxy.GetDataInformation().GetNumberOfPoints() == (3200 if name == "image" else 35)
        digest(servermanager.Fetch(proxy), lines, name)
    return lines


def check_ranks():
    from vtkmodules.vtkParallelCore import vtkMultiProcessController

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
        if name in ("light", "image", "map"):
            told = work_report(data)
            always = name == "image"
            assert [f"seconds of process {i}" in told for i in range(ranks)] == [ranks > 1 or always] * ranks, told
        if name == "light":
            check_shares(told, ranks)
        if name == "image":
            assert told["pixels"] == 3200 and 0 < told["pixels that are means of samples"] < 3200, told
            lines.append("after all, image means of samples %d" % told["pixels that are means of samples"])
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

    # One band is enough for the rest.
    set_own(filters[0], Bands="Luminance")

    # Through time all processes walk together, and the first one writes the file.
    over_time = simple.VisibilityOverTime(FloorMap=filters[2], TimeRange=[18.5, 21.0])
    route = simple.RouteVisibility(
        LightField=filters[0], Route=simple.PolyLineSource(Points=[2.5, 1.2, 0, 0.5, 1.2, 0]), StartTime=20.5)
    for name, proxy in (("over", over_time), ("route", route)):
        algorithm = proxy.GetClientSideObject()
        # One process gives up after a step: so do all.
        tag = algorithm.AddObserver(
            "ProgressEvent", lambda caller, _: caller.SetAbortExecute(1)) if rank == ranks - 1 else None
        algorithm.UpdateTimeStep(0.0, 0, 1, 0)
        assert algorithm.GetOutputDataObject(0).GetNumberOfPoints() == 0
        if tag is not None:
            algorithm.RemoveObserver(tag)
        algorithm.SetAbortExecute(0)
        algorithm.UpdateTimeStep(0.0, 0, 1, 0)
        assert algorithm.GetOutputDataObject(0).GetNumberOfPoints() == (35 if name == "over" else 5)
        digest(algorithm.GetOutputDataObject(0), lines, "time " + name)
    simple.SaveData(OUTPUT + ".nc", proxy=filters[2], TimeRange=[18.5, 21.0])
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

    check_abort(filters[0], rank, ranks, lines)
    check_disagreement(filters[0], rank, ranks, lines)
    check_errors(rank, ranks)
    print("rank %d of %d: as expected" % (rank, ranks), flush=True)
    return lines if rank == 0 else None


sys.argv = sys.argv[:3]
try:
    found = check_server() if PORT else check_ranks()
except Exception:
    # The other processes wait for this one, so that only its sudden end ends them all.
    traceback.print_exc()
    sys.stderr.flush()
    os._exit(1)
if found:
    with open(OUTPUT, "w") as result_file:
        result_file.write("\n".join(sorted(found)) + "\n")
