#!/usr/bin/env python3
"""Writes the small test scenes of this folder: bokeh.gltf, staircase.gltf, thicket.gltf, fish.glb, chess.glb,
artefact-*.gltf, swimmers.glb, reed.glb, painted-blur.glb and orrery.glb. Needs only Python's standard library.

    make_meshes.py            write them beside this file
    make_meshes.py --check    compare the existing files with the output instead; exit code 1 if a file differs

Output is deterministic: coordinates are rounded to 10 micrometres before they are stored.
"""

import math
import pathlib
import sys

sys.dont_write_bytecode = True  # no __pycache__ beside the scenes
from gltf_document import Document, Surface, add_tube, linear, quaternion, smooth_normals
from orrery import orrery
from painted_blur import painted_blur
from reed import reed
from swimmers import swimmers

HERE = pathlib.Path(__file__).resolve().parent


# ---- bokeh.gltf -----------------------------------------------------------------------------------------------------


def bokeh():
    """Returns bokeh.gltf: small bright squares at seven depths in a dark room. The third row is in focus."""
    document = Document()
    dark = document.material("Room", extensions={"KHR_materials_unlit": {}},
                             pbrMetallicRoughness={"baseColorFactor": [0.004, 0.005, 0.008, 1]})
    room = Surface()
    w, h, near, far = 9.0, 6.0, 2.0, -18.0  # bounds of the room, which is seen from the inside
    room.quad([(-w, -h, far), (w, -h, far), (w, h, far), (-w, h, far)])
    room.quad([(w, -h, near), (-w, -h, near), (-w, h, near), (w, h, near)])
    room.quad([(-w, -h, near), (-w, -h, far), (-w, h, far), (-w, h, near)])
    room.quad([(w, -h, far), (w, -h, near), (w, h, near), (w, h, far)])
    room.quad([(-w, -h, near), (w, -h, near), (w, -h, far), (-w, -h, far)])
    room.quad([(-w, h, far), (w, h, far), (w, h, near), (-w, h, near)])
    document.node("Room", mesh=document.mesh("Room", room, dark))

    colors = {"Amber": [1.0, 0.55, 0.18], "Rose": [1.0, 0.22, 0.30], "Mint": [0.25, 1.0, 0.62],
              "Sky": [0.28, 0.58, 1.0], "White": [1.0, 0.95, 0.88]}
    meshes = []
    for name, color in colors.items():
        material = document.material(name, emissiveFactor=color,
                                     pbrMetallicRoughness={"baseColorFactor": [0, 0, 0, 1], "metallicFactor": 0},
                                     extensions={"KHR_materials_emissive_strength": {"emissiveStrength": 60}})
        square = Surface()
        square.quad([(-0.5, -0.5, 0), (0.5, -0.5, 0), (0.5, 0.5, 0), (-0.5, 0.5, 0)], normal=(0, 0, 1))
        meshes.append(document.mesh(f"{name} square", square, material))

    # One row of squares at each depth. Squares grow with depth; each is about three pixels wide at 1024 x 768.
    for row, depth in enumerate([0.8, 1.2, 2.0, 3.5, 6.0, 10.0, 15.0]):
        half_width, half_height = 0.36 * depth, 0.27 * depth
        for column in range(5 + row % 2):
            x = (2 * (column + 0.5) / (5 + row % 2) - 1) * 0.88 + 0.03 * math.sin(7.0 * row + 3.0 * column)
            y = 0.82 - 1.64 * row / 6 + 0.05 * math.sin(2.0 * row + 5.0 * column)
            size = 3 * 2 * half_width / 1024
            document.node(f"Light {depth} m, {column + 1}", mesh=meshes[(row + 2 * column) % len(meshes)],
                          translation=[round(x * half_width, 5), round(y * half_height, 5), -depth],
                          scale=[round(size, 6)] * 3)
    document.camera(2 * math.atan(0.27), 4 / 3, {"fStop": 1.4, "focusDistance": 2.0, "horizontalAperture": 36.0})
    return document.gltf()


# ---- staircase.gltf -------------------------------------------------------------------------------------------------


