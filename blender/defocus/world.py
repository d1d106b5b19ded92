"""Converts the world of a scene to an environment map for `defocus`."""

import math
import os

import bpy
import numpy

PLAIN_SIZE = (16, 8)  # size in px of the environment map for a world of one colour


def linked_node(socket):
    """Returns the node that is linked to a socket, skipping reroute nodes; None if there is none."""
    while socket is not None and socket.is_linked:
        node = socket.links[0].from_node
        if node.type != "REROUTE":
            return node
        socket = node.inputs[0]
    return None


def background_node(world):
    """Returns the Background node of a world; None if its surface is not a Background node."""
    output = world.node_tree.get_output_node("ALL")
    node = linked_node(output.inputs["Surface"]) if output else None
    return node if node and node.type == "BACKGROUND" else None


def rotation_of(texture, notes):
    """Returns the rotation of a texture's coordinates about the vertical axis in radians."""
    mapping = linked_node(texture.inputs["Vector"])
    if mapping is None or mapping.type == "TEX_COORD":
        return 0
    if mapping.type != "MAPPING":
        notes.append(f"the coordinates of the world's texture come from '{mapping.name}', which is ignored")
        return 0
    rotation = mapping.inputs["Rotation"].default_value
    if abs(rotation[0]) > 1e-6 or abs(rotation[1]) > 1e-6:
        notes.append("the world's texture is tilted; only its rotation about the vertical axis is exported")
    return rotation[2]


def linear_pixels(image):
    """Returns the linear colours of an image as height × width × 4; row 0 is the bottom row. None if it has no pixels."""
    width, height = image.size
    if not width or not height:
        return None
    pixels = numpy.empty(width * height * image.channels, numpy.float32)
    image.pixels.foreach_get(pixels)
    pixels = pixels.reshape(height, width, image.channels)[..., :3]
    if not image.is_float and image.colorspace_settings.name == "sRGB":
        pixels = numpy.where(pixels <= 0.04045, pixels / 12.92, ((pixels + 0.055) / 1.055) ** 2.4)
    return numpy.dstack([pixels, numpy.ones((height, width), numpy.float32)]).astype(numpy.float32)


def write_exr(pixels, file):
    image = bpy.data.images.new("defocus world", pixels.shape[1], pixels.shape[0], float_buffer=True)
    try:
        image.colorspace_settings.name = "Non-Color"  # saves the values without colour conversion
        image.pixels.foreach_set(pixels.ravel())
        image.filepath_raw, image.file_format = file, "OPEN_EXR"
        image.save()
    finally:
        bpy.data.images.remove(image)


def environment_of(world, notes):
    """Returns the pixels and the rotation (radians) of an environment map. Adds a note for each omitted feature."""
    color, strength = (0, 0, 0), 1
    if world is not None and not world.use_nodes:
        color = world.color
    elif world is not None:
        node = background_node(world)
        if node is None:
            notes.append(f"the surface of the world '{world.name}' is not a Background node; the world is black")
        else:
            color, strength = node.inputs["Color"].default_value[:3], node.inputs["Strength"].default_value
            texture = linked_node(node.inputs["Color"])
            if texture is not None and texture.type == "TEX_ENVIRONMENT" and texture.projection == "EQUIRECTANGULAR":
                pixels = linear_pixels(texture.image) if texture.image else None
                if pixels is not None:
                    pixels[..., :3] *= strength
                    return pixels, rotation_of(texture, notes)
                notes.append(f"the world's image '{texture.image.name if texture.image else texture.name}' cannot be read; the world has one colour")
            elif texture is not None:
                notes.append(f"the world's colour comes from '{texture.name}', which cannot be exported; the world has one colour")
            if linked_node(node.inputs["Strength"]) is not None:
                notes.append("the world's strength comes from a node; its own value is used")
    pixels = numpy.ones((PLAIN_SIZE[1], PLAIN_SIZE[0], 4), numpy.float32)
    pixels[..., :3] = [strength * channel for channel in color]
    return pixels, 0


def world_words(world, transparent, folder, notes):
    """Writes the environment map into `folder` and returns the command-line options of `defocus`.

    A black world also needs a map: without a map, `defocus` adds default lighting to scenes that have no lights.
    """
    pixels, rotation = environment_of(world, notes)
    file = os.path.join(folder, "world.exr")
    write_exr(pixels, file)
    # The centre of the map lies along +x in Blender, but along -z in glTF, which is Blender's +y.
    degrees = math.remainder(-90 - math.degrees(rotation), 360)
    words = ["--environment", file, "--environment-rotation", f"{degrees:.7g}"]
    return words + ["--background", "none"] if transparent else words
