"""Bad input to light field and views: one message that says what to do, and no output."""
import math

import numpy

import scenes
from scenes import add_cells, box, fetch, image, producer

simple = scenes.load_plugin()
SIZE = (2.0, 1.0, 1.0)
CELLS = (4, 2, 2)


def empty(data):
    if data.IsA("vtkCompositeDataSet"):
        return data.GetNumberOfPartitionedDataSets() == 0
    return data.GetNumberOfPoints() == 0 and data.GetPointData().GetNumberOfArrays() == 0


def check_error(filter_, class_name, *parts):
    with scenes.Messages() as messages:
        data = fetch(filter_)
    assert messages.count("ERROR", class_name) == 1, (parts, messages.text)
    for part in parts:
        assert part in messages.text, (part, messages.text)
    assert empty(data), parts
    simple.Delete(filter_)


def sign():
    return simple.ExitSign(Center=[2, 0.5, 0.5], Normal=[-1, 0, 0], Width=0.4, Height=0.4)


def field_error(*parts, smoke=None, surfaces=None, emitters=None, **properties):
    walls = surfaces if surfaces is not None else [producer(box(SIZE, 0.2), "Walls")]
    check_error(simple.SmokeLightField(
        Smoke=producer(smoke if smoke is not None else image(CELLS, SIZE), "Smoke"),
        Surfaces=walls, Emitters=emitters if emitters is not None else [sign()], **properties),
        "vtkSmokeLightField", *parts)


def check_light_field():
    from vtkmodules.vtkCommonDataModel import vtkPartitionedDataSetCollection, vtkUnstructuredGrid
    from vtkmodules.vtkCommonDataModel import vtkImageData

    field_error("no grid", smoke=vtkPartitionedDataSetCollection())
    field_error("nothing gives light", emitters=[])
    for value, text in ((numpy.nan, "nan"), (-1, "-1"), (numpy.inf, "inf")):
        smoke = image(CELLS, SIZE)
        smoke.GetCellData().GetArray("Extinction").SetComponent(5, 0, value)
        field_error("cell array Extinction of block 'Smoke'", "cell 5 is " + text, smoke=smoke)
    smoke = image(CELLS, SIZE)
    smoke.GetCellData().RemoveArray("Extinction")
    field_error("no array Extinction", smoke=smoke)
    smoke = image(CELLS, SIZE)
    smoke.SetDirectionMatrix(0, -1, 0, 1, 0, 0, 0, 0, 1)
    field_error("turned", smoke=smoke)
    smoke = vtkImageData()
    smoke.SetDimensions(3, 3, 1)
    add_cells(smoke, "Extinction", numpy.ones(4))
    field_error("single node along z", smoke=smoke)

    walls = box(SIZE, 0.2)
    walls.GetCellData().GetArray("Reflectance").SetComponent(3, 0, 1.5)
    field_error("cell array Reflectance of block 'Surfaces'", "is 1.5",
                surfaces=[producer(walls, "Walls")])
    walls = box(SIZE, 0.2)
    add_cells(walls, "Reflectance", numpy.full((6, 2), 0.5))
    field_error("2 components", surfaces=[producer(walls, "Walls")])
    walls = box(SIZE, 0.2)
    walls.GetPoints().SetPoint(2, numpy.nan, 0, 0)
    field_error("point 2", "not finite", surfaces=[producer(walls, "Walls")])
    field_error("no cell array Luminance", emitters=[producer(box(SIZE, 0.2), "Lamp")])
    lamp = box(SIZE, 0.2)
    add_cells(lamp, "Luminance", numpy.array([1, 1, -2, 1, 1, 1.0]))
    field_error("cell array Luminance of block 'Emitters'", "cell 2 is -2",
                emitters=[producer(lamp, "Lamp")])

    field_error("Albedo", "not at most 1", Albedo=1.5)
    field_error("Albedo", "not at most 1", Albedo=math.nan)
    field_error("Tolerance", Tolerance=0)
    field_error("DefaultReflectance", DefaultReflectance=-0.1)
    field_error("Raise PatchSize", PatchSize=1e-6)
    field_error("Wavelengths", Bands="RGB", Wavelengths=[630, 0, 465])


