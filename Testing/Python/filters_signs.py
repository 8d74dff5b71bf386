"""Signs as standards and makers describe them: figures, designs, presets, tables, and signs that
only reflect, up to the contrast that an observer gets."""
import math
import os
import tempfile
import time

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGWriter

import scenes
from scenes import cell_array, check_close, fetch, field, work_done

simple = scenes.load_plugin()
WEIGHTS = numpy.array([0.2126, 0.7152, 0.0722])


def areas(data):
    """Area of each cell, a convex polygon in the plane x = 0."""
    result = []
    for i in range(data.GetNumberOfCells()):
        points = data.GetCell(i).GetPoints()
        y, z = numpy.array([points.GetPoint(j)[1:] for j in range(points.GetNumberOfPoints())]).T
        result.append(0.5 * (y @ numpy.roll(z, -1) - z @ numpy.roll(y, -1)))
    return numpy.array(result)


def lit(data):
    return cell_array(data, "SignPart") == 1


def photopic(values):
    return values if values.ndim == 1 else values @ WEIGHTS


def check_figures():
    """Cells cover the plate once, whatever is drawn, and letters have the areas of their strokes."""
    for text in ("EXIT", "ABCDEFGHIJKLM", "NOPQRSTUVWXYZ", "0123456789", "A-B./&!'+ C"):
        data = fetch(simple.ExitSign(Pattern="Text", Text=text, Width=2))
        assert (areas(data) > 0).all(), text
        check_close(text, areas(data).sum(), 0.6, 1e-9)
    # Letters of height h, strokes of h / 8, 0.6 h wide but for the I; arms of the E and H between
    # their posts: in units of h^2.
    stroke = 0.125
    arm = 0.6 - stroke
    expected = {"I": stroke, "L": stroke + arm * stroke, "T": 0.6 * stroke + (1 - stroke) * stroke,
                "H": 2 * stroke + (0.6 - 2 * stroke) * stroke, "-": 0.4 * stroke}
    for letter, area in expected.items():
        data = fetch(simple.ExitSign(Pattern="Text", Text=letter, FigureHeight=0.2))
        check_close(letter, areas(data)[lit(data)].sum(), area * 0.2 ** 2, 1e-5)
    # A word of two letters with a gap of an eighth, which does not depend on where it is drawn.
    data = fetch(simple.ExitSign(Pattern="Text", Text="il", FigureHeight=0.2))
    check_close("IL", areas(data)[lit(data)].sum(), (expected["I"] + expected["L"]) * 0.04, 1e-5)
    data = fetch(simple.ExitSign(Pattern="Running Man"))
    check_close("running man", areas(data).sum(), 0.18, 1e-9)
    share = areas(data)[lit(data)].sum() / (0.7 * 0.3) ** 2
    assert 0.2 < share < 0.5, share


def check_designs():
    """A panel is the negative of a stencil; bars have the widths that are asked for."""
    stencil = fetch(simple.ExitSign(Pattern="Text", Luminance=100, UnlitLuminance=5))
    panel = fetch(simple.ExitSign(Pattern="Text", Luminance=100, UnlitLuminance=5, Design="Panel"))
    assert numpy.allclose(cell_array(stencil, "Luminance") + cell_array(panel, "Luminance"), 105)
    assert (lit(stencil) != lit(panel)).all()
    bars = fetch(simple.ExitSign(Bars=5, BarFraction=0.8, Width=2.8))
    assert numpy.allclose(areas(bars) / 0.3, [0.8, 0.2, 0.8, 0.2, 0.8])


