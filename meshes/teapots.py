"""Writes a scene for figures of line sampling: a near, a sharp and a far teapot on a checkered floor before lamps.

    meshes/teapots.py FILE [--steps N]

The teapots have the control points of Martin Newell's teapot (1975): two Bézier patches each for handle and spout. Body
and lid are exact surfaces of revolution of his profile curves, not patches. N: segments of each Bézier curve (default
6, which gives 2,300 triangles per teapot). Needs only Python's standard library.
"""

import argparse
import math
import pathlib

from gltf_document import Document, Surface, linear, quaternion, smooth_normals
from make_meshes import checkered

# Control points (radius, height) of lid, gap and body, from the knob to the middle of the bottom. Four points are a
# Bézier curve, and two are a line. The curves of one list join smoothly.
PROFILES = [
    [[(0, 3.15), (0.8, 3.15), (0, 2.85), (0.2, 2.7)], [(0.2, 2.7), (0.4, 2.55), (1.3, 2.55), (1.3, 2.4)]],
    [[(1.3, 2.4), (1.4, 2.4)]],
    [[(1.4, 2.4), (1.3375, 2.53125), (1.4375, 2.53125), (1.5, 2.4)], [(1.5, 2.4), (1.75, 1.875), (2, 1.35), (2, 0.9)],
     [(2, 0.9), (2, 0.45), (1.5, 0.225), (1.5, 0.15)], [(1.5, 0.15), (1.5, 0.075), (1.425, 0), (0, 0)]]]
# Control points of a bent tube. Each row has two opposite points (x, z) of its outline in the plane of symmetry, and
# half its width. Rows 0 to 3 and rows 3 to 6 are Bézier patches.
HANDLE = [((-1.6, 2.025), (-1.5, 2.25), 0.3), ((-2.3, 2.025), (-2.5, 2.25), 0.3), ((-2.7, 2.025), (-3, 2.25), 0.3),
          ((-2.7, 1.8), (-3, 1.8), 0.3), ((-2.7, 1.575), (-3, 1.35), 0.3), ((-2.5, 1.125), (-2.65, 0.9375), 0.3),
          ((-2, 0.9), (-1.9, 0.6), 0.3)]
SPOUT = [((1.7, 1.425), (1.7, 0.6), 0.66), ((2.6, 1.425), (3.1, 0.825), 0.66), ((2.3, 2.1), (2.4, 2.025), 0.25),
         ((2.7, 2.4), (3.3, 2.4), 0.25), ((2.8, 2.475), (3.525, 2.49375), 0.25), ((2.9, 2.475), (3.45, 2.5125), 0.15),
         ((2.8, 2.4), (3.2, 2.4), 0.15)]
SCALE = 0.05  # metres per unit of the control points


def bezier(points, t):
    """Returns a point of the Bézier curve with these control points, by de Casteljau's algorithm."""
    while len(points) > 1:
        points = [tuple((1 - t) * a + t * b for a, b in zip(p, q)) for p, q in zip(points, points[1:])]
    return points[0]


def add_grid(surface, rings):
    """Adds the triangles between closed rings with equal numbers of points. Degenerate triangles are omitted."""
    first, around = len(surface.positions), len(rings[0])
    for ring in rings:
        surface.positions += [(SCALE * x, SCALE * z, -SCALE * y) for x, y, z in ring]  # y is up in glTF
    for row in range(len(rings) - 1):
        for i in range(around):
            a, b = first + row * around + i, first + row * around + (i + 1) % around
            for corners in ((a, a + around, b), (b, a + around, b + around)):
                if len({surface.positions[corner] for corner in corners}) == 3:
                    surface.indices += corners


def along(curves, steps):
    """Returns points along consecutive Bézier curves. steps: number of segments per curve."""
    return [bezier(curve, step / steps) for number, curve in enumerate(curves) for step in range(number > 0, steps + 1)]


