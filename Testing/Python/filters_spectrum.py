"""Red, green and white signs: luminance from bands, and what smoke does to colours."""
import math

import numpy

import scenes
from scenes import cell_array, check_close, fetch, field, point_array

simple = scenes.load_plugin()

WEIGHTS = numpy.array([0.2126, 0.7152, 0.0722])
WAVELENGTHS = numpy.array([630.0, 532.0, 465.0])
COLOURS = {"red": [1, 0, 0], "green": [0, 1, 0], "white": [1, 1, 1]}
# Five of nine equal bars lit: mean and standard deviation over the plate of a unit luminance.
MEAN = 5 / 9
DEVIATION = math.sqrt(20) / 9
LENGTH = 3.999


def look(light, dark=0.0):
    return fetch(simple.VisibilityImage(LightField=light, CameraPosition=[4 - LENGTH, 0.5, 0.5],
                                        TargetSign=0, ImageSize=[32, 32], DarkLuminance=dark))


def check_bands():
    """A sign's bands weigh up to its luminance, whatever its colour, at the sign and at the eye."""
    for name, colour in COLOURS.items():
        sign = scenes.tunnel_sign(Color=colour, Luminance=100)
        light = scenes.tunnel(cells=(4, 2, 2), extinction=0.0, sign=sign, Bands="RGB", Albedo=0.0,
                              PatchSize=1.0)
        image = look(light)
        check_close(name, field(image, "LitLuminance"), 100, 1e-6)
        bands = point_array(image, "LuminanceRGB")
        assert numpy.allclose(bands @ WEIGHTS, point_array(image, "Luminance"), rtol=1e-5)
        brightest = bands.max(axis=0)
        expected = 100 * numpy.array(colour) / (WEIGHTS @ colour)
        assert numpy.allclose(brightest, expected, rtol=1e-5), (name, brightest, expected)


def check_absorption():
    """In smoke that only absorbs the perceived contrast of a bar code is known: D T / (M T + d), with
    the mean M and deviation D of its luminance, the observer's floor d and T = exp(-K s f), where f
    is (633 nm / wavelength)^alpha. Red is ahead of green by that; with alpha 0 there is no
    difference; and in smoke that lets nothing through there is none either."""
    luminance, floor = 100.0, 0.1
    for exponent in (1.0, 2.0, 0.0):
        for extinction in (0.0, 1.0, 1.5, 6.0):
            contrasts = {}
            for name in ("red", "green"):
                sign = scenes.tunnel_sign(Color=COLOURS[name], Luminance=luminance)
                light = scenes.tunnel(cells=(4, 2, 2), extinction=extinction, sign=sign,
                                      Bands="RGB", Albedo=0.0, AngstromExponent=exponent,
                                      PatchSize=1.0)
                contrasts[name] = field(look(light, floor), "PerceivedContrast")
                band = 0 if name == "red" else 1
                scale = (633 / WAVELENGTHS[band]) ** exponent
                light = luminance * math.exp(-extinction * LENGTH * scale)
                # Ways to the plate's rim are longer than to its middle: by r^2 / 2 s, with a mean
                # r^2 of 0.3^2 / 6.
                oblique = extinction * scale * 0.3 ** 2 / 6 / (2 * LENGTH)
                check_close("%s, K = %g, alpha = %g" % (name, extinction, exponent),
                            contrasts[name], DEVIATION * light / (MEAN * light + floor),
                            1e-3 + oblique, 1e-6)
            difference = contrasts["red"] - contrasts["green"]
            if exponent == 0.0 or extinction == 0.0:
                assert abs(difference) < 1e-6, (exponent, extinction, difference)
            elif extinction in (1.0, 1.5):
                assert difference > 0.05, (exponent, extinction, difference)
            elif extinction == 6.0:
                assert 0 < difference < 1e-5, (exponent, difference)


def check_smoke_that_scatters():
    """In a lit tunnel with smoke that scatters (albedo 0.9) the veil of the lamp's white light takes
    the contrast: red, which is dimmed least, is ahead of green in thin smoke by more than ten
    standard errors, and the difference shrinks to next to nothing in thick smoke."""
    lamp = simple.Luminaire(Center=[2.0, 0.5, 0.999], Width=0.2, Height=0.2, Luminance=100)
    differences, errors = [], []
    for extinction in (0.5, 1.5, 3.0):
        results = []
        for name in ("red", "green"):
            sign = scenes.tunnel_sign(Color=COLOURS[name], Luminance=100)
            light = scenes.tunnel(cells=(16, 4, 4), extinction=extinction, sign=sign, Bands="RGB",
                                  Tolerance=0.03, PatchSize=0.25)
            light.Emitters = [sign, lamp]
            image = look(light)
            results.append((field(image, "Contrast"), field(image, "ContrastError")))
        differences.append(results[0][0] - results[1][0])
        errors.append(math.hypot(results[0][1], results[1][1]))
    differences, errors = numpy.array(differences), numpy.array(errors)
    print("red - green:", differences.round(4), "+-", errors.round(4))
    # Between optical depths of 2, where little is lost, and 12, where all is.
    assert (differences[:2] > 10 * errors[:2]).all()
    assert differences.argmax() == 1
    assert abs(differences[2]) < 0.1 * differences[1]


check_bands()
check_absorption()
check_smoke_that_scatters()
print("spectrum: passed")
