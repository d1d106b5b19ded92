"""The button that opens the scene in the program's window."""

import shutil
import subprocess
import tempfile

import bpy

from .engine import reports
from .export import export
from .failure import Failure
from .preferences import find_program

SECONDS_BETWEEN_CHECKS = 1.0
views = []  # open views: (process, its folder)


class DefocusView(bpy.types.Operator):
    bl_idname = "defocus.view"
    bl_label = "Open in Defocus"
    bl_description = "Open the scene in the window of 'defocus view'"

    def execute(self, context):
        folder = tempfile.mkdtemp(prefix="defocus-view-")
        try:
            found = find_program()
            exported = export(context.evaluated_depsgraph_get(), folder, for_view=True)
            reports[context.scene.name] = exported.notes
            views.append((subprocess.Popen([found, "view", *exported.words], cwd=folder), folder))
        except (Failure, OSError) as failure:
            shutil.rmtree(folder, ignore_errors=True)
            self.report({"ERROR"}, str(failure))
            return {"CANCELLED"}
        for note in exported.notes:
            self.report({"WARNING"}, f"Defocus: {note}")
        if not bpy.app.timers.is_registered(remove_closed):
            bpy.app.timers.register(remove_closed, first_interval=SECONDS_BETWEEN_CHECKS, persistent=True)
        return {"FINISHED"}


def remove_closed():
    """Removes the folders of closed windows. Returns the time in s until the next call; None: no window is open."""
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
