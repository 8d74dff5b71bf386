"""What does somebody in the smoke see of a sign, 4, 8 and 12 m away from it?

Usage: pvpython --force-offscreen-rendering sign_image.py PLUGIN OUTPUT_FOLDER [quick]
"""
import os
import sys

from paraview import simple

plugin, folder = sys.argv[1:3]
tolerance = 0.5 if "quick" in sys.argv[3:] else 0.01
simple.LoadPlugin(plugin, ns=vars(simple))
os.makedirs(folder, exist_ok=True)
import room  # noqa: E402

light = simple.SmokeLightField(Smoke=room.smoke(layer=0.8, below=0.1), Emitters=[room.sign(Luminance=300)],
                               Tolerance=tolerance)
for distance in (4.0, 8.0, 12.0):
    eye = [room.SIZE[0] - 0.05 - distance, room.SIZE[1] / 2, 1.7]
    # The plate of sign 0 fills the picture, but for a border of a quarter of its size.
    image = simple.VisibilityImage(LightField=light, CameraPosition=eye, TargetSign=0, Margin=0.25,
                                   ImageSize=[128, 64])
    image.UpdatePipeline()
    print(f"{distance:4.0f} m: lit bars {room.number(image, 'LitLuminance'):8.3g} cd/m2, contrast "
          f"{room.number(image, 'PerceivedContrast'):.3f} +- {room.number(image, 'PerceivedContrastError'):.3f}")
    # All numbers, unscaled, and what a camera would make of them.
    simple.SaveData(os.path.join(folder, f"sign_{distance:g}m.exr"), proxy=image)
    simple.SaveData(os.path.join(folder, f"sign_{distance:g}m.png"), proxy=simple.OutputPort(image, 1))
