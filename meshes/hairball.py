#!/usr/bin/env python3
"""Writes a ball of 100,000 thin curled strands, half a million triangles. Depth images cannot represent its visibility.

The file is too large for the repository. Needs only Python's standard library.

    hairball.py OUT.glb [STRANDS]
"""

import math
import pathlib
import random
import sys

sys.dont_write_bytecode = True
from gltf_document import Document, Surface, linear, quaternion

STRANDS_A_MESH = 9000  # strands per mesh: with 7 vertices per strand, indices fit into 16 bits
PARTS = 3


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    length = math.sqrt(sum(value * value for value in a)) or 1.0
    return tuple(value / length for value in a)


def add_strand(surface, source):
    """Adds a strand that grows outwards from inside the ball, curls about its axis and tapers to a point."""
    z = source.uniform(-1, 1)
    around = source.uniform(0, 2 * math.pi)
    radius = math.sqrt(1 - z * z)
    out = (radius * math.cos(around), z, radius * math.sin(around))
    side = unit(cross(out, (0.3, 1.0, 0.2)))
    other = cross(out, side)
    curl = source.uniform(0, 2 * math.pi)
    turn = source.uniform(1.2, 2.6)
    bend = source.uniform(0.05, 0.16)
    begin, end = source.uniform(0.25, 0.5), source.uniform(0.78, 1.0)
    width = 0.0022
    tone = source.uniform(0.55, 1.0)
    warm = 0.5 + 0.5 * z
    color = linear(int(tone * (70 + 170 * warm)), int(tone * (105 + 50 * warm)), int(tone * (175 - 95 * warm)))
    first = len(surface.positions)
    for part in range(PARTS + 1):
        share = part / PARTS
        angle = curl + turn * share * math.pi
        reach = begin + (end - begin) * share
        drop = -0.22 * share * share
        centre = tuple(reach * o + bend * share * (math.cos(angle) * s + math.sin(angle) * t) for o, s, t in
                       zip(out, side, other))
        centre = (centre[0], centre[1] + drop, centre[2])
        across = tuple(width * (math.cos(curl) * s + math.sin(curl) * t) for s, t in zip(side, other))
        ends = [centre] if part == PARTS else [tuple(c - a for c, a in zip(centre, across)),
                                               tuple(c + a for c, a in zip(centre, across))]
        for place in ends:
            surface.positions.append(place)
            surface.normals.append(out)
            surface.colors.append(color)
    for part in range(PARTS):
        a = first + 2 * part
        surface.indices += [a, a + 1, a + 2]
        if part + 1 < PARTS:
            surface.indices += [a + 2, a + 1, a + 3]


def hairball(strands=100_000):
    source = random.Random(2012)
    document = Document()
    hair = document.material("Hair", doubleSided=True,
                             pbrMetallicRoughness={"metallicFactor": 0, "roughnessFactor": 0.6})
    for first in range(0, strands, STRANDS_A_MESH):
        surface = Surface()
        for _ in range(min(STRANDS_A_MESH, strands - first)):
            add_strand(surface, source)
        document.node(f"Strands {first}", mesh=document.mesh(f"Strands {first}", surface, hair))
    document.sun([1.0, 0.9, 0.76], 3.6, quaternion((-0.7882, 0.6154, 0), 50))
    document.sun([0.5, 0.65, 1.0], 1.4, quaternion((-0.4472, -0.8944, 0), 60))
    document.camera(2 * math.atan(0.27), 4 / 3, {"fStop": 0.2, "focusDistance": 3.15, "horizontalAperture": 36.0},
                    translation=[0.0, -0.12, 3.85])
    return document.glb()


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    pathlib.Path(sys.argv[1]).write_bytes(hairball(*(int(text) for text in sys.argv[2:])))