def checkered(surface, origin, right, up, cells_right, cells_up, light, dark):
    """Adds a checkered rectangle; each check has its own vertices. right, up: vectors along the full sides."""
    normal = (right[1] * up[2] - right[2] * up[1], right[2] * up[0] - right[0] * up[2],
              right[0] * up[1] - right[1] * up[0])

    def at(u, v):
        return tuple(o + u / cells_right * r + v / cells_up * w for o, r, w in zip(origin, right, up))

    for v in range(cells_up):
        for u in range(cells_right):
            color = light if (u + v) % 2 == 0 else dark
            surface.quad([at(u, v), at(u + 1, v), at(u + 1, v + 1), at(u, v + 1)], normal, color)


def staircase():
    """Returns staircase.gltf: twelve steps that lead upwards from 1 m to 7 m, each with a pillar on both sides."""
    document = Document()
    material = document.material("Stone", pbrMetallicRoughness={"metallicFactor": 0, "roughnessFactor": 0.7})
    palette = [(226, 92, 46), (240, 164, 40), (216, 206, 70), (92, 190, 98), (40, 168, 176), (66, 106, 214)]
    pale = linear(222, 214, 200)
    steps, depth, rise, half = 12, 0.5, 0.11, 1.1
    for step in range(steps):
        color = linear(*palette[step % len(palette)])
        shade = linear(*(value // 2 for value in palette[step % len(palette)]))
        z, y = -1.0 - depth * step, -0.62 + rise * step
        stair = Surface()
        checkered(stair, (-half, y - rise, z), (2 * half, 0, 0), (0, rise, 0), 14, 1, pale, shade)
        checkered(stair, (-half, y, z), (2 * half, 0, 0), (0, 0, -depth), 14, 3, pale, color)
        document.node(f"Step {step + 1}", mesh=document.mesh(f"Step {step + 1}", stair, material))
        pillar = Surface()
        a, tall = 0.07, 0.55
        for right, corner in (((1, 0, 0), (-1, 1)), ((0, 0, -1), (1, 1)), ((-1, 0, 0), (1, -1)), ((0, 0, 1), (-1, -1))):
            origin = (corner[0] * a, 0, corner[1] * a)
            checkered(pillar, origin, tuple(2 * a * value for value in right), (0, tall, 0), 2, 8, color, pale)
        checkered(pillar, (-a, tall, a), (2 * a, 0, 0), (0, 0, -2 * a), 2, 2, color, pale)
        mesh = document.mesh(f"Pillar {step + 1}", pillar, material)
        for side in (-1, 1):
            document.node(f"Pillar {step + 1} {'left' if side < 0 else 'right'}", mesh=mesh,
                          translation=[round(side * (0.34 + 0.05 * step), 5), round(y, 5), round(z - depth / 2, 5)])
    document.sun([1.0, 0.96, 0.88], 2.4, quaternion((-0.8944272, 0.4472136, 0), 40))
    document.camera(2 * math.atan(0.27), 4 / 3, {"fStop": 1.4, "focusDistance": 2.75, "horizontalAperture": 36.0})
    return document.gltf()


# ---- thicket.gltf ---------------------------------------------------------------------------------------------------


def leaf(length, width):
    """Returns a pointed leaf of 24 x 8 quads along +y that bends downwards. Its stalk is at the origin."""
    surface = Surface()
    along, across = 24, 8
    for j in range(along + 1):
        t = j / along
        half = 0.5 * width * math.sin(math.pi * t ** 0.8) * (1 - 0.25 * t)
        for i in range(across + 1):
            s = 2 * i / across - 1
            ridge = 0.12 * width * (1 - abs(s)) - 0.35 * length * t * t
            surface.positions.append((half * s, length * t, ridge))
            vein = 1.35 if i == across // 2 else 1.0
            surface.colors.append(linear(*(min(255, round(vein * v)) for v in (46 + 50 * t, 120 + 40 * t, 38))))
    for j in range(along):
        for i in range(across):
            a, b = j * (across + 1) + i, (j + 1) * (across + 1) + i
            surface.indices += [a, a + 1, b + 1, a, b + 1, b]
    surface.normals = smooth_normals(surface)
    return surface


def thicket():
    """Returns thicket.gltf: a checkered court behind leaves near the lens, most of which lie outside the image."""
    document = Document()
    stone = document.material("Stone", pbrMetallicRoughness={"metallicFactor": 0, "roughnessFactor": 0.7})
    pale, red, blue = linear(222, 214, 200), linear(176, 68, 44), linear(44, 92, 132)
    court = Surface()
    checkered(court, (-2.5, -0.7, -2.0), (5, 0, 0), (0, 0, -5.5), 20, 22, pale, red)
    checkered(court, (-2.5, -0.7, -7.5), (5, 0, 0), (0, 4, 0), 20, 16, pale, blue)
    document.node("Court", mesh=document.mesh("Court", court, stone))
    for k, (x, z) in enumerate([(-0.55, -2.6), (0.1, -3.2), (0.75, -4.0), (-0.9, -4.8), (0.4, -5.6)]):
        pillar, a = Surface(), 0.12
        for right, corner in (((1, 0, 0), (-1, 1)), ((0, 0, -1), (1, 1)), ((-1, 0, 0), (1, -1)), ((0, 0, 1), (-1, -1))):
            checkered(pillar, (corner[0] * a, 0, corner[1] * a), tuple(2 * a * v for v in right), (0, 1.1, 0), 2, 9,
                      blue if k % 2 else red, pale)
        checkered(pillar, (-a, 1.1, a), (2 * a, 0, 0), (0, 0, -2 * a), 2, 2, pale, pale)
        document.node(f"Pillar {k + 1}", mesh=document.mesh(f"Pillar {k + 1}", pillar, stone), translation=[x, -0.7, z])

    # Leaves around the view axis at multiples of the golden angle, with a gap in the middle. Each leaf points inwards.
    green = document.material("Leaf", doubleSided=True,
                              pbrMetallicRoughness={"metallicFactor": 0, "roughnessFactor": 0.5})
    mesh = document.mesh("Leaf", leaf(0.022, 0.008), green)
    count = 300
    for k in range(count):
        turn = 137.507764 * k
        depth = 0.08 + 0.07 * ((k * 0.754877666) % 1)
        # distance of the leaf from the view axis; 1 is the distance of the left and right image edges
        reach = math.sqrt(1.3 + 4.2 * (k + 0.5) / count)
        x, y = (0.36 * depth * reach * f(math.radians(turn)) for f in (math.cos, math.sin))
        document.node(f"Leaf {k + 1}", mesh=mesh, translation=[round(x, 5), round(y, 5), round(-depth, 5)],
                      rotation=quaternion((0, 0, 1), turn + 90 + 40 * math.sin(5.0 * k)))
    document.sun([1.0, 0.96, 0.88], 2.6, quaternion((-0.8944272, 0.4472136, 0), 50))
    document.camera(2 * math.atan(0.27), 4 / 3, {"fStop": 0.95, "focusDistance": 3.2, "horizontalAperture": 36.0})
    return document.gltf()


# ---- artefacts ------------------------------------------------------------------------------------------------------

# One scene for each artefact of image-space methods. The scenes are unlit, so that only the blur matters. The lens has
# a focal length of 50 mm, and the sensor is 36 mm wide with an aspect ratio of 3:2, so the field of view at depth d is
# 0.72 d wide and 0.48 d high.


def unlit(document, name, color, strength=None):
    material = {"extensions": {"KHR_materials_unlit": {}}, "pbrMetallicRoughness": {"baseColorFactor": color + [1]}}
    if strength:
        material = {"emissiveFactor": color, "pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 1], "metallicFactor": 0},
                    "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": strength}}}
    return document.material(name, **material)


