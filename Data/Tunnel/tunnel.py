"""The smoke tunnel of Zhang and Rubini: what the paper says of it, what it leaves open, and what a
camera in it sees.

The light of several sources adds up. So each source (a sign's pattern, the lamp near the sign, the
lamp near the camera) is solved alone, for a luminance of 1 cd/m2, and the picture of the sign's
plate that the camera gets from each is kept. Any mixture of luminances is then a sum of pictures,
and its contrast (standard deviation over mean, the paper's eq. 4) follows at once.
"""
import hashlib
import json
import os

import numpy
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkPolyData

# From the paper: length, width and height of the tunnel [m]; sign at one end, camera at the other.
SIZE = (4.0, 1.0, 1.0)
CAMERA = (0.01, 0.5, 0.5)

# Left open by the paper; the scripts vary what matters.
PLATE = 0.3  # m, side of the sign's plate
SQUARE = 0.75  # side of the lit square over that; 9/16 of the plate are lit, of the barcode 5/9
BARS = 9
SIGN_LUMINANCE = 500.0  # cd/m2
LAMP = 0.2  # m, side of a lamp
LAMP_FROM_END = 0.5  # m
LAMP_FLUX = 200.0  # lm; two of them make 100 lx on the floor if nothing were lost
WALLS = 0.2  # reflectance
DARK = 0.1  # cd/m2, equivalent luminance of the observer's noise
THRESHOLD, BAND = 0.2, 0.04  # of perceived contrast, and its spread over observers

# Wavelengths of a red and a green sign, of the extinction that is given, and of white lamps, whose
# light is carried in one band where the eye is most sensitive [nm].
WAVELENGTH = {"red": 630.0, "green": 532.0, "lamp": 555.0}
GIVEN = 633.0

# Albedo and Angstrom exponent. Glycol: droplets of about 1 um that do not absorb and weaken all
# colours alike. Soot: Bond and Bergstrom (2006), 0.25; Ouf et al. (2008), 1.03, rounded.
SMOKES = {"glycol": (0.99, 0.0), "soot": (0.25, 1.0)}

# Per metre, decadic; the extinction coefficient is 2.303 times that.
DENSITIES = (0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.2, 1.4, 1.6)

SOURCES = ("square", "barcode", "lamp near sign", "lamp near camera")


def extinction(density, smoke, light):
    """Extinction coefficient [1/m] of a light for an optical density per metre at 633 nm."""
    _, exponent = SMOKES[smoke]
    return numpy.log(10.0) * density * (GIVEN / WAVELENGTH[light]) ** exponent


def producer(data):
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(data)
    source.UpdatePipeline()
    return source


def add_cells(data, name, values):
    array = numpy_to_vtk(numpy.ascontiguousarray(values), deep=True)
    array.SetName(name)
    data.GetCellData().AddArray(array)


def smoke_box(size, cells, value):
    """Uniform smoke over a box that starts at the origin."""
    data = vtkImageData()
    data.SetDimensions([n + 1 for n in cells])
    data.SetSpacing([s / n for s, n in zip(size, cells)])
    add_cells(data, "Extinction", numpy.full(int(numpy.prod(cells)), float(value)))
    return data


def walls(size, reflectance):
    """The walls of such a box, their fronts inwards."""
    points = vtkPoints()
    points.SetDataTypeToDouble()
    for corner in range(8):
        points.InsertNextPoint([size[a] * (corner >> a & 1) for a in range(3)])
    outwards = [(0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)]
    polys = vtkCellArray()
    for quad in outwards:
        polys.InsertNextCell(4)
        for corner in reversed(quad):
            polys.InsertCellPoint(corner)
    data = vtkPolyData()
    data.SetPoints(points)
    data.SetPolys(polys)
    add_cells(data, "Reflectance", numpy.full(6, float(reflectance)))
    return data


def output(proxy):
    proxy.UpdatePipeline()
    data = proxy.GetClientSideObject().GetOutputDataObject(0)
    if data.GetFieldData().GetNumberOfArrays() == 0:
        raise RuntimeError("no result; see the messages above")
    return data


def field(data, name):
    return data.GetFieldData().GetArray(name).GetValue(0)


class Plate:
    """What the camera gets of the sign's plate from one source of 1 cd/m2."""

    def __init__(self, picture, contrast, error, mean_error):
        self.picture = picture  # cd/m2, a value a pixel
        self.contrast = contrast  # of the plate as MeasureSign has it
        self.error = error  # its standard error
        self.mean_error = mean_error  # standard error of the mean luminance


def contrast(picture, dark=0.0):
    """Standard deviation over mean (and dark luminance) of a picture."""
    return float(picture.std() / (picture.mean() + dark))