def check_uniformity():
    """The mean stays; the extremes have the ratio asked for, but for the rows' own width."""
    for pattern in ("Square", "Barcode", "Text", "Running Man"):
        data = fetch(simple.ExitSign(Pattern=pattern, Uniformity=0.25, Luminance=100,
                                     UnlitLuminance=100, SquareFraction=1))
        luminance = cell_array(data, "Luminance")
        check_close("mean of " + pattern, luminance @ areas(data) / 0.18, 100, 1e-6)
        # 1.6 at the upper edge, 0.4 at the lower, and rows of a sixteenth.
        check_close("most of " + pattern, luminance.max(), 160 - 1.2 / 32 * 100, 1e-6)
        check_close("least of " + pattern, luminance.min(), 40 + 1.2 / 32 * 100, 1e-6)


def check_presets():
    """The numbers that the standards give."""
    def look(preset):
        data = fetch(simple.ExitSign(Preset=preset, Pattern="Square"))
        source = data.GetFieldData().GetAbstractArray("PresetSource").GetValue(0)
        assert preset.split()[0] in source, source
        bright = lit(data)
        assert 0 < bright.sum() < len(bright)
        values = []
        for name in ("Luminance", "Reflectance"):
            value = photopic(cell_array(data, name))
            values += [value[bright][0], value[~bright][0]]
        return values, data
    assert numpy.allclose(look("EN 1838")[0], [10, 2, 0, 0])
    assert numpy.allclose(look("EN 1838 Smoke")[0], [50, 10, 0, 0])
    assert numpy.allclose(look("ISO 3864")[0], [0, 0, 0.75, 0.12])
    assert numpy.allclose(look("UL 924 Stencil")[0], [0.205, 0, 0, 0])
    values, data = look("UL 924 Panel")
    assert numpy.allclose(values, [0.41, 0.205, 0, 0])
    # Contrast (Lg - Ll) / Lg of at least 0.5; the dark letters are red.
    check_close("contrast", (values[0] - values[1]) / values[0], 0.5, 1e-12)
    letters = cell_array(data, "Luminance")[~lit(data)][0]
    assert letters[0] > 10 * letters[1]


def check_table(folder):
    path = os.path.join(folder, "signs.csv")
    with open(path, "w") as table:
        table.write(
            "cx,cy,cz,preset,pattern,text,design,luminance,unlit_luminance,red,green,blue,"
            "reflectance,unlit_reflectance,exponent,uniformity,bar_fraction,figure_height\n"
            "0,0,0,en1838,,,,,,,,,,,,,,\n"
            "0,0,1,EN1838,,,,20,,,,,,,,,,\n"
            "0,0,2,,text,WAY OUT,panel,80,4,,,,,,2,,,0.1\n"
            "0,0,3,,barcode,,,0,0,,,,0.6,0.1,,,0.25,\n"
            "0,0,4,,square,,,100,,1,0,0,,,,0.5,,\n")
    data = fetch(simple.ExitSign(SignTable=path))
    ids = cell_array(data, "SignId")
    bright = lit(data)
    luminance = photopic(cell_array(data, "Luminance"))
    reflectance = photopic(cell_array(data, "Reflectance"))
    exponent = cell_array(data, "EmissionExponent")
    assert numpy.allclose(luminance[(ids == 0) & bright], 10)
    assert numpy.allclose(luminance[(ids == 0) & ~bright], 2)
    assert numpy.allclose(luminance[(ids == 1) & bright], 20)
    assert numpy.allclose(luminance[(ids == 1) & ~bright], 2)
    assert numpy.allclose(luminance[(ids == 2) & bright], 80)
    assert set(exponent[ids == 2]) == {2} and set(exponent[ids != 2]) == {0}
    assert numpy.allclose(reflectance[(ids == 3) & bright], 0.6)
    assert numpy.allclose(reflectance[(ids == 3) & ~bright], 0.1)
    red = cell_array(data, "Luminance")[(ids == 4) & bright]
    assert (red[:, 0] > 0).all() and (red[:, 1:] == 0).all()
    assert luminance[(ids == 4) & bright].max() > 1.2 * luminance[(ids == 4) & bright].min()

    for text, part in (("preset\nxyz", "line 2: the preset 'xyz' is not known"),
                       ("design\nflat", "line 2: the design 'flat' is not known"),
                       ("pattern,text\ntext,\xa7", "line 2, sign 0: the text"),
                       ("pattern,figure_height\ntext,0.29", "is larger than the plate"),
                       ("bar_fraction\n1", "line 2, sign 0: its bar fraction"),
                       ("uniformity\n0", "line 2, sign 0: its uniformity"),
                       ("exponent\n-1", "line 2, sign 0: its emission exponent"),
                       ("red,green,blue,reflectance\n1,0,0,0.5", "reflects as much light"),
                       ("pattern,pattern_file\nimage,no.png", "no.png': there is no such file"),
                       ("colour\n3", "the column 'colour' is not known")):
        header, row = text.split("\n")
        with open(path, "w", encoding="utf-8") as table:
            table.write("cx,cy,cz," + header + "\n0,0,0," + row + "\n")
        with scenes.Messages() as messages:
            cells = fetch(simple.ExitSign(SignTable=path)).GetNumberOfCells()
        assert messages.count("ERROR", "vtkExitSignSource") == 1, (text, messages.text)
        assert part in messages.text, (part, messages.text)
        assert cells == 0


