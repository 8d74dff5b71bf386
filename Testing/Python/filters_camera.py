"""Camera and eye: framing by the lens equation, blur, the photograph, glare, observers."""
import math
import os
import tempfile

import numpy
from vtkmodules.vtkIOImage import vtkPNGReader

import scenes
from scenes import check_close, fetch, field, point_array

simple = scenes.load_plugin()


def clear(*emitters):
    """Light field of clear air with signs and lamps."""
    smoke = scenes.producer(scenes.image((2, 2, 2), (6.0, 4.0, 4.0), 0.0), "ClearAir")
    return simple.SmokeLightField(Smoke=smoke, Emitters=list(emitters), Albedo=0.0)


def lamp(**properties):
    settings = dict(Center=[3.0, 2.0, 2.0], Normal=[-1.0, 0.0, 0.0], Width=0.4, Height=0.4,
                    Luminance=100.0)
    settings.update(properties)
    return simple.Luminaire(**settings)


def check_framing():
    """The sign's size on the sensor is the magnification's share of its own (eq. 8)."""
    sign = simple.ExitSign(Center=[4.0, 2.0, 2.0], Normal=[-1.0, 0.0, 0.0], Width=0.3, Height=0.3)
    view = simple.VisibilityImage(
        LightField=clear(sign), CameraPosition=[1.0, 2.0, 2.0], CameraFocalPoint=[4.0, 2.0, 2.0],
        CameraModel="Canon EOS 10D", PixelBinning=16, FocalLength=100.0)
    image = fetch(view)
    assert image.GetDimensions() == (192, 128, 1)
    # Pixels are square, those of the camera nearly so: 7.373 against 7.389 um; the smaller counts.
    pixel = 15.1 / 128
    mask = point_array(image, "SignMask").reshape(128, 192)
    side = math.sqrt(mask.sum())
    check_close("pinhole", side, 300.0 * 100.0 / 3000.0 / pixel, absolute=1.0)
    # From the sign to the lens 3 m, to the sensor S with 1/3 + 1/s' = 1/0.1.
    behind = 1.0 / (10.0 - 1.0 / 3.0)
    view.FocusDistance = 3.0 + behind
    image = fetch(view)
    check_close("image distance", field(image, "ImageDistance"), 1000.0 * behind, 1e-9)
    check_close("object distance", field(image, "ObjectDistance"), 3.0, 1e-9)
    check_close("magnification", field(image, "Magnification"), behind / 3.0, 1e-9)
    window = image.GetFieldData().GetArray("CameraWindow")
    check_close("window", window.GetValue(3), 0.5 * 15.1 / (1000.0 * behind), 1e-9)


def check_sensor():
    """The sensor's illuminance is that of the photograph: 0.65 L / (N i / f)^2 (ISO 12232)."""
    sign = simple.ExitSign(Center=[4.0, 2.0, 2.0], Normal=[-1.0, 0.0, 0.0], Pattern="Square",
                           SquareFraction=1.0, Width=0.3, Height=0.3, Luminance=100.0)
    view = simple.VisibilityImage(
        LightField=clear(sign), CameraPosition=[3.0, 2.0, 2.0], TargetSign=0, ImageSize=[20, 20],
        FocalLength=100.0, FNumber=4.0, ExposureTime=0.02)
    for focus in (0.0, 1.2):
        view.FocusDistance = focus
        image = fetch(view)
        stop = 4.0 * field(image, "ImageDistance") / 100.0
        illuminance = field(image, "SensorIlluminance")
        check_close("illuminance", illuminance, 0.65 * 100.0 / stop ** 2, 1e-5)
        values = point_array(view.GetClientSideObject().GetOutputDataObject(1), "Photograph")
        decoded = ((118 / 255 + 0.055) / 1.055) ** 2.4
        light = 1.0 - (1.0 - decoded) ** (illuminance * 0.02 / 0.1)
        check_close("pixel value", values[210], 255 * (1.055 * light ** (1 / 2.4) - 0.055),
                    absolute=0.5)