def add_board(document, name, material, depth, left, right, bottom, top, columns=1, rows=1, colors=None):
    """Adds an upright board at `depth`. left, right, bottom, top: from the middle, as fractions of the image size.

    colors: two colours of columns x rows checks; default: white.
    """
    surface = Surface()
    wide, high = 0.72 * depth, 0.48 * depth
    origin = (left * wide, bottom * high, -depth)
    checkered(surface, origin, ((right - left) * wide, 0, 0), (0, (top - bottom) * high, 0), columns, rows,
              *(colors or (linear(255, 255, 255), linear(255, 255, 255))))
    document.node(name, mesh=document.mesh(name, surface, material))


def artefact_camera(document, f_stop, focus):
    document.camera(2 * math.atan(0.24), 1.5, {"fStop": f_stop, "focusDistance": focus, "horizontalAperture": 36.0})


def leaking():
    """Returns a scene of a bright, sharp post in front of a dark, strongly blurred wall, and a less blurred panel."""
    document = Document()
    white = unlit(document, "Paper", [1.0, 1.0, 1.0])
    add_board(document, "Wall", white, 12.0, -0.7, 0.7, -0.7, 0.7, 14, 12, (linear(30, 40, 62), linear(40, 56, 84)))
    add_board(document, "Panel", white, 3.0, -0.42, -0.12, -0.4, 0.4, 6, 12, (linear(228, 84, 52), linear(250, 190, 70)))
    add_board(document, "Post", white, 2.0, 0.1, 0.26, -0.6, 0.6, 4, 30, (linear(255, 246, 220), linear(252, 226, 120)))
    artefact_camera(document, 0.7, 2.0)
    return document.gltf()


