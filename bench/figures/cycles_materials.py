"""Materials of `scripts/figures cycles`, for Blender's Python: one node graph for the glTF exporter and one for Cycles.

The exporter reads the Principled BSDF. Its equations differ from glTF's, so Cycles renders a graph of a Diffuse and a
Glossy BSDF (GGX). Math nodes give them Schlick's Fresnel and the ratio of height-correlated to separable Smith masking.
On normal maps, math nodes also evaluate GGX. These factors depend on the direction to the light, so Cycles renders the
lights one by one.
"""

import functools

import bpy
import numpy


def image_of(name, values, colours):
    """Returns (8-bit image for the exporter, image for Cycles) of an array whose row 0 is the bottom row.

    Cycles interpolates 8-bit colours before it decodes them, so it gets linear floats. colours: sRGB, not data.
    """
    size = values.shape[1], values.shape[0]
    values = numpy.round(values * 255) / 255
    byte = bpy.data.images.new(name, *size)
    if not colours:
        byte.colorspace_settings.name = "Non-Color"
    linear = numpy.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4) if colours else values
    real = bpy.data.images.new(f"{name} linear", *size, float_buffer=True)
    real.colorspace_settings.name = "Linear" if colours else "Non-Color"
    for image, pixels in ((byte, values), (real, linear)):
        image.pixels.foreach_set(numpy.dstack([pixels, numpy.ones(pixels.shape[:2])]).astype(numpy.float32).ravel())
        image.pack()
    return byte, real


MADE = {}  # {name of a material: (colour or image, normal map or None, metallic, roughness)}


class Graph:
    """Builds a node graph in Blender, from its inputs to its output."""

    def __init__(self, surface):
        self.tree = surface.node_tree
        self.tree.nodes.clear()

    def add(self, kind, inputs=(), **settings):
        node = self.tree.nodes.new(kind)
        for name, value in settings.items():
            setattr(node, name, value)
        for name, value in dict(inputs).items():
            if isinstance(value, bpy.types.NodeSocket):
                self.tree.links.new(value, node.inputs[name])
            elif value is not None:
                node.inputs[name].default_value = value
        return node

    def math(self, operation, *values):
        return self.add("ShaderNodeMath", enumerate(values), operation=operation).outputs[0]

    def vector(self, operation, *values):
        node = self.add("ShaderNodeVectorMath", enumerate(values), operation=operation)
        return node.outputs["Value" if operation == "DOT_PRODUCT" else "Vector"]

    def scaled(self, vector, factor):
        return self.vector("MULTIPLY", vector, self.add("ShaderNodeCombineXYZ", enumerate([factor] * 3)).outputs[0])

    def texture(self, image):
        return self.add("ShaderNodeTexImage", image=image).outputs["Color"]

    def normal(self, image):
        return self.add("ShaderNodeNormalMap", {"Color": self.texture(image)}).outputs["Normal"]

    def finish(self, shader):
        self.add("ShaderNodeOutputMaterial", {"Surface": shader.outputs[0]})


def material(name, base, normal=None, metallic=0, roughness=0.5):
    """Returns a new material with the exporter's graph. base: colour, or array of sRGB colours. normal: array."""
    surface = bpy.data.materials.new(name)
    surface.use_nodes = True
    textured = isinstance(base, numpy.ndarray)
    byte, linear = image_of(name, base, True) if textured else ((*base, 1), base)
    bent = image_of(f"{name} normal", normal, False)[0] if normal is not None else None
    MADE[name] = (linear, bent, metallic, roughness)
    graph = Graph(surface)
    graph.finish(graph.add("ShaderNodeBsdfPrincipled", {
        "Base Color": graph.texture(byte) if textured else byte, "Metallic": metallic, "Roughness": roughness, "IOR": 1.5,
        "Normal": graph.normal(bent) if bent else None}))
    return surface