def add_turned(surface, curves, steps):
    """Adds the surface of revolution of a profile about the z axis."""
    angles = [2 * math.pi * i / (4 * steps) for i in range(4 * steps)]
    add_grid(surface, [[(radius * math.cos(angle), radius * math.sin(angle), height) for angle in angles]
                       for radius, height in along(curves, steps if len(curves[0]) == 4 else 1)])


def add_bent_tube(surface, rows, steps):
    """Adds a tube of two Bézier patches and their mirror images."""
    def controls(column):
        points = [(*row[column // 2], row[2] if column in (1, 2) else 0.0) for row in rows]
        return along([points[:4], points[3:]], steps)

    rings = []
    for across in zip(*map(controls, range(4))):
        half = along([[(x, y, z) for x, z, y in across]], steps)
        rings.append(half + [(x, -y, z) for x, y, z in half[-2:0:-1]])
    add_grid(surface, rings)


def teapot(steps=6):
    """Returns the surface of a teapot with the middle of its bottom at the origin."""
    surface = Surface()
    for curves in PROFILES:
        add_turned(surface, curves, steps)
    add_bent_tube(surface, HANDLE, steps)
    add_bent_tube(surface, SPOUT, steps)
    surface.normals = smooth_normals(surface)
    return surface


def teapots(steps=6):
    document = Document()
    floor = -0.14
    tiles = Surface()
    checkered(tiles, (-2.0, floor, -0.5), (4.0, 0, 0), (0, 0, -4.0), 20, 20, linear(214, 208, 196), linear(64, 74, 88))
    document.node("Floor", mesh=document.mesh("Floor", tiles, document.material(
        "Tiles", pbrMetallicRoughness={"metallicFactor": 0, "roughnessFactor": 0.8})))
    surface = teapot(steps)
    for name, color, place, turn in (("Near", [0.75, 0.16, 0.10], (-0.16, -0.66), 25),
                                     ("Sharp", [0.16, 0.42, 0.70], (0.10, -1.1), -20),
                                     ("Far", [0.82, 0.62, 0.12], (0.52, -2.1), 200)):
        material = document.material(name, doubleSided=True, pbrMetallicRoughness={
            "baseColorFactor": [*color, 1], "metallicFactor": 0, "roughnessFactor": 0.35})
        document.node(f"{name} teapot", mesh=document.mesh(f"{name} teapot", surface, material),
                      translation=[place[0], floor, place[1]], rotation=quaternion((0, 1, 0), turn))
    lamp = Surface()
    lamp.quad([(-0.5, -0.5, 0), (0.5, -0.5, 0), (0.5, 0.5, 0), (-0.5, 0.5, 0)], normal=(0, 0, 1))
    light = document.material("Lamp", emissiveFactor=[1.0, 0.85, 0.6],
                              pbrMetallicRoughness={"baseColorFactor": [0, 0, 0, 1], "metallicFactor": 0},
                              extensions={"KHR_materials_emissive_strength": {"emissiveStrength": 40}})
    mesh = document.mesh("Lamp", lamp, light)
    for column in range(7):
        document.node(f"Lamp {column + 1}", mesh=mesh, scale=[0.03] * 3,
                      translation=[round(0.42 * (column - 3), 5), round(0.75 + 0.12 * math.cos(2.2 * column), 5), -4.5])
    document.sun([1.0, 0.96, 0.88], 3.2, quaternion((-0.8944272, 0.4472136, 0), 50))
    document.camera(2 * math.atan(0.27), 4 / 3, {"fStop": 0.95, "focusDistance": 1.1, "horizontalAperture": 36.0},
                    rotation=quaternion((1, 0, 0), -4), translation=[0, 0.06, 0])
    return document.glb()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", metavar="FILE", type=pathlib.Path)
    parser.add_argument("--steps", type=int, default=6, metavar="N")
    arguments = parser.parse_args()
    arguments.file.write_bytes(teapots(arguments.steps))


if __name__ == "__main__":
    main()