def lost_background():
    """Returns a scene of thin bars close to the lens in front of a sharp chart.

    Their blurred edges show parts of the chart that a pinhole image lacks.
    """
    document = Document()
    white = unlit(document, "Paper", [1.0, 1.0, 1.0])
    add_board(document, "Chart", white, 3.0, -0.7, 0.7, -0.7, 0.7, 30, 30, (linear(244, 240, 228), linear(36, 60, 120)))
    for x in (-0.25, 0.25):
        add_board(document, f"Bar {x}", white, 0.7, x - 0.05, x + 0.05, -0.8, 0.8, 1, 1,
                  (linear(40, 120, 60), linear(40, 120, 60)))
    artefact_camera(document, 1.0, 3.0)
    return document.gltf()


def half_discs():
    """Returns a scene of lights far behind a sharp edge, which hides some lights, but not all of their blur disks."""
    document = Document()
    dark = unlit(document, "Night", [0.006, 0.008, 0.014])
    grey = unlit(document, "Sill", [0.12, 0.11, 0.1])
    add_board(document, "Night", dark, 14.0, -0.7, 0.7, -0.7, 0.7)
    add_board(document, "Sill", grey, 2.0, -0.7, 0.7, -0.6, -0.06)
    lamps = [unlit(document, name, color, 120) for name, color in
             (("Amber", [1.0, 0.6, 0.25]), ("Sky", [0.4, 0.7, 1.0]), ("White", [1.0, 0.9, 0.8]))]
    for row, y in enumerate((0.3, 0.12, -0.055, -0.075)):
        for column in range(6):
            light = lamps[column % 3]
            x = -0.4 + 0.16 * column + 0.03 * row
            add_board(document, f"Light {row}.{column}", light, 10.0, x - 0.003, x + 0.003, y - 0.0045, y + 0.0045)
    artefact_camera(document, 0.8, 2.0)
    return document.gltf()


def ghosting():
    """Returns a scene of a patterned board close to the lens, in front of a plain board in focus.

    In image-space methods, the sharp pattern shows through the blurred edge.
    """
    document = Document()
    white = unlit(document, "Paper", [1.0, 1.0, 1.0])
    add_board(document, "Back", white, 3.0, -0.7, 0.7, -0.7, 0.7, 8, 6, (linear(206, 214, 220), linear(182, 194, 204)))
    add_board(document, "Near board", white, 0.9, -0.22, 0.22, -0.24, 0.24, 8, 8, (linear(20, 20, 24), linear(250, 120, 30)))
    artefact_camera(document, 1.0, 3.0)
    return document.gltf()


