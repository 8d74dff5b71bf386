"""What the tests of the FDS reader share: loading the plugin, looking at outputs, counting messages."""

import os
import sys

import numpy as np
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy

import scenes

AXES = "xyz"


def load_plugin(path):
    simple.LoadPlugin(path, remote=False, ns=globals())  # defines FDSSmokeReader


def reader(path, **properties):
    return FDSSmokeReader(FileName=str(path), **properties)


def link(folder, into, names):
    """Puts files of a run into another folder without copying them."""
    for name in names:
        os.symlink(os.path.abspath(os.path.join(folder, name)), os.path.join(into, name))


def write_nan_in_room(folder, into):
    """room_2_2.sf, the extinction of the coarse mesh, with a NaN in cell (3, 4, 5) at -2 s."""
    with open(os.path.join(folder, "room_2_2.sf"), "rb") as file:
        data = bytearray(file.read())
    # That is stored value (4, 5, 6) of 17 x 13 x 13, as each axis begins with a ghost.
    place = 146 + 12 + 4 + 4 * (4 + 17 * (5 + 13 * 6))
    data[place : place + 4] = np.float32(np.nan).tobytes()
    with open(os.path.join(into, "room_2_2.sf"), "wb") as file:
        file.write(data)


class Messages(scenes.Messages):
    """Collects VTK's errors and warnings instead of printing them."""

    def count(self, kind):
        """Messages of a kind, "ERROR" or "Warning", that the reader itself gave."""
        return super().count(kind, "vtkFDSSmokeReader")


class Mesh:
    """A mesh of the Smoke output with its cells as arrays indexed [k, j, i]."""

    def __init__(self, name, grid):
        self.name = name
        self.dimensions = tuple(n - 1 for n in grid.GetDimensions())
        self.nodes = [
            vtk_to_numpy(c)
            for c in (grid.GetXCoordinates(), grid.GetYCoordinates(), grid.GetZCoordinates())
        ]
        shape = self.dimensions[::-1]
        self.extinction = vtk_to_numpy(grid.GetCellData().GetArray("Extinction")).reshape(shape)
        self.solid = vtk_to_numpy(grid.GetCellData().GetArray("Solid")).reshape(shape) != 0

    def cell(self, point):
        """Indices [k, j, i] of the cell that holds a point, or None."""
        found = []
        for axis in (2, 1, 0):
            nodes = self.nodes[axis]
            if not nodes[0] <= point[axis] < nodes[-1]:
                return None
            found.append(int(np.searchsorted(nodes, point[axis], side="right")) - 1)
        return tuple(found)

    def volume(self, mask):
        dx, dy, dz = (np.diff(n) for n in self.nodes)
        return float((mask * dz[:, None, None] * dy[None, :, None] * dx[None, None, :]).sum())


class Smoke:
    def __init__(self, source, time):
        source.UpdatePipeline(time)
        self.data = source.GetClientSideObject().GetOutputDataObject(0)
        self.meshes = [
            Mesh(self.data.GetMetaData(i).Get(self.data.NAME()), self.data.GetPartition(i, 0))
            for i in range(self.data.GetNumberOfPartitionedDataSets())
        ]

    def field(self, name):
        return self.data.GetFieldData().GetAbstractArray(name).GetValue(0)

    def at(self, point):
        for mesh in self.meshes:
            cell = mesh.cell(point)
            if cell is not None:
                return float(mesh.extinction[cell])
        raise ValueError("no mesh holds %s" % (point,))


class Walls:
    """The Geometry output: normal, area, corners, surface and reflectance of each rectangle."""

    def __init__(self, source, time):
        port = simple.OutputPort(source, 1)
        port.UpdatePipeline(time)
        data = source.GetClientSideObject().GetOutputDataObject(1)
        count = data.GetNumberOfCells()
        points = vtk_to_numpy(data.GetPoints().GetData())
        corners = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(count, 4)
        self.corners = points[corners]
        cross = np.cross(
            self.corners[:, 1] - self.corners[:, 0], self.corners[:, 2] - self.corners[:, 0]
        )
        self.area = np.linalg.norm(cross, axis=1)
        self.normal = cross / self.area[:, None]
        names = data.GetCellData().GetAbstractArray("SurfaceName")
        self.surface = np.array([names.GetValue(i) for i in range(count)])
        self.reflectance = vtk_to_numpy(data.GetCellData().GetArray("Reflectance"))

    def facing(self, direction):
        """Mask of rectangles that face e.g. "+x"."""
        axis = AXES.index(direction[1])
        return self.normal[:, axis] * (1 if direction[0] == "+" else -1) > 0.5

    def at(self, direction, coordinate):
        """Mask of rectangles that face a direction in the plane at a coordinate."""
        axis = AXES.index(direction[1])
        return self.facing(direction) & (np.abs(self.corners[:, 0, axis] - coordinate) < 1e-6)

    def total(self, mask):
        return float(self.area[mask].sum())


class Devices:
    def __init__(self, source):
        simple.OutputPort(source, 2).UpdatePipeline()
        self.data = source.GetClientSideObject().GetOutputDataObject(2)
        self.units = self.data.GetFieldData().GetAbstractArray("Units")

    def names(self):
        return [self.data.GetColumnName(i) for i in range(self.data.GetNumberOfColumns())]

    def column(self, name):
        return vtk_to_numpy(self.data.GetColumnByName(name))

    def unit(self, name):
        return self.units.GetValue(self.names().index(name))

    def position(self, name):
        return self.data.GetFieldData().GetArray("Position").GetTuple(self.names().index(name))


def close(value, expected, tolerance, what):
    if not abs(value - expected) <= tolerance:
        sys.exit("%s is %.9g, expected %.9g +- %g" % (what, value, expected, tolerance))


def equal(value, expected, what):
    if value != expected:
        sys.exit("%s is %r, expected %r" % (what, value, expected))


def true(condition, what):
    if not condition:
        sys.exit("not so: " + what)
