"""Writes lamps whose blur grows away from the middle of the image: the radial example of Munkberg and others (2012).

    meshes/radial_blur.py FILE

The blur at the clip-space position p = (x, y, w) of a vertex is C(p) = (a + b·w)·(1 + x² + y²). The first factor, with
constants a and b, is the blur of the thin lens. The vertex attribute _COC_SCALE is the second factor. Needs only
Python's standard library.
"""

import math
import pathlib
import sys

from gltf_document import Document, Surface
from painted_blur import painted

DISTANCE = 2.0  # distance in m from the camera to the lamps
TANGENT = (0.36, 0.27)  # tan(θx/2) and tan(θy/2) of the horizontal and vertical fields of view


def radial_scale(x, y, w=DISTANCE):
    """Returns 1 + x² + y² for the clip position (x / tan(θx/2), y / tan(θy/2), w) of the point (x, y, -w)."""
    return 1 + (x / TANGENT[0]) ** 2 + (y / TANGENT[1]) ** 2


def radial_blur(scaled=True, columns=9, rows=7):
    document = Document()
    tones = [document.material(name, emissiveFactor=color,
                               pbrMetallicRoughness={"baseColorFactor": [0, 0, 0, 1], "metallicFactor": 0},
                               extensions={"KHR_materials_emissive_strength": {"emissiveStrength": 40}})
             for name, color in (("Amber", [1.0, 0.5, 0.15]), ("Sky", [0.3, 0.55, 1.0]))]
    half = 0.006
    for row in range(rows):
        for column in range(columns):
            x, y = (0.9 * DISTANCE * tangent * (2 * index / (count - 1) - 1)
                    for tangent, index, count in zip(TANGENT, (column, row), (columns, rows)))
            lamp = Surface()
            lamp.quad([(x - half, y - half, -DISTANCE), (x + half, y - half, -DISTANCE), (x + half, y + half, -DISTANCE),
                       (x - half, y + half, -DISTANCE)], normal=(0, 0, 1))
            blurs = {"_COC_SCALE": lambda p: radial_scale(p[0], p[1])} if scaled else {}
            attributes = painted(document, lamp, blurs)
            document.node(f"Lamp {row * columns + column + 1}", mesh=document.mesh_of(
                f"Lamp {row * columns + column + 1}",
                {"attributes": attributes, "indices": document.indices(lamp), "material": tones[(row + column) % 2]}))
    document.camera(2 * math.atan(TANGENT[1]), 4 / 3, {"fStop": 0.95, "focusDistance": 2.3, "horizontalAperture": 36.0})
    return document.glb()


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    pathlib.Path(sys.argv[1]).write_bytes(radial_blur())
