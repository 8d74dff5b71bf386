"""Panels of all proxies: panels.py PLUGIN DATA_FOLDER

Every property is documented with its default, which is that of the C++ class, and stands in one group; filters
are in the menu Fire with an icon; files open by their extension; the colour map of floor maps works.
"""

import glob
import os
import re
import sys
import xml.etree.ElementTree as xml

import numpy

import scenes

simple = scenes.load_plugin()
folder = os.path.join(sys.argv[2], os.pardir, "Plugin")


def words(element):
    return " ".join("".join(element.itertext()).split())


def numbers(text):
    return [float(part) for part in re.findall(r"-?[0-9]+(?:\.[0-9]+)?(?:e[-+]?[0-9]+)?", text)]


def printed_values(group, name):
    """What an object that nobody has touched prints of itself."""
    proxy = simple.servermanager.ProxyManager().NewProxy(group, name)
    proxy.UpdateVTKObjects()
    untouched = proxy.GetClientSideObject().NewInstance()
    return dict(re.findall(r"^\s*(\w+): (.*)$", str(untouched), re.MULTILINE))


def is_default(element, printed):
    default = element.get("default_values")
    if element.tag == "StringVectorProperty":
        return printed == (default or "(none)")
    return numpy.allclose(numbers(printed), numbers(default))


# --- documentation, defaults, groups ------------------------------------------------------------------
checked = 0
for path in sorted(glob.glob(os.path.join(folder, "*.xml"))):
    for group, proxy in [(group.get("name"), proxy) for group in xml.parse(path).getroot()
                         for proxy in group]:
        name = proxy.get("name")
        # What ParaView's own ways to show data have in common comes from them, panels and menus too.
        drawn = proxy.tag.endswith("RepresentationProxy")
        assert proxy.find("Documentation") is not None, name
        printed = printed_values(group, name)
        grouped = [entry.get("name") for group in proxy.findall("PropertyGroup")
                   for entry in group.findall("Property")]
        assert len(grouped) == len(set(grouped)), (name, grouped)
        known = set()
        for element in proxy:
            key = element.get("name")
            if not element.tag.endswith("Property"):
                continue
            known.add(key)
            assert element.find("Documentation") is not None, (name, key)
            documentation = words(element.find("Documentation"))
            # ParaView's Python names properties by their labels.
            label = element.get("label")
            assert label is None or re.sub("[^A-Za-z0-9]", "", label) == key, (name, key, label)
            if element.tag in ("InputProperty", "Property") or element.get("information_only"):
                continue
            if key == "FileName":
                assert printed.get(key, "(none)") == "(none)", (name, printed)
                continue
            assert re.search("[Dd]efault", documentation), (name, key, documentation)
            if drawn and key not in printed:
                continue
            assert key in printed, (name, key, "is not printed")
            assert is_default(element, printed[key]), (
                name, key, printed[key], element.get("default_values"))
            stated = re.search(r"[Dd]efault:? ([-(0-9].*)", documentation)
            if stated:
                values = numbers(element.get("default_values"))
                assert numpy.allclose(numbers(stated.group(1))[: len(values)], values), (
                    name, key, stated.group(1), values)
            assert drawn or key in grouped, (name, key, "is in no group")
            checked += 1
        assert set(grouped) <= known, (name, set(grouped) - known)

        # ParaView asks for the inputs of a filter in a dialog where two of them are not optional.
        inputs = proxy.findall("InputProperty")
        assert len(inputs) < 2 or sum(entry.find("Hints/Optional") is None for entry in inputs) > 1, name

        # --- menus and files --------------------------------------------------------------------------
        menu = proxy.find("Hints/ShowInMenu")
        reader = proxy.find("Hints/ReaderFactory")
        assert (menu is not None) or (reader is not None) or drawn or proxy.tag == "WriterProxy", name
        if menu is not None:
            assert menu.get("category") == "Fire", name
            icon = os.path.join(folder, menu.get("icon").replace(":/SmokeVisibility/", ""))
            assert xml.parse(icon).getroot().tag.endswith("svg"), icon
            with open(os.path.join(folder, "SmokeVisibility.qrc")) as file:
                assert "Icons/" + os.path.basename(icon) in file.read(), icon
assert checked > 80, checked

for name, proxy in (("CAD/kiosk.step", "CADReader"), ("CAD/kiosk.ifc", "CADReader"),
                    ("Hall/fds/hall.smv", "FDSSmokeReader")):
    opened = simple.OpenDataFile(os.path.join(sys.argv[2], name))
    assert type(opened).__name__ == proxy, (name, opened)

# --- how a map is shown -------------------------------------------------------------------------------
view = simple.CreateView("RenderView")
floor = simple.FloorMapOfVisibility(
    LightField=scenes.tunnel((8, 2, 2), Tolerance=0.1), Resolution=[4, 2], EyeHeight=0.5)
shown = simple.Show(floor, view)
assert shown.Representation == "Surface", shown.Representation
# Shown, it has the colours of the preset, which do not follow the data: 0.2 is the threshold.
assert list(shown.ColorArrayName) == ["POINTS", "Visibility"], shown.ColorArrayName
colors = simple.GetColorTransferFunction("Visibility")
assert colors.AutomaticRescaleRangeMode == "Never" and shown.LookupTable == colors
points = list(colors.RGBPoints)
assert simple.ImportPresets(filename=os.path.join(folder, "ColorMaps", "FMV.json"))
assert colors.ApplyPreset("FMV", False)
assert numpy.allclose(points, list(colors.RGBPoints)), points
table = colors.GetClientSideObject()


