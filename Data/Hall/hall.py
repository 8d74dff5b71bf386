"""From where in a burning hall can an exit sign be seen?

Usage: pvpython --force-offscreen-rendering hall.py PLUGIN OUTPUT_FOLDER

Variants of the lighting, all with the eight exit signs lit:
  dark       the signs alone, the main case;
  emergency  and emergency lamps under the ceiling;
  lit        and the hall's normal lamps instead.
The dark hall comes without and with the light of the fire itself.
"""
import os
import resource
import sys
import time

import numpy
from paraview import simple
from vtkmodules.vtkFiltersCore import vtkCellCenters
from vtkmodules.util.numpy_support import vtk_to_numpy

plugin, folder = sys.argv[1:3]
simple.LoadPlugin(plugin, ns=vars(simple))

import figures  # noqa: E402
import scene  # noqa: E402

LAST = 600.0  # s, the main map's time
PARTLY = 360.0  # s, while the hall fills with smoke
TIMES = [60.0 * i for i in range(1, 11)]
# Looser than the default of 0.01, for the many maps; the summary says what that changes.
COARSE = 0.1
# Name, eye [m] and sign to look at: along the hall's width towards the sign "South west".
EYES = [("near", [13.5, 3.0, 1.7]), ("middle", [13.5, 7.0, 1.7]), ("far", [13.5, 12.0, 1.7])]
TARGET = 0

stages = {}


def path(name):
    return os.path.join(folder, name)


def run(stage, proxy, when):
    """Updates a proxy for a time and books what that took."""
    start = time.perf_counter()
    proxy.UpdatePipeline(when)
    stages[stage] = stages.get(stage, 0.0) + time.perf_counter() - start


def heading(text):
    print(f"\n{text}", flush=True)


def clear_floor(name, lamps):
    """Illuminance that signs and lamps make on the floor of the hall without smoke [lx]."""
    clear = simple.Calculator(
        Input=reader, AttributeType="Cell Data", ResultArrayName="Extinction",
        Function="0 * Extinction")
    field = scene.light_field("Clear " + name, clear, [signs, lamps], Tolerance=COARSE)
    run("clear floor", field, 0.0)
    walls = scene.output(field).GetPartitionedDataSet(1).GetPartition(0)
    centres = vtkCellCenters()
    centres.SetInputData(walls)
    centres.Update()
    x, y, z = vtk_to_numpy(centres.GetOutput().GetPoints().GetData()).T
    xmin, xmax, ymin, ymax, bottom, _ = scene.HALL
    floor = (x > xmin) & (x < xmax) & (y > ymin) & (y < ymax) & (abs(z - bottom) < 0.01)
    light = vtk_to_numpy(walls.GetCellData().GetArray("Illuminance"))[floor]
    count = lamps.Count[0] * lamps.Count[1]
    luminance = lamps.LuminousFlux / (numpy.pi * lamps.Width * lamps.Height)
    print(f"  {name:9s} {count} lamps of {lamps.Width:g} x {lamps.Height:g} m, "
          f"{lamps.LuminousFlux:g} lm, {luminance:.0f} cd/m2: "
          f"least {light.min():.2f} lx, mean {light.mean():.2f} lx, most {light.max():.2f} lx",
          flush=True)
    simple.Delete(field)
    simple.Delete(clear)


def describe(label, visibility, threshold=0.2):
    seen = visibility >= threshold
    print(f"  {label:26s} a sign is visible from {seen.sum():3d} of {seen.size} places "
          f"({100 * seen.mean():.0f} %), perceived contrast {visibility.min():.4f} to "
          f"{visibility.max():.3f}", flush=True)


# The pipeline of the main case: read, light field, map.
reader = scene.read()
run("read", reader, LAST)
signs = scene.signs()
dark = scene.light_field("Light of the dark hall", reader, [signs])
hall_map = scene.floor_map("Floor map", dark)

heading(f"Dark hall at {LAST:g} s")
run("light field", dark, LAST)
run("floor map", hall_map, LAST)
visibility = scene.values(hall_map, "Visibility")
describe("signs only", visibility)
simple.SaveData(path("hall_map.vti"), proxy=hall_map, DataMode="Binary")
with_places = simple.Calculator(Input=hall_map, ResultArrayName="Place", Function="coords")
simple.SaveData(path("hall_map.csv"), proxy=with_places)
simple.Delete(with_places)
figures.map_figure(path("hall_map.png"), visibility,
                   f"Dark hall, signs only, {LAST:g} s: perceived contrast of the best sign")

heading("Plain contrast (std / mean) stays high where nobody can see the sign any more:")
plain = scene.values(hall_map, "Contrast")
perceived = scene.values(hall_map, "PerceivedContrast")
arriving = scene.values(hall_map, "SignLuminance")
depth = scene.values(hall_map, "OpticalDepth")
best = scene.values(hall_map, "BestSign")
print("  place [m]        best sign  optical depth  luminance [cd/m2]  plain  perceived")
for column, row in ((2, 0), (2, 1), (2, 2), (3, 3), (5, 3), (5, 4)):
    place = row * 12 + column
    x, y, _ = scene.output(hall_map).GetPoint(place)
    sign = best[place]
    print(f"  ({x:5.2f}, {y:5.2f})  {sign:9d}  {depth[place]:13.2f}  {arriving[place, sign]:17.2e}"
          f"  {plain[place, sign]:5.3f}  {perceived[place, sign]:9.4f}")