def air(extinction, size=(8.0, 4.0, 4.0)):
    return scenes.producer(scenes.image((16, 8, 8), size, extinction, (0.0, -2.0, -2.0)), "Air")


def look_at(light, position, **properties):
    image = simple.VisibilityImage(LightField=light, CameraPosition=position, TargetSign=0,
                                   ImageSize=[32, 32], DarkLuminance=0.0, **properties)
    return fetch(image)


def check_reflecting_sign():
    """A sign without light of its own under one small lamp, in clear air and in black smoke: its
    parts have rho E / pi, with E from the lamp by the inverse square, and dim as exp(-K s)."""
    sign = simple.ExitSign(Preset="Custom", Center=[0.0, 0.0, 0.0], Width=0.4, Height=0.4, Bars=9,
                           Luminance=0, Reflectance=0.75, UnlitReflectance=0.12)
    lamp = simple.Luminaire(Center=[4.0, 0.0, 0.0], Normal=[-1, 0, 0], Up=[0, 0, 1], Width=0.05,
                            Height=0.05, Luminance=40000)
    intensity = 40000 * 0.05 ** 2
    eye = [6.0, 1.0, 0.0]
    way = math.hypot(6.0, 1.0)
    for extinction in (0.0, 0.4):
        light = simple.SmokeLightField(Smoke=air(extinction), Emitters=[sign, lamp], Albedo=0.0)
        light.UpdatePipeline()
        illuminance = intensity / 16 * math.exp(-4 * extinction)
        image = look_at(light, eye)
        dimmed = math.exp(-extinction * way)
        # Over the plate of 0.4 m, 4 m from the lamp, E falls with (1 + r^2 / 16)^-2: 0.4 % on
        # average; smoke adds what the ways to the lamp and to the eye are longer.
        check_close("lit", field(image, "LitLuminance"), 0.75 * illuminance / math.pi * dimmed,
                    0.008)
        check_close("unlit", field(image, "UnlitLuminance"), 0.12 * illuminance / math.pi * dimmed,
                    0.008)
        check_close("UL 924 contrast", field(image, "UL924Contrast"), 1 - 0.12 / 0.75, 0.002)
        mean = (5 * 0.75 + 4 * 0.12) / 9
        check_close("contrast", field(image, "Contrast"),
                    math.sqrt(20) / 9 * (0.75 - 0.12) / mean, 0.003)
        assert field(image, "VisibleFraction") == 1.0