def color(value):
    rgb = [0.0, 0.0, 0.0]
    table.GetColor(value, rgb)
    return rgb


# Grey where a sign is seen, brighter where it is seen better; dark red below the threshold of 0.2.
for value in (0.21, 0.5, 0.9):
    assert max(color(value)) - min(color(value)) < 1e-6, color(value)
assert color(0.9)[0] > color(0.5)[0] > color(0.21)[0]
assert color(0.1) == color(0.19) and color(0.1)[0] > 2 * color(0.1)[1]

# What users have saved comes first; their own settings, of the highest priority, are not to be touched here.
settings = simple.servermanager.vtkSMSettings.GetInstance()
own = [0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 0.0]
assert settings.AddCollectionFromString(
    '{"array_lookup_tables": {"LeastVisibility": {"PVLookupTable": {"RGBPoints": %s}}}}' % own, 0.5)
assert list(simple.GetColorTransferFunction("LeastVisibility").RGBPoints) == own

# Signs are bright, images grey, and what others make of the map's places has a legend.
for emitters in (simple.ExitSign(), simple.Luminaire()):
    shown = simple.Show(emitters, view)
    assert list(shown.ColorArrayName) == ["CELLS", "Luminance"], shown.ColorArrayName
    assert list(shown.LookupTable.RGBPoints)[1:4] == [0, 0, 0], list(shown.LookupTable.RGBPoints)
    assert list(shown.LookupTable.RGBPoints)[-3:] == [1, 1, 1], list(shown.LookupTable.RGBPoints)
shown = simple.Show(simple.JinVisibility(LightField=floor.LightField, FloorMap=floor), view)
assert list(shown.ColorArrayName) == ["POINTS", "JinDifference"], shown.ColorArrayName
assert shown.LookupTable.InterpretValuesAsCategories == 1
assert shown.LookupTable.Annotations[:4] == ["0", "seen by both", "1", "by the practice only"]
assert len(shown.LookupTable.IndexedColors) == 21 and len(shown.LookupTable.Annotations) == 14

# --- the area of a map, as a box in the view ----------------------------------------------------------
# The box begins around the light field, here the tunnel of 4 x 1 x 1 m, and comes in place of Bounds.
for group in xml.parse(os.path.join(folder, "FloorMapOfVisibility.xml")).getroot().iter("PropertyGroup"):
    if group.get("panel_widget") == "InteractiveBox":
        assert [(entry.get("function"), entry.get("name")) for entry in group.findall("Property")] == [
            ("Position", "BoxPosition"), ("Scale", "BoxSize")]
        break
else:
    raise AssertionError("the panel of floor maps offers no box")
boxed = simple.FloorMapOfVisibility(LightField=floor.LightField, Resolution=[4, 2], EyeHeight=0.5, UseBox=1)
assert list(boxed.BoxPosition) == [0, 0, 0] and list(boxed.BoxSize) == [4, 1, 1], (boxed.BoxPosition, boxed.BoxSize)
assert (scenes.point_array(scenes.fetch(boxed), "Visibility")
        == scenes.point_array(scenes.fetch(floor), "Visibility")).all()
aside = simple.FloorMapOfVisibility(LightField=scenes.tunnel((8, 2, 2), Tolerance=0.1), UseBox=1,
                                    BoxPosition=[0, 0, 0], BoxSize=[1, 1, 1])
assert list(aside.BoxPosition) == [0, 0, 0] and list(aside.BoxSize) == [1, 1, 1], aside.BoxPosition
beside = simple.FloorMapOfVisibility(LightField=floor.LightField, UseBox=1, BoxPosition=[0, 0, 0], BoxSize=[1, 1, 1])
assert list(beside.BoxPosition) == [0, 0, 0] and list(beside.BoxSize) == [1, 1, 1], beside.BoxSize
boxed.BoxPosition, boxed.BoxSize = [1, 0.25, 0.1], [2, 0.5, 0.9]
boxed.Bounds = [0, 1, 0, 1, 0, 1]
assert scenes.fetch(boxed).GetBounds() == (1.25, 2.75, 0.375, 0.625, 0.6, 0.6), scenes.fetch(boxed).GetBounds()
boxed.BoxSize = [2, 0, 0.9]
with scenes.Messages() as messages:
    scenes.fetch(boxed)
assert messages.count("ERROR", "vtkFloorMapOfVisibility") == 1 and "BoxSize: the box is empty" in messages.text

# --- the signs of a light field, to pick from ---------------------------------------------------------
signs = simple.ExitSign(SignTable=os.path.join(sys.argv[2], "Hall", "signs.csv"))
hall = simple.SmokeLightField(Smoke=scenes.producer(scenes.image((4, 4, 1), (55.0, 35.0, 5.0), 0.0), "Air"),
                              Emitters=[signs], Albedo=0)
hall.UpdatePipeline()
image = simple.VisibilityImage(LightField=hall, CameraPosition=[27, 17, 1.7], ImageSize=[8, 4])
offered = list(image.SMProxy.GetProperty("TargetSignName").FindDomain("vtkSMStringListDomain").GetString(i)
               for i in range(9))
assert offered[:3] == ["(by id)", "0: South west", "1: South east"] and len(offered) == 9, offered
assert image.TargetSignName == "(by id)" and image.TargetSign == -1
for choice in ("6: East south", "East south"):
    image.TargetSignName = choice
    assert scenes.field(scenes.fetch(image), "MeasuredSign") == 6, choice
image.TargetSignName = "Back door"
with scenes.Messages() as messages:
    scenes.fetch(image)
assert "no sign 'Back door'" in messages.text and "'7: East north'" in messages.text, messages.text
print("panels: passed")
