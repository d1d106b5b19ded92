"""Makes painted-blur.glb, whose vertices have attributes with the blur diameter in mm on the sensor."""

import math

from gltf_document import FLOAT, Document, Surface, as_float32, linear, quaternion, smooth_normals


def painted(document, surface, blurs):
    """Returns vertex attributes. blurs: {attribute name: function of a vertex's position that returns mm}."""
    attributes = document.attributes(surface)
    for name, blur in blurs.items():
        attributes[name] = document.accessor([(as_float32(round(blur(p), 5)),) for p in surface.positions], FLOAT, "SCALAR",
                                             34962)
    return attributes


def globe(radius, stacks, slices):
    """Returns a checkered ball whose colours change from blue at the top to orange at the bottom."""
    surface = Surface()
    dusk, dawn = (38, 70, 110), (236, 148, 92)
    for row in range(stacks + 1):
        polar = math.pi * row / stacks
        for column in range(slices + 1):
            azimuth = 2 * math.pi * column / slices
            surface.positions.append((radius * math.sin(polar) * math.sin(azimuth), radius * math.cos(polar),
                                      radius * math.sin(polar) * math.cos(azimuth)))
            stripe = 0.55 if (row // 4 + column // 4) % 2 else 1.0
            share = row / stacks
            tone = [stripe * (low + share * (high - low)) for low, high in zip(dusk, dawn)]
            surface.colors.append(linear(*(int(value) for value in tone)))
    for row in range(stacks):
        for column in range(slices):
            first, below = row * (slices + 1) + column, (row + 1) * (slices + 1) + column
            surface.indices += [] if row == stacks - 1 else [first + 1, below, below + 1]
            surface.indices += [] if row == 0 else [first, below, first + 1]
    surface.normals = smooth_normals(surface)
    return surface


def painted_blur():
    """Returns painted-blur.glb: a ball in focus whose blur grows towards its top (_COC_OFFSET), and lamps around it.

    All lamps have the same depth, but different blurs. Lamps on the left have _COC. The blur of lamps on the right
    shrinks to 0 while the shutter is open (_COC_0, _COC_1).
    """
    document = Document()
    matt = document.material("Matt", pbrMetallicRoughness={"metallicFactor": 0, "roughnessFactor": 0.55})
    ball = globe(0.38, 64, 96)
    attributes = painted(document, ball, {"_COC_OFFSET": lambda p: 2.0 * max(0.0, p[1] / 0.38) ** 1.5})
    document.node("Ball", mesh=document.mesh_of("Ball", {"attributes": attributes, "indices": document.indices(ball),
                                                         "material": matt}),
                  translation=[0, 0.015, -2.0], rotation=quaternion((0, 1, 0), 20))

    tones = [document.material(name, emissiveFactor=color,
                               pbrMetallicRoughness={"baseColorFactor": [0, 0, 0, 1], "metallicFactor": 0},
                               extensions={"KHR_materials_emissive_strength": {"emissiveStrength": 70}})
             for name, color in (("Amber", [1.0, 0.5, 0.15]), ("Rose", [1.0, 0.28, 0.32]), ("Sky", [0.3, 0.55, 1.0]))]
    count = 22
    for k in range(count):
        angle = 2 * math.pi * (k + 0.5) / count
        lamp = Surface()
        lamp.quad([(-0.5, -0.5, 0), (0.5, -0.5, 0), (0.5, 0.5, 0), (-0.5, 0.5, 0)], normal=(0, 0, 1))
        share = 0.5 - 0.5 * math.cos(angle)   # position of the lamp in its arc: 0 at the top, 1 at the bottom
        size = 0.15 + 1.65 * share
        left = math.sin(angle) < 0
        blurs = ({"_COC": lambda _, size=size: size} if left else
                 {"_COC_0": lambda _, size=size: size, "_COC_1": lambda _: 0.0})
        mesh = document.mesh_of(f"Lamp {k + 1}", {"attributes": painted(document, lamp, blurs),
                                                  "indices": document.indices(lamp), "material": tones[k % 3]})
        document.node(f"Lamp {k + 1}", mesh=mesh, translation=[round(0.57 * math.sin(angle), 5),
                                                               round(0.485 * math.cos(angle) + 0.015, 5), -2.0],
                      scale=[0.007] * 3)
    document.sun([1.0, 0.88, 0.72], 3.2, quaternion((-0.7882, 0.6154, 0), 50))
    document.sun([0.5, 0.65, 1.0], 1.0, quaternion((-0.4472, -0.8944, 0), 60))
    document.camera(2 * math.atan(0.27), 4 / 3, {"fStop": 1.4, "focusDistance": 2.0, "horizontalAperture": 36.0})
    return document.glb()
