"""Lamps light the smoke before a sign: does more light help to find the way?

Usage: pvpython --force-offscreen-rendering lamps_veil_signs.py PLUGIN OUTPUT_FOLDER [quick]
"""
import os
import sys

from paraview import simple

plugin, folder = sys.argv[1:3]
tolerance = 0.5 if "quick" in sys.argv[3:] else 0.01
simple.LoadPlugin(plugin, ns=vars(simple))
os.makedirs(folder, exist_ok=True)
import room  # noqa: E402

smoke = room.smoke(layer=0.5, below=0.5)
sign = room.sign(Luminance=100)
for flux in (0.0, 50.0, 200.0, 1000.0):  # lm of each of four lamps under the ceiling
    emitters = [sign]
    if flux > 0.0:
        emitters.append(simple.Luminaire(
            Center=[8, 2, 2.98], Normal=[0, 0, -1], Count=[4, 1], Spacing=[4, 1], Width=0.3, Height=0.3,
            LuminousFlux=flux))
    light = simple.SmokeLightField(Smoke=smoke, Emitters=emitters, Albedo=0.3, Tolerance=tolerance)
    image = simple.VisibilityImage(LightField=light, CameraPosition=[10, 2, 1.7], TargetSign=0, ImageSize=[64, 32])
    image.UpdatePipeline()
    print(f"{flux:5.0f} lm: between the bars {room.number(image, 'UnlitLuminance'):7.3f} cd/m2, contrast "
          f"{room.number(image, 'PerceivedContrast'):.3f}")