def check_views():
    light = simple.SmokeLightField(Smoke=producer(image(CELLS, SIZE), "Smoke"),
                                   Surfaces=[producer(box(SIZE, 0.2), "Walls"),
                                             producer(box((0.4, 0.4, 0.4), 0.2, (0.5, 0.3, 0.3),
                                                          False), "Block")],
                                   Emitters=[sign()])
    fetch(light)

    def picture(*parts, **properties):
        settings = dict(CameraPosition=[0.2, 0.1, 0.1])
        settings.update(properties)
        check_error(simple.VisibilityImage(LightField=light, **settings), "vtkVisibilityImage",
                    *parts)

    picture("no sign 5", "of this light field: 0", TargetSign=5)
    picture("more than 100 million", ImageSize=[10 ** 6, 10 ** 6])
    picture("FocalLength", FocalLength=0)
    picture("coincide", CameraFocalPoint=[0.2, 0.1, 0.1])
    picture("CameraFocalPoint: it is not finite", CameraFocalPoint=[1.0, math.nan, 0.1])
    picture("CameraViewUp: it is not finite", CameraViewUp=[0.0, 0.0, math.inf])

    def floor(*parts, **properties):
        settings = dict(EyeHeight=0.5)
        settings.update(properties)
        check_error(simple.FloorMapOfVisibility(LightField=light, **settings),
                    "vtkFloorMapOfVisibility", *parts)

    floor("more than 100 million places", Resolution=[2 * 10 ** 9, 2 * 10 ** 9])
    floor("not between floor and ceiling", EyeHeight=1.7)
    floor("lower bound", Bounds=[0, 1, 0, -1, 0, 1])
    floor("ContrastThreshold", ContrastThreshold=-1)

    # An area that no place of is in the smoke or sees a sign may be meant in other units: a warning.
    for bounds, warnings in (([2000, 3000, 200, 800, 0, 1000], 1), ([-3, -2, 0, 1, 0, 1], 1),
                             ([0.2, 0.8, 0.2, 0.8, 0, 1], 0)):
        floor_map = simple.FloorMapOfVisibility(LightField=light, EyeHeight=0.5, Bounds=bounds,
                                                Resolution=[3, 2])
        with scenes.Messages() as messages:
            data = fetch(floor_map)
        assert data.GetNumberOfPoints() == 6
        assert messages.count("Warning", "vtkFloorMapOfVisibility") == warnings, messages.text
        assert ("outside of the smoke" in messages.text) == (warnings == 1), messages.text
        simple.Delete(floor_map)

    # A sign behind the eye, seen from its back or hidden is no error but a warning.
    view = simple.VisibilityImage(LightField=light, CameraPosition=[0.2, 0.5, 0.5], TargetSign=0,
                                  ImageSize=[8, 8])
    with scenes.Messages() as messages:
        data = fetch(view)
    assert messages.count("ERROR", "vtkVisibilityImage") == 0, messages.text
    assert messages.count("Warning", "vtkVisibilityImage") == 1, messages.text
    assert scenes.field(data, "VisibleFraction") == 0 and scenes.field(data, "Contrast") == 0

    # Smoke that cells are too coarse for, which may not be refined, is no error but a warning, given
    # once; what scatters less is not too thick.
    for albedo, refined, warnings in ((0.9, 0, 1), (0.9, 500000, 0), (0.1, 0, 0)):
        thick = simple.SmokeLightField(Smoke=producer(image(CELLS, SIZE, extinction=20.0), "ThickSmoke"),
                                       Emitters=[simple.Luminaire(Center=[1, 0.5, 1])], Albedo=albedo,
                                       Tolerance=0.1, MaximumRefinedCells=refined)
        with scenes.Messages() as messages:
            fetch(thick)
        assert messages.count("Warning", "vtkSmokeLightField") == warnings, messages.text
        assert ("MaximumRefinedCells" in messages.text) == (warnings == 1), messages.text

    # Two sources that keep the same SignId make one sign, which nobody means; the pieces of one
    # sign may come from two sources.
    for place, sign_id, warnings in (([1.0, 0.95, 0.5], 0, 1), ([1.0, 0.95, 0.5], 1, 0),
                                     ([1.95, 0.6, 0.5], 0, 0)):
        signs = [simple.ExitSign(Center=[1.95, 0.5, 0.5], Normal=[-1, 0, 0], Width=0.1, Height=0.1),
                 simple.ExitSign(Center=place, Normal=[-1, 0, 0], Width=0.1, Height=0.1,
                                 SignId=sign_id)]
        two = simple.SmokeLightField(Smoke=producer(image(CELLS, SIZE), "Smoke"), Emitters=signs,
                                     Tolerance=0.1)
        with scenes.Messages() as messages:
            fetch(two)
        assert messages.count("Warning", "vtkSmokeLightField") == warnings, messages.text
        assert ("SignId 0" in messages.text) == (warnings == 1), messages.text

    # Smoke inside the obstruction is none: its cells are solid.
    solid = image((20, 10, 10), SIZE)
    extinction = scenes.cell_array(solid, "Extinction").reshape(10, 10, 20)
    extinction[3:7, 3:7, 5:9] = 0
    light.Smoke = producer(solid, "SolidSmoke")
    picture("inside a solid", CameraPosition=[0.7, 0.5, 0.5])

    # A lamp is no sign.
    lamps = simple.SmokeLightField(Smoke=producer(image(CELLS, SIZE), "Smoke"),
                                   Emitters=[simple.Luminaire(Center=[1, 0.5, 1])])
    check_error(simple.FloorMapOfVisibility(LightField=lamps, EyeHeight=0.5),
                "vtkFloorMapOfVisibility", "holds no sign")

    # Any other collection is not a light field.
    other = simple.GroupDatasets(Input=[producer(box(SIZE, 0.2), "Walls")])
    check_error(simple.FloorMapOfVisibility(LightField=other), "vtkFloorMapOfVisibility",
                "no block named Smoke")


check_light_field()
check_views()
print("errors: passed")
