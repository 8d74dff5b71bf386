"""The tunnel of Zhang and Rubini, from sources to sign image and floor map, against converged values."""
import numpy

import scenes
from scenes import cell_array, check_close, fetch, field, point_array

simple = scenes.load_plugin()
EYE = [0.001, 0.5, 0.5]


def check_light_field():
    data = fetch(scenes.tunnel())
    names = [data.GetMetaData(i).Get(data.NAME()) for i in range(3)]
    assert names == ["Smoke", "Surfaces", "Emitters"], names
    smoke, walls, sign = [data.GetPartition(i, 0) for i in range(3)]
    assert smoke.GetNumberOfCells() == 4000 and sign.GetNumberOfCells() == 9
    # 0.0849 m patches: 48 x 12 on the four long walls, 12 x 12 at the ends.
    assert walls.GetNumberOfCells() == 4 * 48 * 12 + 2 * 12 * 12, walls.GetNumberOfCells()
    assert set(cell_array(walls, "ParentCell")) == set(range(6))
    assert numpy.all(cell_array(walls, "Reflectance") == 0.2)
    components = {name: smoke.GetCellData().GetArray(name).GetNumberOfComponents()
                  for name in ("Fluence", "FluenceError", "DirectFluence", "MultipleFluence")}
    assert components == dict(Fluence=1, FluenceError=1, DirectFluence=1, MultipleFluence=16)
    for block in (walls, sign):
        components = {name: block.GetCellData().GetArray(name).GetNumberOfComponents()
                      for name in ("Illuminance", "IlluminanceError", "IlluminanceBack",
                                   "DirectIlluminance", "MultipleIlluminance")}
        assert components == dict(Illuminance=1, IlluminanceError=1, IlluminanceBack=1,
                                  DirectIlluminance=2, MultipleIlluminance=32)
    fluence = cell_array(smoke, "Fluence")
    parts = cell_array(smoke, "DirectFluence") + cell_array(smoke, "MultipleFluence").mean(axis=1)
    assert numpy.allclose(fluence, parts, rtol=1e-5)
    assert field(data, "Albedo") == 0.9 and field(smoke, "Albedo") == 0.9
    assert field(data, "Bands") == 1 and field(data, "Tolerance") == 0.01
    what = data.GetFieldData().GetAbstractArray("WorkReportWhat")
    assert what.GetNumberOfValues() == data.GetFieldData().GetArray("WorkReportCount") \
        .GetNumberOfTuples() > 0


def check_image():
    image = fetch(simple.VisibilityImage(LightField=scenes.tunnel(), CameraPosition=EYE,
                                         TargetSign=0, ImageSize=[64, 64]))
    assert image.GetDimensions() == (64, 64, 1) and image.GetSpacing() == (1, 1, 1)
    # Values of a path tracer that was run until its standard error was 0.1 %.
    check_close("lit mean", field(image, "LitLuminance"), 0.01926, 0.01)
    check_close("dark mean", field(image, "UnlitLuminance"), 0.00092, 0.01)
    check_close("contrast", field(image, "Contrast"), 0.8205, absolute=0.005)
    check_close("visible", field(image, "VisibleFraction"), 1.0, 1e-9)
    # The eye is 1 mm inside the tunnel, which makes the way 3.999 m.
    check_close("depth", field(image, "OpticalDepthToSign"), 3.999, 1e-3)
    mean = field(image, "MeanLuminance")
    check_close("perceived", field(image, "PerceivedContrast"),
                field(image, "Contrast") * mean / (mean + 0.1), 1e-6)
    luminance = point_array(image, "Luminance")
    assert numpy.all(point_array(image, "SignMask") == 1)
    assert numpy.all(point_array(image, "SignIds") == 0)
    assert numpy.allclose(luminance, point_array(image, "DirectLuminance") +
                          point_array(image, "VeilLuminance"), rtol=1e-5)
    # Pixels average over the bars' edges, the mean over the plate is the same.
    check_close("mean of the pixels", luminance.mean(), mean, 0.01)
    middle = luminance.reshape(64, 64)[32]
    check_close("lit pixel", middle[3], 0.01926, 0.015)
    check_close("dark pixel", middle[10], 0.00094, 0.02)
    # The tolerance asks for half of it in the mean of the veils, and a sign's light adds none; one
    # of 4096 pixels may be three times as bad.
    error = point_array(image, "LuminanceError") / luminance
    assert error.min() > 0.0 and error.max() < 0.015, (error.min(), error.max())
    rms, median = numpy.sqrt((error ** 2).mean()), numpy.median(error)
    print("relative error of a pixel: rms %.5f, median %.5f, worst %.5f" % (rms, median, error.max()))
    assert rms < 0.005 and median < 0.005, (rms, median)


