"""Routes through smoke against closed forms and published numbers: filters_route.py PLUGIN DATA_FOLDER"""
import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData, vtkTable

import scenes

simple = scenes.load_plugin()
SIZE = (12.0, 2.0, 2.0)


def line(points, times=None):
    data, corners, lines = vtkPolyData(), vtkPoints(), vtkCellArray()
    lines.InsertNextCell(len(points))
    for point in points:
        lines.InsertCellPoint(corners.InsertNextPoint(point))
    data.SetPoints(corners)
    data.SetLines(lines)
    if times is not None:
        array = numpy_to_vtk(numpy.array(times, float), deep=True)
        array.SetName("Time")
        data.GetPointData().AddArray(array)
    return scenes.producer(data, "Route")


def table(**columns):
    data = vtkTable()
    for name, values in columns.items():
        array = numpy_to_vtk(numpy.array(values, float), deep=True)
        array.SetName(name)
        data.AddColumn(array)
    return scenes.producer(data, "Trajectories")


def light_field(smoke, surfaces=()):
    sign = simple.ExitSign(Center=[12.0, 1.0, 1.0], Normal=[-1.0, 0.0, 0.0], Width=0.2, Height=0.1,
                           Luminance=300.0, SignId=4)
    return simple.SmokeLightField(Smoke=smoke, Surfaces=list(surfaces), Emitters=[sign], Albedo=0.0)


def summary(data, name):
    return vtk_to_numpy(data.GetFieldData().GetArray(name))


straight = line([(1.0, 1.0, 0.0), (6.0, 1.0, 0.0)])

# --- speeds in even smoke -----------------------------------------------------------------------------
# Law, speed in clear air, extinction, speed, and where that number stands: the test of FDS+Evac's guide (5 m at
# 1.5 m/s), and the worked example of Fridolf and others (visibilities of 2 and 0.5 m).
PUBLISHED = [("Frantzich and Nilsson", 1.5, 0.0, 1.5), ("Frantzich and Nilsson", 1.5, 4.34, 0.975),
             ("Frantzich and Nilsson", 1.5, 8.67, 0.45), ("Frantzich and Nilsson", 1.5, 13.01, 0.15),
             ("Fridolf", 1.2, 1.0, 0.86), ("Fridolf", 1.0, 1.0, 0.66), ("Fridolf", 1.0, 4.0, 0.2),
             ("Fridolf", 1.2, 0.6, 1.2), ("Constant", 1.2, 9.0, 1.2)]
for law, clear, extinction, speed in PUBLISHED:
    route = simple.RouteVisibility(
        LightField=light_field(scenes.producer(scenes.image((4, 1, 1), SIZE, extinction), "Even")),
        Route=straight, SpeedLaw=law, WalkingSpeed=clear, EyeHeight=1.0, StartTime=7.0)
    data = scenes.fetch(route)
    # The guide rounds to three digits.
    scenes.check_close(law, scenes.point_array(data, "Speed")[0], speed, 1e-3)
    scenes.check_close("time", summary(data, "RouteTime")[0], 5.0 / scenes.point_array(data, "Speed")[0], 1e-9)
    assert scenes.point_array(data, "Time")[0] == 7.0
    assert numpy.allclose(scenes.point_array(data, "Extinction"), extinction, rtol=1e-6)
    assert numpy.allclose(scenes.point_array(data, "Distance"), numpy.linspace(0.0, 5.0, 11))

# --- smoke that grows -----------------------------------------------------------------------------------
# K = 0.2 t: dx/dt = v (1 - c 0.2 t), so that x = v (t - c 0.1 t^2), c = 0.057 / 0.706.
TIMES = [0.0, 1.0, 3.0, 6.0, 20.0, 60.0]
RATE, SPEED, C = 0.2, 1.2, 0.057 / 0.706
growing = light_field(scenes.smoke_over_time(TIMES, [RATE * t for t in TIMES], (4, 1, 1), SIZE))
route = simple.RouteVisibility(LightField=growing, Route=straight, SpeedLaw="Frantzich and Nilsson",
                               WalkingSpeed=SPEED, EyeHeight=1.0, SampleSpacing=0.1)
data = scenes.fetch(route)
times, way = (scenes.point_array(data, name) for name in ("Time", "Distance"))
# Taking the speed half-way through a step is wrong in the square of the step alone.
assert numpy.allclose(way, SPEED * (times - C * 0.5 * RATE * times ** 2), atol=1e-4)
assert numpy.allclose(scenes.point_array(data, "Extinction"), RATE * times, rtol=1e-5)
assert list(summary(data, "TimeStepsUsed")) == [0.0, 1.0, 3.0, 6.0]
assert not scenes.point_array(data, "BeyondTimes").any()

# Who comes later than the last step finds its smoke.
late = scenes.fetch(simple.RouteVisibility(
    LightField=growing, Route=straight, SpeedLaw="Frantzich and Nilsson", WalkingSpeed=SPEED, EyeHeight=1.0,
    StartTime=59.0))
assert numpy.allclose(scenes.point_array(late, "Extinction"), numpy.minimum(12.0, RATE * scenes.point_array(late, "Time")))
assert list(scenes.point_array(late, "BeyondTimes")) == list((scenes.point_array(late, "Time") > 60.0).astype(int))
scenes.check_close("slowest", scenes.point_array(late, "Speed")[-1], SPEED * 0.1, 1e-9)

