"""Defines the render engine, which runs the program `defocus` once for each frame."""

import os
import tempfile

import bpy
import numpy
from bpy.app.handlers import persistent

from . import program
from .camera import picture_size
from .export import export
from .failure import Cancelled, Failure
from .main_thread import on_main_thread
from .motion import exposure_of, poses_during
from .passes import passes_of, read_passes, words_for
from .preferences import find_program
from .scratch import new_folder

pictures = {}  # picture_key() → last image: (pixels of each pass, metadata texts, width, height)
reports = {}  # scene name → messages about items that the last export left out


class DefocusEngine(bpy.types.RenderEngine):
    bl_idname = "DEFOCUS"
    bl_label = "Defocus"
    bl_use_preview = False
    bl_use_postprocess = True
    bl_use_eevee_viewport = True

    def update_render_passes(self, scene=None, renderlayer=None):
        for one in passes_of(renderlayer):
            self.register_pass(scene, renderlayer, one.name, len(one.channels), one.channels, one.kind)

    def render(self, depsgraph):
        try:
            pixels, texts, view = self.render_frame(depsgraph)
            pictures[picture_key(depsgraph)] = pixels, texts, view.picture_width, view.picture_height
        except Failure as failure:
            self.report({"ERROR"}, str(failure))
        except Cancelled:
            pass
        self.show_last(depsgraph)

    def on_main_thread(self, function):
        return on_main_thread(function, self.test_break)

    def render_frame(self, depsgraph):
        """Renders a frame. Returns pixels of each pass (name → flat array), metadata texts, and the camera.View."""
        scene = depsgraph.scene_eval
        found = find_program()
        with new_folder("render", tempfile.TemporaryDirectory) as folder:
            self.update_stats("", "Defocus: exporting the scene")
            poses = poses_during(self, depsgraph, exposure_of(scene)[1])
            exported = self.on_main_thread(lambda: export(depsgraph, folder, poses, is_film=self.is_animation))
            reports[scene.name] = exported.notes
            for note in exported.notes:
                self.report({"WARNING"}, f"Defocus: {note}")
            passes = passes_of(depsgraph.view_layer_eval)
            picture = os.path.join(folder, "picture.exr")
            words = [found, "render", *exported.words, "-o", picture, *words_for(passes)]
            for message in program.run(words, folder, self.show_progress, self.test_break):
                is_warning = message.startswith("warning: ")
                self.report({"WARNING" if is_warning else "INFO"}, "Defocus: " + message.removeprefix("warning: ").removeprefix(f"{picture}: "))
            pixels, texts = read_passes(passes, picture, os.path.join(folder, "picture.depth.exr"), exported.view)
            return pixels, texts, exported.view

    def show_progress(self, stage, share):
        self.update_stats("", f"Defocus: {stage}")
        self.update_progress(share)

    def show_last(self, depsgraph):
        """Shows the view layer's last image if it has the size of the render.

        Blender clears the render result before each render. After a failed render, the user thus still sees the last
        image.
        """
        pixels, texts, *size = pictures.get(picture_key(depsgraph), ({}, {}, 0, 0))
        if tuple(size) != picture_size(depsgraph.scene_eval.render):
            return
        result = self.begin_result(0, 0, *size, layer=depsgraph.view_layer_eval.name)
        passes = result.layers[0].passes
        # Only foreach_set of the collection of passes accepts arrays of vectors. Its array holds the pixels of all
        # passes.
        passes.foreach_set("rect", numpy.concatenate([
            pixels.get(one.name, numpy.zeros(size[0] * size[1] * one.channels, numpy.float32)) for one in passes]))
        self.end_result(result)
        metadata = self.get_result()
        for name, text in texts.items():
            metadata.stamp_data_add_field(name, text.replace("ViewLayer.", f"{depsgraph.view_layer_eval.name}."))


def picture_key(depsgraph):
    return f"{depsgraph.scene_eval.name}/{depsgraph.view_layer_eval.name}"


@persistent
def forget(*_):
    """Forgets the images and reports of a Blender file when another file is opened."""
    pictures.clear()
    reports.clear()


def register():
    bpy.utils.register_class(DefocusEngine)
    bpy.app.handlers.load_pre.append(forget)


def unregister():
    bpy.app.handlers.load_pre.remove(forget)
    bpy.utils.unregister_class(DefocusEngine)
