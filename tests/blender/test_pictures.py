"""Compares Defocus's images in Blender with Cycles, without indirect light, and with the thin-lens equation."""

import json
import math
import os
import pathlib
import tempfile
import unittest

import bpy
import numpy

import pictures
import scenes

# If this variable names a PNG file, the test saves three images of the still life in it: by Cycles with 1,024 samples,
# by Defocus, and their difference times 5.
FIGURE = os.environ.get("DEFOCUS_BLENDER_FIGURE")


def pixels_per_angle(camera, width, height):
    """Returns the focal length in pixels, which depends on the sensor fit as Blender's documentation says."""
    data = camera.data
    horizontal = data.sensor_fit == "HORIZONTAL" or (data.sensor_fit == "AUTO" and width >= height)
    sensor = data.sensor_height if data.sensor_fit == "VERTICAL" else data.sensor_width
    return data.lens * (width if horizontal else height) / sensor


def blur_radius(camera, depth, width, height):
    """Returns the circle of confusion radius of a thin lens in px."""
    lens, focus = camera.data.lens * 1e-3, camera.data.dof.focus_distance
    return 0.5 * lens / camera.data.dof.aperture_fstop * abs(1 / focus - 1 / depth) * pixels_per_angle(camera, width, height)


def lamp_radius(camera, lamp, width, height):
    """Returns the radius of a lamp's unblurred image in px."""
    return 0.5 * lamp.dimensions.z / lamp.location.y * pixels_per_angle(camera, width, height)


class StillLife(unittest.TestCase):
    def testPicturesAndOutlinesEqualThoseOfCycles(self):
        scene = scenes.still_life()
        softbox = bpy.data.objects["softbox"]
        lens = scene.camera.data.dof
        softbox.hide_render = True
        scene.cycles.samples, scene.defocus.samples = (1024, 256) if FIGURE else (128, 96)
        reference = pictures.rendered("CYCLES", scene)
        softbox.hide_render = False
        picture = pictures.rendered("DEFOCUS", scene)
        self.assertIn("the area light 'softbox' is not exported: glTF has only point, spot and sun lights", self.report(scene))
        value = pictures.psnr(picture, reference)
        pictures.say(f"still life, f/1.4: {value:.1f} dB")
        if FIGURE:
            one, other = pictures.encoded(reference), pictures.encoded(picture)
            pictures.save_png(FIGURE, [one, other, numpy.clip(0.5 + 5 * (other - one), 0, 1)])
        self.assertGreater(value, 35)

        bpy.data.objects.remove(bpy.data.objects["floor"])
        bpy.data.objects.remove(bpy.data.objects["wall"])
        lens.use_dof = False
        softbox.hide_render, scene.cycles.samples = True, 64
        distance = pictures.silhouette_distance(pictures.rendered("CYCLES", scene), pictures.rendered("DEFOCUS", scene))
        pictures.say(f"still life, outlines: {distance:.2f} px")
        self.assertLess(distance, 0.5)

    def report(self, scene):
        from defocus_engine.engine import reports
        return reports[scene.name]


class Lens(unittest.TestCase):
    def check(self, width, height, fit, shift=(0, 0), count=1):
        """Compares the blur disks of the first `count` lamps in both engines with each other and with the thin lens."""
        scene, camera, lamps = scenes.lamps(width, height)
        camera.data.sensor_fit, camera.data.shift_x, camera.data.shift_y = fit, *shift
        for lamp in lamps[:count]:
            for other in lamps:
                other.hide_render = other is not lamp
            depth = lamp.location.y
            measured = {engine: pictures.disk(pictures.rendered(engine, scene)[..., 0]) for engine in ("CYCLES", "DEFOCUS")}
            expected = math.hypot(blur_radius(camera, depth, width, height), lamp_radius(camera, lamp, width, height))
            distance = math.dist(measured["CYCLES"][0], measured["DEFOCUS"][0])
            pictures.say(f"{width}x{height} {fit} shift {shift}, {depth:.1f} m: radius {expected:.2f} px, Cycles {measured['CYCLES'][1]:.2f} px, "
                         f"Defocus {measured['DEFOCUS'][1]:.2f} px; centre off by {distance:.2f} px")
            self.assertLess(distance, 0.5)
            for radius in (measured["CYCLES"][1], expected):
                self.assertLess(abs(measured["DEFOCUS"][1] / radius - 1), 0.03)

    def testLandscape(self):
        self.check(160, 120, "AUTO", count=2)

    def testPortrait(self):
        self.check(90, 120, "AUTO")

    def testVerticalFit(self):
        self.check(120, 90, "VERTICAL")

    def testHorizontalFitOfAPortrait(self):
        self.check(90, 120, "HORIZONTAL")

    def testShift(self):
        self.check(120, 90, "AUTO", (0.1, -0.05))