def check_reflecting_sign_in_room():
    """Under indirect light alone: the parts keep the ratio of their reflectances, without noise
    between them, because light that varies no more than its noise counts as even."""
    walls = scenes.producer(scenes.box((6.0, 4.0, 3.0), 0.6, (0.0, -2.0, -1.5)), "Walls")
    sign = simple.ExitSign(Preset="ISO 3864", Center=[0.0, 0.0, 0.3], Width=0.4, Height=0.4)
    # The lamp shines away from the sign.
    lamp = simple.Luminaire(Center=[2.0, 0.0, 1.0], Normal=[1, 0, 0], Up=[0, 0, 1],
                            LuminousFlux=2000)
    smoke = scenes.producer(scenes.image((12, 8, 6), (6.0, 4.0, 3.0), 0.0, (0.0, -2.0, -1.5)), "Air")
    light = simple.SmokeLightField(Smoke=smoke, Surfaces=[walls], Emitters=[sign, lamp])
    light.UpdatePipeline()
    image = look_at(light, [4.0, 0.5, 0.2])
    bright = field(image, "LitLuminance")
    check_close("ratio", bright / field(image, "UnlitLuminance"), 0.75 / 0.12, 1e-3)
    assert field(image, "ContrastError") < 1e-3
    # The mean illuminance of a closed room, from its balance: flux rho / (A (1 - rho)), is met to
    # the unevenness of a room.
    mean = 2000 * 0.6 / (108 * 0.4)
    check_close("luminance", bright, 0.75 * mean / math.pi, 0.3)


def check_hidden_sign():
    """Behind a block no part of a sign is looked at, beside it all parts; the report says which."""
    block = scenes.producer(scenes.box((0.1, 2.0, 2.0), 0.3, (3.0, -1.0, -1.0), False), "Block")
    sign = simple.ExitSign(Center=[0.0, 0.0, 0.0], Luminance=200)
    light = simple.SmokeLightField(Smoke=air(0.1), Surfaces=[block], Emitters=[sign])
    light.UpdatePipeline()
    for eye, seen, why in (([6.0, 0.0, 0.0], 0.0, "surfaces stand before all of it"),
                           ([2.0, 0.0, 0.0], 1.0, "nothing reaches between the eye and the sign")):
        image = look_at(light, eye)
        assert field(image, "VisibleFraction") == seen
        assert work_done(image, "signs not looked at in parts") == (1.0, why)


def check_blank_plate():
    """Standard deviation over mean is the paper's method: a blank plate that is lit from the side
    has a contrast, which is that of the illuminance's slope, and observers count as seeing it. What
    tells it from a sign is that its lit parts and its unlit ones, which are none, do not differ."""
    def plate(fraction):
        return simple.ExitSign(Center=[0.0, 0.0, 0.0], Width=0.8, Height=0.8, Pattern="Square",
                               SquareFraction=fraction, Luminance=0, Reflectance=0.8,
                               UnlitReflectance=0.1)
    lamp = simple.Luminaire(Center=[0.4, -0.4, 0.0], Normal=[-1, 0, 0], Up=[0, 0, 1], Width=0.05,
                            Height=0.05, Luminance=40000)

    def measured(fraction):
        light = simple.SmokeLightField(Smoke=air(0.0), Emitters=[plate(fraction), lamp], Albedo=0.0)
        light.UpdatePipeline()
        return look_at(light, [6.0, 0.0, 0.0])
    blank = measured(1.0)
    # E falls as cos^2 / r^2 with the distance from the lamp's foot on the plate's edge.
    y, z = numpy.meshgrid(numpy.linspace(0.0, 0.8, 401), numpy.linspace(-0.4, 0.4, 401))
    fall = 1.0 / (y ** 2 + z ** 2 + 0.16) ** 2
    check_close("slope", field(blank, "Contrast"), fall.std() / fall.mean(), 0.02)
    assert field(blank, "VisibleProbability") > 0.99
    assert field(blank, "WebberContrast") == 0.0 and field(blank, "UnlitLuminance") == 0.0
    assert field(measured(0.5), "UL924Contrast") > 0.5


