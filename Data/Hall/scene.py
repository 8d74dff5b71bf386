"""The scene of the hall: smoke and walls from FDS, exit signs from a table, and two sets of lamps."""
import os

from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy

HERE = os.path.dirname(os.path.abspath(__file__))
RUN = os.path.join(HERE, "fds", "hall.smv")
SIGNS = os.path.join(HERE, "signs.csv")

# xmin, xmax, ymin, ymax, floor and ceiling of the hall [m]; the smoke's meshes reach 2.5 m farther.
HALL = [0.0, 55.0, 0.0, 35.0, 0.0, 5.0]
# xmin, xmax, ymin, ymax of the burning bed [m]
FIRE = [26.5, 28.5, 16.5, 18.5]


def read(name="Smoke", flames="None"):
    """The FDS run: its ports are the smoke, the walls, the devices' measurements and the 2-D slices. With
    flames="Heat Release" the smoke over the burning bed gives light, 0.05 lm per watt."""
    return simple.FDSSmokeReader(registrationName=name, FileName=RUN, FlameModel=flames)


def signs():
    return simple.ExitSign(registrationName="Exit signs", SignTable=SIGNS)


def lamps(name, across, along, size, flux):
    """Square lamps [m] of some luminous flux each [lm], evenly spaced under the ceiling, shining down."""
    width, depth = HALL[1] - HALL[0], HALL[3] - HALL[2]
    return simple.Luminaire(
        registrationName=name, Center=[HALL[0] + width / 2, HALL[2] + depth / 2, HALL[5] - 0.02],
        Normal=[0, 0, -1], Count=[across, along], Spacing=[width / across, depth / along],
        Width=size, Height=size, LuminousFlux=flux)


def emergency_lamps():
    return lamps("Emergency lamps", 6, 4, 0.3, 200.0)


def normal_lamps():
    return lamps("Normal lamps", 10, 6, 0.6, 3500.0)


def light_field(name, smoke, emitters, **properties):
    """The light of a scene. The reader's second port is the geometry."""
    reader = simple.FindSource("Smoke")
    return simple.SmokeLightField(
        registrationName=name, Smoke=smoke, Surfaces=[simple.OutputPort(reader, 1)],
        Emitters=emitters, **properties)


def floor_map(name, field):
    """A map of 12 x 8 standing places, eyes at 1.7 m."""
    return simple.FloorMapOfVisibility(
        registrationName=name, LightField=field, Bounds=HALL, Resolution=[12, 8], EyeHeight=1.7)


def output(proxy, port=0):
    """The VTK data behind a proxy (client and server are one process here)."""
    return proxy.GetClientSideObject().GetOutputDataObject(port)


def values(proxy, name):
    """A point array of an image as numpy array, a row a place."""
    return vtk_to_numpy(output(proxy).GetPointData().GetArray(name)).copy()


def work_report(proxy):
    """What a filter did and left out: (what, count, why)."""
    fields = output(proxy).GetFieldData()
    columns = [fields.GetAbstractArray("WorkReport" + name) for name in ("What", "Count", "Why")]
    return [tuple(column.GetValue(i) for column in columns)
            for i in range(columns[0].GetNumberOfValues())]
