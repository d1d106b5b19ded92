"""Defines the button that opens the scene in the window of `defocus`."""

import shutil
import subprocess

import bpy

from .engine import reports
from .export import export
from .failure import Failure
from .preferences import find_program
from .scratch import new_folder

SECONDS_BETWEEN_CHECKS = 1.0
views = []  # open windows: (process, temporary folder of the exported scene)


class DefocusView(bpy.types.Operator):
    bl_idname = "defocus.view"
    bl_label = "Open in Defocus"
    bl_description = "Open the scene in the window of 'defocus view'"

    def execute(self, context):
        try:
            notes = reports[context.scene.name] = open_view(context.evaluated_depsgraph_get())
        except (Failure, OSError) as failure:
            self.report({"ERROR"}, str(failure))
            return {"CANCELLED"}
        for note in notes:
            self.report({"WARNING"}, f"Defocus: {note}")
        if not bpy.app.timers.is_registered(remove_closed):
            bpy.app.timers.register(remove_closed, first_interval=SECONDS_BETWEEN_CHECKS, persistent=True)
        return {"FINISHED"}


def open_view(depsgraph):
    """Opens the scene in the window of `defocus`, and returns the export's warnings. Raises Failure or OSError."""
    found = find_program()
    folder = new_folder("view")
    try:
        exported = export(depsgraph, folder, for_view=True)
        views.append((subprocess.Popen([found, "view", *exported.words], cwd=folder), folder))
    except BaseException:
        shutil.rmtree(folder, ignore_errors=True)
        raise
    return exported.notes


def remove_closed():
    """Removes the folders of closed windows. Returns the seconds until the next call, or None if no window is open."""
    for view in list(views):
        if view[0].poll() is not None:
            shutil.rmtree(view[1], ignore_errors=True)
            views.remove(view)
    return SECONDS_BETWEEN_CHECKS if views else None


def register():
    bpy.utils.register_class(DefocusView)


def unregister():
    for process, folder in views:
        process.terminate()
        process.wait()
        shutil.rmtree(folder, ignore_errors=True)
    views.clear()
    bpy.utils.unregister_class(DefocusView)
