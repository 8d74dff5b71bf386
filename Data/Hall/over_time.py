"""How long can an exit sign be seen from each place of the hall?

Usage: pvpython --force-offscreen-rendering over_time.py PLUGIN OUTPUT_FOLDER [quick]
"""
import os
import sys

import numpy
from paraview import simple

plugin, folder = sys.argv[1:3]
quick = "quick" in sys.argv[3:]  # fewer steps and rougher light, to see that all works
simple.LoadPlugin(plugin, ns=vars(simple))

import figures  # noqa: E402
import scene  # noqa: E402

os.makedirs(folder, exist_ok=True)

# The run's steps are a minute apart; the map has them all, and so has what follows it.
smoke = scene.read()
light = scene.light_field("Light", smoke, [scene.signs()], Tolerance=0.5 if quick else 0.05)
floor = scene.floor_map("Map", light)
over_time = simple.VisibilityOverTime(FloorMap=floor)
if quick:
    over_time.TimeRange = [400.0, 600.0]
    over_time.Stride = 3
over_time.UpdatePipeline()

available, interval, outcome, last = (scene.values(over_time, name) for name in (
    "AvailableTime", "AvailableTimeInterval", "Outcome", "LastSign"))
fields = scene.output(over_time).GetFieldData()
first, end = (fields.GetArray("TimeRange").GetValue(i) for i in range(2))
print(f"{fields.GetArray('TimeSteps').GetValue(0):.0f} steps from {first:g} to {end:g} s")
names = fields.GetAbstractArray("OutcomeNames")
for i in range(names.GetNumberOfValues()):
    print(f"  {names.GetValue(i):16s} {(outcome == i).sum():3d} of {outcome.size} places")
lost = numpy.flatnonzero(outcome == 1)
if lost.size:
    place = lost[numpy.argmin(available[lost])]
    x, y, _ = scene.output(over_time).GetPoint(place)
    sign = scene.output(over_time).GetFieldData().GetAbstractArray("SignNames").GetValue(last[place])
    print(f"The first place to lose all signs is ({x:.1f}, {y:.1f}), at {available[place]:.0f} s, known from steps "
          f"{interval[place]:.0f} s apart. The last sign seen is '{sign}'.")
figures.time_figure(os.path.join(folder, "hall_available_time.png"), available, outcome, end)

# For an evacuation model: all maps in one file, and as a table.
if not quick:
    simple.SaveData(os.path.join(folder, "hall_map.nc"), proxy=floor, Table=1)
