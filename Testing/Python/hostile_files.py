"""Files that somebody prepared to do harm, and wishes beyond any machine: an error, or good data, and soon.

Damaged forms of each kind of file that a sign, lamp, camera or building is described by, and of a state file;
then the requests for 1e9 places, pixels and lamps, with little memory left to the process.
"""
import contextlib
import os
import random
import re
import resource
import struct
import subprocess
import sys
import tempfile
import time

import scenes
from samples import IES, RESPONSE, png
from scenes import fetch, image, producer

simple = scenes.load_plugin()
DATA = sys.argv[2]
# The pipeline's own message, that an algorithm failed, follows the algorithm's.
ERRORS = re.compile(r"ERROR: In .*\nvtk(?!\w*Pipeline )")
LONGEST = 20.0  # s, for a file that a reader should turn down at once


def variants(good):
    """What may have become of a file on its way, or have been made of it: (name, bytes)."""
    chance = random.Random(7)
    yield "empty", b""
    yield "zeros", bytes(2000)
    yield "noise", chance.randbytes(4000)
    yield "one long line", b"1," * 500000
    yield "deep", b"[" * 100000
    yield "shell", b"$(touch harm);`touch harm`\n" + good
    yield "python", b"__import__('os').system('touch harm')\n" + good
    for number in (b"1e999", b"nan", b"-99999999999999999999", b"2147483648", b"0x41"):
        digits = [i for i, byte in enumerate(good) if 48 <= byte < 58]
        place = chance.choice(digits or [0])
        yield "number " + number.decode(), good[:place] + number + good[place + 1:]
    for _ in range(25):
        damaged = bytearray(good)
        for _ in range(chance.randint(1, 6)):
            damaged[chance.randrange(len(damaged))] = chance.randrange(256)
        yield "damaged", bytes(damaged[: chance.choice((len(damaged), len(damaged) // 2))])


def read(make, path, what):
    """Makes a pipeline object of a file: one error and no output, or output without an error."""
    start = time.perf_counter()
    with scenes.Messages() as messages:
        proxy = make(path)
        data = fetch(proxy)
    taken = time.perf_counter() - start
    errors = len(ERRORS.findall(messages.text))
    cells = data.GetNumberOfCells()
    assert errors <= 1 and (errors == 0) == (cells > 0), (what, errors, cells, messages.text)
    assert taken < LONGEST, (what, taken)
    simple.Delete(proxy)
    return errors


def check_files(folder):
    with open(os.path.join(DATA, "Hall", "signs.csv"), "rb") as file:
        signs = file.read()
    with open(os.path.join(DATA, "CAD", "materials.csv"), "rb") as file:
        materials = file.read()
    light = scenes.tunnel((8, 2, 2), Tolerance=0.2)

    def camera(path):
        return simple.VisibilityImage(LightField=light, ResponseFile=path, ImageSize=[8, 8],
                                      CameraPosition=[0.5, 0.5, 0.5], TargetSign=0)

    def building(path):
        return simple.CADReader(FileName=os.path.join(DATA, "CAD", "kiosk.stl"), MaterialTable=path)

    kinds = {
        "table.csv": (signs, lambda path: simple.ExitSign(SignTable=path)),
        "picture.png": (png(), lambda path: simple.ExitSign(Pattern="Image", PatternFile=path)),
        "lamp.ies": (IES.encode(), lambda path: simple.Luminaire(PhotometricFile=path)),
        "response.csv": (RESPONSE.encode(), camera),
        "materials.csv": (materials, building),
        "materials.json": (b'[{"name": "Plaster*", "reflectance": 0.7}]', building),
    }
    for name, (good, make) in kinds.items():
        path = os.path.join(folder, name)
        with open(path, "wb") as file:
            file.write(good)
        assert read(make, path, name) == 0, name
        turned_down = 0
        for what, data in variants(good):
            with open(path, "wb") as file:
                file.write(data)
            turned_down += read(make, path, name + ", " + what)
        assert turned_down >= 5, (name, turned_down)
        # What is no file: a folder, a device without an end, a pipe that nobody writes to.
        pipe = os.path.join(folder, "pipe." + name)
        os.mkfifo(pipe)
        for path in (folder, "/dev/zero", pipe, os.path.join(folder, "gone")):
            assert read(make, path, name + ", " + path) == 1, (name, path)
    assert not os.path.exists("harm") and not os.path.exists(os.path.join(folder, "harm"))


def check_state(folder):
    """A state file is data: what looks like code in it is not run, and what is damaged is not loaded."""
    simple.ExitSign(SignTable=os.path.join(DATA, "Hall", "signs.csv"), Text="NOTAUSGANG")
    path = os.path.join(folder, "state.pvsm")
    simple.SaveState(path)
    with open(path) as file:
        state = file.read()
    harm = os.path.join(folder, "harm")
    assert state.count('value="NOTAUSGANG"') == 1
    state = state.replace('value="NOTAUSGANG"', "value=\"__import__('os').mknod('%s')\"" % harm)
    with open(path, "w") as file:
        file.write(state)
    script = ("import sys; sys.argv = ['', %r]; sys.path.insert(0, %r); import scenes; "
              "s = scenes.load_plugin(); s.LoadState(%r); "
              "[p.UpdatePipeline() for p in s.GetSources().values()]"
              % (sys.argv[1], os.path.dirname(os.path.abspath(__file__)), path))
    program = os.path.join(folder, "open.py")
    with open(program, "w") as file:
        file.write(script)
    subprocess.run(["pvpython", "--force-offscreen-rendering", program], check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=100)
    assert not os.path.exists(harm)


def refused(proxy, *parts):
    """One error with these words, and no output."""
    start = time.perf_counter()
    with scenes.Messages() as messages:
        data = fetch(proxy)
    assert len(ERRORS.findall(messages.text)) == 1, (parts, messages.text)
    for part in parts:
        assert part in messages.text, (part, messages.text)
    assert data.GetNumberOfElements(0) == 0, parts
    assert time.perf_counter() - start < LONGEST, parts
    simple.Delete(proxy)


@contextlib.contextmanager
def little_memory():
    """Half a gigabyte more than this process has now, and no more."""
    with open("/proc/self/status") as file:
        taken = next(1024 * int(line.split()[1]) for line in file if line.startswith("VmRSS"))
    before = resource.getrlimit(resource.RLIMIT_DATA)
    resource.setrlimit(resource.RLIMIT_DATA, (taken + 2 ** 29, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_DATA, before)


def check_memory():
    light = scenes.tunnel((8, 2, 2), Tolerance=0.2)
    fetch(light)
    # Beyond what makes sense.
    refused(simple.FloorMapOfVisibility(LightField=light, EyeHeight=0.5, Resolution=[40000, 25000]),
            "Resolution", "100 million places", "Give fewer")
    refused(simple.VisibilityImage(LightField=light, ImageSize=[40000, 25000]),
            "ImageSize", "100 million pixels", "Give a smaller image")
    refused(simple.Luminaire(Count=[10 ** 9, 1], Spacing=[1, 1]), "Count", "1 to 10000")
    refused(simple.Luminaire(Count=[10000, 10000], Spacing=[1, 1]), "more than a million")
    # Beyond what this process may have.
    many = producer(image((300, 100, 100), (4.0, 1.0, 1.0)), "ManyCells")
    with little_memory():
        refused(simple.FloorMapOfVisibility(LightField=light, EyeHeight=0.5, Resolution=[9000, 9000]),
                "Resolution", "MiB of memory", "are free", "Give fewer places")
        refused(simple.VisibilityImage(LightField=light, ImageSize=[9000, 9000]),
                "ImageSize", "MiB of memory", "are free", "Give a smaller image")
        refused(simple.SmokeLightField(Smoke=many, Emitters=[scenes.tunnel_sign()]),
                "3000000 smoke cells", "MiB of memory", "Give coarser smoke")


def check_run(folder):
    """A run of a few kilobytes on disk (its slice is a file with a hole) whose mesh has 3e8 cells."""
    cells = 700
    index = ["CHID", " huge", "", "NMESHES", " 1", "", "GRID mesh", " %d %d %d 0" % (3 * (cells,)),
             "", "PDIM", " 0 1 0 1 0 1 0 0 0", ""]
    for axis in "XYZ":
        index += ["TRN" + axis, " 0"] + [" %d %g" % (k, k / cells) for k in range(cells + 1)] + [""]
    index += ["OBST", " 0", "", "VENT", " 0 0", "",
              "SLCC 1 # STRUCTURED & 0 %d 0 %d 0 %d ! 1 1 0" % (3 * (cells,)),
              " huge_1_1.sf", " SOOT EXTINCTION COEFFICIENT", " ext_coef_C", " 1/m", ""]
    path = os.path.join(folder, "huge.smv")
    with open(path, "w") as file:
        file.write("\n".join(index))

    def record(data):
        return struct.pack("<i", len(data)) + data + struct.pack("<i", len(data))

    with open(os.path.join(folder, "huge_1_1.sf"), "wb") as file:
        for label in ("SOOT EXTINCTION COEFFICIENT", "ext_coef_C", "1/m"):
            file.write(record(label.ljust(30).encode()))
        file.write(record(struct.pack("<6i", 0, cells, 0, cells, 0, cells)))
        file.write(record(struct.pack("<f", 0.0)))
        values = 4 * (cells + 1) ** 3
        file.write(struct.pack("<i", values))
        file.seek(values, os.SEEK_CUR)
        file.write(struct.pack("<i", values))
    with little_memory():
        refused(simple.FDSSmokeReader(FileName=path), "huge.smv", "its smoke would take",
                "MiB of memory")


with tempfile.TemporaryDirectory() as temporary:
    check_files(temporary)
    check_state(temporary)
    check_run(temporary)
check_memory()
print("hostile files: passed")
