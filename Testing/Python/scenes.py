"""What the tests that run under pvpython share: the plugin, small scenes, and checks of messages."""
import os
import re
import sys

import numpy
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkPoints, vtkStringOutputWindow
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkPolyData


def load_plugin():
    """Loads the plugin that the first argument names; its proxies are then in paraview.simple."""
    simple.LoadPlugin(os.path.abspath(sys.argv[1]), remote=False)
    return simple


def producer(data, name):
    """A pipeline source that holds a data object."""
    source = simple.TrivialProducer(registrationName=name)
    source.GetClientSideObject().SetOutput(data)
    source.UpdatePipeline()
    return source


def add_cells(data, name, values):
    array = numpy_to_vtk(numpy.ascontiguousarray(values), deep=True)
    array.SetName(name)
    data.GetCellData().AddArray(array)


def image(cells, size, extinction=1.0, origin=(0.0, 0.0, 0.0)):
    """An image of so many cells over a box of a size [m], with one extinction [1/m]."""
    data = vtkImageData()
    data.SetOrigin(origin)
    data.SetDimensions([n + 1 for n in cells])
    data.SetSpacing([s / n for s, n in zip(size, cells)])
    add_cells(data, "Extinction", numpy.full(int(numpy.prod(cells)), float(extinction)))
    return data


def smoke_over_time(times, extinctions, cells, size):
    """A source of an image with time steps; its extinction is the same everywhere at each of them [1/m]."""
    source = simple.ProgrammableSource(OutputDataSetType="vtkImageData")
    source.ScriptRequestInformation = f"""
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline
info = self.GetOutputInformation(0)
info.Set(Pipeline.TIME_STEPS(), {list(times)}, {len(times)})
info.Set(Pipeline.TIME_RANGE(), [{times[0]}, {times[-1]}], 2)
info.Set(Pipeline.WHOLE_EXTENT(), [0, {cells[0]}, 0, {cells[1]}, 0, {cells[2]}], 6)
"""
    # ParaView runs the script among the test's own globals, with NumPy's names in place of Python's.
    source.Script = f"""
import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline


def fill_smoke(image, time):
    times = numpy.array({list(times)})
    step = int(numpy.argmin(numpy.abs(times - time)))
    image.SetDimensions({[n + 1 for n in cells]})
    image.SetSpacing({[s / n for s, n in zip(size, cells)]})
    extinction = numpy_to_vtk(numpy.full({int(numpy.prod(cells))}, {list(extinctions)}[step]), deep=True)
    extinction.SetName("Extinction")
    image.GetCellData().AddArray(extinction)
    image.GetInformation().Set(image.DATA_TIME_STEP(), times[step])


fill_smoke(self.GetImageDataOutput(), self.GetOutputInformation(0).Get(Pipeline.UPDATE_TIME_STEP()))
"""
    return source


def box(size, reflectance, origin=(0.0, 0.0, 0.0), inwards=True):
    """The six walls of a box as quads, with their fronts inwards or outwards."""
    points = vtkPoints()
    points.SetDataTypeToDouble()
    for corner in range(8):
        points.InsertNextPoint([origin[a] + size[a] * (corner >> a & 1) for a in range(3)])
    outwards = [(0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)]
    polys = vtkCellArray()
    for quad in outwards:
        polys.InsertNextCell(4)
        for corner in reversed(quad) if inwards else quad:
            polys.InsertCellPoint(corner)
    data = vtkPolyData()
    data.SetPoints(points)
    data.SetPolys(polys)
    add_cells(data, "Reflectance", numpy.full(6, float(reflectance)))
    return data


def tunnel_sign(**properties):
    """The bar code of the tunnel, flush on its far wall."""
    settings = dict(Center=[4.0, 0.5, 0.5], Normal=[-1.0, 0.0, 0.0], Width=0.3, Height=0.3,
                    Pattern="Barcode", Bars=9, Luminance=1.0)
    settings.update(properties)
    return simple.ExitSign(**settings)


def tunnel(cells=(40, 10, 10), extinction=1.0, sign=None, **properties):
    """Light field of the tunnel, 4 x 1 x 1 m, of Zhang and Rubini's experiment."""
    settings = dict(Albedo=0.9)
    settings.update(properties)
    smoke = producer(image(cells, (4.0, 1.0, 1.0), extinction), "TunnelSmoke")
    walls = producer(box((4.0, 1.0, 1.0), 0.2), "TunnelWalls")
    return simple.SmokeLightField(
        Smoke=smoke, Surfaces=[walls], Emitters=[sign or tunnel_sign()], **settings)


def fetch(proxy):
    """The output of a pipeline object, up to date."""
    proxy.UpdatePipeline()
    return proxy.GetClientSideObject().GetOutputDataObject(0)


def point_array(data, name):
    return vtk_to_numpy(data.GetPointData().GetArray(name))


def cell_array(data, name):
    return vtk_to_numpy(data.GetCellData().GetArray(name))


def field(data, name):
    """A number of the field data."""
    array = data.GetFieldData().GetArray(name)
    assert array is not None, name + " is missing from the field data"
    return array.GetComponent(0, 0)


def work_done(data, what):
    """A row of the work report: how many, and why."""
    names, counts, reasons = (data.GetFieldData().GetAbstractArray("WorkReport" + part)
                              for part in ("What", "Count", "Why"))
    for i in range(names.GetNumberOfValues()):
        if names.GetValue(i) == what:
            return counts.GetValue(i), reasons.GetValue(i)
    raise AssertionError(f"the work report does not tell of {what}")


class Messages:
    """Collects VTK's errors and warnings instead of printing them."""

    def __enter__(self):
        self.before = vtkOutputWindow.GetInstance()
        self.window = vtkStringOutputWindow()
        vtkOutputWindow.SetInstance(self.window)
        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
        return self

    def __exit__(self, *_):
        vtkOutputWindow.SetInstance(self.before)
        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_ERROR)
        self.text = self.window.GetOutput()
        if isinstance(self.text, bytes):  # A message that quotes a damaged file.
            self.text = self.text.decode("utf-8", "replace")

    def count(self, kind, class_name):
        """Messages of a kind, "ERROR" or "Warning", that objects of a class gave."""
        return len(re.findall(kind + r": In .*\n" + class_name + r" \(", self.text))


def check_close(what, value, expected, relative=0.0, absolute=0.0):
    limit = absolute + relative * abs(expected)
    assert abs(value - expected) <= limit, \
        "%s: %g instead of %g +- %g" % (what, value, expected, limit)
