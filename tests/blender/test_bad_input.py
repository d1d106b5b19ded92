"""Tests that each faulty scene or system gives one message, leaves no files or data, and keeps the last image."""

import os
import pathlib
import subprocess
import tempfile
import unittest.mock

import bpy

import scenes

from defocus_engine import engine, exr, failure, program, viewer


def small_scene():
    scene = scenes.empty_scene(32, 24)
    scenes.camera(place=(0, 0, 0), pitch=0)
    bpy.ops.mesh.primitive_plane_add(size=3, location=(0, 2, 0), rotation=(1.57, 0, 0))
    scenes.with_material(scenes.glowing("wall", 0.25))
    scene.defocus.samples = 16
    scene.render.engine = "DEFOCUS"
    return scene


def brightness(scene):
    """Returns the mean of the render result's red channel."""
    with tempfile.TemporaryDirectory() as folder:
        bpy.data.images["Render Result"].save_render(f"{folder}/all.exr", scene=scene)
        import pictures
        return pictures.read(f"{folder}/all.exr")[..., 0].mean()


class BadInput(unittest.TestCase):
    def message(self):
        """Renders, expects one error and returns its line. Checks that no data or files are left behind."""
        data = self.data()
        with self.assertRaises(RuntimeError) as caught:
            bpy.ops.render.render()
        self.assertEqual(data, self.data())
        self.check_no_files()
        lines = [line for line in str(caught.exception).splitlines() if line.startswith("Error: ")]
        self.assertEqual(len(lines), 1, caught.exception)
        return lines[0].removeprefix("Error: ")

    def data(self):
        """Returns the names of all data that an export could leave behind."""
        kinds = (bpy.data.objects, bpy.data.meshes, bpy.data.scenes, bpy.data.cameras, bpy.data.lights, bpy.data.images)
        return [block.name for kind in kinds for block in kind if block.name != "Render Result"]

    def check_no_files(self):
        left = [name for name in os.listdir(tempfile.gettempdir()) if name.startswith("defocus-")]
        self.assertEqual(left, [])

    def testProgramIsMissing(self):
        scene = small_scene()
        bpy.ops.render.render()
        self.assertAlmostEqual(brightness(scene), 0.25, places=3)
        given, path = bpy.context.preferences.addons["defocus_engine"].preferences, os.environ["PATH"]
        before, given.program, os.environ["PATH"] = given.program, "", "/nowhere"
        try:
            self.assertIn("not in PATH", self.message())
            given.program = "/nowhere/defocus"
            self.assertEqual(self.message(), "/nowhere/defocus is not a program; correct the path in the preferences of the add-on Defocus")
        finally:
            given.program, os.environ["PATH"] = before, path
        self.assertAlmostEqual(brightness(scene), 0.25, places=3)

    def testSceneWithoutCamera(self):
        small_scene().camera = None
        self.assertIn("camera", self.message().lower())

    def testOrthographicCamera(self):
        small_scene().camera.data.type = "ORTHO"
        self.assertEqual(self.message(), "The camera 'Camera' is orthographic; Defocus needs a perspective camera")

    def testExporterIsOff(self):
        small_scene()
        bpy.ops.preferences.addon_disable(module="io_scene_gltf2")
        try:
            self.assertIn("glTF exporter is off", self.message())
        finally:
            bpy.ops.preferences.addon_enable(module="io_scene_gltf2")

    def testExporterFails(self):
        small_scene()
        from io_scene_gltf2.blender.exp import gltf2_blender_gather
        function = gltf2_blender_gather.gather_gltf2

        def broken(_settings):
            raise ValueError("broken exporter")

        gltf2_blender_gather.gather_gltf2 = broken
        try:
            self.assertEqual(self.message(), "Blender's glTF exporter failed: ValueError: broken exporter")
        finally:
            gltf2_blender_gather.gather_gltf2 = function

    def testUnknownOption(self):
        small_scene().defocus.further = "--fstops 3"
        self.assertIn("--fstops", self.message())

    def testDamagedPictureIsRefused(self):
        with tempfile.TemporaryDirectory() as folder:
            whole = pathlib.Path(folder) / "whole.exr"
            fish = pathlib.Path(__file__).resolve().parents[2] / "meshes" / "fish.glb"
            subprocess.run([os.environ["DEFOCUS_PROGRAM"], "--quiet", "render", fish, "-o", whole, "--size", "32x24", "--samples", "1"], check=True)
            data = whole.read_bytes()
            pixels, _ = exr.read(whole)
            self.assertEqual({name: values.shape for name, values in pixels.items()}, dict.fromkeys("ABGR", (24, 32)))
            cut = pathlib.Path(folder) / "cut.exr"
            for size in range(0, len(data), max(1, len(data) // 97)):
                cut.write_bytes(data[:size])
                with self.subTest(size=size), self.assertRaises(failure.Failure):
                    exr.read(cut)

    def testUnbalancedQuotes(self):
        small_scene().defocus.further = "--camera 'x"
        self.assertEqual(self.message(), "The further options of Defocus cannot be read: No closing quotation")

    def testCancelledRenderKeepsThePicture(self):
        scene = small_scene()
        bpy.ops.render.render()
        scene.defocus.samples = 65536
        run = program.run
        # Replaces program.run() to simulate a cancelled render, because Blender's test_break() cannot be replaced.
        program.run = lambda words, folder, on_progress, _: run(words, folder, on_progress, is_cancelled=lambda: True)
        try:
            bpy.ops.render.render()
        finally:
            program.run = run
        self.check_no_files()
        self.assertAlmostEqual(brightness(scene), 0.25, places=3)

    def testFilmEndsAtTheFrameThatFails(self):
        scene = small_scene()
        scene.frame_start, scene.frame_end = 1, 3
        run, frames = program.run, []

        def failing(*arguments):
            frames.append(scene.frame_current)
            if len(frames) == 2:
                raise failure.Failure("no power")
            return run(*arguments)

        program.run = failing
        try:
            with tempfile.TemporaryDirectory() as folder:
                scene.render.filepath = f"{folder}/####"
                with self.assertRaisesRegex(RuntimeError, "Error: no power"):
                    bpy.ops.render.render(animation=True)
                self.assertEqual(os.listdir(folder), ["0001.exr"])
        finally:
            program.run = run
        self.assertEqual(frames, [1, 2])
        self.check_no_files()

    def testMissingTextureIsReported(self):
        scene = small_scene()
        image = bpy.data.images.new("lost", 4, 4)
        image.source, image.filepath = "FILE", "//gone/näher.png"
        material = scenes.diffuse("Farbe", image)
        bpy.context.object.data.materials[0] = material
        bpy.ops.render.render()
        self.assertIn("the image 'lost' of the material 'Farbe' is missing: //gone/näher.png", engine.reports[scene.name])

    def testTemporaryFolderWithOtherLetters(self):
        scene = small_scene()
        with tempfile.TemporaryDirectory(prefix="Ordner mit Wörtern ") as folder:
            usual, tempfile.tempdir = tempfile.tempdir, folder
            try:
                bpy.ops.render.render()
            finally:
                tempfile.tempdir = usual
            self.assertEqual(os.listdir(folder), [])
        self.assertAlmostEqual(brightness(scene), 0.25, places=3)

    def testTemporaryFolderThatIsMissing(self):
        small_scene()
        message = "Error: No temporary folder can be made: .*No such file"
        with unittest.mock.patch.object(tempfile, "tempdir", "/proc/none"):
            for command in bpy.ops.render.render, bpy.ops.defocus.view:
                with self.assertRaisesRegex(RuntimeError, message):
                    command()

    def testProgramThatWritesNoPicture(self):
        small_scene()
        given = bpy.context.preferences.addons["defocus_engine"].preferences
        before, given.program = given.program, "/bin/true"
        try:
            with self.assertRaisesRegex(RuntimeError, "Error: defocus wrote no image that can be read: No such file"):
                bpy.ops.render.render()
        finally:
            given.program = before
        self.check_no_files()

    def testWindowGetsTheSceneAndItsFolderIsRemoved(self):
        scene = small_scene()
        scene.defocus.further = "--cat-eye 0.5"
        given = bpy.context.preferences.addons["defocus_engine"].preferences
        before = given.program
        with tempfile.TemporaryDirectory() as folder:
            given.program = f"{folder}/stand-in"
            pathlib.Path(given.program).write_text(f'#!/bin/sh\ntest -s "$2" && echo "$@" >{folder}/words\n')
            os.chmod(given.program, 0o755)
            try:
                self.assertEqual(bpy.ops.defocus.view(), {"FINISHED"})
                viewer.views[0][0].wait()
                viewer.remove_closed()
            finally:
                given.program = before
            words = pathlib.Path(f"{folder}/words").read_text()
        self.assertTrue(words.startswith("view "))
        self.assertIn("--fstop 1.4", words[:words.rindex("--cat-eye 0.5")])
        self.assertEqual(viewer.views, [])
        self.check_no_files()

    def testChoicesOfAnotherVersionAreDefaults(self):
        scene = small_scene()
        scene.defocus["method"], scene.defocus["preset"], scene.defocus["quality"], scene.defocus["levels"] = 77, 77, 77, 77
        scene.defocus["shutter_position"], scene.defocus["not_a_setting"] = 77, "x"
        scene.render.use_motion_blur = True
        bpy.ops.render.render()
        self.assertAlmostEqual(brightness(scene), 0.25, places=3)
