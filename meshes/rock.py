#!/usr/bin/env python3
"""Writes a rock, one closed mesh of a million triangles. Shows the time to the first image of a large scanned object.

The file is too large for the repository. Needs only Python's standard library.

    rock.py OUT.glb [TRIANGLES]
"""

import math
import pathlib
import sys

sys.dont_write_bytecode = True
from gltf_document import Document, Surface

WAVES = [(0.20, (2.1, 1.3, -0.7), 0.3), (0.09, (-3.9, 4.4, 2.6), 1.9), (0.035, (11.0, -8.0, 9.5), 4.0),
         (0.012, (-31.0, 27.0, 36.0), 0.8), (0.004, (97.0, 83.0, -109.0), 2.7)]  # (height, frequencies, phase)


def rock_point(out):
    """Returns the position and the normal of the rock's surface in the direction `out` from its centre."""
    radius, slope = 1.0, [0.0, 0.0, 0.0]
    for height, frequencies, phase in WAVES:
        angle = sum(f * o for f, o in zip(frequencies, out)) + phase
        radius += height * math.sin(angle)
        slope = [s + height * math.cos(angle) * f for s, f in zip(slope, frequencies)]
    along = sum(s * o for s, o in zip(slope, out))
    normal = [radius * o - (s - along * o) for s, o in zip(slope, out)]
    length = math.sqrt(sum(n * n for n in normal))
    return [radius * o for o in out], [n / length for n in normal]


def rock(triangles=1_000_000):
    rows = max(3, math.ceil(math.sqrt(triangles) / 2) + 1)
    columns = 2 * rows  # quadrilaterals around the equator
    surface = Surface()
    for row in range(rows + 1):
        down = math.pi * row / rows
        for column in range(columns + 1):
            turn = 2 * math.pi * (column % columns) / columns
            position, normal = rock_point((math.sin(down) * math.sin(turn), math.cos(down), math.sin(down) * math.cos(turn)))
            surface.positions.append(position)
            surface.normals.append(normal)
    for row in range(rows):
        for column in range(columns):
            a = row * (columns + 1) + column
            b = a + columns + 1
            if row > 0:
                surface.indices += [a, b, a + 1]
            if row + 1 < rows:
                surface.indices += [a + 1, b, b + 1]
    document = Document()
    stone = document.material("Stone", pbrMetallicRoughness={"baseColorFactor": [0.4, 0.36, 0.32, 1], "metallicFactor": 0, "roughnessFactor": 0.9})
    document.node("Rock", mesh=document.mesh("Rock", surface, stone))
    return document.glb()


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    pathlib.Path(sys.argv[1]).write_bytes(rock(*(int(text) for text in sys.argv[2:])))
