"""Smoke of your own: any image or grid with an Extinction [1/m] will do. Here a layer that sinks.

Usage: pvpython --force-offscreen-rendering own_smoke.py PLUGIN OUTPUT_FOLDER [quick]
"""
import os
import sys

from paraview import simple

plugin, folder = sys.argv[1:3]
tolerance = 0.5 if "quick" in sys.argv[3:] else 0.01
simple.LoadPlugin(plugin, ns=vars(simple))
os.makedirs(folder, exist_ok=True)
import room  # noqa: E402

for height in (2.4, 2.0, 1.6, 1.2):  # m, of the layer's lower side
    light = simple.SmokeLightField(Smoke=room.smoke(layer=1.5, height=height), Emitters=[room.sign()],
                                   Tolerance=tolerance)
    seen = {}
    for eye in (1.7, 0.8):  # m, upright and crouching
        floor = simple.FloorMapOfVisibility(LightField=light, Resolution=[32, 8], EyeHeight=eye)
        floor.UpdatePipeline()
        status = floor.GetClientSideObject().GetOutputDataObject(0).GetPointData().GetArray("Status")
        seen[eye] = sum(status.GetValue(i) == 0 for i in range(256)) / 2.56
    print(f"Layer above {height:g} m: the sign is seen from {seen[1.7]:3.0f} % of the floor upright, "
          f"{seen[0.8]:3.0f} % crouching")
