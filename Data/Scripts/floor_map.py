"""From where in the hall can an exit sign be seen? The shortest way from a run of FDS to a table of places.

Usage: pvpython --force-offscreen-rendering floor_map.py PLUGIN OUTPUT_FOLDER [quick]
"""
import os
import sys

from paraview import simple

plugin, folder = sys.argv[1:3]
tolerance = 0.5 if "quick" in sys.argv[3:] else 0.01
simple.LoadPlugin(plugin, ns=vars(simple))
os.makedirs(folder, exist_ok=True)
hall = os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "Hall")

run = simple.FDSSmokeReader(FileName=os.path.join(hall, "fds", "hall.smv"), FlameModel="None")
signs = simple.ExitSign(SignTable=os.path.join(hall, "signs.csv"))
# The reader's first output is the smoke, its second the walls.
light = simple.SmokeLightField(Smoke=run, Surfaces=[simple.OutputPort(run, 1)], Emitters=[signs],
                               Tolerance=tolerance)
floor = simple.FloorMapOfVisibility(LightField=light, Bounds=[0, 55, 0, 35, 0, 5], Resolution=[12, 8])
floor.UpdatePipeline(600.0)  # s

least, most = floor.PointData["Visibility"].GetRange()
print(f"Perceived contrast of the best sign: {least:.4f} to {most:.3f}; below 0.2 it is not seen.")
simple.SaveData(os.path.join(folder, "floor_map.csv"), proxy=floor)
simple.SaveData(os.path.join(folder, "floor_map.vti"), proxy=floor, DataMode="Binary")
