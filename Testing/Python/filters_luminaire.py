"""Luminaires with photometric files, and daylight, from the file to illuminance and luminance."""
import math
import os
import tempfile

import numpy

import scenes
from scenes import cell_array, check_close, fetch, field

simple = scenes.load_plugin()


def candela(vertical, horizontal):
    """A wide beam that is stronger to the sides of 0 and 180 degrees; 5 cd upwards."""
    if vertical > 90:
        return 5.0
    sine = math.sin(math.radians(vertical))
    spread = 1 + 0.5 * sine ** 2 * math.cos(math.radians(2 * horizontal))
    return 5 + 400 * math.cos(math.radians(vertical)) * (0.5 + 1.5 * sine ** 2) * spread


def write(path, up=False, size="0.1 0.2 0", lumens=2000):
    vertical = [2.5 * i for i in range(73 if up else 37)]
    horizontal = [5.0 * i for i in range(19)]
    with open(path, "w") as file:
        file.write("IESNA:LM-63-2002\n[TEST] made for a test\n[MANUFAC] none\nTILT=NONE\n")
        file.write("1 %g 1 %d %d 1 2 %s\n1 1 20\n" % (lumens, len(vertical), len(horizontal), size))
        for angles in (vertical, horizontal):
            file.write(" ".join("%g" % a for a in angles) + "\n")
        for c in horizontal:
            file.write(" ".join("%.6g" % candela(v, c) for v in vertical) + "\n")
    return path


def flux(up):
    """The integral of the candelas, by a fine sum."""
    total = 0.0
    for v in numpy.arange(0.25, 180 if up else 90, 0.5):
        ring = numpy.mean([candela(v, c) for c in range(0, 360, 3)])
        total += 2 * math.pi * ring * math.sin(math.radians(v)) * math.radians(0.5)
    return total


def floor(places, size=0.1):
    """Small horizontal plates at z = 0 that face up, without reflection."""
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
    points, polys = vtkPoints(), vtkCellArray()
    points.SetDataTypeToDouble()
    for x, y in places:
        ids = [points.InsertNextPoint(x + size * dx, y + size * dy, 0)
               for dx, dy in ((-.5, -.5), (.5, -.5), (.5, .5), (-.5, .5))]
        polys.InsertNextCell(4, ids)
    data = vtkPolyData()
    data.SetPoints(points)
    data.SetPolys(polys)
    scenes.add_cells(data, "Reflectance", numpy.zeros(len(places)))
    return scenes.producer(data, "Floor")


def block(light, kind, index=0):
    return fetch(light).GetPartition(kind, index)


def check_lamp(path):
    """Candelas are kept, the opening's size is taken over, and the flux is reported."""
    data = fetch(simple.Luminaire(PhotometricFile=write(path)))
    assert data.GetNumberOfCells() == 1
    # Width, 0.1 m, across the plane of horizontal angle 0, which is Up, here y; length along it.
    assert numpy.allclose(data.GetBounds(), [-0.05, 0.05, -0.1, 0.1, 0, 0])
    # Half a percent for the interpolation over 2.5 degrees.
    check_close("flux", field(data, "LampFlux"), flux(False), 0.005)
    assert field(data, "RatedFlux") == 2000
    check_close("luminance", cell_array(data, "Luminance")[0],
                field(data, "LampFlux") / (math.pi * 0.02), 1e-9)
    index = cell_array(data, "PhotometryIndex")[0]
    intensity = data.GetFieldData().GetArray("Photometry%dIntensity" % index)
    check_close("candela", intensity.GetValue(12), candela(30, 0), 1e-5)

    scaled = fetch(simple.Luminaire(PhotometricFile=path, LuminousFlux=100, SizeFromFile=0))
    check_close("scaled flux", field(scaled, "LampFlux"), 100, 1e-9)
    assert numpy.allclose(scaled.GetBounds(), [-0.3, 0.3, -0.3, 0.3, 0, 0])

    both = fetch(simple.Luminaire(PhotometricFile=write(path, up=True), Count=[2, 1]))
    assert both.GetNumberOfCells() == 4
    check_close("flux both ways", field(both, "LampFlux"), flux(True), 0.005)
    assert numpy.allclose(both.GetBounds()[4:], [0, 0.001])

    with scenes.Messages() as messages:
        fetch(simple.Luminaire(PhotometricFile=write(path, lumens=100)))
    assert messages.count("Warning", "vtkLuminaireSource") == 1, messages.text
    assert "more than the 100 lm" in messages.text


