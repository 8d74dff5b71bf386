"""A building from a CAD file, with what the file does not know from a table: paint, glass, lit signs.

Usage: pvpython --force-offscreen-rendering building_from_cad.py PLUGIN OUTPUT_FOLDER [quick]
"""
import os
import sys

from paraview import simple

plugin, folder = sys.argv[1:3]
tolerance = 0.5 if "quick" in sys.argv[3:] else 0.01
simple.LoadPlugin(plugin, ns=vars(simple))
os.makedirs(folder, exist_ok=True)
import room  # noqa: E402

cad = os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "CAD")

kiosk = simple.CADReader(FileName=os.path.join(cad, "kiosk.obj"), MaterialTable=os.path.join(cad, "materials.csv"),
                         Translation=[9, 0.5, 0])
kiosk.UpdatePipeline()
print("Metres a unit of the file:", room.number(kiosk, "UnitScale"))
# Its first output are the surfaces, its second what the table made luminous or a sign.
light = simple.SmokeLightField(
    Smoke=room.smoke(layer=0.4), Surfaces=[simple.OutputPort(kiosk, 0)],
    Emitters=[simple.OutputPort(kiosk, 1), room.sign(SignId=7)], Tolerance=tolerance)
floor = simple.FloorMapOfVisibility(LightField=light, Resolution=[32, 8])
floor.UpdatePipeline()
status = floor.GetClientSideObject().GetOutputDataObject(0).GetPointData().GetArray("Status")
hidden = sum(status.GetValue(i) == 2 for i in range(256))
print(f"From {hidden} of 256 places the building, or its back, hides all signs.")
simple.SaveData(os.path.join(folder, "kiosk_map.csv"), proxy=floor)
