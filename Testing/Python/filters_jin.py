"""Today's practice against closed forms, and against what FDS itself wrote: filters_jin.py PLUGIN DATA_FOLDER"""
import os
import sys

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

import scenes

simple = scenes.load_plugin()
BOTH, PRACTICE, MAP, NEITHER, NO_SIGN, SOLID, UNKNOWN = range(7)

# --- two layers of smoke ------------------------------------------------------------------------------
# A room of 12 x 4 x 3 m: extinction 0.2 1/m before x = 6 m and 1 1/m behind it, two signs on the far wall and
# one on the near one, and a wall from x = 3 to 3.1 m that leaves half of the room's width.
SIZE, THIN, THICK, BORDER = (12.0, 4.0, 3.0), 0.2, 1.0, 6.0
smoke = scenes.image((12, 2, 3), SIZE)
extinction = vtk_to_numpy(smoke.GetCellData().GetArray("Extinction")).reshape(3, 2, 12)
extinction[:, :, :6], extinction[:, :, 6:] = THIN, THICK
walls = scenes.box((0.1, 2.0, 3.0), 0.3, origin=(3.0, 0.0, 0.0), inwards=False)
CENTRES = {1: (12.0, 1.0, 2.5), 2: (12.0, 3.0, 2.5), 7: (0.0, 0.9, 2.5)}
signs = [simple.ExitSign(Center=centre, Normal=[-1.0 if centre[0] > 6.0 else 1.0, 0.0, 0.0], Width=0.4,
                         Height=0.2, Luminance=300.0, SignId=number)
         for number, centre in CENTRES.items()]
light = simple.SmokeLightField(
    Smoke=scenes.producer(smoke, "Layers"), Surfaces=[scenes.producer(walls, "Half a wall")], Emitters=signs,
    Albedo=0.3, Tolerance=0.1)
places = simple.FloorMapOfVisibility(LightField=light, EyeHeight=1.7, Resolution=[12, 4])
seen = scenes.point_array(scenes.fetch(places), "Status") == 0


def depth(eye, centre):
    """Optical depth of the straight line, by hand: the share of its length behind the border is thick."""
    length = numpy.linalg.norm(numpy.subtract(centre, eye))
    behind = max(0.0, max(eye[0], centre[0]) - max(BORDER, min(eye[0], centre[0])))
    share = behind / abs(eye[0] - centre[0])
    return length, length * (share * THICK + (1.0 - share) * THIN)


def hidden(eye, centre):
    """Whether the half wall lies between."""
    for x in (3.0, 3.1):
        share = (x - eye[0]) / (centre[0] - eye[0])
        if 0.0 < share < 1.0 and eye[1] + share * (centre[1] - eye[1]) < 2.0:
            return True
    return False


for factor in (3.0, 8.0):
    jin = simple.JinVisibility(LightField=light, FloorMap=places, VisibilityFactor=factor)
    data = scenes.fetch(jin)
    names = ("InView", "SightDistance", "MeanExtinction", "JinVisibility")
    in_view, distance, mean_extinction, visibility = (scenes.point_array(data, name) for name in names)
    solid = scenes.point_array(scenes.fetch(places), "Status") == 3
    for place in range(data.GetNumberOfPoints()):
        eye = data.GetPoint(place)
        least = None
        for column, (number, centre) in enumerate(CENTRES.items()):
            if solid[place]:
                continue
            assert in_view[place, column] == (not hidden(eye, centre)), (eye, centre)
            if hidden(eye, centre):
                assert visibility[place, column] == 0.0
                continue
            length, expected = depth(eye, centre)
            scenes.check_close("distance", distance[place, column], length, 1e-6)
            scenes.check_close("mean extinction", mean_extinction[place, column], expected / length, 1e-6)
            scenes.check_close(
                "visibility", visibility[place, column], min(30.0, factor * length / expected), 1e-6)
            if least is None or expected < least[0]:
                least = expected, number
        if solid[place]:
            continue
        assert least is not None
        scenes.check_close("depth", scenes.point_array(data, "OpticalDepth")[place], least[0], 1e-6)
        scenes.check_close("contrast", scenes.point_array(data, "BeerLambertContrast")[place],
                           numpy.exp(-least[0]), 1e-5)
        assert scenes.point_array(data, "JinSign")[place] == least[1]
        for name, practice in (("JinDifference", least[0] <= factor),
                               ("BeerLambertDifference", least[0] <= -numpy.log(0.02))):
            category = scenes.point_array(data, name)[place]
            assert category == {(1, 1): BOTH, (1, 0): PRACTICE, (0, 1): MAP, (0, 0): NEITHER}[
                int(practice), int(seen[place])], (name, eye, category)
    counts = vtk_to_numpy(data.GetFieldData().GetArray("JinDifferenceCount"))
    assert counts.sum() == 48 and counts[BOTH] > 0
    # With C = 3 the map sees lit signs that Jin's law for reflecting ones gives up.
    assert (counts[MAP] > 0) == (factor == 3.0), counts
    assert set(scenes.point_array(data, "FDSDifference")) == {UNKNOWN}
    assert numpy.isnan(scenes.point_array(data, "FDSVisibility")).all()
    field_names = data.GetFieldData().GetAbstractArray("DifferenceNames")
    assert field_names.GetNumberOfValues() == len(counts)

