"""Walks through the user guide in the real ParaView, as a script of its window: see run.sh.

Opens the hall, adds signs and lamps, and makes light field, image and floor map; goes to another time, saves the
state, starts afresh and loads it again. Pictures of the window go to the folder SMOKEVISIBILITY_WALK, and a file
"passed" there says that all went as it should.
"""
import ctypes
import os
import subprocess
import time
import traceback

from paraview import simple
from smokevisibility import display
from vtkmodules.util.numpy_support import vtk_to_numpy

DATA = os.environ["SMOKEVISIBILITY_DATA"]
FOLDER = os.environ["SMOKEVISIBILITY_WALK"]
TOLERANCE = float(os.environ.get("SMOKEVISIBILITY_TOLERANCE", "0.2"))
HALL = [0, 55, 0, 35, 0, 5]

# The script runs inside the window's event loop, which stands still meanwhile: let it turn.
qt = ctypes.CDLL("libQt5Core.so.5")
process_events = qt._ZN16QCoreApplication13processEventsE6QFlagsIN10QEventLoop17ProcessEventsFlagEE
process_events.argtypes = [ctypes.c_int]


def settle(seconds=1.0):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        process_events(0)
        time.sleep(0.02)


def picture(name, select=None):
    """The window as it is now, in few colours: a guide needs no more."""
    if select is not None:
        simple.SetActiveSource(select)
    simple.Render()
    settle()
    subprocess.run(["import", "-window", "root", "-trim", "+dither", "-colors", "64",
                    "-define", "png:compression-level=9", "PNG8:" + os.path.join(FOLDER, name + ".png")],
                   check=True)


def values(proxy, name):
    data = proxy.GetClientSideObject().GetOutputDataObject(0)
    return vtk_to_numpy(data.GetPointData().GetArray(name)).copy()


def look_down(view):
    view.CameraPosition = [27.5, -22, 48]
    view.CameraFocalPoint = [27.5, 15.5, 0]
    view.CameraViewUp = [0, 0, 1]


def walk():
    settle(2)
    view = simple.GetActiveViewOrCreate("RenderView")
    scene = simple.GetAnimationScene()

    run = simple.OpenDataFile(os.path.join(DATA, "Hall", "fds", "hall.smv"))
    run.UpdatePipeline(600.0)
    simple.RenameSource("Hall", run)
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.AnimationTime = 600.0
    shown = simple.Show(run, view)
    assert shown.Representation == "Smoke", shown.Representation
    shown.ExtinctionFactor = 0.2
    look_down(view)
    picture("1_smoke", run)

    signs = simple.ExitSign(registrationName="Exit signs",
                            SignTable=os.path.join(DATA, "Hall", "signs.csv"))
    display.show_signs(signs, view)
    lamps = simple.Luminaire(
        registrationName="Emergency lamps", Center=[27.5, 17.5, 4.98], Normal=[0, 0, -1],
        Count=[6, 4], Spacing=[9.2, 8.75], Width=0.3, Height=0.3, LuminousFlux=200)
    display.show_signs(lamps, view)
    picture("2_signs", signs)

    light = simple.SmokeLightField(
        registrationName="Light field", Smoke=run, Surfaces=[simple.OutputPort(run, 1)],
        Emitters=[signs, lamps], Tolerance=TOLERANCE)
    light.UpdatePipeline(600.0)
    picture("3_light_field", light)

    image = simple.VisibilityImage(registrationName="South west", LightField=light, TargetSign=0,
                                   CameraPosition=[13.5, 7, 1.7], Margin=0.25)
    layout = simple.GetLayout(view)
    flat = simple.CreateView("RenderView")
    layout.SplitHorizontal(0, 0.6)
    simple.AssignViewToLayout(flat, layout, 2)
    display.show_image(image, flat)
    picture("4_image", image)
    contrast = image.GetClientSideObject().GetOutputDataObject(0).GetFieldData().GetArray("PerceivedContrast")
    assert 0.0 <= contrast.GetValue(0) < 2.0

    simple.SetActiveView(view)
    floor = simple.FloorMapOfVisibility(registrationName="Floor map", LightField=light, Resolution=[22, 14],
                                        UseBox=1, BoxPosition=HALL[::2], BoxSize=HALL[1::2])
    floor.UpdatePipeline(600.0)
    simple.Hide(run, view)
    shown = simple.Show(floor, view)
    colors = list(simple.GetColorTransferFunction("Visibility").RGBPoints)
    assert list(shown.ColorArrayName) == ["POINTS", "Visibility"] and colors[-4:] == [1, 1, 1, 1], colors
    picture("5_box", floor)
    boxed = values(floor, "Visibility")
    floor.UseBox, floor.Bounds = 0, HALL
    floor.UpdatePipeline(600.0)
    display.show_map(floor, view)
    picture("5_map", floor)
    late = values(floor, "Visibility")
    assert (boxed == late).all(), "the box gives another map than the same bounds"

    scene.AnimationTime = 360.0
    simple.Render(view)
    picture("6_earlier", floor)
    early = values(floor, "Visibility")
    assert early.mean() > late.mean() + 0.05, (early.mean(), late.mean())

    state = os.path.join(FOLDER, "walk.pvsm")
    simple.SaveState(state)
    simple.ResetSession()
    settle()
    assert not simple.GetSources()
    simple.LoadState(state)
    settle()
    floor = simple.FindSource("Floor map")
    floor.UpdatePipeline(360.0)
    assert (values(floor, "Visibility") == early).all(), "the loaded state gives another map"
    picture("7_loaded", floor)


try:
    walk()
    open(os.path.join(FOLDER, "passed"), "w").close()
except Exception:
    # ParaView keeps what scripts print.
    with open(os.path.join(FOLDER, "failed"), "w") as file:
        traceback.print_exc(file=file)
settle(0.2)
# ParaView would go on and wait for its user.
os._exit(0)
