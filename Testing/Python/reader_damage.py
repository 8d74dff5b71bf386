"""FDSSmokeReader on runs with damage and on properties without sense: pvpython reader_damage.py PLUGIN DATA_FOLDER

What can be shown is shown, with a warning that says what is missing; else there is one error.
"""

import math
import os
import re
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from paraview import simple
from reader_common import Devices, Messages, Smoke, Walls, close, equal, link, load_plugin, reader, true

load_plugin(sys.argv[1])
folder = os.path.join(sys.argv[2], "Room", "fds")
index = os.path.join(folder, "room.smv")
# Extinction of cells, and the flames: HRRPUV (2) and their temperature (3) in bytes.
SMOKE = ("room_1_2.sf", "room_2_2.sf")
HEAT = ("room_1_2.s3d", "room_2_2.s3d")
GLOW = ("room_1_3.s3d", "room_2_3.s3d")


def messages_of(action):
    with Messages() as messages:
        action()
    return messages


# --- an index that cannot be read is complained of once, however often the pipeline asks ---------------
with tempfile.TemporaryDirectory() as temporary:
    path = os.path.join(temporary, "bad.smv")
    with open(path, "w") as file:
        file.write("GRID a\n 2 0 2\n")
    with Messages() as said:
        bad = reader(path)
        for _ in range(4):
            bad.UpdatePipelineInformation()
    equal(said.text.count("ERROR"), 1, "errors of a bad index")
    true("bad.smv, line 2: a mesh needs three positive cell counts" in said.text, "it names the line")

    def ask():
        bad.UpdatePipelineInformation()
        for port in range(4):
            simple.OutputPort(bad, port).UpdatePipeline(1.0)

    equal(messages_of(ask).count("ERROR"), 0, "nothing new to say")
    equal(bad.GetClientSideObject().GetOutputDataObject(0).GetNumberOfPartitionedDataSets(), 0, "no data")
    with Messages() as said:
        bad.FileName = os.path.join(temporary, "none.smv")
        ask()
    equal(said.count("ERROR"), 1, "another file, another error")
    bad.FileName = index
    equal(messages_of(ask).count("ERROR"), 0, "a good index after a bad one")
    close(Smoke(bad, 30.0).field("Time"), 30.0, 0.0, "it is read")

    # --- numbers that are none --------------------------------------------------------------------
    for name in (
        "TransparencyThreshold", "MassExtinctionCoefficient", "VisibilityFactor", "Albedo", "LuminousEfficacy"
    ):
        for value in (math.nan, math.inf, -math.inf):
            strange = reader(index)
            with Messages() as said:
                setattr(strange, name, value)
                strange.UpdatePipeline(30.0)
            equal(said.count("ERROR"), 1, "errors of %s = %g" % (name, value))
            true(name + ": it is %g" % value in said.text, "the error names " + name)
            setattr(strange, name, 0.5)
            close(Smoke(strange, 30.0).field("Time"), 30.0, 0.0, "a number again")

# --- flames that end before the smoke, and flames whose file is gone -------------------------------------
for model, cut, kept, last in (("Heat Release", HEAT, GLOW, "0.0008"), ("Temperature", GLOW, HEAT, "10.0111")):
    for size in ("inside a frame", "between frames"):
        with tempfile.TemporaryDirectory() as temporary:
            link(folder, temporary, ("room.smv",) + SMOKE + kept + (cut[1],))
            with open(os.path.join(folder, cut[0]), "rb") as file:
                whole = file.read()
            # Frames: a time (12 bytes), sizes (16), and bytes with their length in front and behind.
            end = 40
            for _ in range(2):
                end += 28 + int.from_bytes(whole[end + 28 : end + 32], "little") + 8
            with open(os.path.join(temporary, cut[0]), "wb") as file:
                file.write(whole[: end + (20 if size == "inside a frame" else 0)])
            burning = reader(os.path.join(temporary, "room.smv"), FlameModel=model)
            said = messages_of(lambda: burning.UpdatePipeline(30.0))
            true(
                cut[0] + ": " in said.text
                and "has no frame near 30 s: the flames of " + last in said.text,
                "%s cut %s: the file and the time of what is shown" % (cut[0], size),
            )
            equal(cut[0] + ": frame 3 at byte" in said.text, size == "inside a frame", "damage is named")
            equal(said.count("ERROR"), 0, "cut flames are no error")
            early = messages_of(lambda: burning.UpdatePipeline(2.0))
            true("has no frame near" not in early.text, "nothing is missing early on")
    with tempfile.TemporaryDirectory() as temporary:
        link(folder, temporary, ("room.smv",) + SMOKE + kept + (cut[1],))
        link(folder, temporary, ("room_1_8p01.q", "room_1_28p01.q", "room_2_8p01.q", "room_2_28p01.q"))
        burning = reader(os.path.join(temporary, "room.smv"), FlameModel=model)
        said = messages_of(lambda: burning.UpdatePipeline(28.0))
        true(cut[0] + ": the 8-bit file of" in said.text, "a missing file of flames is named")
        equal(said.count("ERROR"), 0, "missing flames are no error")