# --- what is seen ---------------------------------------------------------------------------------------
# Who stands still sees what the map shows, step by step, and loses the sign when the map says.
STEPS = [0.0, 100.0, 200.0, 300.0, 400.0, 500.0, 600.0]
smoky = light_field(scenes.smoke_over_time(STEPS, [0.004 * t for t in STEPS], (8, 2, 2), SIZE))
floor_map = simple.FloorMapOfVisibility(LightField=smoky, EyeHeight=1.0, Resolution=[6, 1])
over_time = scenes.fetch(simple.VisibilityOverTime(FloorMap=floor_map))
standing = scenes.fetch(simple.RouteVisibility(
    LightField=smoky, Route=table(X=[3.0, 3.0], y=[1.0, 1.0], time=[0.0, 600.0]), EyeHeight=1.0,
    SampleInterval=100.0))
for i, step in enumerate(STEPS):
    floor_map.UpdatePipeline(step)
    expected = scenes.point_array(floor_map.GetClientSideObject().GetOutputDataObject(0), "Visibility")[1]
    scenes.check_close("standing", scenes.point_array(standing, "Visibility")[i], expected, 1e-6)
scenes.check_close("loss", summary(standing, "FirstLossTime")[0],
                   scenes.point_array(over_time, "AvailableTime")[1], 1e-6)
scenes.check_close("dark", summary(standing, "InvisibleTime")[0],
                   scenes.point_array(over_time, "InvisibleTime")[1], 1e-6)
assert summary(standing, "LongestInvisibleTime")[0] == summary(standing, "InvisibleTime")[0]
assert summary(standing, "RouteLength")[0] == 0.0 and set(scenes.point_array(standing, "BestSign")) == {4}

# Two people, one of whom walks back and forth. Rows of a table may be mixed.
both = scenes.fetch(simple.RouteVisibility(
    LightField=smoky, EyeHeight=1.0, SampleSpacing=1.0, Route=table(
        person=[2, 1, 2, 1, 2], x=[2, 1, 5, 9, 2], y=[1, 1, 1, 1, 1], z=[0, 0, 0, 0, 0], t=[50, 0, 53, 10, 59])))
assert both.GetNumberOfLines() == 2
assert numpy.allclose(summary(both, "RouteLength"), [8.0, 6.0])
assert numpy.allclose(summary(both, "RouteTime"), [10.0, 9.0])
assert numpy.allclose(scenes.point_array(both, "Speed"), [0.8] * 9 + [1.0] * 3 + [0.5] * 4)

# A wall of 0.6 m at x = 6 m hides the sign from eyes at 0.5 m that are close before it: where the line from the
# plate's upper edge, 1.05 m up at x = 12 m, over the edge of the wall falls below the eye.
box = scenes.producer(scenes.box((0.1, 2.0, 0.6), 0.3, origin=(6.0, 0.0, 0.0), inwards=False), "Wall")
SHADOW = 6.0 - (0.6 - 0.5) * (12.0 - 6.0) / (1.05 - 0.6)
walled = light_field(scenes.producer(scenes.image((4, 1, 1), SIZE, 0.01), "Clear"), [box])
walking = scenes.fetch(simple.RouteVisibility(
    LightField=walled, Route=line([(0.5, 0.0625, 0.0), (11.5, 0.0625, 0.0)]), EyeHeight=0.5, SampleSpacing=0.05,
    WalkingSpeed=1.0))
status = scenes.point_array(walking, "Status")
x = vtk_to_numpy(walking.GetPoints().GetData())[:, 0]
hidden = (status == 2) | (status == 3)
assert not hidden[(x < SHADOW - 0.1) | (x > 6.2)].any()
assert hidden[(x > SHADOW + 0.1) & (x < 6.0)].all()
scenes.check_close("hidden way", summary(walking, "InvisibleDistance")[0], 6.1 - SHADOW, absolute=0.2)
loss = vtk_to_numpy(walking.GetFieldData().GetArray("FirstLossPlace"))[0]
scenes.check_close("first loss", loss[0], x[hidden][0], absolute=0.051)
assert summary(walking, "LeastVisibility")[0] == 0.0

# --- errors -------------------------------------------------------------------------------------------
for properties, words in (
        ({"WalkingSpeed": 0.0}, "WalkingSpeed: it is not positive"),
        ({"Acuity": 10801.0}, "Acuity: it is too large"),
        ({"DarkLuminance": -1.0}, "DarkLuminance: it is negative"),
        ({"AdaptationLuminance": 1e13}, "AdaptationLuminance: it is too large"),
        ({"Route": table(a=[1.0, 2.0])}, "no columns x and y"),
        ({"Route": table(x=[1.0], y=[2.0])}, "no line of at least two points"),
        ({"Route": line([(0, 0, 0), (1, 0, 0)], [5.0, 4.0])}, "its time is not after that of the corner before"),
        ({"SampleSpacing": 1e-7}, "more than a million places")):
    settings = dict(LightField=smoky, Route=straight)
    settings.update(properties)
    with scenes.Messages() as messages:
        simple.RouteVisibility(**settings).UpdatePipeline()
    assert words in messages.text and messages.count("ERROR", "vtkRouteVisibility") == 1, (words, messages.text)
print("routes: passed")