def check_plane(path):
    """Illuminance on a plane against candela / r^2 cos, in clear air and through black smoke."""
    write(path, up=True)
    places = [(0, 0), (1.5, 0), (0, 1.5), (-1, 2), (2, -2.5), (3, 3)]
    lamp = simple.Luminaire(Center=[0, 0, 3], PhotometricFile=path)
    for extinction in (0.0, 0.5):
        air = scenes.producer(
            scenes.image((8, 8, 4), (8, 8, 4), extinction, (-4, -4, 0)), "Air")
        light = simple.SmokeLightField(Smoke=air, Surfaces=[floor(places)], Emitters=[lamp],
                                       Albedo=0.0)
        values = cell_array(block(light, 1), "Illuminance")
        for (x, y), value in zip(places, values):
            distance = math.sqrt(x * x + y * y + 9)
            vertical = math.degrees(math.acos(3 / distance))
            # Horizontal angle 0 is y; seen from above it grows counter-clockwise, towards -x.
            horizontal = math.degrees(math.atan2(-x, y))
            expected = candela(vertical, horizontal) * 3 / distance ** 3
            check_close("illuminance at %g, %g" % (x, y), value,
                        expected * math.exp(-extinction * distance), 0.01)
    # Fluence of a cell: its centre's value, to the second order in its size over the distance.
    fluence = cell_array(block(light, 0), "Fluence")
    centre = numpy.array([1.5, 0.5, 0.5])
    index = 5 + 8 * 4 + 64 * 0
    way = centre - [0, 0, 3]
    distance = numpy.linalg.norm(way)
    expected = candela(math.degrees(math.acos(-way[2] / distance)),
                       math.degrees(math.atan2(-way[0], way[1]))) / distance ** 2
    check_close("fluence", fluence[index], expected * math.exp(-0.5 * distance), 0.05)


def check_room(path):
    """A closed room with scattering smoke takes in all of the flux, up and down, and a light field
    that is saved and read back keeps the photometry."""
    write(path, up=True)
    lamp = simple.Luminaire(Center=[2, 1.5, 2], PhotometricFile=path)
    walls = scenes.producer(scenes.box((4, 3, 3), 0.5), "Walls")
    smoke = scenes.producer(scenes.image((8, 6, 6), (4, 3, 3), 0.3), "Smoke")
    light = simple.SmokeLightField(Smoke=smoke, Surfaces=[walls], Emitters=[lamp], Albedo=0.5,
                                   PatchSize=0.25)
    absorbed = 0.3 * 0.5 * 0.125 * cell_array(block(light, 0), "Fluence").sum()
    patches = block(light, 1)
    simple_areas = simple.CellSize(Input=scenes.producer(patches, "Patches"))
    sizes = cell_array(fetch(simple_areas), "Area")
    absorbed += 0.5 * (sizes * cell_array(patches, "Illuminance")).sum()
    for index, data in enumerate((block(light, 2),)):
        absorbed += 0.02 * cell_array(data, "Illuminance").sum()
        absorbed += 0.02 * cell_array(data, "IlluminanceBack").sum()
    check_close("flux in the room", absorbed, field(fetch(lamp), "LampFlux"), 0.015)

    eye = [3.2, 1.5, 0.8]
    image = simple.VisibilityImage(LightField=light, CameraPosition=eye,
                                   CameraFocalPoint=[2, 1.5, 2], ImageSize=[16, 16],
                                   FocalLength=500)
    direct = scenes.point_array(fetch(image), "DirectLuminance").max()
    way = math.dist(eye, [2, 1.5, 2])
    vertical = math.acos(1.2 / way)
    expected = candela(math.degrees(vertical), 90) / (0.02 * math.cos(vertical))
    check_close("luminance of the lamp", direct, expected * math.exp(-0.3 * way), 0.02)

    saved = os.path.join(os.path.dirname(path), "light.vtpc")
    simple.SaveData(saved, proxy=light, DataMode="Binary")
    again = simple.VisibilityImage(LightField=simple.OpenDataFile(saved), CameraPosition=eye,
                                   CameraFocalPoint=[2, 1.5, 2], ImageSize=[16, 16],
                                   FocalLength=500)
    assert scenes.point_array(fetch(again), "DirectLuminance").max() == direct


