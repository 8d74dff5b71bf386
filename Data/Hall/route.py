"""What does somebody see who walks from the middle of the burning hall to a door?

Usage: pvpython --force-offscreen-rendering route.py PLUGIN OUTPUT_FOLDER [quick]
"""
import os
import sys

from paraview import simple

plugin, folder = sys.argv[1:3]
quick = "quick" in sys.argv[3:]  # rougher light and fewer places, to see that all works
simple.LoadPlugin(plugin, ns=vars(simple))

import figures  # noqa: E402
import scene  # noqa: E402

os.makedirs(folder, exist_ok=True)

light = scene.light_field("Light", scene.read(), [scene.signs()], Tolerance=0.5 if quick else 0.05)
# On the floor, around the fire and to the door "South west".
way = simple.PolyLineSource(Points=[31.0, 22.0, 0.0, 23.0, 21.0, 0.0, 14.5, 4.0, 0.0, 13.5, 0.5, 0.0])
walks = {}
for start in (540.0,) if quick else (360.0, 480.0, 600.0):
    route = simple.RouteVisibility(
        LightField=light, Route=way, StartTime=start, SpeedLaw="Fridolf", SampleSpacing=3.0 if quick else 0.5)
    route.UpdatePipeline()
    fields = scene.output(route).GetFieldData()
    length, duration, dark, longest, loss = (fields.GetArray(name).GetValue(0) for name in (
        "RouteLength", "RouteTime", "InvisibleTime", "LongestInvisibleTime", "FirstLossDistance"))
    seen = f"lost after {loss:.1f} m, for {dark:.0f} s in all" if dark else "never lost"
    print(f"From {start:g} s: {length:.1f} m in {duration:.0f} s; all signs {seen}, {longest:.0f} s at a stretch")
    walks[start] = (scene.values(route, "Distance"), scene.values(route, "Visibility"),
                    scene.values(route, "Speed"))
figures.route_figure(os.path.join(folder, "hall_route.png"), walks)