def prepare_for_cycles(name, light):
    """Replaces the node graph of a material by one that evaluates glTF's equations for one light."""
    base, bent, metallic, roughness = MADE[name]
    graph = Graph(bpy.data.materials[name])
    math, vector = graph.math, graph.vector
    geometry = graph.add("ShaderNodeNewGeometry").outputs
    smooth, to_eye = geometry["Normal"], geometry["Incoming"]
    if light.data.type == "SUN":
        to_light = graph.add("ShaderNodeCombineXYZ", enumerate(light.matrix_world.col[2][:3])).outputs[0]
    else:
        to_light = vector("NORMALIZE", vector("SUBTRACT", light.location, geometry["Position"]))
    # Compute the normal as x T + y (N × T) + z N, with the vector (x, y, z) of the normal map, the tangent T and the
    # vertex normal N. The Normal Map node would change normals whose mirrored direction is below the surface.
    normal = smooth
    if bent:
        axes = graph.add("ShaderNodeSeparateXYZ", {0: vector("MULTIPLY_ADD", graph.texture(bent), (2, 2, 2), (-1, -1, -1))}).outputs
        tangent = graph.add("ShaderNodeTangent", direction_type="UV_MAP", uv_map="UVMap").outputs[0]
        across = graph.scaled(vector("CROSS_PRODUCT", smooth, tangent), axes[1])
        normal = vector("NORMALIZE", vector("ADD", graph.scaled(tangent, axes[0]), vector("ADD", across, graph.scaled(smooth, axes[2]))))
    half = vector("NORMALIZE", vector("ADD", to_light, to_eye))
    colour = graph.texture(base) if isinstance(base, bpy.types.Image) else base

    # Fresnel F = F0 + (1 − F0) g. The diffuse part is scaled by 1 − F.
    g = math("POWER", math("SUBTRACT", 1.0, vector("DOT_PRODUCT", half, to_eye)), 5.0)
    if metallic:
        fresnel = vector("ADD", graph.scaled(colour, math("SUBTRACT", 1.0, g)), graph.scaled((1, 1, 1), g))
    else:
        fresnel = graph.scaled((1, 1, 1), math("ADD", 0.04, math("MULTIPLY", 0.96, g)))

    # Height-correlated Smith masking is 2 / (a + b), where a and b are √(1 + α² tan²θ) for the directions to the light
    # and to the eye.
    def product(*factors):
        return functools.reduce(lambda left, right: math("MULTIPLY", left, right), factors)

    def cosine(first, second):
        return math("MAXIMUM", vector("DOT_PRODUCT", first, second), 1e-4)

    def slope(cosine):
        return math("SQRT", math("ADD", 1 - alpha2, math("DIVIDE", alpha2, product(cosine, cosine))))

    alpha2 = roughness ** 4
    nl, nv, nh = (cosine(normal, direction) for direction in (to_light, to_eye, half))
    a, b = slope(nl), slope(nv)
    both = math("ADD", a, b)
    matt = graph.scaled(colour, product(0.96, math("SUBTRACT", 1.0, g))) if not metallic else (0, 0, 0)
    if bent:
        # Put the complete BRDF into the colour of a diffuse closure with the interpolated vertex normal. In a closure
        # with the mapped normal, Cycles would adjust this normal, which darkens the surface.
        base = math("ADD", 1.0, product(alpha2 - 1, nh, nh))
        lobe = math("DIVIDE", alpha2 / 2, product(base, base, nl, nv, both))
        light = vector("ADD", matt, graph.scaled(fresnel, lobe))
        light = graph.scaled(light, math("DIVIDE", nl, cosine(smooth, to_light)))
        return graph.finish(graph.add("ShaderNodeBsdfDiffuse", {"Color": light, "Normal": smooth}))
    ratio = math("DIVIDE", product(0.5, math("ADD", a, 1.0), math("ADD", b, 1.0)), both)
    glossy = graph.add("ShaderNodeBsdfGlossy", {"Color": graph.scaled(fresnel, ratio), "Roughness": roughness}, distribution="GGX")
    diffuse = graph.add("ShaderNodeBsdfDiffuse", {"Color": matt if not metallic else (0, 0, 0, 1)})
    graph.finish(graph.add("ShaderNodeAddShader", {0: diffuse.outputs[0], 1: glossy.outputs[0]}))