def check_errors(path):
    with open(path, "w") as file:
        file.write("IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 3 1 1 2 0 0 0\n1 1 10\n0 45 90\n0\n1 x 3\n")
    for what, part, properties in (
            ("bad number", "line 7: 'x' stands for the intensity", {"PhotometricFile": path}),
            ("no file", "no such file", {"PhotometricFile": path + "x"})):
        with scenes.Messages() as messages:
            cells = fetch(simple.Luminaire(**properties)).GetNumberOfCells()
        assert messages.count("ERROR", "vtkLuminaireSource") == 1, (what, messages.text)
        assert part in messages.text and cells == 0, (what, messages.text)
    # Lamps whose tables a filter has dropped are told from Lambertian ones.
    lamp = fetch(simple.Luminaire(PhotometricFile=write(path)))
    data = lamp.NewInstance()
    data.ShallowCopy(lamp)
    data.GetFieldData().Initialize()
    air = scenes.producer(scenes.image((2, 2, 2), (1, 1, 1), 0.0), "Air")
    light = simple.SmokeLightField(Smoke=air, Emitters=[scenes.producer(data, "Lamp")])
    with scenes.Messages() as messages:
        fetch(light)
    assert "its field data have no array Photometry" in messages.text, messages.text


def check_daylight():
    """A sky of 2000 cd/m2 over an open floor: pi L, on both sides, and L where nothing is met; with
    smoke above, exp(-K s) of it; a negative sky is an error."""
    air = scenes.producer(scenes.image((4, 4, 4), (4, 4, 4), 0.0, (-2, -2, -2)), "Air")
    light = simple.SmokeLightField(Smoke=air, Surfaces=[floor([(0, 0)], 2.8)], SkyLuminance=2000)
    patches = block(light, 1)
    # A black floor is seen nowhere in the veil, which the tolerance is about: the spread of the
    # batches tells how well its mean is known.
    batches = cell_array(patches, "MultipleIlluminance").reshape(-1, 2, 16).mean(axis=0)
    for side, own in (("Illuminance", batches[0]), ("IlluminanceBack", batches[1])):
        error = own.std(ddof=1) / 4 / (2000 * math.pi)
        assert error < 0.02, error
        check_close(side, cell_array(patches, side).mean(), 2000 * math.pi, 0.002 + 3 * error)
    look = dict(CameraPosition=[1.5, 0, -1], CameraFocalPoint=[1.5, 0, 1], CameraViewUp=[1, 0, 0],
                ImageSize=[8, 8], FocalLength=2000)
    image = fetch(simple.VisibilityImage(LightField=light, **look))
    assert numpy.allclose(scenes.point_array(image, "Luminance"), 2000)
    smoke = scenes.producer(scenes.image((4, 4, 4), (4, 4, 4), 0.4, (-2, -2, -2)), "Smoke")
    light = simple.SmokeLightField(Smoke=smoke, SkyLuminance=2000, Albedo=0.0)
    image = fetch(simple.VisibilityImage(LightField=light, **look))
    # A long focal length: all pixels look straight up through 3 m.
    assert numpy.allclose(scenes.point_array(image, "Luminance"), 2000 * math.exp(-1.2), rtol=1e-4)
    light.SkyLuminance = -1
    with scenes.Messages() as messages:
        fetch(light)
    assert messages.count("ERROR", "vtkSmokeLightField") == 1 and "SkyLuminance" in messages.text


with tempfile.TemporaryDirectory() as temporary:
    lamp_file = os.path.join(temporary, "lamp.ies")
    check_lamp(lamp_file)
    check_plane(lamp_file)
    check_room(lamp_file)
    check_errors(lamp_file)
check_daylight()
print("luminaires and daylight: passed")
