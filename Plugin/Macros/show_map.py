"""Shows the selected floor map in the colours of a Floor Map of Visibility."""
from paraview import simple
from smokevisibility import display

display.show_map()
simple.Render()
