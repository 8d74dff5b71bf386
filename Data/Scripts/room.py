"""Smoke made by hand, for scripts that need no run of FDS: a corridor of 16 x 4 x 3 m with a layer under its ceiling."""
import numpy
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData

SIZE = (16.0, 4.0, 3.0)  # m
CELLS = (32, 8, 12)


def smoke(layer, below=0.0, height=1.8, name="Smoke"):
    """Extinction [1/m] in the layer, which begins at a height [m], and below it."""
    z = (numpy.arange(CELLS[2]) + 0.5) * SIZE[2] / CELLS[2]
    extinction = numpy.repeat(numpy.where(z > height, layer, below), CELLS[0] * CELLS[1])  # x fastest
    image = vtkImageData()
    image.SetDimensions([n + 1 for n in CELLS])
    image.SetSpacing([s / n for s, n in zip(SIZE, CELLS)])
    array = numpy_to_vtk(extinction, deep=True)
    array.SetName("Extinction")
    image.GetCellData().AddArray(array)
    source = simple.TrivialProducer(registrationName=name)
    source.GetClientSideObject().SetOutput(image)
    return source


def sign(**properties):
    """An exit sign over the door at the corridor's far end, facing whoever comes along."""
    settings = dict(Center=[SIZE[0] - 0.05, SIZE[1] / 2, 2.2], Normal=[-1, 0, 0], Width=0.6, Height=0.3)
    return simple.ExitSign(**{**settings, **properties})


def number(proxy, name):
    """A number of the field data, such as PerceivedContrast."""
    return proxy.GetClientSideObject().GetOutputDataObject(0).GetFieldData().GetArray(name).GetValue(0)
