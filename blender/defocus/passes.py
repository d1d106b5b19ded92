"""Lists Blender's render passes: which passes a view layer needs, the EXR layers for them, and their pixels."""

import dataclasses

import numpy

from . import exr

FAR = 1e10  # depth of the background in Blender, m
CRYPTOMATTE_PASSES = 3  # the EXR files store six ranks of ids per pixel, two in each pass


@dataclasses.dataclass
class Pass:
    name: str  # name of the pass in Blender, and in EXR files written with --exr-names blender
    channels: str
    kind: str  # Blender's type of the pass's values
    wanted: str = ""  # property of the view layer that enables the pass; empty if the pass is always enabled
    layer: str = ""  # layer name for --exr-layers; empty if the pass needs no layer


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
    """Returns the passes that a view layer enables, or for None, the passes that are always enabled."""
    return [one for one in ALL if not one.wanted or (view_layer is not None and getattr(view_layer, one.wanted))]


def words_for(passes):
    """Returns the command-line options of `defocus` for the passes."""
    layers = list(dict.fromkeys(one.layer for one in passes if one.layer))
    words = ["--exr-layers", ",".join(layers), "--exr-names", "blender"] if layers else []
    # Blender's depth pass has the depths of a pinhole image, from which compositor nodes can compute blur.
    return words + (["--aov", "depth"] if any(one.name == "Depth" for one in passes) else [])


def in_blender(name, pixels):
    """Converts the values of a pass from glTF's axes (y up) to Blender's axes (z up)."""
    if name in ("Position", "Normal"):
        return numpy.stack([pixels[..., 0], -pixels[..., 2], pixels[..., 1]], -1)
    if name == "Depth":
        return numpy.where(numpy.isfinite(pixels), numpy.minimum(pixels, FAR), FAR)
    return pixels


def read_passes(passes, file, depth_file, view):
    """Returns the values of each pass (name → flat array), cropped to the part that Blender shows, and the texts that
    Cryptomatte needs in the image's metadata."""
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
