"""Uses the plugin where ParaView found it by itself: use_plugin.py PREFIX SAMPLE [OTHER_PLUGIN]"""

import os
import sys

from paraview import simple

prefix, sample = (os.path.realpath(path) for path in sys.argv[1:3])
# No LoadPlugin: PV_PLUGIN_PATH says where to look.
kiosk = simple.CADReader(FileName=sample)
kiosk.UpdatePipeline()
bounds = kiosk.GetDataInformation().GetBounds()
assert abs(bounds[5] - 3.0) < 1e-6, bounds
simple.ExitSign().UpdatePipeline()
with open("/proc/self/maps") as file:
    libraries = {line.split()[-1] for line in file if "libSmoke" in line or "SmokeVisibility.so" in line}
assert len(libraries) == 4, libraries
assert all(library.startswith(prefix + os.sep) for library in libraries), libraries

if len(sys.argv) > 3:
    simple.LoadPlugin(sys.argv[3], remote=False)
    other = simple.MillimetreReader(FileName=sample)
    other.UpdatePipeline()
    assert abs(other.GetDataInformation().GetBounds()[5] - 0.003) < 1e-9
print("The installed plugin works.")