def panes():
    """Returns a scene of alpha-blended panes: one in focus, a blurred one behind, and one close to the lens."""
    document = Document()
    white = unlit(document, "Paper", [1.0, 1.0, 1.0])
    glass = {"alphaMode": "BLEND", "doubleSided": True, "extensions": {"KHR_materials_unlit": {}},
             "pbrMetallicRoughness": {"baseColorFactor": [1.0, 1.0, 1.0, 0.5]}}
    glass = document.material("Glass", **glass)
    add_board(document, "Wall", white, 12.0, -0.7, 0.7, -0.7, 0.7, 28, 20, (linear(244, 236, 214), linear(58, 70, 96)))
    add_board(document, "Far pane", glass, 6.0, -0.05, 0.28, -0.02, 0.44, 1, 1, (linear(230, 70, 60), linear(230, 70, 60)))
    add_board(document, "Chart", white, 2.0, -0.42, -0.08, -0.36, 0.12, 17, 16, (linear(250, 246, 236), linear(36, 60, 120)))
    add_board(document, "Sharp pane", glass, 2.0, 0.1, 0.42, -0.38, 0.3, 6, 9, (linear(120, 220, 150), linear(40, 150, 110)))
    add_board(document, "Near pane", glass, 0.8, -0.3, 0.02, -0.22, 0.4, 1, 1, (linear(255, 170, 40), linear(255, 170, 40)))
    artefact_camera(document, 1.0, 2.0)
    return document.gltf()


def resolution_loss():
    """Returns a scene of a fine chart that slants out of focus.

    The blur is only a few pixels wide, so images rendered at a reduced resolution look pixelated.
    """
    document = Document()
    white = unlit(document, "Paper", [1.0, 1.0, 1.0])
    surface = Surface()
    checkered(surface, (-1.1, -0.62, -1.6), (2.2, 0, 0), (0, 1.2, -1.6), 44, 36, linear(250, 246, 236), linear(60, 24, 40))
    document.node("Chart", mesh=document.mesh("Chart", surface, white))
    artefact_camera(document, 1.0, 2.2)
    return document.gltf()


# ---- fish.glb -------------------------------------------------------------------------------------------------------


def add_fin(surface, outline, thickness, color):
    """Adds a closed fin in the plane z = 0 that is thicker in the middle. outline: counter-clockwise seen from +z."""
    first = len(surface.positions)
    middle = [sum(p[axis] for p in outline) / len(outline) for axis in range(2)]
    surface.positions += [(x, y, 0.0) for x, y in outline]
    surface.positions += [(middle[0], middle[1], thickness), (middle[0], middle[1], -thickness)]
    surface.colors += [color] * (len(outline) + 2)
    front, back = first + len(outline), first + len(outline) + 1
    for i in range(len(outline)):
        j = (i + 1) % len(outline)
        surface.indices += [front, first + i, first + j, back, first + j, first + i]


