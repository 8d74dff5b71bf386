"""Time: maps follow ParaView's time, and what a series of them says agrees with closed forms.

filters_time.py PLUGIN DATA_FOLDER

Smoke that only absorbs, the same everywhere, K(t) = 0.004 t 1/m: the luminance of a sign at the distance d is
L exp(-K d), and its perceived contrast s L exp(-K d) / (m L exp(-K d) + D), s and m being standard deviation and
mean over L in clear air.
"""
import numpy
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline

import scenes

simple = scenes.load_plugin()

TIMES = [0.0, 100.0, 200.0, 300.0, 400.0, 500.0, 600.0]
RATE = 0.004  # 1/m a second
DARK = 0.1  # cd/m2
LUMINANCE = 300.0  # cd/m2



def time_steps(proxy):
    proxy.UpdatePipelineInformation()
    steps = proxy.GetClientSideObject().GetOutputInformation(0).Get(vtkStreamingDemandDrivenPipeline.TIME_STEPS())
    return None if steps is None else list(steps)


smoke = scenes.smoke_over_time(TIMES, [RATE * t for t in TIMES], (8, 2, 2), (12.0, 2.0, 2.0))
exit_sign = simple.ExitSign(Center=[12.0, 1.0, 1.0], Normal=[-1.0, 0.0, 0.0], Width=0.2, Height=0.1,
                       Pattern="Barcode", Bars=9, Luminance=LUMINANCE, SignId=4)
light = simple.SmokeLightField(Smoke=smoke, Emitters=[exit_sign], Albedo=0.0)
floor_map = simple.FloorMapOfVisibility(LightField=light, EyeHeight=1.0, Resolution=[6, 1], DarkLuminance=DARK)

# --- the map follows time ---------------------------------------------------------------------------------
maps = {}
assert time_steps(floor_map) == TIMES, time_steps(floor_map)
for step in TIMES:
    floor_map.UpdatePipeline(step)
    data = floor_map.GetClientSideObject().GetOutputDataObject(0)
    maps[step] = scenes.point_array(data, "Visibility").astype(float).copy()
distances = numpy.array([12.0 - data.GetPoint(i)[0] for i in range(data.GetNumberOfPoints())])
assert numpy.allclose(distances, [11, 9, 7, 5, 3, 1]), distances

# Mean and standard deviation of the clear plate, from the clear map itself.
lit_share = 5.0 / 9.0
plain = maps[0.0] * (lit_share * LUMINANCE + DARK) / LUMINANCE
for step, found in maps.items():
    arriving = LUMINANCE * numpy.exp(-RATE * step * distances)
    expected = plain * arriving / (lit_share * arriving + DARK)
    # Near the sign its parts are at different distances: at 1 m the corner of the plate is 0.6 % farther away,
    # which at K = 2.4 dims it by 1.5 %.
    assert numpy.allclose(found, expected, rtol=0.02), (step, found, expected)
assert maps[600.0][0] < 1e-4 < 0.8 < maps[600.0][5]

# --- when places lose the sign ------------------------------------------------------------------------
over_time = simple.VisibilityOverTime(FloorMap=floor_map)
summary = scenes.fetch(over_time)
available = scenes.point_array(summary, "AvailableTime")
interval = scenes.point_array(summary, "AvailableTimeInterval")
outcome = scenes.point_array(summary, "Outcome")
share = DARK * 0.2 / (LUMINANCE * (plain - 0.2 * lit_share))
crossing = -numpy.log(share) / (RATE * distances)
series = numpy.array([maps[t] for t in TIMES])
for place, distance in enumerate(distances):
    if crossing[place] > TIMES[-1]:
        assert outcome[place] == 0 and available[place] == TIMES[-1] and interval[place] == 0.0
        continue
    assert outcome[place] == 1 and interval[place] == 100.0
    # The time lies on the line between the two maps, and the true one between the same two.
    after = int(numpy.argmax(series[:, place] < 0.2))
    (t0, t1), (c0, c1) = TIMES[after - 1: after + 1], series[after - 1: after + 1, place]
    assert t0 <= crossing[place] <= t1, (distance, crossing[place])
    scenes.check_close("time at %g m" % distance, available[place], t0 + (c0 - 0.2) / (c0 - c1) * (t1 - t0), 1e-5)
assert list(outcome) == [1, 1, 1, 1, 0, 0] or list(outcome) == [1, 1, 1, 0, 0, 0], outcome
assert numpy.allclose(scenes.point_array(summary, "InvisibleTime"), TIMES[-1] - available)
assert set(scenes.point_array(summary, "FirstSign")) == {4}
# It belongs to all times.
assert time_steps(over_time) is None
assert scenes.field(summary, "ContrastThreshold") == 0.2

# --- work that is given up --------------------------------------------------------------------------------
# Who stops the map half-way through the series gets the former answer, not one of half a series.
before = available.copy()
steps_done = []


def stop_at_third(algorithm, _):
    steps_done.append(1)
    if len(steps_done) == 3:
        algorithm.SetAbortExecute(1)


floor_map.EyeHeight = 1.1
algorithm = floor_map.GetClientSideObject()
observer = algorithm.AddObserver("StartEvent", stop_at_third)
with scenes.Messages() as messages:
    over_time.UpdatePipeline()
assert not messages.text, messages.text
assert len(steps_done) == 3, len(steps_done)
kept = over_time.GetClientSideObject().GetOutputDataObject(0)
assert numpy.array_equal(scenes.point_array(kept, "AvailableTime"), before)
algorithm.RemoveObserver(observer)
algorithm.SetAbortExecute(0)
# ParaView's client would not ask again of its own accord.
over_time.GetClientSideObject().Update()
done = over_time.GetClientSideObject().GetOutputDataObject(0)
assert not numpy.array_equal(scenes.point_array(done, "AvailableTime"), before)
floor_map.EyeHeight = 1.0

# --- errors -------------------------------------------------------------------------------------------
steady = simple.FloorMapOfVisibility(LightField=scenes.tunnel((8, 2, 2), Tolerance=0.1), EyeHeight=0.5)
for properties, words in (({"FloorMap": steady}, "it has no time steps"),
                          ({"FloorMap": floor_map, "TimeRange": [700.0, 800.0]}, "no time step lies within it"),
                          ({"FloorMap": floor_map, "Stride": 0}, "Stride: it is below 1")):
    with scenes.Messages() as messages:
        simple.VisibilityOverTime(**properties).UpdatePipeline()
    assert words in messages.text and messages.count("ERROR", "vtkVisibilityOverTime") == 1, (words, messages.text)
# VTK itself refuses what is no map at all.
with scenes.Messages() as messages:
    simple.VisibilityOverTime(FloorMap=exit_sign).UpdatePipeline()
assert "vtkImageData is required" in messages.text, messages.text
print("time: passed")
