"""File > Save Data writes images and maps as OpenEXR; a file that cannot be written is one error."""
import os
import tempfile

import scenes
from scenes import fetch

simple = scenes.load_plugin()
LIGHT = scenes.tunnel(cells=(8, 4, 4), Tolerance=0.1)
IMAGE = simple.VisibilityImage(LightField=LIGHT, CameraPosition=[1, 0.5, 0.5], TargetSign=0,
                               ImageSize=[16, 8])
FLOOR = simple.FloorMapOfVisibility(LightField=LIGHT, EyeHeight=0.5, Resolution=[4, 2])


def header(path):
    """The bytes before the pixels."""
    with open(path, "rb") as file:
        return file.read(6000)


with tempfile.TemporaryDirectory() as folder:
    path = os.path.join(folder, "image.exr")
    simple.SaveData(path, proxy=IMAGE)
    text = header(path)
    assert text[:4] == b"\x76\x2f\x31\x01"
    for name in (b"Y", b"Direct", b"Veil", b"Error", b"OpticalDepth", b"Mask", b"SignId"):
        assert b"\0" + name + b"\0" in text, name
    for name in (b"Contrast", b"PerceivedContrast", b"VisibleFraction", b"CameraPosition.2",
                 b"Albedo"):
        assert name + b"\0double\0" in text, name
    assert b"Units\0string\0" in text and b"cd/m2" in text
    assert os.listdir(folder) == ["image.exr"]

    path = os.path.join(folder, "map.exr")
    simple.SaveData(path, proxy=FLOOR)
    for name in (b"Visibility", b"Status", b"JinVisibility", b"Contrast"):
        assert b"\0" + name + b"\0" in header(path), name

    fetch(IMAGE)
    with scenes.Messages() as messages:
        try:
            simple.SaveData(os.path.join(folder, "no such folder", "image.exr"), proxy=IMAGE)
        except RuntimeError:
            pass
    assert messages.count("ERROR", "vtkEXRWriter") == 1, messages.text
    assert "cannot be written" in messages.text
print("EXR: passed")
