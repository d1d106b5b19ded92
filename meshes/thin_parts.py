#!/usr/bin/env python3
"""Writes an object of thin parts, which is hard to simplify. The file is too large for the repository.

    thin_parts.py wires|leaves|relief|lattice OUT.gltf

wires: a cage of round wires; leaves: a shrub of curved sheets; relief: a plate with raised and sunk letters;
lattice: beams along the edges of a grid of cubes.
Needs only Python's standard library.
"""

import math
import pathlib
import random
import sys

sys.dont_write_bytecode = True
from gltf_document import Document, Surface, linear, smooth_normals

GOLDEN = 0.6180339887498949


def unit(a):
    length = math.sqrt(sum(value * value for value in a)) or 1.0
    return tuple(value / length for value in a)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def along(origin, *terms):
    """Returns the origin plus the sum of factor · vector over all terms (factor, vector)."""
    return tuple(origin[axis] + sum(factor * vector[axis] for factor, vector in terms) for axis in range(3))


def add_wire(surface, points, radius, color, around=8, closed=False):
    """Adds a tube through the points; an open tube has flat ends."""
    first, count = len(surface.positions), len(points)
    for i, point in enumerate(points):
        before, after = (points[i - 1], points[(i + 1) % count]) if closed else (points[max(i - 1, 0)], points[min(i + 1, count - 1)])
        direction = unit(along(after, (-1, before)))
        side = unit(cross(direction, (0.13, 0.99, 0.05) if abs(direction[1]) < 0.9 else (0.99, 0.1, 0.1)))
        other = cross(direction, side)
        for k in range(around):
            angle = 2 * math.pi * k / around
            surface.positions.append(along(point, (radius * math.cos(angle), side), (radius * math.sin(angle), other)))
    surface.colors += [color] * (count * around)
    for i in range(count if closed else count - 1):
        a, b = first + i * around, first + (i + 1) % count * around
        for k in range(around):
            j = (k + 1) % around
            surface.indices += [a + k, b + k, a + j, a + j, b + k, b + j]
    if not closed:
        for k in range(1, around - 1):
            end = first + (count - 1) * around
            surface.indices += [first, first + k, first + k + 1, end, end + k + 1, end + k]


def wires(surface):
    """Adds a cage of size 2 around a coil. Its wires follow meridians and parallels and are 0.006 to 0.012 thick."""
    def on_cage(turn, height):
        width = 0.35 + 0.65 * math.sin(math.pi * min(max(height, 0), 1)) ** 0.6
        return (width * math.cos(turn), 2 * height - 1, width * math.sin(turn))
    for i in range(20):
        turn = 2 * math.pi * i / 20
        add_wire(surface, [on_cage(turn, k / 150) for k in range(151)], 0.006, linear(205, 175, 90))
    for i in range(9):
        height = (i + 0.5) / 9
        add_wire(surface, [on_cage(2 * math.pi * k / 240, height) for k in range(240)], 0.004, linear(190, 190, 200), closed=True)
    coil = [(0.25 * math.cos(k / 9), 1.6 * k / 1200 - 0.8, 0.25 * math.sin(k / 9)) for k in range(1200)]
    add_wire(surface, coil, 0.003, linear(210, 90, 60))


def add_leaf(surface, root, direction, length, color, steps=5):
    side = unit(cross(direction, (0.2, 1.0, 0.1)))
    up = cross(side, direction)
    first = len(surface.positions)
    for i in range(steps + 1):
        share = i / steps
        width = 0.22 * length * math.sin(math.pi * share) ** 0.8 + 0.004 * length
        middle = along(root, (length * share, direction), (-0.25 * length * share * share, (0, 1, 0)))
        for k in (-1, -0.5, 0, 0.5, 1):
            surface.positions.append(along(middle, (width * k, side), (0.4 * width * k * k, up)))
            surface.colors.append(color)
    for i in range(steps):
        for k in range(4):
            a, b = first + 5 * i + k, first + 5 * (i + 1) + k
            surface.indices += [a, a + 1, b, b, a + 1, b + 1]


