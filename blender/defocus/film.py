"""Reuses the exported glTF file for all frames of an animation between which only poses, camera or lens change.

Blender makes a depsgraph for each frame, without information about earlier frames. Frames are therefore compared by a
hash of everything that the exporter writes except object poses.
"""

import hashlib
import shutil

import bpy
import numpy
from bpy.app.handlers import persistent

from .materials import changes_with_time
from .motion import instance_key
from .scratch import new_folder
from .scene_copy import LIGHT_VALUES, is_sheared

_film = {"folder": None, "signature": None, "file": None}

# Properties that determine the exported mesh: (collection of the mesh, property, type, values per element).
MESH_ARRAYS = (("vertices", "co", numpy.float32, 3), ("vertices", "normal", numpy.float32, 3),
               ("loops", "vertex_index", numpy.int32, 1), ("polygons", "loop_total", numpy.int32, 1),
               ("polygons", "material_index", numpy.int32, 1), ("polygons", "use_smooth", bool, 1))


def array_of(collection, name, kind, count):
    values = numpy.empty(len(collection) * count, kind)
    collection.foreach_get(name, values)
    return values


def mesh_hash(mesh):
    digest = hashlib.blake2b()
    for collection, name, kind, count in MESH_ARRAYS:
        digest.update(array_of(getattr(mesh, collection), name, kind, count).tobytes())
    for layer in mesh.uv_layers:
        digest.update(layer.name.encode() + array_of(layer.data, "uv", numpy.float32, 2).tobytes())
    for layer in mesh.color_attributes:
        digest.update(layer.name.encode() + array_of(layer.data, "color", numpy.float32, 4).tobytes())
    return digest.digest()


def signature_of(depsgraph):
    """Returns a hash of the exported scene without object poses. Sheared poses count: glTF nodes cannot store them."""
    digest, meshes = hashlib.blake2b(), {}
    scene = depsgraph.scene_eval
    camera = scene.camera.evaluated_get(depsgraph).data
    digest.update(repr((scene.name, camera.clip_start, camera.clip_end, sorted((key, str(value)) for key, value in camera.items()))).encode())
    for instance in depsgraph.object_instances:
        thing = instance.object
        if not instance.show_self or thing.type not in {"MESH", "LIGHT"}:
            # Skip objects that are neither meshes nor lights. Blender also lists the meshes of curves and texts, as
            # instances.
            continue
        digest.update(repr((instance_key(instance), thing.type)).encode())
        if thing.type == "LIGHT":
            digest.update(repr([tuple(value) if name == "color" else value for name in (*LIGHT_VALUES, "angle", "shadow_soft_size")
                                if (value := getattr(thing.data, name, None)) is not None]).encode())
            continue
        if is_sheared(instance.matrix_world):
            digest.update(repr(instance.matrix_world).encode())
        pointer = thing.data.as_pointer()
        if pointer not in meshes:
            meshes[pointer] = mesh_hash(thing.data)
        digest.update(meshes[pointer])
        for slot in thing.material_slots:
            digest.update(repr(slot.material.name if slot.material else None).encode())
            if slot.material and changes_with_time(slot.material.original):
                digest.update(repr(scene.frame_current_final).encode())
    return digest.digest()


def folder():
    """Returns the temporary folder of the animation's files, which the first call makes."""
    if _film["folder"] is None:
        _film["folder"] = new_folder("film")
    return _film["folder"]


def last_file(signature):
    """Returns the GltfFile of an earlier frame whose scene has this hash; None if there is none."""
    return _film["file"] if signature == _film["signature"] else None


def keep(signature, file):
    _film.update(signature=signature, file=file)


@persistent
def end(*_):
    if _film["folder"] is not None:
        shutil.rmtree(_film["folder"], ignore_errors=True)
    _film.update(folder=None, signature=None, file=None)


HANDLERS = ("render_init", "render_complete", "render_cancel")


def register():
    for name in HANDLERS:
        getattr(bpy.app.handlers, name).append(end)


def unregister():
    for name in HANDLERS:
        getattr(bpy.app.handlers, name).remove(end)
    end()
