"""Passes: what Blender wants, the program's layers for them, and the pixels of each."""

import dataclasses

import numpy

from . import exr

FAR = 1e10  # Blender's depth of the background, m
CRYPTOMATTE_PASSES = 3  # passes of two ranks each; the program's files have six ranks


@dataclasses.dataclass
class Pass:
    name: str  # name in Blender and in the program's files with --exr-names blender
    channels: str
    kind: str  # Blender's type of the pass's values
    wanted: str = ""  # property of the view layer; empty: always
    layer: str = ""  # layer name in --exr-layers; empty: none


def cryptomatte(name, wanted, layer):
    return [Pass(f"{name}{rank:02}", "RGBA", "COLOR", wanted, layer) for rank in range(CRYPTOMATTE_PASSES)]


ALL = [
    Pass("Combined", "RGBA", "COLOR"),
    Pass("Depth", "Z", "VALUE", "use_pass_z"),
    Pass("Position", "XYZ", "VECTOR", "use_pass_position", "position"),
    Pass("Normal", "XYZ", "VECTOR", "use_pass_normal", "normal"),
    Pass("DiffCol", "RGB", "COLOR", "use_pass_diffuse_color", "albedo"),
    Pass("Emit", "RGB", "COLOR", "use_pass_emit", "emission"),
    *cryptomatte("CryptoObject", "use_pass_cryptomatte_object", "objects"),
    *cryptomatte("CryptoMaterial", "use_pass_cryptomatte_material", "materials"),
]
PROPERTIES = list(dict.fromkeys(one.wanted for one in ALL if one.wanted))


def passes_of(view_layer):
    """Returns the passes that a view layer wants; without a view layer (None), those that are always there."""
    return [one for one in ALL if not one.wanted or (view_layer is not None and getattr(view_layer, one.wanted))]


def words_for(passes):
    """Returns the options of the program for the passes."""
    layers = list(dict.fromkeys(one.layer for one in passes if one.layer))
    words = ["--exr-layers", ",".join(layers), "--exr-names", "blender"] if layers else []
    # Blender's depth pass has the depths of a pinhole image, so that Blender's nodes can blur by it.
    return words + (["--aov", "depth"] if any(one.name == "Depth" for one in passes) else [])


def in_blender(name, pixels):
    """Returns the values of a pass in Blender's axes, with z up; the program's are glTF's, with y up."""
    if name in ("Position", "Normal"):
        return numpy.stack([pixels[..., 0], -pixels[..., 2], pixels[..., 1]], -1)
    if name == "Depth":
        return numpy.where(numpy.isfinite(pixels), numpy.minimum(pixels, FAR), FAR)
    return pixels


def read_passes(passes, file, depth_file, view):
    """Returns the values of each pass (name → array) in the part of the canvas that Blender shows, and the texts of
    Cryptomatte for the picture's metadata."""
    channels, texts = exr.read(file)
    if any(one.name == "Depth" for one in passes):
        depth = exr.read(depth_file)[0]
        channels["ViewLayer.Depth.Z"] = next(iter(depth.values()))
    prefix = "ViewLayer.Combined." if "ViewLayer.Combined.R" in channels else ""
    result = {}
    for one in passes:
        place = prefix if one.name == "Combined" else f"ViewLayer.{one.name}."
        pixels = numpy.stack([channels[place + letter] for letter in one.channels], -1)
        pixels = pixels[view.y:view.y + view.picture_height, view.x:view.x + view.picture_width]
        result[one.name] = in_blender(one.name, pixels).astype(numpy.float32).ravel()
    return result, texts
