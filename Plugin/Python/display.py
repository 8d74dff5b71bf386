"""Shows what the filters make as a fire engineer wants to see it: ``from smokevisibility import display``.

Works in pvpython, in scripts and in ParaView's Python shell; the macros that come with the plugin call it.
"""
import json
import os

from paraview import servermanager, simple

#: The colour map of floor maps, which is kept beside this file.
COLOR_MAP = os.path.join(os.path.dirname(os.path.abspath(__file__)), "FMV.json")


def show_map(floor_map=None, view=None, array="Visibility"):
    """A floor map as a flat surface at eye level: grey from 0 to 1, the brighter the better a sign is seen, dark
    red below the threshold of 0.2. Returns the representation."""
    floor_map = floor_map or simple.GetActiveSource()
    view = view or simple.GetActiveViewOrCreate("RenderView")
    shown = simple.Show(floor_map, view)
    shown.SetRepresentationType("Surface")
    simple.ColorBy(shown, ("POINTS", array))
    if array == "Visibility":
        # Importing it as a preset would add one more to those of the user each time.
        with open(COLOR_MAP) as file:
            preset = json.load(file)[0]
        colors = simple.GetColorTransferFunction(array)
        for name in ("ColorSpace", "NanColor", "RGBPoints"):
            setattr(colors, name, preset[name])
        colors.AutomaticRescaleRangeMode = "Never"
    shown.SetScalarBarVisibility(view, True)
    # Light would make the grey of a flat surface depend on where the camera is.
    shown.Ambient, shown.Diffuse, shown.Specular = 1.0, 0.0, 0.0
    return shown


def show_signs(emitters=None, view=None):
    """Signs and lamps as bright as they are, by their luminance, and not shaded."""
    emitters = emitters or simple.GetActiveSource()
    view = view or simple.GetActiveViewOrCreate("RenderView")
    shown = simple.Show(emitters, view)
    simple.ColorBy(shown, ("CELLS", "Luminance", "Magnitude"))
    simple.GetColorTransferFunction("Luminance").ApplyPreset("Black-Body Radiation", True)
    shown.Ambient, shown.Diffuse, shown.Specular = 1.0, 0.0, 0.0
    return shown


def show_image(image=None, view=None):
    """What the eye sees, in grey from dark to the brightest pixel; luminances of signs keep their own colours."""
    image = image or simple.GetActiveSource()
    view = view or simple.GetActiveViewOrCreate("RenderView")
    shown = simple.Show(image, view)
    simple.ColorBy(shown, ("POINTS", "Luminance"), separate=True)
    simple.GetColorTransferFunction("Luminance", shown, separate=True).ApplyPreset("Grayscale", True)
    shown.SetScalarBarVisibility(view, True)
    view.InteractionMode = "2D"
    view.OrientationAxesVisibility = 0
    simple.ResetCamera(view)
    return shown


def show_smoke(smoke=None, view=None, factor=1.0):
    """Smoke of any source as the volume that a run's smoke opens as, drawn ``factor`` times as thick as it is. Returns
    the representation."""
    smoke = smoke or simple.GetActiveSource()
    view = view or simple.GetActiveViewOrCreate("RenderView")
    shown = simple.GetRepresentation(smoke, view)
    if shown.GetXMLName() != "SmokeRepresentation":
        # How something is shown stays what it was made as.
        simple.Delete(shown)
        shown = simple.Show(smoke, view, "SmokeRepresentation")
    shown.SetRepresentationType("Smoke")
    shown.ExtinctionFactor = factor
    shown.Visibility = 1
    return shown


def camera_from_view(image=None, view=None):
    """Gives a Visibility Image the camera of a 3-D view: what the view shows is what the eye in the smoke sees."""
    image = image or simple.GetActiveSource()
    view = view or simple.GetActiveView()
    if image is None or image.GetXMLName() != "VisibilityImage":
        raise RuntimeError("Select a Visibility Image in the pipeline browser first")
    if view is None or "CameraPosition" not in view.ListProperties():
        raise RuntimeError("Select a 3-D view first")
    image.TargetSign = -1
    image.CameraPosition = list(view.CameraPosition)
    image.CameraFocalPoint = list(view.CameraFocalPoint)
    image.CameraViewUp = list(view.CameraViewUp)
    return image


def signs(light_field=None):
    """The signs of a light field, or of emitters: a list of (id, name), for TargetSign."""
    source = light_field or simple.GetActiveSource()
    if source.GetXMLName() == "SmokeLightField":
        return sorted(set(sum((signs(emitters) for emitters in source.Emitters), [])))
    source.UpdatePipeline()
    here = source.GetClientSideObject()
    data = here.GetOutputDataObject(source.Port) if here else servermanager.Fetch(source)
    found = {}

    def collect(block):
        if block is None:
            return
        if hasattr(block, "NewIterator"):
            iterator = block.NewIterator()
            iterator.InitTraversal()
            while not iterator.IsDoneWithTraversal():
                collect(iterator.GetCurrentDataObject())
                iterator.GoToNextItem()
            return
        cells = block.GetCellData() if hasattr(block, "GetCellData") else None
        ids = cells.GetArray("SignId") if cells else None
        names = cells.GetAbstractArray("SignName") if cells else None
        for i in range(ids.GetNumberOfTuples() if ids else 0):
            number = int(ids.GetComponent(i, 0))
            if number >= 0:
                found.setdefault(number, names.GetValue(i) if names else "")

    collect(data)
    return [(number, found[number] or "Sign %d" % number) for number in sorted(found)]
