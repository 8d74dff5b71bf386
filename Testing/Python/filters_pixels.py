"""Signs and lamps of less than a pixel, and of some: their light in a free picture against the
closed form, luminance times the area in the picture, wherever among the pixels they fall."""
import math

import numpy

import scenes
from scenes import check_close, fetch, field, point_array

simple = scenes.load_plugin()

DISTANCE = 20.0  # m from the eye to the sign
PIXEL = 0.5 / 50.0  # tangent of the angle of a pixel: 36 mm over 72 pixels, behind 50 mm
LIMIT = 0.02


def scene(extinction, emitters, surfaces=(), **properties):
    smoke = scenes.producer(scenes.image((4, 2, 2), (24.0, 12.0, 12.0), extinction), "Air")
    light = simple.SmokeLightField(Smoke=smoke, Surfaces=list(surfaces), Emitters=list(emitters),
                                   Albedo=0.0, **properties)
    light.UpdatePipeline()
    return light


def sign(**properties):
    settings = dict(Center=[22.0, 6.0, 6.0], Normal=[-1, 0, 0], Width=0.12, Height=0.12, Bars=9,
                    Luminance=300.0)
    settings.update(properties)
    return simple.ExitSign(**settings)


def picture(light, right=0.0, up=0.0, **properties):
    """Looks straight at the sign's wall, shifted by so many pixels."""
    settings = dict(ImageSize=[72, 48])
    settings.update(properties)
    step = PIXEL * DISTANCE
    view = simple.VisibilityImage(
        LightField=light, CameraPosition=[2.0, 6.0 + step * right, 6.0 + step * up],
        CameraFocalPoint=[22.0, 6.0 + step * right, 6.0 + step * up], **settings)
    return fetch(view)


def flux(image, pixel=PIXEL):
    """Luminance times area in the picture, at unit distance [cd]."""
    return point_array(image, "Luminance").astype(float).sum() * pixel ** 2


def shifts(count=5):
    return [((i + 0.37) / count, (j + 0.61) / count) for i in range(count) for j in range(count)]


def check_sizes():
    """0.05 to 20 pixels wide; five of nine bars are lit."""
    for width, height in ((0.01, 0.01), (0.12, 0.12), (0.3, 0.1), (0.6, 0.5), (1.2, 0.3),
                          (0.85, 0.85), (2.0, 1.6), (4.0, 3.3)):
        light = scene(0.0, [sign(Width=width, Height=height)])
        expected = 300.0 * 5 / 9 * width * height / DISTANCE ** 2
        for right, up in shifts(4):
            found = flux(picture(light, right, up))
            check_close("%g x %g m at %g, %g" % (width, height, right, up), found, expected, LIMIT)


def check_smoke_and_background():
    """Dimmed by exp(-K d), over a glowing wall that the sign hides."""
    wall = simple.Luminaire(Center=[22.1, 6.0, 6.0], Normal=[-1, 0, 0], Width=11.0, Height=11.0,
                            Luminance=20.0)
    plate = sign(Width=0.15, Height=0.15, Pattern="Square", SquareFraction=1.0)
    for extinction in (0.0, 0.1):
        light = scene(extinction, [plate, wall])
        without = scene(extinction, [sign(Center=[2.0, 1.0, 1.0], Normal=[-1, 0, 0]), wall])
        for right, up in shifts(3):
            found = flux(picture(light, right, up)) - flux(picture(without, right, up))
            expected = (300.0 * math.exp(-extinction * 20.0) - 20.0 * math.exp(-extinction * 20.1)
                        ) * 0.15 ** 2 / DISTANCE ** 2
            # What the eye misses of the wall is a little smaller, the wall being further away.
            check_close("before a wall, K = %g" % extinction, found, expected, LIMIT)


