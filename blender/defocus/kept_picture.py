"""The last picture of each view layer, which stays in the render window if the next render fails or is cancelled."""

import os
import shutil
import tempfile

_state = {"folder": None, "pictures": {}}


def keep(layer, files, view):
    """Moves the files of a picture into a folder that lives as long as Blender. files: name of the pass → file."""
    if _state["folder"] is None:
        _state["folder"] = tempfile.mkdtemp(prefix="defocus-last-")
    kept = {}
    for name, file in files.items():
        kept[name] = os.path.join(_state["folder"], f"{hash(layer) & 0xffffffff:08x}-{name}.exr")
        shutil.move(file, kept[name])
    _state["pictures"][layer] = (kept, view)
    return kept


def last(layer, width, height):
    """Returns (files, view) of the view layer's last picture if it has this size, else None."""
    picture = _state["pictures"].get(layer)
    if picture and (picture[1].picture_width, picture[1].picture_height) == (width, height):
        return picture
    return None


def forget():
    if _state["folder"] is not None:
        shutil.rmtree(_state["folder"], ignore_errors=True)
    _state.update(folder=None, pictures={})