def check_blur():
    """The edge of a bright plate becomes the integral of a disc."""
    view = simple.VisibilityImage(
        LightField=clear(lamp()), CameraPosition=[1.0, 2.0, 2.0], CameraFocalPoint=[3.0, 2.0, 2.0],
        FocalLength=100.0, SensorSize=[20.0, 2.0], ImageSize=[200, 20], FNumber=2.0, Acuity=0.0,
        LensBlur=1, FocusDistance=4.0)
    image = fetch(view)
    aperture, distance, focus = 0.05, 2.0, field(image, "ObjectDistance")
    behind = field(image, "ImageDistance")
    radius = 0.5 * aperture * behind * abs(1.0 / distance - 1.0 / focus)  # mm on the sensor
    x = (numpy.arange(200) + 0.5 - 100) * 0.1
    edge = 200.0 * behind / 1000.0 / distance

    def step(at):
        at = numpy.clip(at, -1.0, 1.0)
        return 0.5 + (at * numpy.sqrt(1.0 - at * at) + numpy.arcsin(at)) / math.pi

    expected = 100.0 * (step((edge + x) / radius) - step((x - edge) / radius))
    row = point_array(image, "Luminance").reshape(20, 200)[10]
    # 64 points of the lens: one of them may lie on either side of the edge.
    assert abs(row - expected).max() < 100.0 * 2.0 / 64, abs(row - expected).max()
    assert radius > 0.5  # five pixels
    view.FocusDistance = distance + 1.0 / (10.0 - 1.0 / distance)
    sharp = point_array(fetch(view), "Luminance").reshape(20, 200)[10]
    assert ((sharp > 1.0) & (sharp < 99.0)).sum() <= 4


def check_photograph():
    view = simple.VisibilityImage(
        LightField=clear(lamp()), CameraPosition=[1.0, 2.0, 2.0], CameraFocalPoint=[3.0, 2.0, 2.0],
        ImageSize=[30, 20], ExposureTime=0.01, FNumber=4.0)
    fetch(view)
    photograph = view.GetClientSideObject().GetOutputDataObject(1)
    values = point_array(photograph, "Photograph")
    assert photograph.GetDimensions() == (30, 20, 1) and values.dtype == numpy.uint8
    exposure = 0.65 * 100.0 * 0.01 / 16.0
    # ISO 12232: 118 at 0.1 lx s; 1 - exp(-H / H0), encoded as sRGB.
    decoded = ((118 / 255 + 0.055) / 1.055) ** 2.4
    light = 1.0 - (1.0 - decoded) ** (exposure / 0.1)
    check_close("pixel value", values.max(), 255 * (1.055 * light ** (1 / 2.4) - 0.055),
                absolute=0.5)
    assert values.min() == 0
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "photograph.png")
        simple.SaveData(path, proxy=simple.OutputPort(view, 1))
        reader = vtkPNGReader()
        reader.SetFileName(path)
        reader.Update()
        png = point_array(reader.GetOutput(), "PNGImage")
        assert numpy.array_equal(png.reshape(-1), values)
        curve = os.path.join(folder, "curve.csv")
        with open(curve, "w") as file:
            file.write("exposure,pixel_value\n0,0\n1,100\n")
        view.ResponseFile = curve
        fetch(view)
        values = point_array(view.GetClientSideObject().GetOutputDataObject(1), "Photograph")
        check_close("tabulated response", values.max(), 100.0 * exposure, absolute=0.5)
        with open(curve, "w") as file:
            file.write("exposure,pixel_value\n0,0\n1,400\n")
        view.ExposureTime = 0.02
        with scenes.Messages() as messages:
            view.UpdatePipeline()
        assert messages.count("ERROR", "vtkVisibilityImage") == 1, messages.text
        assert "line 3" in messages.text, messages.text
    colour = simple.VisibilityImage(
        LightField=simple.SmokeLightField(
            Smoke=scenes.producer(scenes.image((2, 2, 2), (6.0, 4.0, 4.0), 0.0), "Clear"),
            Emitters=[lamp(Color=[1.0, 0.0, 0.0])], Albedo=0.0, Bands="RGB"),
        CameraPosition=[1.0, 2.0, 2.0], CameraFocalPoint=[3.0, 2.0, 2.0], ImageSize=[30, 20])
    fetch(colour)
    values = point_array(colour.GetClientSideObject().GetOutputDataObject(1), "Photograph")
    assert values.shape == (600, 3) and values[:, 0].max() > 100 and not values[:, 1:].any()


