"""Defocus as a render engine of Blender: exports the scene as glTF and renders it with the program `defocus`."""

bl_info = {
    "name": "Defocus",
    "author": "The defocus project",
    "version": (0, 2, 0),
    "blender": (3, 4, 0),
    "location": "Render properties > Render Engine > Defocus",
    "description": "Renders with the depth of field of a real lens",
    "doc_url": "",
    "category": "Render",
}

from . import engine, film, panel, preferences, settings, viewer

MODULES = (preferences, settings, film, engine, viewer, panel)


def register():
    for module in MODULES:
        module.register()


def unregister():
    for module in reversed(MODULES):
        module.unregister()
