"""Opens hall.pvsm in a fresh process and checks that it gives the very same map again.

Usage: pvpython --force-offscreen-rendering check_state.py PLUGIN OUTPUT_FOLDER
"""
import os
import sys

import numpy
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy

plugin, folder = sys.argv[1:3]
simple.LoadPlugin(plugin, ns=vars(simple))

import scene  # noqa: E402

saved = simple.XMLImageDataReader(FileName=[os.path.join(folder, "hall_map.vti")])
saved.UpdatePipeline()
expected = scene.output(saved).GetPointData()

# The paths in the state are absolute. data_directory finds the same files elsewhere, for a state
# that was copied together with Data/Hall.
simple.LoadState(os.path.join(folder, "hall.pvsm"), data_directory=scene.HERE)
hall_map = simple.FindSource("Floor map")
hall_map.UpdatePipeline(600.0)
found = scene.output(hall_map).GetPointData()

different = []
for i in range(expected.GetNumberOfArrays()):
    name = expected.GetArrayName(i)
    array = found.GetArray(name)
    if array is None or not numpy.array_equal(
            vtk_to_numpy(array), vtk_to_numpy(expected.GetArray(i)), equal_nan=True):
        different.append(name)
if different or found.GetNumberOfArrays() != expected.GetNumberOfArrays():
    sys.exit(f"The map of the state file differs in: {', '.join(different) or 'its arrays'}")
print(f"hall.pvsm gives an identical map ({expected.GetNumberOfArrays()} arrays)")