def check_emission_exponent():
    """Seen 60 degrees off the normal, luminance is down by cos^n."""
    for exponent in (0.0, 2.0):
        sign = simple.ExitSign(Center=[0.0, 0.0, 0.0], EmissionExponent=exponent, Luminance=200,
                               Width=0.1, Height=0.05)
        light = simple.SmokeLightField(Smoke=air(0.0), Emitters=[sign], Albedo=0.0)
        light.UpdatePipeline()
        image = look_at(light, [1.0, math.sqrt(3.0), 0.0])
        # 0.1 m at 2 m: angles differ by 0.025 from side to side, to the second order 1e-3.
        check_close("luminance", field(image, "LitLuminance"), 200 * 0.5 ** exponent, 2e-3)


def check_readable_presets():
    """All presets go through to a contrast; a running man and a word keep theirs near and lose it
    far away, where the eye does not resolve their strokes."""
    for preset in ("EN 1838", "UL 924 Stencil", "UL 924 Panel"):
        sign = simple.ExitSign(Preset=preset, Center=[0.0, 0.0, 0.0])
        light = simple.SmokeLightField(Smoke=air(0.0, (400.0, 4.0, 4.0)), Emitters=[sign],
                                       Albedo=0.0)
        light.UpdatePipeline()
        data = fetch(sign)
        luminance = photopic(cell_array(data, "Luminance"))
        weight = areas(data)
        mean = luminance @ weight / weight.sum()
        deviation = math.sqrt(((luminance - mean) ** 2) @ weight / weight.sum())
        near = field(look_at(light, [2.0, 0.0, 0.0]), "Contrast")
        check_close(preset + " near", near, deviation / mean, 0.01)
        far = field(look_at(light, [300.0, 0.0, 0.0]), "Contrast")
        assert far < 0.8 * near, (preset, near, far)


def check_detailed_image(folder):
    """A picture of 100 x 100 random grey levels costs little in the light field, and lights and
    shows the plate as its mean does."""
    path = os.path.join(folder, "noise.png")
    grey = numpy.random.default_rng(1).integers(0, 256, (100, 100), dtype=numpy.uint8)
    picture = vtkImageData()
    picture.SetDimensions(100, 100, 1)
    picture.GetPointData().SetScalars(numpy_to_vtk(grey.ravel(), deep=True))
    writer = vtkPNGWriter()
    writer.SetFileName(path)
    writer.SetInputData(picture)
    writer.Write()
    share = grey / 255.0
    linear = numpy.where(share <= 0.04045, share / 12.92, ((share + 0.055) / 1.055) ** 2.4)

    sign = simple.ExitSign(Center=[0.0, 0.0, 0.0], Width=0.3, Height=0.3, Pattern="Image",
                           PatternFile=path, Luminance=300, Reflectance=0.5)
    assert fetch(sign).GetNumberOfCells() > 9000
    light = simple.SmokeLightField(Smoke=air(0.1), Emitters=[sign], Albedo=0.0)
    began = time.process_time()
    emitters = fetch(light).GetPartition(2, 0)
    # 0.1 s here; 13 s while every cell asked how much of the sign's light it gets from the others.
    assert time.process_time() - began < 3.0, time.process_time() - began
    assert emitters.GetNumberOfCells() > 9000
    assert (cell_array(emitters, "Illuminance") == 0.0).all()
    image = look_at(light, [2.0, 0.0, 0.0])
    check_close("mean", field(image, "MeanLuminance"), 300 * linear.mean() * math.exp(-0.2), 2e-3)
    check_close("contrast", field(image, "Contrast"), linear.std() / linear.mean(), 0.01)


check_figures()
check_designs()
check_uniformity()
check_presets()
with tempfile.TemporaryDirectory() as temporary:
    check_table(temporary)
    check_detailed_image(temporary)
check_reflecting_sign()
check_reflecting_sign_in_room()
check_hidden_sign()
check_blank_plate()
check_emission_exponent()
check_readable_presets()
print("signs: passed")