def fish():
    """Returns fish.glb: a fish of about 800 triangles, 0.3 m long, as one mesh with vertex colours."""
    document = Document()
    material = document.material("Fish", pbrMetallicRoughness={"metallicFactor": 0, "roughnessFactor": 0.4})
    surface = Surface()

    def skin(p):
        if 0.035 < p[0] < 0.06 or -0.04 < p[0] < -0.015:
            return linear(244, 238, 226)
        return linear(240, 96, 14) if p[1] > -0.02 else linear(250, 140, 60)

    profile = [(0, 0, 0), (0.03, 0.22, 0.1), (0.1, 0.42, 0.19), (0.2, 0.6, 0.26), (0.32, 0.7, 0.3), (0.45, 0.72, 0.3),
               (0.58, 0.66, 0.26), (0.7, 0.52, 0.19), (0.81, 0.36, 0.12), (0.9, 0.26, 0.07), (0.97, 0.2, 0.03), (1, 0, 0)]
    rings = []
    for a, height, width in profile:
        x, ring = 0.11 - 0.22 * a, []
        for i in range(24 if height else 1):
            turn = 2 * math.pi * i / 24
            ring.append((x, 0.09 * height * math.cos(turn), 0.09 * width * math.sin(turn)))
        rings.append(ring)
    add_tube(surface, rings, skin)

    orange = linear(255, 140, 36)
    tail = [(-0.09, 0.014), (-0.115, 0.034), (-0.165, 0.072), (-0.152, 0.03), (-0.14, 0.0), (-0.152, -0.03),
            (-0.165, -0.072), (-0.115, -0.034), (-0.09, -0.014)]
    dorsal = [(0.05, 0.05), (0.035, 0.085), (0.005, 0.094), (-0.03, 0.092), (-0.066, 0.088), (-0.085, 0.07), (-0.07, 0.03),
              (-0.02, 0.05), (0.02, 0.055)]
    anal = [(-0.078, -0.025), (-0.09, -0.065), (-0.06, -0.082), (-0.035, -0.078), (-0.012, -0.055), (-0.045, -0.04)]
    for outline in (tail, dorsal, anal[::-1]):
        area = sum(p[0] * q[1] - q[0] * p[1] for p, q in zip(outline, outline[1:] + outline[:1]))
        add_fin(surface, outline if area > 0 else outline[::-1], 0.003, orange)
    for side in (1, -1):
        first = len(surface.positions)
        add_fin(surface, [(0.03, -0.006), (-0.005, 0.012), (-0.028, 0.002), (-0.034, -0.014), (-0.02, -0.03), (0.028, -0.02)],
                0.003, orange)
        for k in range(first, len(surface.positions)):  # moves the fin away from the flank
            x, y, z = surface.positions[k]
            surface.positions[k] = (x, y, z + side * (0.022 + 0.5 * (0.03 - x)))
        center, radius = (0.075, 0.014, side * 0.0185), 0.0085
        eye = [[(center[0], center[1] + radius, center[2])]]
        for i in range(1, 8):
            polar = math.pi * i / 8
            eye.append([(center[0] + radius * math.sin(polar) * math.sin(2 * math.pi * k / 12),
                         center[1] + radius * math.cos(polar),
                         center[2] + radius * math.sin(polar) * math.cos(2 * math.pi * k / 12)) for k in range(12)])
        eye.append([(center[0], center[1] - radius, center[2])])
        add_tube(surface, eye, lambda p: linear(30, 32, 44))
    surface.normals = smooth_normals(surface)
    document.node("Fish", mesh=document.mesh("Fish", surface, material))
    return document.glb()


# ---- chess.glb ------------------------------------------------------------------------------------------------------

# Profiles of turned pieces: (radius, height) in cm, from the foot to the tip. A piece is closed at both ends.
FOOT = [(0, 0), (2.0, 0), (2.1, 0.15), (2.1, 0.5), (1.95, 0.7), (1.6, 0.85), (1.55, 1.1), (1.65, 1.25), (1.6, 1.4),
        (1.2, 1.7), (0.98, 2.2)]
PAWN = FOOT + [(0.8, 3.0), (0.74, 3.6), (0.9, 3.75), (1.2, 3.85), (1.22, 4.0), (1.0, 4.12), (0.78, 4.2), (1.05, 4.5),
               (1.2, 4.9), (1.22, 5.2), (1.12, 5.6), (0.85, 5.95), (0.45, 6.15), (0, 6.22)]
BISHOP = FOOT + [(0.82, 3.4), (0.74, 4.8), (0.95, 5.0), (1.3, 5.12), (1.32, 5.3), (1.0, 5.45), (0.9, 5.6), (0.8, 5.75),
                 (1.05, 6.2), (1.18, 6.8), (1.08, 7.4), (0.75, 8.0), (0.35, 8.4), (0.28, 8.5), (0.36, 8.65), (0.32, 8.85),
                 (0.16, 9.0), (0, 9.03)]
QUEEN = FOOT + [(0.9, 3.6), (0.78, 5.8), (1.0, 6.0), (1.45, 6.12), (1.47, 6.32), (1.1, 6.5), (0.95, 6.7), (1.0, 7.2),
                (1.2, 8.0), (1.5, 8.7), (1.52, 8.8), (1.3, 8.85), (0.9, 8.95), (0.5, 9.2), (0.42, 9.35), (0.5, 9.6),
                (0.42, 9.85), (0.2, 10.0), (0, 10.03)]


