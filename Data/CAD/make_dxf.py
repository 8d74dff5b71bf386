"""Makes the kiosk as DXF: python3 make_dxf.py FILE, with ezdxf 0.18.1 (python3-ezdxf of Debian 12).

Millimetres, a layer for each object, colours from AutoCAD's first fifteen; see make_meshes.py for the shape.
"""

import sys

import ezdxf

drawing = ezdxf.new("R2000")
drawing.units = ezdxf.units.MM
for name, color in (("Kiosk", 9), ("ExitSign-03", 3), ("Glazing-1", 5)):
    drawing.layers.add(name, color=color)
space = drawing.modelspace()


def quad(layer, color, *corners):
    corners = [tuple(1000 * x for x in corner) for corner in corners]
    space.add_3dface(corners, dxfattribs={"layer": layer, "color": color})


block = [(x, y, z) for z in (0, 3) for y in (2, 4) for x in (1, 2)]
for side in ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)):
    quad("Kiosk", 9, *(block[i] for i in side))
quad("ExitSign-03", 3, (1.35, 1.99, 2.2), (1.65, 1.99, 2.2), (1.65, 1.99, 2.35), (1.35, 1.99, 2.35))
quad("Glazing-1", 5, (3, 2, 1), (3, 3, 1), (3, 3, 2), (3, 2, 2))
drawing.saveas(sys.argv[1])
