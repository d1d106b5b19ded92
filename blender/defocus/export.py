"""Exports a scene for `defocus`: a glTF file, an environment map, and options. Must run on the main thread."""

import contextlib
import dataclasses
import io
import math
import os

import bpy

from . import film
from .camera import camera_words, view_of
from .failure import Failure
from .gltf_file import NAME, read_gltf
from .motion import exposure_of, poses_at
from .scene_copy import scene_copy
from .settings import setting_words
from .world import world_words

EXPORTER = "io_scene_gltf2"


@dataclasses.dataclass
class Export:
    words: list  # scene file and options, as command-line arguments of `defocus`
    view: object  # camera.View: sizes of the canvas and of the part that Blender shows
    notes: list  # one line for each item that is not exported


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


def lighting_option():
    """Returns the name of the exporter's option for the units of lights; Blender 3.6 renamed it."""
    known = bpy.ops.export_scene.gltf.get_rna_type().properties.keys()
    return next(name for name in ("convert_lighting_mode", "export_import_convert_lighting_mode") if name in known)


def reason_of(error):
    """Returns the last line of an operator's traceback, which names the cause of the error."""
    lines = [line for line in str(error).splitlines() if line.strip() and not line.startswith(("Location:", " "))]
    return lines[-1].removeprefix("Error: ") if lines else "it gave no reason"


def export_gltf(scene, file):
    """Writes a scene as glTF. If that fails, raises Failure with the last line of the exporter's message."""
    if EXPORTER not in bpy.context.preferences.addons:
        raise Failure("Blender's glTF exporter is off; turn on the add-on 'Import-Export: glTF 2.0 format'")
    said = io.StringIO()
    try:
        with shown_scene(scene), contextlib.redirect_stdout(said):
            # COMPAT keeps the light units of Blender (W), so that the image has the same radiances as in Cycles.
            bpy.ops.export_scene.gltf(filepath=file, check_existing=False, export_format="GLTF_SEPARATE", use_active_scene=True,
                                      export_cameras=True, export_lights=True, export_extras=True, export_apply=False,
                                      export_animations=False, export_skins=False, export_morph=False, export_current_frame=True,
                                      **{lighting_option(): "COMPAT"})
    except RuntimeError as error:
        raise Failure(f"Blender's glTF exporter failed: {reason_of(error)}") from error
    if not os.path.isfile(file):
        raise Failure("Blender's glTF exporter wrote no file")


def light_words(copy):
    """Returns the options for light sizes. `defocus` has one angle for all suns and one radius for other lights."""
    words = []
    for sizes, option, factor, what in ((copy.light_angles, "--light-angle", 180 / math.pi, "sun lights have different angles"),
                                        (copy.light_radii, "--light-radius", 1, "point and spot lights have different radii")):
        if len(sizes) > 1:
            copy.note(f"the {what}; all get the largest")
        if sizes:
            words += [option, f"{max(sizes) * factor:.7g}"]
    return words


def exported_file(depsgraph, camera, view, folder):
    """Exports the evaluated scene of a depsgraph into `folder` and returns its GltfFile."""
    with scene_copy(depsgraph, camera, view) as copy:
        export_gltf(copy.scene, os.path.join(folder, NAME))
        return read_gltf(folder, copy, light_words(copy))


def export(depsgraph, folder, poses=(), for_view=False, is_film=False):
    """Exports the evaluated scene of a depsgraph into `folder` and returns an Export.

    poses: poses during the exposure, from motion.poses_during(); empty for no motion blur.
    is_film: whether the frame belongs to an animation. The glTF file is then in the animation's folder, and is reused
    if only object poses, camera, lens or world have changed.
    """
    scene = depsgraph.scene_eval
    if scene.camera is None:
        raise Failure("The scene has no camera; add one, or make one the active camera")
    camera = scene.camera.evaluated_get(depsgraph)
    view = view_of(camera.data, scene.render)
    signature = film.signature_of(depsgraph) if is_film else None
    file = film.last_file(signature) if is_film else None
    if file is None:
        file = exported_file(depsgraph, camera, view, film.folder() if is_film else folder)
        if is_film:
            film.keep(signature, file)
    notes = list(file.notes)
    words = file.write(poses_at(depsgraph), exposure_of(scene)[0], poses)
    words = [file.path, *camera_words(camera, view), *words, *world_words(scene.world, scene.render.film_transparent, folder, notes)]
    if scene.render.pixel_aspect_x != scene.render.pixel_aspect_y:
        notes.append("the pixel aspect ratio is ignored: pixels are square")
    return Export([*words, *setting_words(scene.defocus, for_view)], view, notes)
