"""Exports a scene for the program: a glTF file, an environment map, and options. Needs the main thread."""

import contextlib
import dataclasses
import io
import json
import math
import os

import bpy

from .camera import camera_words, view_of
from .failure import Failure
from .motion import SEGMENTS, add_motion, exposure_of
from .scene_copy import scene_copy
from .settings import setting_words
from .world import world_words

EXPORTER = "io_scene_gltf2"


@dataclasses.dataclass
class Export:
    words: list  # scene and options of the program
    view: object  # camera.View
    notes: list  # one line for each thing that is not exported


@contextlib.contextmanager
def shown_scene(scene):
    """Shows a scene in the window, because the exporter reads the window's scene."""
    manager = bpy.context.window_manager
    window = bpy.context.window or (manager.windows[0] if manager.windows else None)
    if window is None:
        raise Failure("Blender's exporter needs a window, and there is none")
    shown, layer = window.scene, window.view_layer
    try:
        with bpy.context.temp_override(window=window):
            window.scene = scene
        with bpy.context.temp_override(window=window, scene=scene, view_layer=scene.view_layers[0]):
            yield
    finally:
        with bpy.context.temp_override(window=window):
            window.scene = shown
            window.view_layer = layer


def reason_of(error):
    """Returns the line of an operator's error that names the cause: the last one of its traceback."""
    lines = [line for line in str(error).splitlines() if line.strip() and not line.startswith(("Location:", " "))]
    return lines[-1].removeprefix("Error: ") if lines else "it gave no reason"


def export_gltf(scene, file):
    """Writes a scene as glTF. Throws Failure with the exporter's last line if it fails."""
    if EXPORTER not in bpy.context.preferences.addons:
        raise Failure("Blender's glTF exporter is off; turn on the add-on 'Import-Export: glTF 2.0 format'")
    said = io.StringIO()
    try:
        with shown_scene(scene), contextlib.redirect_stdout(said):
            # COMPAT keeps Blender's watts, so that radiances in the picture are those of Cycles.
            bpy.ops.export_scene.gltf(filepath=file, check_existing=False, export_format="GLTF_SEPARATE", use_active_scene=True,
                                      export_cameras=True, export_lights=True, convert_lighting_mode="COMPAT", export_extras=True,
                                      export_apply=False, export_animations=False, export_skins=False, export_morph=False,
                                      export_current_frame=True)
    except RuntimeError as error:
        raise Failure(f"Blender's glTF exporter failed: {reason_of(error)}") from error
    if not os.path.isfile(file):
        raise Failure("Blender's glTF exporter wrote no file")


def finish_gltf(file, copy, seconds, poses):
    """Gives nodes, meshes, cameras and lights the user's names of their objects, which messages and options use, and adds the motion while the shutter is open."""
    with open(file, encoding="utf-8") as stream:
        content = json.load(stream)
    nodes = [(index, *copy.moving[node["name"]]) for index, node in enumerate(content.get("nodes", [])) if node["name"] in copy.moving]
    moves = add_motion(content, nodes, seconds, poses)
    lights = content.get("extensions", {}).get("KHR_lights_punctual", {}).get("lights", [])
    for node in content.get("nodes", []):
        node["name"] = copy.names.get(node["name"], node["name"])
        light = node.get("extensions", {}).get("KHR_lights_punctual", {}).get("light")
        for kind, index in ((content.get("meshes"), node.get("mesh")), (content.get("cameras"), node.get("camera")), (lights, light)):
            if index is not None:
                kind[index]["name"] = node["name"]
    with open(file, "w", encoding="utf-8") as stream:
        json.dump(content, stream, ensure_ascii=False)
    if not moves:
        return []
    return ["--time", "0", "--shutter", f"{seconds:.7g}", "--shutter-position", "start", "--motion-segments", str(SEGMENTS)]


def light_words(copy):
    """Returns the sizes of the lights. The program has one angle for all suns, and one radius for all other lights."""
    words = []
    for sizes, option, factor, what in ((copy.light_angles, "--light-angle", 180 / math.pi, "sun lights have different angles"),
                                        (copy.light_radii, "--light-radius", 1, "point and spot lights have different radii")):
        if len(sizes) > 1:
            copy.note(f"the {what}; all get the largest")
        if sizes:
            words += [option, f"{max(sizes) * factor:.7g}"]
    return words


def export(depsgraph, folder, poses=(), for_view=False):
    """Exports the evaluated scene of a depsgraph into `folder` and returns an Export.

    poses: the poses at the frames of exposure_of (motion.poses_during); none: no motion blur.
    """
    scene = depsgraph.scene_eval
    if scene.camera is None:
        raise Failure("The scene has no camera; add one, or make one the active camera")
    camera = scene.camera.evaluated_get(depsgraph)
    view = view_of(camera.data, scene.render)
    file = os.path.join(folder, "scene.gltf")
    with scene_copy(depsgraph, camera, view) as copy:
        export_gltf(copy.scene, file)
        words = finish_gltf(file, copy, exposure_of(scene)[0], poses)
        words += light_words(copy) + world_words(scene.world, scene.render.film_transparent, folder, copy.notes)
        if scene.render.pixel_aspect_x != scene.render.pixel_aspect_y:
            copy.note("the pixel aspect ratio is ignored: pixels are square")
    words = [file, *camera_words(camera, view), *words, *setting_words(scene.defocus, for_view)]
    return Export(words, view, copy.notes)
