"""Reports the parts of materials that glTF cannot represent, and copies animated materials."""

import os

import bpy

# Types of nodes that Blender's glTF exporter supports between an image and an input of a Principled BSDF.
EXPORTED_NODES = {"TEX_IMAGE", "MAPPING", "UVMAP", "TEX_COORD", "NORMAL_MAP", "SEPRGB", "SEPARATE_COLOR", "MIX_RGB", "MIX", "RGB", "VALUE",
                  "VERTEX_COLOR", "ATTRIBUTE", "MATH", "REROUTE", "INVERT", "GROUP", "GROUP_INPUT", "RGBTOBW"}
SHADERS = {"BSDF_PRINCIPLED", "EMISSION", "BACKGROUND"}
INPUTS = ("Base Color", "Metallic", "Roughness", "Normal", "Alpha", "Emission", "Emission Color")


def upstream(socket, seen):
    """Adds to the set `seen` all nodes that an input depends on, and returns the set."""
    for link in socket.links:
        if link.from_node not in seen:
            seen.add(link.from_node)
            for inner in link.from_node.inputs:
                upstream(inner, seen)
    return seen


def image_is_missing(image):
    """Returns whether an image has neither pixels nor a file."""
    if image.source == "GENERATED" or image.packed_file or image.has_data:
        return False
    return not os.path.isfile(bpy.path.abspath(image.filepath, library=image.library))


def missing_images(material):
    nodes = material.node_tree.nodes if material.use_nodes and material.node_tree else []
    return [node.image for node in nodes if node.type == "TEX_IMAGE" and node.image and image_is_missing(node.image)]


def material_notes(material):
    """Returns a message for each part of a material that is not exported."""
    if not material.use_nodes or material.node_tree is None:
        return []
    output = material.node_tree.get_output_node("ALL")
    if output is None:
        return [f"the material '{material.name}' has no output"]
    notes = []
    if output.inputs["Volume"].is_linked:
        notes.append(f"the volume of the material '{material.name}' is not exported")
    if output.inputs["Displacement"].is_linked:
        notes.append(f"the displacement of the material '{material.name}' is not exported")
    shader = next((node for node in upstream(output.inputs["Surface"], set()) if node.type in SHADERS), None)
    if shader is None:
        notes.append(f"the material '{material.name}' has no Principled BSDF; glTF has no other material")
    elif shader.type == "BSDF_PRINCIPLED":
        for name in INPUTS:
            if name in shader.inputs:
                for node in sorted(upstream(shader.inputs[name], set()), key=lambda node: node.name):
                    if node.type not in EXPORTED_NODES:
                        notes.append(f"{name} of the material '{material.name}' depends on '{node.name}', which glTF cannot hold")
    notes += [f"all frames use the same frame of the image '{node.image.name}' of the material '{material.name}'"
              for node in material.node_tree.nodes
              if node.type == "TEX_IMAGE" and node.image and node.image.source in {"SEQUENCE", "MOVIE"}]
    notes += [f"the image '{image.name}' of the material '{material.name}' is missing: {image.filepath}" for image in missing_images(material)]
    return notes


def changes_with_time(material):
    """Returns whether a material has keyframes or drivers."""
    return bool(material.animation_data or (material.node_tree and material.node_tree.animation_data))


def posed_material(material, evaluated):
    """Returns a copy of a material with the values of its evaluated nodes.

    Blender's exporter reads original materials, whose animated values may belong to another frame.
    """
    posed = material.copy()
    for data in (posed, posed.node_tree):
        if data is not None:
            data.animation_data_clear()
    if posed.node_tree is not None:
        for node, source in zip(posed.node_tree.nodes, evaluated.node_tree.nodes):
            for sockets, values in ((node.inputs, source.inputs), (node.outputs, source.outputs)):
                for socket, value in zip(sockets, values):
                    if hasattr(value, "default_value"):
                        socket.default_value = value.default_value
    return posed