def check_camera():
    """A free camera sees the sign where it is, and the walls around it."""
    view = simple.VisibilityImage(LightField=scenes.tunnel(), CameraPosition=[1, 0.5, 0.5],
                                  CameraFocalPoint=[4, 0.5, 0.5], ImageSize=[60, 40])
    image = fetch(view)
    mask = point_array(image, "SignMask").reshape(40, 60)
    # 0.3 m at 3 m in front of a 50 mm lens is 5 mm of the sensor's 36 mm, or 8.33 of 60 pixels.
    assert mask.sum() == 64, mask.sum()
    assert mask[16:24, 26:34].all()
    assert field(image, "MeasuredSign") == 0
    light_field = view.LightField
    check_close("the same from either camera", field(image, "Contrast"), field(fetch(
        simple.VisibilityImage(LightField=light_field, CameraPosition=[1, 0.5, 0.5],
                               TargetSign=0)), "Contrast"), 1e-12)
    view.CameraFocalPoint = [0, 0.5, 0.5]
    image = fetch(view)
    assert field(image, "MeasuredSign") == -1 and field(image, "Contrast") == 0
    assert not point_array(image, "SignMask").any()


def check_floor_map():
    light_field = scenes.tunnel()
    floor = simple.FloorMapOfVisibility(LightField=light_field, EyeHeight=0.5, Resolution=[8, 2],
                                        DarkLuminance=0)
    data = fetch(floor)
    assert data.GetDimensions() == (8, 2, 1)
    assert numpy.allclose(data.GetOrigin(), [0.25, 0.25, 0.5])
    assert numpy.allclose(data.GetSpacing()[:2], [0.5, 0.5])
    assert data.GetPointData().GetArray("Contrast").GetComponentName(0) == "Sign 0"
    assert not point_array(data, "Status").any()
    assert not point_array(data, "BestSign").any()
    visibility = point_array(data, "Visibility").reshape(2, 8)
    assert numpy.all(numpy.diff(visibility[0]) > -0.01), visibility
    # The scene is the same left and right.
    assert numpy.allclose(visibility[0], visibility[1], atol=0.005), visibility
    image = fetch(simple.VisibilityImage(LightField=light_field, TargetSign=0, DarkLuminance=0,
                                         CameraPosition=[0.25, 0.25, 0.5], ImageSize=[1, 1]))
    check_close("map and image", visibility[0, 0], field(image, "PerceivedContrast"), 1e-6)


def check_bands():
    """Bands that come out equal are solved once, and views of them agree with one band."""
    one = scenes.tunnel(cells=(20, 5, 5))
    three = scenes.tunnel(cells=(20, 5, 5), Bands="RGB", AngstromExponent=0.0)
    smoke = fetch(three).GetPartition(0, 0)
    fluence = cell_array(smoke, "Fluence")
    assert numpy.array_equal(fluence[:, 1], cell_array(fetch(one).GetPartition(0, 0), "Fluence"))
    assert numpy.array_equal(fluence[:, 0], fluence[:, 2])
    report = fetch(three).GetFieldData().GetAbstractArray("WorkReportWhat")
    assert "Bands left out" in [report.GetValue(i) for i in range(report.GetNumberOfValues())]
    images = [fetch(simple.VisibilityImage(LightField=light, CameraPosition=EYE, TargetSign=0,
                                           ImageSize=[8, 8])) for light in (one, three)]
    assert numpy.array_equal(*[point_array(image, "Luminance") for image in images])
    assert point_array(images[1], "LuminanceRGB").shape == (64, 3)
    assert images[0].GetPointData().GetArray("LuminanceRGB") is None

    # Blue light is dimmed more than red: optical depth 4 (633 / wavelength).
    smoky = fetch(simple.VisibilityImage(
        LightField=scenes.tunnel(cells=(20, 5, 5), Bands="RGB", Albedo=0), CameraPosition=EYE,
        TargetSign=0, ImageSize=[9, 9]))
    # Without scattering only what left the middle of the first bar arrives.
    rgb = point_array(smoky, "LuminanceRGB")[0] / point_array(smoky, "LuminanceRGB")[0][0]
    expected = numpy.exp(-4.0 * 633 * (1 / numpy.array([630, 532, 465]) - 1 / 630))
    assert numpy.allclose(rgb, expected, rtol=0.01), (rgb, expected)


check_light_field()
check_image()
check_camera()
check_floor_map()
check_bands()
print("tunnel: passed")
