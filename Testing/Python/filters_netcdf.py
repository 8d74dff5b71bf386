"""Floor maps of all times as NetCDF and as a table, read back without the plugin: filters_netcdf.py PLUGIN DATA_FOLDER"""
import csv
import os
import tempfile

import numpy
from scipy.io import netcdf_file
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkIONetCDF import vtkNetCDFCFReader

import scenes

simple = scenes.load_plugin()
TIMES = [0.0, 60.0, 120.0, 300.0]
light = simple.SmokeLightField(
    Smoke=scenes.smoke_over_time(TIMES, [0.003 * t for t in TIMES], (4, 2, 2), (12.0, 4.0, 2.0)), Albedo=0.0,
    Emitters=[simple.ExitSign(Center=[12.0, 1.0, 1.0], Normal=[-1.0, 0.0, 0.0], Width=0.4, Height=0.2, SignId=4),
              simple.ExitSign(Center=[0.0, 3.0, 1.0], Normal=[1.0, 0.0, 0.0], Width=0.4, Height=0.2, SignId=9)])
places = simple.FloorMapOfVisibility(LightField=light, EyeHeight=1.5, Resolution=[6, 2])
FIELDS = {"perceived_contrast": "PerceivedContrast", "contrast": "Contrast", "sign_luminance": "SignLuminance",
          "visible_fraction": "VisibleFraction"}
FLAT = {"visibility": "Visibility", "visibility_error": "VisibilityError",
        "visibility_division_error": "VisibilityDivisionError", "best_sign": "BestSign",
        "visible_probability": "VisibleProbability", "status": "Status"}


def expected(time, name):
    places.UpdatePipeline(time)
    values = scenes.point_array(places.GetClientSideObject().GetOutputDataObject(0), name)
    # Points run along x first; the file has (sign, y, x).
    return values.reshape(2, 6) if values.ndim == 1 else numpy.moveaxis(values.reshape(2, 6, -1), 2, 0)


with tempfile.TemporaryDirectory() as folder:
    path = os.path.join(folder, "map.nc")
    simple.SaveData(path, proxy=places, Table=1)
    with netcdf_file(path, mmap=False) as file:
        assert file.Conventions == b"CF-1.8" and file.contrast_threshold == 0.2
        variables = {name: variable[...].copy() for name, variable in file.variables.items()}
        assert file.variables["perceived_contrast"].dimensions == ("time", "sign", "y", "x")
        assert file.variables["status"].dimensions == ("time", "y", "x")
        units = {name: getattr(variable, "units", b"") for name, variable in file.variables.items()}
        assert file.variables["status"].flag_meanings.split()[2] == b"no_sign_in_view"
    assert list(variables["time"]) == TIMES and units["time"] == b"seconds since 2000-01-01 00:00:00"
    assert numpy.allclose(variables["x"], numpy.arange(1.0, 12.0, 2.0)) and units["x"] == b"m"
    assert numpy.allclose(variables["y"], [1.0, 3.0]) and float(variables["z"]) == 1.5
    assert list(variables["sign"]) == [4, 9] and units["sign_luminance"] == b"cd m-2"
    names = [b"".join(name).rstrip(b"\0").decode() for name in variables["sign_name"]]
    assert names == ["Sign 4", "Sign 9"], names
    for i, time in enumerate(TIMES):
        for name, array in {**FIELDS, **FLAT}.items():
            assert numpy.array_equal(variables[name][i], expected(time, array)), (time, name)
    assert variables["perceived_contrast"][0].max() > 5 * variables["perceived_contrast"][3, 0, 0, 0]

    with open(os.path.join(folder, "map.csv"), newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == len(TIMES) * 12 * 2 and rows[1]["sign_name"] == "Sign 9"
    for row in rows:
        at = (TIMES.index(float(row["time_s"])), [4, 9].index(int(row["sign"])),
              int(float(row["y_m"]) // 2), int(float(row["x_m"]) // 2))
        assert float(row["z_m"]) == 1.5
        for name in FIELDS:
            column = row[name + ("_cd_m2" if name == "sign_luminance" else "")]
            scenes.check_close(name, float(column), variables[name][at], 1e-7)

    # VTK's own reader knows the dimensions and the times as well.
    reader = vtkNetCDFCFReader()
    reader.SetFileName(path)
    reader.UpdateMetaData()
    # It knows the time by its unit.
    reader.SetDimensions("(sign, y, x)")
    reader.UpdateInformation()
    steps = reader.GetOutputInformation(0).Get(vtkStreamingDemandDrivenPipeline.TIME_STEPS())
    assert list(steps) == TIMES, steps
    reader.UpdateTimeStep(300.0)
    data = reader.GetOutputDataObject(0)
    read = scenes.cell_array(data, "perceived_contrast")
    assert numpy.array_equal(read, variables["perceived_contrast"][3].ravel())

    # Some of the steps; a map without time; and what cannot be written leaves nothing behind.
    simple.SaveData(path, proxy=places, TimeRange=[50.0, 400.0], Stride=2)
    with netcdf_file(path, mmap=False) as file:
        assert list(file.variables["time"][...]) == [60.0, 300.0]
    steady = simple.FloorMapOfVisibility(LightField=scenes.tunnel((8, 2, 2), Tolerance=0.1), EyeHeight=0.5)
    simple.SaveData(path, proxy=steady)
    with netcdf_file(path, mmap=False) as file:
        assert file.variables["visibility"].shape == (1, 8, 12)
    for bad, proxy, words in ((os.path.join(folder, "none", "map.nc"), places, "map.nc': No such file"),
                              (os.path.join(folder, "wavelet.nc"), simple.Wavelet(), "SignIds"),
                              (os.path.join(folder, "stride.nc"), places, "Stride: it is below 1")):
        with scenes.Messages() as messages:
            simple.SaveData(bad, proxy=proxy, **({"Stride": 0} if "stride" in bad else {}))
        assert words in messages.text and messages.count("ERROR", "vtkFloorMapWriter") == 1, messages.text
        assert not os.path.exists(bad), bad
print("NetCDF: passed")