class Features(unittest.TestCase):
    def testBladesStandAsInCycles(self):
        scene, camera, lamps = scenes.lamps(96, 72)
        bpy.data.objects.remove(lamps[0])
        camera.data.dof.aperture_blades, camera.data.dof.aperture_rotation = 3, math.radians(20)
        camera.data.dof.aperture_ratio, camera.data.dof.aperture_fstop = 1.5, 1
        scene.cycles.samples = 512
        one, other = (pictures.rendered(engine, scene)[..., 0] for engine in ("CYCLES", "DEFOCUS"))
        # sums over 3 x 3 px suppress the noise of Cycles
        one, other = (light.reshape(24, 3, 32, 3).sum((1, 3)) for light in (one, other))
        overlap = numpy.minimum(one / one.sum(), other / other.sum()).sum()
        turned = numpy.minimum(one / one.sum(), other[::-1] / other.sum()).sum()
        pictures.say(f"blades: overlap {overlap:.3f}, mirrored {turned:.3f}")
        self.assertGreater(overlap, 0.93)
        self.assertLess(turned, 0.9)

    def testFocusFollowsAnAnimatedObject(self):
        scene, camera, lamps = scenes.lamps(96, 72)
        bpy.data.objects.remove(lamps.pop())
        target = bpy.data.objects.new("target", None)
        scene.collection.objects.link(target)
        camera.data.dof.focus_object = target
        distances = (0.75, 1.4)
        for frame, distance in zip((1, 3), distances):
            target.location = (0.3, distance, 0)
            target.keyframe_insert("location", frame=frame)
        scene.frame_start, scene.frame_end, scene.frame_step = 1, 3, 2
        scene.render.engine = "DEFOCUS"
        with tempfile.TemporaryDirectory() as folder:
            scene.render.filepath = f"{folder}/####"
            bpy.ops.render.render(animation=True)
            frames = [pictures.read(file)[..., 0] for file in sorted(pathlib.Path(folder).glob("*.exr"))]
        for light, camera.data.dof.focus_distance in zip(frames, distances):
            expected = math.hypot(blur_radius(camera, lamps[0].location.y, 96, 72), lamp_radius(camera, lamps[0], 96, 72))
            self.assertLess(abs(pictures.disk(light)[1] / expected - 1), 0.03)

    def testDepthPassAndRenderRegion(self):
        scene = scenes.empty_scene(64, 48)
        scenes.camera(place=(0, 0, 0), pitch=0)
        bpy.ops.mesh.primitive_plane_add(size=1, location=(0.5, 2, 0), rotation=(math.radians(90), 0, 0))
        scenes.with_material(scenes.glowing("wall", 1))
        scene.defocus.samples = 16
        scene.view_layers[0].use_pass_z = True
        scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
        scene.render.use_border, scene.render.use_crop_to_border = True, True
        scene.render.border_min_x, scene.render.border_max_x = 0.25, 0.75
        scene.render.engine = "DEFOCUS"
        scene.camera.data.dof.use_dof = False
        bpy.ops.render.render()
        passes = dict(self.passes(scene))
        self.assertEqual(passes["Combined"].shape[:2], (48, 32))
        self.assertAlmostEqual(passes["Depth"][24, 24, 0], 2, places=4)
        self.assertEqual(passes["Depth"][24, 4, 0], 1e10)
        self.assertAlmostEqual(passes["Combined"][24, 24, 3], 1, places=4)
        self.assertAlmostEqual(passes["Combined"][24, 4, 3], 0, places=4)

    def testLayersReachThePasses(self):
        scene = scenes.empty_scene(64, 48)
        scenes.camera(place=(0, 0, 0), pitch=0)
        scene.camera.data.shift_x = 0.05
        for name, size, place, colour in (("Würfel", 1, (0.6, 2, 0), (0.2, 0.5, 0.8)), ("far wall", 9, (0, 4, 0), (1, 1, 1))):
            bpy.ops.mesh.primitive_plane_add(size=size, location=place, rotation=(math.radians(90), 0, 0))
            bpy.context.object.name = name
            scenes.with_material(scenes.diffuse(f"{name}'s paint", color=colour))
        scene.camera.data.dof.focus_distance, scene.camera.data.dof.aperture_fstop = 4, 0.2
        scene.defocus.samples, layer = 64, scene.view_layers[0]
        layer.name = "Sicht"
        for name in ("position", "normal", "diffuse_color", "emit", "cryptomatte_object", "cryptomatte_material"):
            setattr(layer, f"use_pass_{name}", True)
        scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR_MULTILAYER", "32"
        scene.render.engine = "DEFOCUS"
        bpy.ops.render.render()
        passes, texts = dict(self.passes(scene)), self.texts
        near = 24, 52
        for name, expected in (("Position", (None, 2, None)), ("Normal", (0, -1, 0)), ("DiffCol", (0.2, 0.5, 0.8)), ("Emit", (0, 0, 0))):
            for value, right in zip(passes[name][near], expected):
                if right is not None:
                    self.assertAlmostEqual(value, right, places=3, msg=name)
        across = passes["Position"][24, :, 0]
        self.assertTrue((numpy.diff(across[40:]) > 0).all(), "x grows to the right")
        names = {hash_: name for text in texts.values() if text.startswith("{") for name, hash_ in json.loads(text).items()}
        for kind, name in (("CryptoObject00", "Würfel"), ("CryptoMaterial00", "Würfel's paint")):
            number, share = passes[kind][near][:2]
            self.assertEqual(names[f"{numpy.float32(number).view(numpy.uint32):08x}"], name)
            self.assertAlmostEqual(share, 1, places=4)
        self.assertIn("Sicht.CryptoObject", texts.values())
        share = passes["CryptoObject00"][24, :, 1]
        self.assertGreater(((share > 0.4) & (share < 0.95)).sum(), 3, "edges are soft")

    def passes(self, scene):
        import OpenImageIO as oiio
        with tempfile.TemporaryDirectory() as folder:
            bpy.data.images["Render Result"].save_render(f"{folder}/all.exr", scene=scene)
            source = oiio.ImageInput.open(f"{folder}/all.exr")
            spec = source.spec()
            names, pixels = spec.channelnames, source.read_image("float")[::-1]
            self.texts = {one.name: one.value for one in spec.extra_attribs if one.name.startswith("cryptomatte/")}
            source.close()
        for name in dict.fromkeys(channel.split(".")[-2] for channel in names):
            letters = "RGBA" if f"{name}.R" in " ".join(names) else "XYZ"
            ordered = sorted((i for i, channel in enumerate(names) if channel.split(".")[-2] == name),
                             key=lambda i: letters.index(names[i][-1]))
            yield name, pixels[..., ordered]

    def testWorldLightsAsInCycles(self):
        scene = scenes.empty_scene(96, 72)
        scenes.camera(place=(0, 0, 0), pitch=0, fstop=8)
        bpy.ops.mesh.primitive_uv_sphere_add(segments=64, ring_count=32, radius=0.25, location=(0, 1, 0))
        scenes.with_material(scenes.diffuse("ball"), smooth=True)
        size = 64
        sky = numpy.zeros((size // 2, size, 4), numpy.float32)
        sky[..., 3], sky[..., :3] = 1, 0.1
        sky[16:, 8:24, 0] = 2  # a red patch on one side of the map, and a blue patch on another side
        sky[4:12, 40:48, 2] = 5
        image = bpy.data.images.new("sky", size, size // 2, float_buffer=True)
        image.pixels.foreach_set(sky.ravel())
        world = scene.world = bpy.data.worlds.new("world")
        world.use_nodes = True
        nodes, links = world.node_tree.nodes, world.node_tree.links
        texture, mapping, coordinates = (nodes.new(f"ShaderNode{name}") for name in ("TexEnvironment", "Mapping", "TexCoord"))
        texture.image, mapping.inputs["Rotation"].default_value[2] = image, 0.7
        links.new(coordinates.outputs["Generated"], mapping.inputs["Vector"])
        links.new(mapping.outputs["Vector"], texture.inputs["Vector"])
        links.new(texture.outputs["Color"], nodes["Background"].inputs["Color"])
        nodes["Background"].inputs["Strength"].default_value = 0.5
        scene.cycles.samples, scene.defocus.samples = 64, 128
        for transparent in (False, True):
            scene.render.film_transparent = transparent
            one, other = pictures.rendered("CYCLES", scene), pictures.rendered("DEFOCUS", scene)
            value = pictures.psnr(one, other)
            pictures.say(f"world, transparent {transparent}: {value:.1f} dB")
            self.assertGreater(value, 35)

    def testRenderModifiersInstancesAndNames(self):
        from defocus_engine.engine import reports
        scene = scenes.empty_scene(64, 48)
        scenes.camera(place=(0, 0, 0), pitch=0, fstop=8)
        material = scenes.glowing("Glühen 光", 1)
        bpy.ops.mesh.primitive_plane_add(size=0.1, location=(-0.2, 1, 0), rotation=(math.radians(90), 0, 0))
        tile = scenes.with_material(material)
        tile.name = "Fliese 瓷砖"
        array = tile.modifiers.new("array", "ARRAY")
        array.count, array.show_viewport, array.use_relative_offset = 2, False, True
        array.relative_offset_displace = (2, 0, 0)
        bpy.ops.object.text_add(location=(0.1, 1, 0.05), rotation=(math.radians(90), 0, 0), radius=0.1)
        bpy.context.object.data.materials.append(material)
        group = bpy.data.collections.new("group")
        bpy.ops.mesh.primitive_uv_sphere_add(radius=0.03, location=(0, 1, -0.12))
        ball = scenes.with_material(material)
        scene.collection.objects.unlink(ball)
        group.objects.link(ball)
        for across in (-0.1, 0.1):
            bpy.ops.object.collection_instance_add(collection="group", location=(across, 0, 0))
        hidden = bpy.data.objects.new("hidden", tile.data)
        scene.collection.objects.link(hidden)
        hidden.hide_render, hidden.location = True, (0, 0.9, 0)
        things, meshes = len(bpy.data.objects), len(bpy.data.meshes)
        value = pictures.silhouette_distance(pictures.rendered("CYCLES", scene), pictures.rendered("DEFOCUS", scene))
        pictures.say(f"modifiers, text, instances: {value:.2f} px")
        self.assertLess(value, 0.5)
        self.assertEqual((things, meshes), (len(bpy.data.objects), len(bpy.data.meshes)))
        self.assertEqual(reports[scene.name], [])

    def testMotionBlurIsAsWideAsThePath(self):
        scene = scenes.empty_scene(96, 72)
        camera = scenes.camera(place=(0, 0, 0), pitch=0)
        camera.data.dof.use_dof, scene.defocus.samples = False, 256
        bpy.ops.mesh.primitive_uv_sphere_add(radius=0.02, location=(0, 1, 0))
        ball = scenes.with_material(scenes.glowing("ball", 1))
        for frame, across in ((0, -0.1), (2, 0.1)):  # the ball moves by 0.1 m per frame
            ball.location.x = across
            ball.keyframe_insert("location", frame=frame)
        for point in ball.animation_data.action.fcurves[0].keyframe_points:
            point.interpolation = "LINEAR"
        scene.frame_set(1)
        scene.render.use_motion_blur, scene.render.motion_blur_shutter = True, 0.5
        light = pictures.rendered("DEFOCUS", scene)[..., 0].sum(axis=0)
        x = numpy.arange(96) + 0.5
        mean = light @ x / light.sum()
        scene.render.use_motion_blur = False
        still = pictures.rendered("DEFOCUS", scene)[..., 0].sum(axis=0)
        width = math.sqrt(12 * (light @ (x - mean) ** 2 / light.sum() - still @ (x - 48) ** 2 / still.sum()))
        # length in px of a path of 0.05 m at a distance of 1 m: 50 mm lens, sensor and image 36 mm and 96 px wide
        expected = 0.05 * 96 * 50 / 36
        pictures.say(f"motion blur: {width:.2f} px, expected {expected:.2f} px")
        self.assertAlmostEqual(mean, 48, delta=0.1)
        self.assertAlmostEqual(width / expected, 1, delta=0.02)

    def testFilmOfMovingThingsIsExportedOnce(self):
        from defocus_engine import export
        scene = scenes.empty_scene(48, 36)
        camera = scenes.camera(place=(0, 0, 0), pitch=0)
        bpy.ops.mesh.primitive_plane_add(size=0.1, location=(0, 1, 0), rotation=(math.radians(90), 0, 0))
        material = scenes.glowing("wall", 1)
        wall = scenes.with_material(material)
        strength = material.node_tree.nodes["Principled BSDF"].inputs["Emission Strength"]
        scene.frame_start, scene.frame_end, scene.render.engine, scene.defocus.samples = 1, 3, "DEFOCUS", 32
        for frame, across in ((1, -0.1), (3, 0.1)):
            camera.location.x, wall.location.z = across, 0.5 * across
            camera.keyframe_insert("location", frame=frame)
            wall.keyframe_insert("location", frame=frame)
        exports, function = [], export.export_gltf

        def counted(*arguments):
            exports.append(1)
            function(*arguments)

        export.export_gltf = counted
        try:
            first = self.film(scene)
            self.assertEqual(len(exports), 1)
            strength.default_value = 0.25
            strength.keyframe_insert("default_value", frame=1)
            strength.default_value = 1
            strength.keyframe_insert("default_value", frame=3)
            second = self.film(scene)
            self.assertEqual(len(exports), 4)
        finally:
            export.export_gltf = function
        for frame, across in ((0, -0.1), (2, 0.1)):
            (x, y), _ = pictures.disk(first[frame])
            pixels = 50 / 36 * 48  # pixels per metre at a distance of 1 m: focal length / sensor width · image width
            self.assertAlmostEqual(x, 23.5 - across * pixels, delta=0.1)
            self.assertAlmostEqual(y, 17.5 + 0.5 * across * pixels, delta=0.1)
        self.assertAlmostEqual(second[0].max(), 0.25, places=3)
        self.assertAlmostEqual(second[2].max(), 1, places=3)

    def film(self, scene):
        with tempfile.TemporaryDirectory() as folder:
            scene.render.filepath = f"{folder}/####"
            bpy.ops.render.render(animation=True)
            self.assertEqual([name for name in os.listdir(tempfile.gettempdir()) if name.startswith("defocus-film")], [])
            return [pictures.read(file)[..., 0] for file in sorted(pathlib.Path(folder).glob("*.exr"))]

    def testEditModeIsRenderedAndStays(self):
        scene = scenes.empty_scene(32, 24)
        scenes.camera(place=(0, 0, 0), pitch=0)
        bpy.ops.mesh.primitive_plane_add(size=0.1, location=(0, 1, 0), rotation=(math.radians(90), 0, 0))
        scenes.with_material(scenes.glowing("tile", 1))
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.transform.resize(value=(3, 3, 3))
        picture = pictures.rendered("DEFOCUS", scene)
        self.assertEqual(bpy.context.object.mode, "EDIT")
        self.assertAlmostEqual(picture[..., 3].sum(), (0.3 * 50 / 36 * 32) ** 2, delta=1)
