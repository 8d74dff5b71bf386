"""What the experiment's camera takes: photographs of the sign in ever denser smoke, Canon EOS 10D.

Usage: pvpython --force-offscreen-rendering photographs.py PLUGIN OUTPUT_FOLDER
"""
import os
import sys

import claims
import tunnel as scene

DENSITIES = (0.0, 0.4, 0.8)
# 4 m from the sensor, which is about 5 cm behind the lens.
FOCUS = scene.SIZE[0] - scene.CAMERA[0] + 0.05


def take(folder, densities=DENSITIES, binning=16):
    """PNG and EXR of the same frame for each density, both lamps on."""
    from paraview import simple
    tunnel = scene.Tunnel()
    luminance = {"square": scene.SIGN_LUMINANCE}
    for which in ("sign", "camera"):
        luminance["lamp near " + which] = tunnel.lamp_luminance(scene.LAMP_FLUX)
    for density in densities:
        smoke = scene.producer(scene.smoke_box(scene.SIZE, tunnel.cells,
                                               scene.extinction(density, "glycol", "lamp")))
        surfaces = scene.producer(scene.walls(scene.SIZE, scene.WALLS))
        light = simple.SmokeLightField(
            Smoke=smoke, Surfaces=[surfaces], Albedo=scene.SMOKES["glycol"][0],
            Emitters=tunnel.emitters("square", scene.SQUARE, scene.LAMP_FROM_END, luminance),
            Tolerance=0.02)
        view = simple.VisibilityImage(
            LightField=light, CameraPosition=scene.CAMERA,
            CameraFocalPoint=[scene.SIZE[0], 0.5, 0.5],
            CameraModel="Canon EOS 10D", PixelBinning=binning, FocalLength=50, FNumber=5.6, ISO=100,
            FocusDistance=FOCUS)
        name = os.path.join(folder, f"photograph_{density:g}")
        scene.output(view)
        simple.SaveData(name + ".png", proxy=simple.OutputPort(view, 1))
        simple.SaveData(name + ".exr", proxy=view)


if __name__ == "__main__":
    claims.load_plugin(sys.argv[1])
    take(sys.argv[2])