# --- what FDS wrote -----------------------------------------------------------------------------------
# The room's slices of VISIBILITY lie at z = 1.75 m (fine mesh) and 1.7 m (coarse): in the middle of cells whose
# extinction the run wrote as well, by V = 3/K up to 30 m.
run = simple.FDSSmokeReader(FileName=os.path.join(sys.argv[2], "Room", "fds", "room.smv"))
sign = simple.ExitSign(Center=[6.35, 1.2, 2.0], Normal=[-1.0, 0.0, 0.0], Width=0.4, Height=0.2)
room = simple.SmokeLightField(
    Smoke=run, Surfaces=[simple.OutputPort(run, 1)], Emitters=[sign], Tolerance=0.3, PatchSize=1.0)
room_map = simple.FloorMapOfVisibility(
    LightField=room, EyeHeight=1.72, Bounds=[0.03, 6.33, 0.0, 2.4, 0.0, 2.4], Resolution=[14, 8])
jin = simple.JinVisibility(LightField=room, FloorMap=room_map, Slices=simple.OutputPort(run, 3))
jin.UpdatePipeline(20.0)
data = jin.GetClientSideObject().GetOutputDataObject(0)
written = scenes.point_array(data, "FDSVisibility")
status = scenes.point_array(room_map.GetClientSideObject().GetOutputDataObject(0), "Status")
smoke = run.GetClientSideObject().GetOutputDataObject(0)
grids = [smoke.GetPartition(i, 0) for i in range(smoke.GetNumberOfPartitionedDataSets())]
compared = 0
for place in range(data.GetNumberOfPoints()):
    x, y, z = data.GetPoint(place)
    if status[place] == 3 or numpy.isnan(written[place]):
        continue
    grid = min((g for g in grids if g.GetBounds()[0] <= x <= g.GetBounds()[1]),
               key=lambda g: g.GetBounds()[1] - g.GetBounds()[0])
    level = 1.75 if grid.GetBounds()[1] < 4.0 else 1.7
    nodes = [vtk_to_numpy(n) for n in (grid.GetXCoordinates(), grid.GetYCoordinates(), grid.GetZCoordinates())]
    # The coarse mesh's slice lies between two rows of nodes, 1 mm off being well inside the cells.
    i, j, k = (int(numpy.searchsorted(n, c)) - 1 for n, c in zip(nodes, (x, y, level - 0.001)))
    value = grid.GetCellData().GetArray("Extinction").GetValue(i + (len(nodes[0]) - 1) * (j + (len(nodes[1]) - 1) * k))
    if value > 0.0:
        scenes.check_close("FDS's visibility", written[place], min(30.0, 3.0 / value), 1e-5)
        compared += 1
assert compared > 60, compared
difference = scenes.point_array(data, "FDSDifference")
assert set(difference) <= {BOTH, PRACTICE, MAP, NEITHER, NO_SIGN, SOLID, UNKNOWN}
distance = scenes.point_array(data, "SightDistance")
for place in numpy.flatnonzero((scenes.point_array(data, "InView") == 1) & ~numpy.isnan(written) & (status != 3)):
    practice = written[place] >= 30.0 or distance[place] <= written[place]
    assert (difference[place] in (BOTH, PRACTICE)) == practice, (place, difference[place])

# --- errors -------------------------------------------------------------------------------------------
for properties, words in (({"VisibilityFactor": 0.0}, "VisibilityFactor: it is not positive"),
                          ({"FloorMap": simple.Wavelet()}, "it has no point array Status")):
    settings = dict(LightField=light, FloorMap=places)
    settings.update(properties)
    with scenes.Messages() as messages:
        simple.JinVisibility(**settings).UpdatePipeline()
    assert words in messages.text and messages.count("ERROR", "vtkJinVisibility") == 1, messages.text
print("Jin: passed")
