"""How far can signs be seen that satisfy three standards, in smoke of 0.3 per metre?

Usage: pvpython --force-offscreen-rendering compare_signs.py PLUGIN OUTPUT_FOLDER [quick]
"""
import os
import sys

from paraview import simple

plugin, folder = sys.argv[1:3]
tolerance = 0.5 if "quick" in sys.argv[3:] else 0.01
simple.LoadPlugin(plugin, ns=vars(simple))
os.makedirs(folder, exist_ok=True)
import room  # noqa: E402

smoke = room.smoke(layer=0.3, below=0.3)
for preset in ("EN 1838", "EN 1838 Smoke", "UL 924 Stencil"):
    light = simple.SmokeLightField(Smoke=smoke, Emitters=[room.sign(Preset=preset)], Tolerance=tolerance)
    # One row of places along the corridor, a quarter of a metre apart.
    floor = simple.FloorMapOfVisibility(LightField=light, Bounds=[0, 15, 1.5, 2.5, 0, 3], Resolution=[60, 1])
    floor.UpdatePipeline()
    data = floor.GetClientSideObject().GetOutputDataObject(0)
    seen = [data.GetPoint(i)[0] for i in range(60) if data.GetPointData().GetArray("Status").GetValue(i) == 0]
    print(f"{preset:15s} seen from {room.SIZE[0] - min(seen):5.2f} m" if seen else f"{preset:15s} not seen")
    simple.SaveData(os.path.join(folder, "along_" + preset.replace(" ", "_") + ".csv"), proxy=floor)