def turned(profile, size, around=40):
    """Returns a surface of revolution about the y axis. Its profile is a Catmull-Rom spline (1974)."""
    curve = []
    for i in range(len(profile) - 1):
        p = [profile[max(0, min(len(profile) - 1, i + k))] for k in (-1, 0, 1, 2)]
        for step in range(2):
            t = step / 2
            curve.append([max(0.0, 0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t * t
                                          + (3 * b - a - 3 * c + d) * t ** 3)) for a, b, c, d in zip(*p)])
    curve.append(list(profile[-1]))
    rings = []
    for radius, height in curve:
        points = around if radius > 0 else 1
        rings.append([(size * radius * math.cos(2 * math.pi * k / around), size * height,
                       size * radius * math.sin(2 * math.pi * k / around)) for k in range(points)])
    surface = Surface()
    add_tube(surface, [rings[0]] + rings[1:-1] + [rings[-1]], lambda p: (255, 255, 255, 255))
    surface.colors = []
    surface.normals = smooth_normals(surface)
    return surface


def chess(cells=1):
    """Returns chess.glb: pieces on a board from 0.2 m to 1.4 m in evening light, with small lamps far behind.

    The animation moves a queen close to the camera, and the bishop behind it. cells: number of grid cells, of two
    triangles each, along each side of the board.
    """
    document = Document()
    cm = 0.01
    ivory = document.material("Ivory", pbrMetallicRoughness={"baseColorFactor": [0.78, 0.66, 0.47, 1], "metallicFactor": 0,
                                                             "roughnessFactor": 0.32})
    rosewood = document.material("Rosewood", pbrMetallicRoughness={"baseColorFactor": [0.2, 0.028, 0.02, 1],
                                                                   "metallicFactor": 0, "roughnessFactor": 0.25})
    board = document.material("Board", pbrMetallicRoughness={
        "baseColorTexture": {"index": document.checks((206, 184, 148), (70, 42, 30))}, "metallicFactor": 0,
        "roughnessFactor": 0.55})
    shade = document.material("Shade", alphaMode="BLEND", extensions={"KHR_materials_unlit": {}})

    plane = Surface()
    side, back = 6 * cm * 10, -6 * cm * 24
    tiles = (back - 0.24) / (-12 * cm)
    for y in range(cells + 1):
        for x in range(cells + 1):
            plane.positions.append((side * (2 * x / cells - 1), 0, 0.24 + (back - 0.24) * y / cells))
            plane.normals.append((0, 1, 0))
            plane.coordinates.append((10 * x / cells, tiles * (1 - y / cells)))
            if x < cells and y < cells:
                a, b = y * (cells + 1) + x, (y + 1) * (cells + 1) + x
                plane.indices += [a, a + 1, b + 1, a, b + 1, b]
    document.node("Board", mesh=document.mesh("Board", plane, board))

    # A soft shadow under each piece: dark in the middle, clear at its rim.
    blot = Surface()
    ring = [(math.cos(math.pi * k / 16), 0, math.sin(math.pi * k / 16)) for k in range(32)]
    blot.positions = [(0, 0, 0)] + [(0.6 * x, 0, 0.6 * z) for x, _, z in ring] + ring
    blot.normals = [(0, 1, 0)] * 65
    blot.colors = [(8, 4, 3, 240)] + [(8, 4, 3, 190)] * 32 + [(8, 4, 3, 0)] * 32
    for k, n in ((k, (k + 1) % 32) for k in range(32)):
        blot.indices += [0, 1 + n, 1 + k, 1 + k, 1 + n, 33 + n, 1 + k, 33 + n, 33 + k]
    shadow = document.mesh("Shade", blot, shade)

    meshes = {(name, tone): document.mesh(f"{tone} {name}", turned(profile, cm), material)
              for name, profile in (("Pawn", PAWN), ("Bishop", BISHOP), ("Queen", QUEEN))
              for tone, material in (("Ivory", ivory), ("Rosewood", rosewood))}

    def piece(label, name, tone, column, row):
        x, z = round((column + 0.5) * 6 * cm, 5), round(0.24 - (row + 0.5) * 6 * cm, 5)
        document.node(label, mesh=meshes[name, tone], translation=[x, 0, z])
        document.node(f"{label}'s shade", mesh=shadow, translation=[round(x - 0.006, 5), 0.0006, round(z - 0.004, 5)],
                      scale=[0.037, 1, 0.032])
        return len(document.json["nodes"]) - 2

    near = piece("Near queen", "Queen", "Rosewood", -1.55, 0.2)
    moving = piece("Bishop", "Bishop", "Rosewood", 1.2, 6)
    piece("Queen", "Queen", "Ivory", -0.5, 5)
    for index, (name, tone, column, row) in enumerate((
            ("Pawn", "Ivory", 0.6, 3.2), ("Pawn", "Ivory", -2.2, 6), ("Pawn", "Ivory", 2.6, 8),
            ("Bishop", "Ivory", -3.2, 9), ("Pawn", "Rosewood", -1.2, 10), ("Queen", "Rosewood", 1.2, 12),
            ("Pawn", "Rosewood", 3.4, 12), ("Pawn", "Rosewood", -4.0, 13), ("Bishop", "Rosewood", -1.4, 15),
            ("Pawn", "Ivory", 4.6, 17), ("Pawn", "Rosewood", 0.8, 18), ("Pawn", "Ivory", -5.0, 19))):
        piece(f"{name} {index + 1}", name, tone, column, row)

    lamps = [document.material(name, emissiveFactor=color,
                               pbrMetallicRoughness={"baseColorFactor": [0, 0, 0, 1], "metallicFactor": 0},
                               extensions={"KHR_materials_emissive_strength": {"emissiveStrength": 90}})
             for name, color in (("Amber", [1.0, 0.52, 0.16]), ("Rose", [1.0, 0.26, 0.3]), ("Sky", [0.3, 0.55, 1.0]),
                                 ("White", [1.0, 0.86, 0.66]))]
    glows = []
    for material in lamps:
        square = Surface()
        square.quad([(-0.5, -0.5, 0), (0.5, -0.5, 0), (0.5, 0.5, 0), (-0.5, 0.5, 0)], normal=(0, 0, 1))
        glows.append(document.mesh("Lamp", square, material))
    for k in range(22):
        depth = 2.6 + 1.6 * math.sin(5.1 * k) ** 2
        document.node(f"Lamp {k + 1}", mesh=glows[(3 * k + k // 4) % 4],
                      translation=[round((-1.05 + 0.1 * k + 0.06 * math.sin(9.0 * k)) * depth / 2.4, 5),
                                   round(0.16 * depth / 2.4 + 0.28 * math.sin(2.3 * k + 0.5) ** 2, 5), round(-depth, 5)],
                      scale=[round(0.004 * depth, 5)] * 3)

    document.slide("Move", {near: (0.5, 0, -0.2), moving: (-0.45, 0, 0)})
    document.sun([1.0, 0.86, 0.68], 3.4, quaternion((-0.7882, 0.6154, 0), 52))
    document.sun([0.55, 0.68, 1.0], 0.9, quaternion((-0.4472, -0.8944, 0), 48))
    document.camera(2 * math.atan(0.27), 4 / 3, {"fStop": 1.4, "focusDistance": 0.58, "horizontalAperture": 36.0},
                    translation=[0.0, 0.14, 0.46], rotation=quaternion((-1, 0, 0), 7))
    return document.glb()


def main():
    check = sys.argv[1:] == ["--check"]
    if sys.argv[1:] and not check:
        sys.exit(__doc__)
    differing = []
    for name, make in (("bokeh.gltf", bokeh), ("staircase.gltf", staircase), ("thicket.gltf", thicket),
                       ("fish.glb", fish), ("chess.glb", chess),
                       ("artefact-leaking.gltf", leaking), ("artefact-lost-background.gltf", lost_background),
                       ("artefact-half-discs.gltf", half_discs), ("artefact-ghosting.gltf", ghosting),
                       ("artefact-resolution-loss.gltf", resolution_loss), ("artefact-panes.gltf", panes),
                       ("swimmers.glb", swimmers), ("reed.glb", reed), ("painted-blur.glb", painted_blur),
                       ("orrery.glb", orrery)):
        path, data = HERE / name, make()
        if not check:
            path.write_bytes(data)
        elif not path.exists() or path.read_bytes() != data:
            differing.append(name)
    if differing:
        sys.exit(f"differs from what make_meshes.py writes: {', '.join(differing)}")


if __name__ == "__main__":
    main()
