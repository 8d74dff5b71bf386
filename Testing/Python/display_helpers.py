"""What smokevisibility.display shows, and the macros that call it: display_helpers.py PLUGIN DATA_FOLDER"""
import os
import sys

import scenes
from smokevisibility import display

simple = scenes.load_plugin()
MACROS = os.path.join(sys.argv[2], os.pardir, "Plugin", "Macros")


def macro(name):
    path = os.path.join(MACROS, name)
    with open(path) as file:
        exec(compile(file.read(), path, "exec"), {"__name__": "__main__"})


view = simple.CreateView("RenderView")
light = scenes.tunnel((8, 2, 2), sign=scenes.tunnel_sign(SignId=3), Tolerance=0.2)
floor = simple.FloorMapOfVisibility(LightField=light, Resolution=[4, 2], EyeHeight=0.5)

# The sign picker: ids and names, of a light field as of a table.
assert display.signs(light) == [(3, "Sign 3")], display.signs(light)
table = simple.ExitSign(SignTable=os.path.join(sys.argv[2], "Hall", "signs.csv"))
assert display.signs(table)[:2] == [(0, "South west"), (1, "South east")] and len(display.signs(table)) == 8
simple.SetActiveSource(table)
macro("list_signs.py")

# The map: flat, in its colours, whatever the range of its values.
simple.SetActiveSource(floor)
macro("show_map.py")
shown = simple.GetDisplayProperties(floor, view)
assert shown.Representation == "Surface" and shown.Ambient == 1.0 and shown.Diffuse == 0.0
assert shown.ColorArrayName[1] == "Visibility"
points = list(simple.GetColorTransferFunction("Visibility").RGBPoints)
assert points[0] == 0.0 and points[-4] == 1.0 and points[4] == 0.2, points
bounds = floor.GetDataInformation().GetBounds()
assert bounds[4] == bounds[5] == 0.5, bounds

# Signs by their luminance, smoke as a volume, the image in grey.
assert display.show_signs(table, view).ColorArrayName[1] == "Luminance"
run = simple.FDSSmokeReader(FileName=os.path.join(sys.argv[2], "Room", "fds", "room.smv"))
run.UpdatePipeline(20.0)
volume = display.show_smoke(run, view)
assert volume.Representation == "Smoke" and volume.ExtinctionFactor == 1
assert display.show_smoke(run, view, 0.5) is volume or volume.ExtinctionFactor == 0.5
own = scenes.producer(scenes.image((4, 4, 4), (1, 1, 1)), "Own smoke")
simple.Show(own, view)
assert display.show_smoke(own, view).Representation == "Smoke"
assert sum(getattr(shown, "Input", None) == own for shown in view.Representations) == 1
image = simple.VisibilityImage(LightField=light, ImageSize=[8, 8], CameraPosition=[1, 0.5, 0.5], TargetSign=3)
flat = simple.CreateView("RenderView")
assert display.show_image(image, flat).ColorArrayName[1] == "Luminance"

# The camera of a view.
simple.SetActiveView(view)
view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [0.5, 0.25, 0.75], [3, 0.5, 0.5], [0, 0, 1]
simple.SetActiveSource(image)
macro("camera_from_view.py")
assert list(image.CameraPosition) == [0.5, 0.25, 0.75] and list(image.CameraFocalPoint) == [3, 0.5, 0.5]
assert image.TargetSign == -1
scenes.fetch(image)
try:
    display.camera_from_view(floor, view)
    raise AssertionError("a map has no camera")
except RuntimeError as error:
    assert "Visibility Image" in str(error)
print("display: passed")