# --- boundary files and 2-D slices that end early ------------------------------------------------------------
with tempfile.TemporaryDirectory() as temporary:
    link(folder, temporary, ("room.smv", "room_devc.csv") + SMOKE + HEAT)
    for name in ("room_1_1.bf", "room_1_9.sf"):
        with open(os.path.join(folder, name), "rb") as file:
            whole = file.read()
        with open(os.path.join(temporary, name), "wb") as file:
            file.write(whole[:-10])
    ending = reader(os.path.join(temporary, "room.smv"))
    # ParaView updates all outputs.
    said = messages_of(lambda: ending.UpdatePipeline(30.0))
    equal((said.count("ERROR"), said.count("Warning")), (0, 1), "messages of what is cut")
    true("room.smv: 2 files of the run are not whole" in said.text, "their number")
    for port, name in ((3, "room_1_9.sf"), (4, "room_1_1.bf")):
        true(re.search(re.escape(name) + ": frame .* is cut short", said.text), name)
        simple.OutputPort(ending, port).UpdatePipeline(30.0)
        data = ending.GetClientSideObject().GetOutputDataObject(port)
        shown = [data.GetPartition(i, 0) for i in range(data.GetNumberOfPartitionedDataSets())]
        times = [block.GetFieldData().GetArray("Time").GetValue(0) for block in shown if block]
        equal(len(times), 1, "blocks whose files are there")
        true(15 < times[0] < 29, "the time of the last whole frame, %g s" % times[0])
    again = messages_of(lambda: ending.UpdatePipeline(8.0))
    equal(again.count("Warning"), 0, "it is said once")

