"""Tests that Blender reads Defocus's multi-layer files: Cryptomattes in the compositor, and passes."""

import os
import pathlib
import subprocess
import tempfile
import unittest

import bpy
import numpy

import pictures

WIDTH, HEIGHT = 96, 64
COLOURS = {"Würfel": (1, 0, 0, 1), "green": (0, 1, 0, 1), "far away": (0, 0, 1, 1)}


def three_lamps():
    """Makes a scene with red, green and blue glowing squares, one behind another, and a camera at f/1."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    for place, (name, colour) in enumerate(COLOURS.items()):
        bpy.ops.mesh.primitive_plane_add(size=0.5 + place, location=(0.2 * place - 0.1, 1 + 2 * place, 0), rotation=(1.5707963, 0, 0))
        bpy.context.object.name = name
        material = bpy.data.materials.new(name)
        material.use_nodes = True
        nodes = material.node_tree.nodes
        nodes.clear()
        emission, output = nodes.new("ShaderNodeEmission"), nodes.new("ShaderNodeOutputMaterial")
        emission.inputs["Color"].default_value = colour
        material.node_tree.links.new(emission.outputs["Emission"], output.inputs["Surface"])
        bpy.context.object.data.materials.append(material)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.rotation_euler = (1.5707963, 0, 0)
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = WIDTH, HEIGHT, 100
    return scene


class Layers(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="layers-")
        self.addCleanup(self.folder.cleanup)
        self.scene = three_lamps()
        scene_file = self.path("scene.glb")
        bpy.ops.export_scene.gltf(filepath=scene_file, export_cameras=True)
        for names in ("nuke", "blender", "plain"):
            layers = ["--method", "accumulation"] if names == "plain" else ["--exr-layers", "all", "--exr-names", names]
            subprocess.run([os.environ["DEFOCUS_PROGRAM"], "--quiet", "render", scene_file, "-o", self.path(f"{names}.exr"), "--size", f"{WIDTH}x{HEIGHT}",
                            "--fstop", "0.5", "--focus-distance", "3", "--samples", "64", "--background", "none", "--lod", "off", *layers], check=True)

    def path(self, name):
        return str(pathlib.Path(self.folder.name) / name)

    def composited(self, file, layer, name):
        """Returns the matte of the object `name`, from the compositor's Cryptomatte node."""
        self.scene.use_nodes = True
        nodes, links = self.scene.node_tree.nodes, self.scene.node_tree.links
        nodes.clear()
        node = nodes.new("CompositorNodeCryptomatteV2")
        node.source = "IMAGE"
        node.image = bpy.data.images.load(file)
        node.layer_name = layer
        node.matte_id = name
        output = nodes.new("CompositorNodeComposite")
        links.new(node.outputs["Matte"], output.inputs["Image"])
        self.scene.render.engine = "CYCLES"
        self.scene.cycles.samples = 1
        self.scene.render.image_settings.file_format = "OPEN_EXR"
        self.scene.render.image_settings.color_depth = "32"
        self.scene.render.filepath = self.path("matte.exr")
        bpy.ops.render.render(write_still=True)
        return pictures.read(self.scene.render.filepath)[..., 0]

    def testCryptomattePicksABlurredObject(self):
        for names, layer in (("nuke", "CryptoObject"), ("blender", "ViewLayer.CryptoObject")):
            lit = pictures.read(self.path("plain.exr"))
            for channel, name in enumerate(COLOURS):
                with self.subTest(names=names, name=name):
                    matte = self.composited(self.path(f"{names}.exr"), layer, name)
                    pictures.say(f"{names}, {name}: matte differs by at most {numpy.abs(matte - lit[..., channel]).max():.1e}")
                    self.assertGreater(matte.max(), 0.9)
                    self.assertGreater(numpy.mean((matte > 0.05) & (matte < 0.95)), 0.02, "the edges are soft")
                    self.assertLess(numpy.abs(matte - lit[..., channel]).max(), 1e-3)

    def testPassesAreRead(self):
        self.scene.use_nodes = True
        node = self.scene.node_tree.nodes.new("CompositorNodeImage")
        node.image = bpy.data.images.load(self.path("blender.exr"))
        outputs = {one.name for one in node.outputs}
        for name in ("Combined", "Depth", "DepthNearest", "Normal", "Position", "DiffCol", "Emit", "Vector", "CryptoObject00"):
            self.assertIn(name, outputs)


if __name__ == "__main__":
    unittest.main()
