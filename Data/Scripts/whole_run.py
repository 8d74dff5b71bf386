"""Maps every step of a run, on one machine or many. A job that was killed goes on where it stopped.

Usage: pvbatch whole_run.py PLUGIN OUTPUT_FOLDER [quick]
       mpiexec -np 4 --bind-to none pvbatch whole_run.py PLUGIN OUTPUT_FOLDER

Each step becomes map_SECONDS.vti. It is written under another name first: a file of that name is whole.
"""
import os
import sys

from paraview import servermanager, simple
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter

plugin, folder = sys.argv[1:3]
quick = "quick" in sys.argv[3:]  # rougher light and two steps, to see that all works
simple.LoadPlugin(plugin, ns=vars(simple))
os.makedirs(folder, exist_ok=True)
hall = os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "Hall")

run = simple.FDSSmokeReader(FileName=os.path.join(hall, "fds", "hall.smv"), FlameModel="None")
signs = simple.ExitSign(SignTable=os.path.join(hall, "signs.csv"))
light = simple.SmokeLightField(Smoke=run, Surfaces=[simple.OutputPort(run, 1)], Emitters=[signs],
                               Tolerance=0.5 if quick else 0.02)
floor = simple.FloorMapOfVisibility(LightField=light, Bounds=[0, 55, 0, 35, 0, 5], Resolution=[12, 8])

run.UpdatePipelineInformation()
steps = list(run.TimestepValues)[1::5] if quick else list(run.TimestepValues)
for step in steps:
    path = os.path.join(folder, f"map_{step:06.1f}.vti")
    if os.path.exists(path):
        print(f"{step:6.1f} s: kept", flush=True)
        continue
    floor.UpdatePipeline(step)
    # The processes of a parallel run work together; this one, which runs the script, gets the whole map.
    writer = vtkXMLImageDataWriter()
    writer.SetInputData(servermanager.Fetch(floor))
    writer.SetDataModeToBinary()
    writer.SetFileName(path + ".part")
    if not writer.Write():
        sys.exit(f"{path}.part cannot be written")
    os.replace(path + ".part", path)
    least, most = floor.PointData["Visibility"].GetRange()
    print(f"{step:6.1f} s: perceived contrast {least:.4f} to {most:.3f}", flush=True)