# --- a run that still goes: one message, however many files it has begun a frame in --------------------------
with tempfile.TemporaryDirectory() as temporary:
    cut = []
    for name in sorted(os.listdir(folder)):
        if name.endswith((".sf", ".bf", ".s3d", ".csv")):
            with open(os.path.join(folder, name), "rb") as file:
                whole = file.read()
            with open(os.path.join(temporary, name), "wb") as file:
                # The coarse mesh is far behind.
                file.write(whole[: len(whole) // 2 if name in (SMOKE[1], HEAT[1]) else -10])
            cut.append(name)
    link(folder, temporary, ("room.smv",))
    growing = reader(os.path.join(temporary, "room.smv"))
    said = messages_of(lambda: growing.UpdatePipeline(8.0))
    equal((said.count("ERROR"), said.count("Warning")), (0, 1), "messages of a run that goes on")
    number = int(re.search(r"room\.smv: (\d+) files of the run are not whole", said.text).group(1))
    listed = len(re.findall(r" is cut short", said.text))
    rest = re.search(r"^and (\d+) more", said.text, re.MULTILINE)
    true(number > 5, "%d files of %d are read" % (number, len(cut)))
    equal(listed + (int(rest.group(1)) if rest else 0), number, "files listed")
    equal(messages_of(lambda: growing.UpdatePipeline(4.0)).count("Warning"), 0, "it is said once")
    late = messages_of(lambda: growing.UpdatePipeline(30.0))
    equal(late.count("Warning"), 1, "one message of all frames that are missing")
    for missing in ("Mesh 'coarse' has no frame at", HEAT[1] + ": HRRPUV of mesh 'coarse' has no frame near"):
        true(missing in late.text, missing)

# --- a mesh whose files are lost, and a pipe in place of a table -----------------------------------------------
with tempfile.TemporaryDirectory() as temporary:
    link(folder, temporary, ("room.smv", SMOKE[0]) + HEAT)
    os.mkfifo(os.path.join(temporary, "room_devc.csv"))
    part = reader(os.path.join(temporary, "room.smv"))
    said = messages_of(lambda: part.UpdatePipeline(20.0))
    true(SMOKE[1] + ": the slice of" in said.text, "the file that is missing")
    # A port that fails leaves the others as they are.
    alone = reader(os.path.join(temporary, "room.smv")).GetClientSideObject()
    alone.Update(1)
    walls = alone.GetOutputDataObject(1).GetNumberOfCells()
    said = messages_of(lambda: alone.Update(0))
    equal(said.count("ERROR"), 1, "errors of the port that fails")
    equal(alone.GetOutputDataObject(0).GetNumberOfPartitionedDataSets(), 0, "its meshes")
    equal((walls > 0, alone.GetOutputDataObject(1).GetNumberOfCells()), (True, walls), "the walls")

# --- times that are none --------------------------------------------------------------------------------------
for way in ("Nearest Frame", "Linear"):
    for time, shown in ((math.nan, -2.0), (math.inf, 30.0), (-math.inf, -2.0)):
        at = Smoke(reader(index, TimeInterpolation=way), time).field("Time")
        close(at, shown, 1e-3, "%s at %g s" % (way, time))

# --- heat release beside black bodies ----------------------------------------------------------------------
heat = Smoke(reader(index), 20.0).field("FlameHeatRelease")
glowing = Smoke(reader(index, FlameModel="Temperature"), 20.0)
close(glowing.field("FlameHeatRelease"), heat, 0.0, "heat release, whatever the model of light")
with tempfile.TemporaryDirectory() as temporary:
    link(folder, temporary, ("room.smv",) + SMOKE + GLOW)
    alone = Smoke(reader(os.path.join(temporary, "room.smv"), FlameModel="Temperature"), 20.0)
    true(not alone.data.GetFieldData().HasArray("FlameHeatRelease"), "no heat release without HRRPUV")
    close(alone.field("FlameLumens"), glowing.field("FlameLumens"), 0.0, "the light is the same")

# --- a change of what is not there ---------------------------------------------------------------------------
with tempfile.TemporaryDirectory() as temporary:
    link(folder, temporary, SMOKE + HEAT + ("room_devc.csv",))
    with open(index) as file:
        text = file.read()
    with open(os.path.join(temporary, "room.smv"), "w") as file:
        file.write(text + "HIDE_OBST     2\n   999     12.0\n")
    line = text.count("\n") + 2
    changed = reader(os.path.join(temporary, "room.smv"))
    said = messages_of(lambda: changed.UpdatePipeline(16.0))
    equal((said.count("ERROR"), said.count("Warning")), (0, 1), "messages of a strange change")
    true("room.smv, line %d: a change names obstruction 999 of mesh 'coarse'" % line in said.text, "its line")
    equal(Smoke(changed, 16.0).meshes[1].solid.sum(), 0, "the screen still goes")

# --- a table of devices that is being written --------------------------------------------------------------
with tempfile.TemporaryDirectory() as temporary:
    link(folder, temporary, ("room.smv",) + SMOKE + HEAT)
    with open(os.path.join(folder, "room_devc.csv"), "rb") as file:
        table = file.read()
    rows = table.split(b"\n")
    for size, warnings in ((len(b"\n".join(rows[:9])) + 1, 0), (len(b"\n".join(rows[:9])) + 20, 1)):
        with open(os.path.join(temporary, "room_devc.csv"), "wb") as file:
            file.write(table[:size])
        going = reader(os.path.join(temporary, "room.smv"))
        said = messages_of(lambda: simple.OutputPort(going, 2).UpdatePipeline())
        equal(said.count("Warning"), warnings, "warnings of a table of %d bytes" % size)
        equal("room_devc.csv: its last line is cut short" in said.text, warnings == 1, "what is cut")
        equal(len(Devices(going).column("Time")), 7, "rows before it")

# --- labels that would do something to a terminal, or are no text --------------------------------------------
def told(data, name):
    """The values of a text array of field or cell data."""
    array = data.GetAbstractArray(name)
    return [array.GetValue(i) for i in range(array.GetNumberOfValues())]


with tempfile.TemporaryDirectory() as temporary:
    link(folder, temporary, SMOKE[:1] + HEAT + ("room_1_9.sf", "room_2_9.sf"))
    with open(index, "rb") as file:
        bad = file.read()
    with open(os.path.join(folder, "room_devc.csv"), "rb") as file:
        table = file.read()
    for good, hostile in ((b"coarse", b"c\x1b[2Jo"), (b" WALL\n", b" W\xfcnde\n"), (b" TEMPERATURE\n", b" T\x9b31m\n")):
        true(good in bad, "the index has %s" % good)
        bad = bad.replace(good, hostile)
    with open(os.path.join(temporary, "room.smv"), "wb") as file:
        file.write(bad.replace(b" K1 %", b" K\xb9 %"))
    with open(os.path.join(temporary, "room_devc.csv"), "wb") as file:
        file.write(table.replace(b",K1,", b",K\xb9,", 1))
    strange = reader(os.path.join(temporary, "room.smv"))
    said = messages_of(lambda: strange.UpdatePipeline(20.0))
    true("'c\\x1B[2Jo'" in said.text and "\x1b" not in said.text, "the mesh's name is escaped")
    link(folder, temporary, SMOKE[1:])
    strange = reader(os.path.join(temporary, "room.smv"))
    smoke = Smoke(strange, 20.0)
    equal(smoke.meshes[1].name, "c\\x1B[2Jo", "a mesh")
    true("'c\\x1B[2Jo'" in smoke.field("ExtinctionSource"), "sources of meshes")
    true("W\\xFCnde" in Walls(strange, 20.0).surface, "a surface in Latin-1")
    columns = Devices(strange)
    equal(columns.names()[1], "K\\xB9", "a device in Latin-1")
    true(not math.isnan(columns.position("K\\xB9")[0]), "it is where the index has it")
    simple.OutputPort(strange, 3).UpdatePipeline(20.0)
    planes = strange.GetClientSideObject().GetOutputDataObject(3)
    names = [planes.GetMetaData(i).Get(planes.NAME()) for i in range(planes.GetNumberOfPartitionedDataSets())]
    true(any(name.startswith("T\\x9B31m fine") for name in names), "a quantity of slices")

print("reader_damage: all as expected")
