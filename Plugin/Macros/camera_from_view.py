"""Gives the selected Visibility Image the camera of the active 3-D view."""
from smokevisibility import display

display.camera_from_view()