def check_eye():
    sign = scenes.tunnel_sign(Luminance=100.0)
    dazzling = lamp(Center=[3.0, 0.5, 0.95], Normal=[-1.0, 0.0, 0.0], Width=0.08, Height=0.08,
                    Luminance=20000.0)
    smoke = scenes.producer(scenes.image((8, 2, 2), (4.0, 1.0, 1.0), 0.3), "ThinSmoke")
    light = simple.SmokeLightField(Smoke=smoke, Emitters=[sign, dazzling], Albedo=0.0)
    view = simple.VisibilityImage(LightField=light, CameraPosition=[0.01, 0.5, 0.5], TargetSign=0,
                                  ImageSize=[8, 8])
    plain = fetch(view)
    assert field(plain, "EyeLuminance") == 0.1
    plain = {name: field(plain, name) for name in ("PerceivedContrast", "Contrast",
                                                   "MeanLuminance", "VisibleProbability")}
    check_close("probability", plain["VisibleProbability"], 0.5 * math.erfc(
        (0.2 - plain["PerceivedContrast"]) / (0.04 * math.sqrt(2))), absolute=1e-9)
    view.Glare = 1
    image = fetch(view)
    distance = math.hypot(2.99, 0.45)
    angle = math.degrees(math.atan2(0.45, 2.99))
    illuminance = 20000.0 * 0.0064 * (2.99 / distance) / distance ** 2 * math.exp(-0.3 * distance)
    veil = illuminance * (2.99 / distance) * (
        10 / angle ** 3 + (5 / angle ** 2 + 0.05 / angle) * (1 + (35 / 62.5) ** 4) + 0.00125)
    check_close("veil", field(image, "EyeLuminance") - 0.1, veil, 0.02)
    mean = plain["MeanLuminance"]
    check_close("dazzled", field(image, "PerceivedContrast"), plain["Contrast"] * mean /
                (mean + field(image, "EyeLuminance")), 1e-4)
    # Both filters have the same eye.
    floor = simple.FloorMapOfVisibility(
        LightField=light, Resolution=[1, 1], EyeHeight=0.5, Glare=1, Bounds=[0, 0.02, 0, 1, 0, 1])
    data = fetch(floor)
    check_close("map", point_array(data, "Visibility")[0], field(image, "PerceivedContrast"), 1e-5)
    check_close("eye", point_array(data, "EyeLuminance")[0], field(image, "EyeLuminance"), 1e-5)
    check_close("share of observers", point_array(data, "VisibleProbability")[0],
                field(image, "VisibleProbability"), 1e-5)
    floor.ObserverAge = 80
    assert point_array(fetch(floor), "EyeLuminance")[0] > 1.5 * field(image, "EyeLuminance")
    # What is wrong with the eye, both say in the same words.
    for name, value, part in (("AdaptationLuminance", -1.0, "it is negative"),
                              ("AdaptationTime", -1.0, "it is negative"),
                              ("DarkLuminance", -0.1, "it is negative"),
                              ("Acuity", math.nan, "it is not finite"),
                              ("Acuity", 1e300, "it is too large"),
                              ("DarkLuminance", 1e300, "it is too large"),
                              ("AdaptationLuminance", 1e13, "it is too large"),
                              ("ObserverAge", 101.0, "it is not from 0 to 100")):
        texts = []
        for proxy, kind in ((view, "vtkVisibilityImage"), (floor, "vtkFloorMapOfVisibility")):
            before = getattr(proxy, name)
            setattr(proxy, name, value)
            with scenes.Messages() as messages:
                proxy.UpdatePipeline()
            assert messages.count("ERROR", kind) == 1, messages.text
            setattr(proxy, name, before)
            texts.append(messages.text[messages.text.index(name + ": " + part):].splitlines()[0])
        assert texts[0] == texts[1], texts


check_framing()
check_sensor()
check_blur()
check_photograph()
check_eye()
print("camera and eye: passed")
