"""Defines the preferences of the add-on: the path of the program `defocus`."""

import os
import shutil

import bpy

from .failure import Failure


class DefocusPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    program: bpy.props.StringProperty(
        name="Program", subtype="FILE_PATH", default="",
        description="Path of the program defocus. Empty: the program is searched in PATH")

    def draw(self, _context):
        self.layout.prop(self, "program")
        try:
            self.layout.label(text=f"Found: {find_program()}", icon="CHECKMARK")
        except Failure as failure:
            self.layout.label(text=str(failure), icon="ERROR")


def find_program():
    """Returns the path of the program `defocus`. Raises Failure if the program is not found."""
    addon = bpy.context.preferences.addons.get(__package__)
    given = bpy.path.abspath(addon.preferences.program) if addon else ""
    if given:
        if os.path.isfile(given) and os.access(given, os.X_OK):
            return given
        raise Failure(f"{given} is not a program; correct the path in the preferences of the add-on Defocus")
    found = shutil.which("defocus")
    if not found:
        raise Failure("The program defocus is not in PATH; install it or set its path in the preferences of the add-on Defocus")
    return found


def register():
    bpy.utils.register_class(DefocusPreferences)


def unregister():
    bpy.utils.unregister_class(DefocusPreferences)