def check_hidden():
    """A screen hides the sign's lower half, or all of it."""
    for top, share in ((6.0, 0.5), (6.2, 0.0)):
        screen = scenes.producer(scenes.box((0.01, 4.0, top - 4.0), 0.0, (12.0, 4.0, 4.0),
                                            inwards=False), "Screen")
        light = scene(0.0, [sign(Pattern="Square", SquareFraction=1.0)], [screen])
        expected = share * 300.0 * 0.12 ** 2 / DISTANCE ** 2
        # Nearer than the sign by 10 m: seen by an eye shifted upwards the screen's edge sinks.
        for right in (0.0, 0.3, 0.7):
            found = flux(picture(light, right, 0.0))
            check_close("behind a screen up to %g m" % top, found, expected, LIMIT, 1e-9)
    away = scene(0.0, [sign(Normal=[1, 0, 0])])
    assert flux(picture(away)) == 0.0


def check_reflecting():
    """rho E / pi, the lamp's E by the inverse square."""
    lamp = simple.Luminaire(Center=[17.0, 6.0, 6.0], Normal=[1, 0, 0], Up=[0, 0, 1], Width=0.1,
                            Height=0.1, Luminance=50000.0)
    plate = sign(Center=[22.0, 6.6, 6.0], Pattern="Square", SquareFraction=1.0, Luminance=0,
                 Reflectance=0.8)
    light = scene(0.0, [plate, lamp])
    square = 25.0 + 0.36
    illuminance = 500.0 / square * (25.0 / square)
    expected = 0.8 * illuminance / math.pi * 0.12 ** 2 / DISTANCE ** 2
    for right, up in shifts(3):
        check_close("reflecting", flux(picture(light, right, up)), expected, LIMIT)


def check_lamps():
    lamps = [simple.Luminaire(Center=[22.0, 5.0 + i, 6.3], Normal=[-1, 0, 0], Width=0.05,
                              Height=0.08, Luminance=1000.0) for i in range(3)]
    light = scene(0.0, lamps)
    for right, up in shifts(3):
        check_close("lamps", flux(picture(light, right, up)),
                    3 * 1000.0 * 0.05 * 0.08 / DISTANCE ** 2, LIMIT)


def check_coarse_eye():
    """An eye that resolves 2.3 pixels gets the same light, spread."""
    light = scene(0.0, [sign()])
    expected = 300.0 * 5 / 9 * 0.12 ** 2 / DISTANCE ** 2
    sharp = point_array(picture(light, 0.4, 0.2), "Luminance").max()
    for right, up in shifts(3):
        image = picture(light, right, up, Acuity=math.degrees(2.3 * PIXEL) * 60.0)
        check_close("coarse eye", flux(image), expected, LIMIT)
        assert point_array(image, "Luminance").max() < 0.5 * sharp


def check_identity():
    """The pixel that holds its middle says which sign it is, so that the picture measures it."""
    light = scene(0.0, [sign(SignId=7, Width=0.05, Height=0.05)])
    for right, up in shifts(3):
        image = picture(light, right, up)
        ids = point_array(image, "SignIds")
        assert (ids == 7).sum() == 1 and field(image, "MeasuredSign") == 7
        assert ids[point_array(image, "Luminance").argmax()] == 7 or (
            point_array(image, "Luminance") > 0).sum() > 1


def check_blur():
    """Every point of the lens sees it."""
    light = scene(0.0, [sign()])
    image = picture(light, 0.3, 0.6, LensBlur=1, FNumber=1.4, FocusDistance=3.0)
    behind = field(image, "ImageDistance")
    check_close("blurred", flux(image, 0.5 / behind), 300.0 * 5 / 9 * 0.12 ** 2 / DISTANCE ** 2,
                LIMIT)
    values = point_array(image, "Luminance")
    assert values.max() < 0.9 * point_array(picture(light, 0.3, 0.6), "Luminance").max()
    assert numpy.isfinite(values).all()


check_sizes()
check_smoke_and_background()
check_hidden()
check_reflecting()
check_lamps()
check_coarse_eye()
check_identity()
check_blur()
print("small signs: passed")
