"""Makes the kiosk in the formats that Blender writes: blender --background --python make_meshes.py -- FOLDER

A block of 1 x 2 x 3 m, a sign of 0.3 x 0.15 m on its front and a pane of 1 x 1 m, with the colours of their
materials. Blender 3.4.1 of Debian 12 wrote the files beside this script.
"""

import os
import sys

import bpy

folder = sys.argv[sys.argv.index("--") + 1]
bpy.ops.wm.read_factory_settings(use_empty=True)


def material(name, color):
    """A material whose exported colour is `color`: red, green, blue, opacity."""
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    shader = made.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = color
    shader.inputs["Alpha"].default_value = color[3]
    if color[3] < 1:
        made.blend_method = "BLEND"
    return made


def part(name, corners, faces, made):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(corners, [], faces)
    mesh.materials.append(made)
    thing = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(thing)


# A block from (1, 2, 0) to (2, 4, 3), fronts outwards.
block = [(x, y, z) for z in (0, 3) for y in (2, 4) for x in (1, 2)]
sides = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
part("Kiosk", block, sides, material("Plaster", (0.8, 0.7, 0.6, 1)))
# Its front looks along -y.
part(
    "ExitSign-03",
    [(1.35, 1.99, 2.2), (1.65, 1.99, 2.2), (1.65, 1.99, 2.35), (1.35, 1.99, 2.35)],
    [(0, 1, 2, 3)],
    material("SignGreen", (0.1, 0.5, 0.2, 1)),
)
part(
    "Glazing-1",
    [(3, 2, 1), (3, 3, 1), (3, 3, 2), (3, 2, 2)],
    [(0, 1, 2, 3)],
    material("Glass", (0.9, 0.95, 1, 0.2)),
)


def path(name):
    return os.path.join(folder, name)


bpy.ops.wm.obj_export(filepath=path("kiosk.obj"), path_mode="STRIP")
# What the 3DS file is made of: assimp keeps the axes, and 3DS has z up.
bpy.ops.wm.obj_export(filepath=path("kiosk_z_up.obj"), path_mode="STRIP", forward_axis="Y", up_axis="Z")
bpy.ops.export_mesh.stl(filepath=path("kiosk.stl"))
bpy.ops.export_mesh.ply(filepath=path("kiosk.ply"), use_ascii=True)
bpy.ops.export_scene.gltf(filepath=path("kiosk.gltf"), export_format="GLTF_EMBEDDED")
bpy.ops.export_scene.gltf(filepath=path("kiosk.glb"), export_format="GLB")
bpy.ops.export_scene.fbx(filepath=path("kiosk.fbx"))
if hasattr(bpy.ops.wm, "collada_export"):
    bpy.ops.wm.collada_export(filepath=path("kiosk.dae"))
