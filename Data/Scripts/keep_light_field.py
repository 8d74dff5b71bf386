"""A light field takes long, views of it are cheap: solve it once, save it, and look at it later.

Usage: pvpython --force-offscreen-rendering keep_light_field.py PLUGIN OUTPUT_FOLDER [quick]
"""
import os
import sys

from paraview import simple

plugin, folder = sys.argv[1:3]
tolerance = 0.5 if "quick" in sys.argv[3:] else 0.01
simple.LoadPlugin(plugin, ns=vars(simple))
os.makedirs(folder, exist_ok=True)
import room  # noqa: E402

path = os.path.join(folder, "light.vtpc")
if not os.path.exists(path):
    light = simple.SmokeLightField(Smoke=room.smoke(layer=1.0, below=0.2), Emitters=[room.sign()], Tolerance=tolerance)
    # Binary: ParaView of Debian 12 stumbles over files with raw appended data.
    simple.SaveData(path, proxy=light, DataMode="Binary")

saved = simple.XMLPartitionedDatasetCollectionReader(FileName=[path])
for threshold in (0.1, 0.2, 0.3):
    floor = simple.FloorMapOfVisibility(LightField=saved, Resolution=[32, 8], ContrastThreshold=threshold)
    floor.UpdatePipeline()
    status = floor.GetClientSideObject().GetOutputDataObject(0).GetPointData().GetArray("Status")
    seen = sum(status.GetValue(i) == 0 for i in range(256)) / 2.56
    print(f"With a threshold of {threshold:g} the sign is seen from {seen:.0f} % of the floor")
