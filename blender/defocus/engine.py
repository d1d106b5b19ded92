"""The render engine: one run of the program for each frame."""

import atexit
import os
import tempfile

import bpy
import numpy

from . import kept_picture, program
from .camera import frame_size
from .export import export
from .failure import Failure
from .main_thread import on_main_thread
from .motion import exposure_of, poses_during
from .preferences import find_program

FAR = 1e10  # m; Blender's depth of the background
reports = {}  # scene name → lines on what the last export left out


class DefocusEngine(bpy.types.RenderEngine):
    bl_idname = "DEFOCUS"
    bl_label = "Defocus"
    bl_use_preview = False
    bl_use_postprocess = True
    bl_use_eevee_viewport = True

    def update_render_passes(self, scene=None, renderlayer=None):
        self.register_pass(scene, renderlayer, "Combined", 4, "RGBA", "COLOR")
        if renderlayer is not None and renderlayer.use_pass_z:
            self.register_pass(scene, renderlayer, "Depth", 1, "Z", "VALUE")

    def render(self, depsgraph):
        try:
            if self.render_frame(depsgraph):
                return
        except Failure as failure:
            self.report({"ERROR"}, str(failure))
        self.show_last(depsgraph)

    def render_frame(self, depsgraph):
        """Renders the frame. Returns False if the user cancelled it."""
        scene = depsgraph.scene_eval
        found = find_program()
        with tempfile.TemporaryDirectory(prefix="defocus-") as folder:
            self.update_stats("", "Defocus: exporting the scene")
            poses = poses_during(self, depsgraph, exposure_of(scene)[1])
            exported = on_main_thread(lambda: export(depsgraph, folder, poses, is_film=self.is_animation))
            reports[scene.name] = exported.notes
            for note in exported.notes:
                self.report({"WARNING"}, f"Defocus: {note}")
            wants_depth = depsgraph.view_layer_eval.use_pass_z
            picture = os.path.join(folder, "picture.exr")
            words = [found, "render", *exported.words, "-o", picture, *(["--aov", "depth"] if wants_depth else [])]
            messages = program.run(words, folder, self.show_progress, self.test_break)
            if messages is None:
                return False
            for message in messages:
                is_warning = message.startswith("warning: ")
                self.report({"WARNING" if is_warning else "INFO"}, "Defocus: " + message.removeprefix("warning: ").removeprefix(f"{picture}: "))
            files = {"Combined": picture}
            if wants_depth:
                files["Depth"] = os.path.join(folder, "picture.depth.exr")
            self.show(kept_picture.keep(picture_key(depsgraph), files, exported.view), exported.view, depsgraph)
        return True

    def show_progress(self, stage, share):
        self.update_stats("", f"Defocus: {stage}")
        self.update_progress(share)

    def show(self, files, view, depsgraph):
        """Copies a picture into the render result."""
        result = self.begin_result(0, 0, view.picture_width, view.picture_height, layer=depsgraph.view_layer_eval.name)
        passes = result.layers[0].passes
        # Only the collection's foreach_set takes arrays of vectors: one array with the pixels of all passes in turn.
        passes.foreach_set("rect", numpy.concatenate([self.pass_pixels(files, view, one) for one in passes]))
        self.end_result(result)

    def pass_pixels(self, files, view, one):
        """Returns the pixels of a pass; 0 if there is no file for it."""
        if one.name not in files:
            return numpy.zeros(view.picture_width * view.picture_height * one.channels, numpy.float32)
        pixels = on_main_thread(lambda: read_pixels(files[one.name], view))[..., :one.channels]
        if one.name == "Depth":
            pixels = numpy.where(numpy.isfinite(pixels), numpy.minimum(pixels, FAR), FAR)
        return pixels.ravel()

    def show_last(self, depsgraph):
        """Shows the scene's last picture again, because Blender clears the render result before each render."""
        scene = depsgraph.scene_eval
        width, height = frame_size(scene.render)
        picture = kept_picture.last(picture_key(depsgraph), width, height)
        if picture and not self.is_animation:
            self.show(*picture, depsgraph)


def picture_key(depsgraph):
    return f"{depsgraph.scene_eval.name}/{depsgraph.view_layer_eval.name}"


def read_pixels(file, view):
    """Returns the part of a canvas that Blender shows as height × width × channels.

    Blender's RenderLayer.load_from_file would multiply the colours by alpha once more.
    """
    image = bpy.data.images.load(file)
    try:
        image.colorspace_settings.name = "Non-Color"
        pixels = numpy.empty(image.size[0] * image.size[1] * image.channels, numpy.float32)
        image.pixels.foreach_get(pixels)
        pixels = pixels.reshape(image.size[1], image.size[0], image.channels)
        return pixels[view.y:view.y + view.picture_height, view.x:view.x + view.picture_width]
    finally:
        bpy.data.images.remove(image)


def register():
    bpy.utils.register_class(DefocusEngine)
    atexit.register(kept_picture.forget)


def unregister():
    atexit.unregister(kept_picture.forget)
    bpy.utils.unregister_class(DefocusEngine)
