"""Runs inside Blender for `scripts/figures cycles`: renders each scene with Cycles and with defocus, and compares them.

Prints a line of JSON for each scene.
"""

import json
import math
import pathlib
import subprocess
import sys

import bpy
import numpy

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from figures.cycles_materials import MADE, prepare_for_cycles  # noqa: E402
from figures.cycles_scenes import SCENES  # noqa: E402


def prepared_scene(width, height, samples):
    """Returns an empty scene for direct light in Cycles, with a black world and a box filter of one pixel."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    MADE.clear()
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = width, height, 100
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
    cycles = scene.cycles
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = cycles.transmission_bounces = 0
    cycles.samples, cycles.use_adaptive_sampling, cycles.use_denoising = samples, False, False
    cycles.pixel_filter_type = "BOX"
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.blur_glossy = cycles.light_sampling_threshold = 0
    return scene


def read_exr(file):
    """Returns the linear colours of an image as a height × width × 3 array; row 0 is the bottom row."""
    image = bpy.data.images.load(str(file))
    pixels = numpy.empty(image.size[0] * image.size[1] * 4, numpy.float32)
    image.pixels.foreach_get(pixels)
    result = pixels.reshape(image.size[1], image.size[0], 4)[..., :3].astype(float)
    bpy.data.images.remove(image)
    return result


def encoded(linear):
    clamped = numpy.clip(linear, 0, 1)
    return numpy.where(clamped <= 0.0031308, 12.92 * clamped, 1.055 * clamped ** (1 / 2.4) - 0.055)


def render_cycles(scene, base, seed, shadows):
    """Renders an image for each light with Cycles, and returns the sum of these images."""
    lights = [thing for thing in scene.objects if thing.type == "LIGHT"]
    total = 0
    for index, light in enumerate(lights):
        for other in lights:
            other.hide_render = other is not light
            other.data.cycles.cast_shadow = shadows
        for name in MADE:
            prepare_for_cycles(name, light)
        scene.cycles.seed = seed * len(lights) + index
        scene.render.filepath = f"{base}.exr"
        bpy.ops.render.render(write_still=True)
        total = total + read_exr(f"{base}.exr")
    return total


def render_defocus(program, scene, base, samples, shadows):
    """Renders with defocus. Returns the image and the name of the OpenGL device."""
    lens = scene.camera.data.dof
    words = [program, "render", f"{base}.glb", "-o", f"{base}.exr", "--quiet", "--stats", f"{base}.json", "--samples", samples,
             "--size", f"{scene.render.resolution_x}x{scene.render.resolution_y}", "--lod", "off", "--units", "m",
             "--fstop", lens.aperture_fstop, "--focus-distance", lens.focus_distance, "--background", "0,0,0",
             "--shadows", "on" if shadows else "off", "--light-angle", 0, "--light-radius", 0]
    subprocess.run([str(word) for word in words], check=True)
    return read_exr(f"{base}.exr"), json.loads(pathlib.Path(f"{base}.json").read_text())["device"]


def psnr(mse):
    return -10 * math.log10(max(mse, 1e-12))


def write_strip(images, file):
    """Writes images, in [0, 1], side by side as a PNG file."""
    strip = numpy.concatenate(images, axis=1)
    strip = numpy.dstack([strip, numpy.ones(strip.shape[:2])]).astype(numpy.float32)
    image = bpy.data.images.new("strip", strip.shape[1], strip.shape[0])
    image.pixels.foreach_set(strip.ravel())
    image.filepath_raw, image.file_format = str(file), "PNG"
    image.save()


def compare(name, settings):
    scene = prepared_scene(settings["width"], settings["height"], settings["samples"])
    SCENES[name]()
    base = pathlib.Path(settings["folder"]) / name.replace(" ", "-")
    bpy.ops.export_scene.gltf(filepath=f"{base}.glb", export_cameras=True, export_lights=True, convert_lighting_mode="COMPAT")
    result = {"scene": name}
    for shadows, counts in ((False, settings["counts"]), (True, settings["counts"][-1:])):
        first, second = (render_cycles(scene, base, seed, shadows) for seed in (0, 1))
        noise = numpy.mean((encoded(first) - encoded(second)) ** 2) / 4
        reference = encoded((first + second) / 2)
        errors = []
        for samples in counts:
            image, result["device"] = render_defocus(settings["program"], scene, base, samples, shadows)
            difference = encoded(image) - reference
            errors.append(psnr(numpy.mean(difference ** 2) - noise))
        write_strip([reference, encoded(image), numpy.clip(0.5 + 5 * difference, 0, 1)], f"{base}{'-shadows' if shadows else ''}.png")
        result["shadows" if shadows else "plain"] = [*errors, psnr(noise)]
    print(json.dumps(result), flush=True)


if __name__ == "__main__":
    given = json.loads(sys.argv[-1])
    if unknown := set(given["scenes"]) - set(SCENES):
        sys.exit(f"There is no scene '{unknown.pop()}'; the scenes are: {', '.join(SCENES)}.")
    for name in given["scenes"] or SCENES:
        compare(name, given)
