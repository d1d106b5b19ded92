"""Runs inside Blender for `scripts/figures peers`: renders the .glb file of defocus_peers_bench with Cycles or EEVEE.

Prints a line of JSON for each image. Blender keeps its scene between images, so the times of two images differ by
the time of the additional samples.
"""

import json
import resource
import sys
import time

import bpy
import numpy

numpy.bool = bool  # Blender 3.4's importer uses this name, which numpy 1.24 lacks
REFERENCE_SEED = 1_000_000


def emit_base_colour(material):
    """Makes the surface emit its base colour, vertex colour times factor.

    Cycles does not sample the surface as a light, because light does not bounce.
    """
    factor = next((socket.default_value[:] for node in material.node_tree.nodes if node.type == "MIX"
                   for socket in node.inputs if socket.type == "RGBA" and not socket.is_linked), (1, 1, 1))
    add, link = material.node_tree.nodes.new, material.node_tree.links.new
    material.node_tree.nodes.clear()
    colour, product, emission, output = map(add, ("ShaderNodeVertexColor", "ShaderNodeVectorMath", "ShaderNodeEmission", "ShaderNodeOutputMaterial"))
    colour.layer_name, product.operation = "Col", "MULTIPLY"
    product.inputs[1].default_value = factor[:3]
    link(colour.outputs["Color"], product.inputs[0])
    link(product.outputs[0], emission.inputs["Color"])
    link(emission.outputs[0], output.inputs["Surface"])
    material.cycles.sample_as_light = False


def prepared_scene(facts, width, height):
    """Imports the file and returns its scene, with the camera, the lens and the background that `facts` names."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=facts["file"])
    for material in bpy.data.materials:
        emit_base_colour(material)
    scene = bpy.context.scene
    scene.camera = next(thing for thing in scene.objects if thing.type == "CAMERA")
    lens = scene.camera.data
    lens.sensor_fit, lens.sensor_width, lens.lens, lens.clip_start = "HORIZONTAL", facts["sensorWidth"], facts["focalLength"], facts["nearPlane"]
    lens.clip_end = 1000
    lens.dof.use_dof, lens.dof.focus_distance = True, facts["focusDistance"]
    lens.dof.aperture_fstop, lens.dof.aperture_blades = facts["fStop"], 0
    scene.world = bpy.data.worlds.new("background")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (*facts["background"], 1)
    scene.world.cycles.sampling_method = "NONE"
    render = scene.render
    render.resolution_x, render.resolution_y, render.resolution_percentage = width, height, 100
    render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR", "32"
    render.use_persistent_data = True
    scene.view_settings.view_transform = "Standard"
    cycles = scene.cycles
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = cycles.transmission_bounces = 0
    cycles.use_adaptive_sampling, cycles.use_denoising, cycles.pixel_filter_type = False, False, "BOX"
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.blur_glossy = cycles.light_sampling_threshold = 0
    render.filter_size = 1.1  # used only by EEVEE; its filter of this size has the variance of a box filter 1 px wide
    eevee = scene.eevee
    eevee.use_bokeh_jittered, eevee.bokeh_overblur, eevee.use_gtao, eevee.use_bloom = True, 0, False, False
    return scene


def times():
    used = resource.getrusage(resource.RUSAGE_SELF)
    return time.monotonic(), used.ru_utime + used.ru_stime


def render(scene, samples, seed, file):
    """Renders an image. Returns the wall-clock time and the CPU time."""
    scene.cycles.samples = scene.eevee.taa_render_samples = samples
    scene.cycles.seed = seed
    begin = times()
    bpy.ops.render.render()
    end = times()
    bpy.data.images["Render Result"].save_render(file)
    return [after - before for before, after in zip(begin, end)]


def main(given):
    scene = prepared_scene(given["facts"], given["width"], given["height"])
    method = given["method"]
    scene.render.engine = {"cycles": "CYCLES", "eevee": "BLENDER_EEVEE"}[method]
    render(scene, 1, 0, f"{given['folder']}/first.exr")  # untimed: Blender loads kernels and builds its BVH
    for samples in (1, *given["counts"]):
        runs = [render(scene, samples, 0, f"{given['folder']}/{method}-{samples}.exr")
                for _ in range(3 if samples <= 32 and method == "cycles" else 1)]
        seconds, cpu = map(min, zip(*runs))
        print(json.dumps({"method": method, "samples": samples, "seconds": seconds, "cpuSeconds": cpu}), flush=True)
    if given["referenceSamples"]:
        render(scene, given["referenceSamples"], REFERENCE_SEED, f"{given['folder']}/{method}-reference.exr")


if __name__ == "__main__":
    main(json.loads(sys.argv[-1]))