def leaves(surface):
    """Adds a shrub of size 2: 60 twigs with 2,160 leaves, each 0.05 to 0.11 long."""
    source = random.Random(1845)
    for twig in range(60):
        height = 1 - 2 * (twig + 0.5) / 60
        turn = 2 * math.pi * twig * GOLDEN
        flat = math.sqrt(1 - height * height)
        way = (flat * math.cos(turn), 0.6 + 0.7 * height, flat * math.sin(turn))
        points = [along((0, -0.7, 0), (k / 12, way), (-0.25 * (k / 12) ** 2, (0, 1, 0))) for k in range(13)]
        add_wire(surface, points, 0.005, linear(95, 70, 45), around=5)
        for leaf in range(36):
            root = points[3 + leaf % 10]
            direction = unit(along(way, (1.4, [source.uniform(-1, 1) for _ in range(3)])))
            tone = source.uniform(0.6, 1.1)
            add_leaf(surface, root, direction, source.uniform(0.05, 0.11), linear(int(90 * tone), int(150 * tone), int(55 * tone)))


LETTERS = {  # rows of five pixels for each letter, from the top
    "B": "1111010001111101000111110", "O": "0111010001100011000101110", "K": "1000110010111001001010001",
    "E": "1111110000111101000011111", "H": "1000110001111111000110001", "F": "1111110000111101000010000",
    "C": "0111110000100001000001111", "U": "1000110001100011000101110", "S": "0111110000011100000111110",
    "D": "1111010001100011000111110"}


def relief(surface, columns=320, rows=160):
    """Adds a plate of 2 by 1 with rounded edges. Letters are raised or sunk by 0.03, with strokes 0.05 wide."""
    text = ("BOKEH", "FOCUS", "DEFOC")

    def ink(x, y):
        line = int(y * len(text))
        column = x * 5
        letter = LETTERS[text[line][int(column)]]
        u, v = (column % 1) * 7 - 1, (y * len(text) % 1) * 7 - 1
        return 0 <= u < 5 and 0 <= v < 5 and letter[5 * int(v) + int(u)] == "1"

    def height(x, y):
        raised = sum(ink(min(max(x + dx, 0), 0.9999), min(max(y + dy, 0), 0.9999)) for dx, dy in
                     ((0, 0), (0.002, 0), (-0.002, 0), (0, 0.004), (0, -0.004))) / 5
        edge = min(x, 1 - x, 2 * min(y, 1 - y) / 4)
        sign = -1 if int(y * len(text)) == 1 else 1
        return 0.03 * sign * raised - 0.05 * max(0, 1 - edge / 0.02) ** 2

    first = len(surface.positions)
    for i in range(rows + 1):
        for k in range(columns + 1):
            x, y = k / columns, i / rows
            z = height(x, y)
            surface.positions.append((2 * x - 1, 0.5 - y, z))
            surface.colors.append(linear(200, 165, 95) if z > 0.015 else linear(70, 85, 95))
    for i in range(rows):
        for k in range(columns):
            a = first + i * (columns + 1) + k
            b = a + columns + 1
            surface.indices += [a, b, a + 1, a + 1, b, b + 1]


def lattice(surface, cells=5, parts=10):
    """Adds slightly bent beams, 0.024 thick, along the edges of a grid of 5 x 5 x 5 cubes in a cube of size 2."""
    def bent(p):
        return along(p, (0.04 * math.sin(2.1 * p[1]), (1, 0, 0)), (0.04 * math.sin(1.7 * p[2]), (0, 1, 0)))
    for axis in range(3):
        for i in range(cells + 1):
            for k in range(cells + 1):
                points = []
                for step in range(cells * parts + 1):
                    place = [2 * i / cells - 1, 2 * k / cells - 1]
                    place.insert(axis, 2 * step / (cells * parts) - 1)
                    points.append(bent(place))
                add_wire(surface, points, 0.012, linear(150, 60 + 25 * i, 60 + 25 * k), around=8)


OBJECTS = {"wires": wires, "leaves": leaves, "relief": relief, "lattice": lattice}


def thin_parts(name):
    surface = Surface()
    OBJECTS[name](surface)
    surface.normals = smooth_normals(surface)
    document = Document()
    material = document.material(name, doubleSided=name in ("leaves", "relief"),
                                 pbrMetallicRoughness={"metallicFactor": 0, "roughnessFactor": 0.45})
    document.node(name, mesh=document.mesh(name, surface, material))
    return document.gltf()


if __name__ == "__main__":
    if len(sys.argv) != 3 or sys.argv[1] not in OBJECTS:
        sys.exit(__doc__)
    pathlib.Path(sys.argv[2]).write_bytes(thin_parts(sys.argv[1]))
