"""Where does the map differ from today's practice, and why?

Usage: pvpython --force-offscreen-rendering jin.py PLUGIN OUTPUT_FOLDER [quick]
"""
import os
import sys

from paraview import simple

plugin, folder = sys.argv[1:3]
quick = "quick" in sys.argv[3:]  # rougher light, to see that all works
simple.LoadPlugin(plugin, ns=vars(simple))

import figures  # noqa: E402
import scene  # noqa: E402

os.makedirs(folder, exist_ok=True)
WHEN = 600.0  # s

smoke, signs = scene.read(), scene.signs()
tolerance = 0.5 if quick else 0.05
cases = {"dark": scene.light_field("Dark", smoke, [signs], Tolerance=tolerance)}
if not quick:
    cases["lit"] = scene.light_field("Lit", smoke, [signs, scene.normal_lamps()], Tolerance=tolerance)

pictures = {}
for lighting, light in cases.items():
    floor = scene.floor_map("Map, " + lighting, light)
    for factor, kind in ((3.0, "reflecting"), (8.0, "lit")):
        jin = simple.JinVisibility(LightField=light, FloorMap=floor, VisibilityFactor=factor)
        jin.UpdatePipeline(WHEN)
        fields = scene.output(jin).GetFieldData()
        names, counts = (fields.GetAbstractArray(name) for name in ("DifferenceNames", "JinDifferenceCount"))
        title = f"{lighting} hall, C = {factor:g} ({kind} signs)"
        print(title + ": " + ", ".join(
            f"{counts.GetValue(i)} {names.GetValue(i)}" for i in range(names.GetNumberOfValues())
            if counts.GetValue(i)))
        pictures[title] = scene.values(jin, "JinDifference")
figures.difference_figure(os.path.join(folder, "hall_jin.png"), pictures, f"{WHEN:g} s")