heading(f"Three images of the sign {TARGET}, {LAST:g} s")
images = []
for name, eye in EYES:
    image = simple.VisibilityImage(
        registrationName=f"Image {name}", LightField=dark, CameraPosition=eye, TargetSign=TARGET,
        Margin=0.25, ImageSize=[256, 128])
    run("sign images", image, LAST)
    simple.SaveData(path(f"sign_{name}.exr"), proxy=image)
    fields = scene.output(image).GetFieldData()
    number = {key: fields.GetArray(key).GetValue(0) for key in (
        "Contrast", "PerceivedContrast", "LitLuminance", "UnlitLuminance", "OpticalDepthToSign")}
    luminance = scene.values(image, "Luminance").reshape(128, 256)
    distance = eye[1] - 0.05
    caption = (f"{name}: {distance:.2f} m away, lit bars {number['LitLuminance']:.3g} cd/m2, "
               f"contrast {number['Contrast']:.2f}, perceived {number['PerceivedContrast']:.2f}")
    print(f"  {caption}, between the bars {number['UnlitLuminance']:.3g} cd/m2, "
          f"optical depth {number['OpticalDepthToSign']:.2f}", flush=True)
    figures.sign_figure(path(f"sign_{name}.png"), luminance, caption)
    images.append(image)

work = [("light field", scene.work_report(dark)), ("floor map", scene.work_report(hall_map))]

# A view of the hall and the state file that opens all this in ParaView.
start = time.perf_counter()
figures.hall_view(path("hall_3d.png"), reader, signs, hall_map, LAST)
simple.SaveState(path("hall.pvsm"))
stages["3-D view and state"] = time.perf_counter() - start

# Side branches, made after the state was saved.
heading("Clear floor, no smoke")
emergency, normal = scene.emergency_lamps(), scene.normal_lamps()
clear_floor("emergency", emergency)
clear_floor("lit", normal)

heading("Dark hall, minute by minute")
dark_coarse = scene.light_field("Dark, coarse", reader, [signs], Tolerance=COARSE)
coarse_map = scene.floor_map("Dark map, coarse", dark_coarse)
strip = {}
for when in TIMES:
    run("time strip", coarse_map, when)
    strip[when] = scene.values(coarse_map, "Visibility")
    describe(f"{when:g} s", strip[when])
change = abs(strip[LAST] - visibility).max()
print(f"  at {LAST:g} s the tolerance of {COARSE:g} instead of {dark.Tolerance:g} changes "
      f"no contrast by more than {change:.1e}")
figures.strip_figure(path("hall_times.png"), strip)

heading("Dark, emergency and lit hall, and the light of the fire")
variants = {"dark (signs only)": {when: strip[when] for when in (PARTLY, LAST)}}
for name, lamps in (("emergency lamps", emergency), ("lit (normal lamps)", normal)):
    field = scene.light_field(name, reader, [signs, lamps], Tolerance=COARSE)
    variant_map = scene.floor_map("Map, " + name, field)
    variants[name] = {}
    for when in (PARTLY, LAST):
        run("lit variants", variant_map, when)
        variants[name][when] = scene.values(variant_map, "Visibility")
# The light of the fire: the same smoke, with the flames glowing.
burning = scene.read("Smoke and fire", "Heat Release")
glowing = scene.light_field("Light of the fire", burning, [signs], Tolerance=COARSE)
glowing_map = scene.floor_map("Map, light of the fire", glowing)
variants["with the fire's light"] = {}
for when in (PARTLY, LAST):
    run("fire's light", glowing_map, when)
    variants["with the fire's light"][when] = scene.values(glowing_map, "Visibility")
    fields = scene.output(burning).GetFieldData()
    heat, lumens, placed = (fields.GetArray(key).GetValue(0) for key in (
        "FlameHeatRelease", "FlameLumens", "FlameLumensPlaced"))
    print(f"  the fire at {when:g} s: {heat / 1e6:.2f} MW, {lumens:.0f} lm, of which {placed:.0f} lm "
          f"are given to smoke to emit", flush=True)
for name, maps in variants.items():
    for when, contrast in maps.items():
        describe(f"{name}, {when:g} s", contrast)
figures.variants_figure(path("hall_lighting.png"), variants)

heading("Work done and left out")
for stage, report in work:
    for what, count, why in report:
        print(f"  {stage}: {what}: {count:g} ({why})")

heading("Time of each stage [s]")
for stage, seconds in stages.items():
    print(f"  {stage:20s} {seconds:8.2f}")
print(f"  {'all':20s} {sum(stages.values()):8.2f}")
peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
print(f"Peak memory {peak:.0f} MiB")
print(f"Results in {folder}")
