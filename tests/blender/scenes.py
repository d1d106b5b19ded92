"""Builds the scenes of the add-on's tests. Lengths are in m, and directions are in Blender's axes (z up)."""

import math

import bpy
import numpy


def empty_scene(width=256, height=192):
    """Returns an empty scene that both engines render alike: no bounces, a pixel-sized box filter, and no clamping."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=False)
    scene = bpy.context.scene
    render, cycles = scene.render, scene.cycles
    render.resolution_x, render.resolution_y, render.resolution_percentage = width, height, 100
    render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR", "32"
    render.film_transparent = True
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = cycles.transmission_bounces = 0
    cycles.samples, cycles.use_adaptive_sampling, cycles.use_denoising = 256, False, False
    cycles.pixel_filter_type = "BOX"
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.light_sampling_threshold = 0
    scene.defocus.samples, scene.defocus.levels = 256, "off"
    return scene


def checker(name, first, second, cells=12, size=768):
    """Returns a packed image of a checker board; colours are sRGB-encoded.

    Texels are small, because Cycles interpolates encoded colours, whereas glTF interpolates linear colours.
    """
    cell = numpy.arange(size) * cells // size
    colors = numpy.where(((cell[:, None] + cell) % 2 == 0)[..., None], (*first, 1), (*second, 1)).astype(numpy.float32)
    image = bpy.data.images.new(name, size, size)
    image.pixels.foreach_set(colors.ravel())
    image.pack()
    return image


def diffuse(name, image=None, color=(0.8, 0.8, 0.8)):
    """Returns a Lambertian material: a Diffuse BSDF for Cycles, and a Principled BSDF for the glTF exporter.

    The diffuse reflection of Cycles' Principled BSDF (Burley 2012) differs from glTF's. show_for() chooses the BSDF.
    """
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    shader = material.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*color, 1)
    shader.inputs["Specular"].default_value, shader.inputs["Roughness"].default_value = 0, 1
    lambert = material.node_tree.nodes.new("ShaderNodeBsdfDiffuse")
    lambert.inputs["Color"].default_value = (*color, 1)
    if image:
        texture = material.node_tree.nodes.new("ShaderNodeTexImage")
        texture.image = image
        material.node_tree.links.new(texture.outputs["Color"], shader.inputs["Base Color"])
        material.node_tree.links.new(texture.outputs["Color"], lambert.inputs["Color"])
    return material


def show_for(engine):
    """Links each material's output to its Diffuse BSDF for Cycles, or to its Principled BSDF for Defocus."""
    for material in bpy.data.materials:
        nodes = material.node_tree.nodes
        if "Diffuse BSDF" in nodes:
            shader = nodes["Diffuse BSDF" if engine == "CYCLES" else "Principled BSDF"]
            material.node_tree.links.new(shader.outputs["BSDF"], nodes["Material Output"].inputs["Surface"])


def glowing(name, radiance):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    shader = material.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value, shader.inputs["Specular"].default_value = (0, 0, 0, 1), 0
    shader.inputs["Emission"].default_value, shader.inputs["Emission Strength"].default_value = (1, 1, 1, 1), radiance
    return material


def with_material(material, smooth=False):
    thing = bpy.context.object
    thing.data.materials.append(material)
    for face in thing.data.polygons:
        face.use_smooth = smooth
    return thing


def camera(place=(0, 0, 0.25), focus=1.0, fstop=1.4, pitch=8):
    """Adds a 50 mm camera with a 36 mm sensor that looks along +y, tilted down by `pitch` degrees."""
    bpy.ops.object.camera_add(location=place, rotation=(math.radians(90 - pitch), 0, 0))
    bpy.context.scene.camera = bpy.context.object
    data = bpy.context.object.data
    data.lens, data.sensor_width, data.sensor_height, data.clip_start = 50, 36, 24, 0.05
    data.dof.use_dof, data.dof.focus_distance, data.dof.aperture_fstop, data.dof.aperture_blades = True, focus, fstop, 0
    return bpy.context.object


def light(kind, name, place, energy, rotation=(0, 0, 0)):
    bpy.ops.object.light_add(type=kind, location=place, rotation=[math.radians(angle) for angle in rotation])
    thing = bpy.context.object
    thing.name, thing.data.energy = name, energy
    return thing


def still_life():
    """Returns six objects, a sun, a point, a spot and an area light, and a camera at f/1.4 with a focus object."""
    scene = empty_scene()
    tiles = checker("tiles", (0.9, 0.9, 0.85), (0.25, 0.35, 0.6))
    bricks = checker("bricks", (0.75, 0.3, 0.2), (0.85, 0.75, 0.55), 8)
    bpy.ops.mesh.primitive_plane_add(size=5, location=(0, 2.4, 0))
    with_material(diffuse("floor", tiles)).name = "floor"
    bpy.ops.mesh.primitive_plane_add(size=5, location=(0, 2.6, 0), rotation=(math.radians(90), 0, 0))
    with_material(diffuse("wall", bricks)).name = "wall"
    bpy.ops.mesh.primitive_cube_add(size=0.2, location=(-0.14, 1.0, 0.1), rotation=(0, 0, 0.5))
    box = with_material(diffuse("box", tiles))
    box.name = "box"
    bpy.ops.mesh.primitive_uv_sphere_add(segments=96, ring_count=48, radius=0.12, location=(0.2, 1.35, 0.12))
    with_material(diffuse("ball", bricks), smooth=True).name = "ball"
    bpy.ops.mesh.primitive_cone_add(vertices=64, radius1=0.12, depth=0.3, location=(-0.35, 1.7, 0.15))
    with_material(diffuse("cone", tiles)).name = "cone"
    bpy.ops.mesh.primitive_torus_add(major_radius=0.08, minor_radius=0.025, location=(0.12, 0.75, 0.1), rotation=(1.2, 0.2, 0))
    with_material(diffuse("ring", color=(0.7, 0.5, 0.2)), smooth=True).name = "ring"
    light("SUN", "sun", (0, 0, 3), 1.5, (40, 10, 30)).data.angle = 0.02
    light("POINT", "lamp", (-0.4, 0.8, 0.7), 6).data.shadow_soft_size = 0.02
    spot = light("SPOT", "spot", (0.5, 0.9, 0.9), 15, (10, 20, 0))
    spot.data.spot_size, spot.data.spot_blend, spot.data.shadow_soft_size = math.radians(70), 0, 0.02
    light("AREA", "softbox", (0, 1, 2), 10)
    camera(focus=5).data.dof.focus_object = box
    return scene


def lamps(width, height):
    """Makes two small glowing balls, in front of and behind the focus plane. Returns (scene, camera, balls)."""
    scene = empty_scene(width, height)
    scene.cycles.samples, scene.defocus.samples = 128, 128
    view = camera(place=(0, 0, 0), focus=1.0, pitch=0)
    view.data.lens = 135
    balls = []
    for depth, across in ((0.8, -0.04), (1.4, 0.04)):
        place = (across, depth, 0.01) if width >= height else (0.01, depth, across)
        bpy.ops.mesh.primitive_uv_sphere_add(segments=32, ring_count=16, radius=0.006, location=place)
        balls.append(with_material(glowing(f"lamp at {depth} m", 1)))
    bpy.context.view_layer.update()
    return scene, view, balls