class Tunnel:
    """Solves the tunnel, source by source, and remembers what it solved."""

    def __init__(self, folder=None, tolerance=0.01, cells=(40, 10, 10), pixels=72):
        self.folder = folder
        self.tolerance = tolerance
        self.cells = cells
        self.pixels = pixels  # a multiple of 8 and 9, so that no pixel lies across a pattern's edge
        self.solved = {}

    def lamp_area(self):
        return LAMP * LAMP

    def lamp_luminance(self, flux):
        """Luminance [cd/m2] of a Lambertian lamp of a luminous flux [lm]."""
        return flux / (numpy.pi * self.lamp_area())

    def emitters(self, source, square, lamp_from_end, scale=None):
        """The sign and the lamps; `scale` gives luminances to several sources at once."""
        scale = scale or {source: 1.0}
        pattern = "square" if "square" in scale else "barcode"
        sign = simple.ExitSign(
            Center=[SIZE[0], 0.5, 0.5], Normal=[-1, 0, 0], Width=PLATE, Height=PLATE,
            Pattern=pattern.capitalize(), SquareFraction=square, Bars=BARS,
            Luminance=scale.get(pattern, 0.0))
        result = [sign]
        for name, x in (("lamp near sign", SIZE[0] - lamp_from_end),
                        ("lamp near camera", lamp_from_end)):
            if name in scale:
                result.append(simple.Luminaire(
                    Center=[x, 0.5, SIZE[2] - 0.001], Normal=[0, 0, -1], Up=[1, 0, 0], Width=LAMP,
                    Height=LAMP, Luminance=scale[name]))
        return result

    def solve(self, value, albedo, emitters, reflectance):
        """The picture that the camera takes of the sign."""
        smoke = producer(smoke_box(SIZE, self.cells, value))
        surfaces = producer(walls(SIZE, reflectance))
        light = simple.SmokeLightField(Smoke=smoke, Surfaces=[surfaces], Emitters=emitters,
                                       Albedo=albedo, Tolerance=self.tolerance)
        view = simple.VisibilityImage(
            LightField=light, CameraPosition=CAMERA, TargetSign=0, DarkLuminance=0,
            ImageSize=[self.pixels, self.pixels])
        data = output(view)
        picture = vtk_to_numpy(data.GetPointData().GetArray("Luminance")).astype(float)
        plate = Plate(picture, field(data, "Contrast"), field(data, "ContrastError"),
                      field(data, "MeanLuminanceError"))
        for proxy in (view, light, smoke, surfaces, *emitters):
            simple.Delete(proxy)
        return plate

    def plate(self, value, albedo, source, square=SQUARE, reflectance=WALLS,
              lamp_from_end=LAMP_FROM_END):
        """One source of 1 cd/m2 in smoke of an extinction coefficient [1/m] and albedo."""
        key = json.dumps([SIZE, CAMERA, PLATE, BARS, LAMP, round(float(value), 9), albedo, source,
                          square if source == "square" else 0, reflectance,
                          lamp_from_end if source.startswith("lamp") else 0, self.tolerance,
                          self.cells, self.pixels])
        if key in self.solved:
            return self.solved[key]
        name = self.folder and os.path.join(
            self.folder, hashlib.sha256(key.encode()).hexdigest()[:16] + ".npz")
        if name and os.path.exists(name):
            kept = numpy.load(name)
            plate = Plate(kept["picture"], *kept["numbers"])
        else:
            plate = self.solve(value, albedo, self.emitters(source, square, lamp_from_end),
                               reflectance)
            if name:
                os.makedirs(self.folder, exist_ok=True)
                numpy.savez(name, picture=plate.picture, key=key,
                            numbers=[plate.contrast, plate.error, plate.mean_error])
        self.solved[key] = plate
        return plate

    def sign(self, smoke, density, pattern, colour="red", **open_choices):
        """A sign of 1 cd/m2 and a colour in a smoke of an optical density per metre."""
        return self.plate(extinction(density, smoke, colour), SMOKES[smoke][0], pattern,
                          **open_choices)

    def lamp(self, smoke, density, which, **open_choices):
        """The veil of a white lamp of 1 cd/m2."""
        return self.plate(extinction(density, smoke, "lamp"), SMOKES[smoke][0],
                          "lamp near " + which, **open_choices)

    def picture(self, smoke, density, pattern, colour="red", luminance=SIGN_LUMINANCE, lamps=(),
                flux=LAMP_FLUX, **open_choices):
        """The plate [cd/m2] with a sign and the lamps that are on ("sign", "camera")."""
        total = luminance * self.sign(smoke, density, pattern, colour, **open_choices).picture
        for which in lamps:
            total = total + self.lamp_luminance(flux) * \
                self.lamp(smoke, density, which, **open_choices).picture
        return total


def crossing(densities, contrasts, level):
    """Density at which a contrast falls to a level, between the points by a straight line in its
    logarithm; None where it does not."""
    for i in range(1, len(densities)):
        if contrasts[i - 1] >= level > contrasts[i]:
            high, low = numpy.log(contrasts[i - 1]), numpy.log(max(contrasts[i], 1e-12))
            part = (high - numpy.log(level)) / (high - low)
            return float(densities[i - 1] + part * (densities[i] - densities[i - 1]))
    return None


def film(exposure):
    """Pixel value of an exposure [lx s at ISO 100]; the default curve of VisibilityImage."""
    middle = ((118 / 255 + 0.055) / 1.055) ** 2.4
    light = 1.0 - (1.0 - middle) ** (exposure / 0.1)
    return 255.0 * numpy.where(light <= 0.0031308, 12.92 * light,
                               1.055 * numpy.maximum(light, 1e-12) ** (1 / 2.4) - 0.055)


def photograph(picture):
    """The 8-bit photograph of a picture, exposed as an average meter wants it: a mean of
    0.65 * 12.5 lx s over the speed (ISO 2720)."""
    return numpy.round(film(picture / picture.mean() * 0.65 * 12.5 / 100.0))


def measures(picture):
    """Contrast of a picture's luminance, as perceived, and of the photograph."""
    return {"luminance": contrast(picture), "perceived": contrast(picture, DARK),
            "photograph": contrast(photograph(picture))}
