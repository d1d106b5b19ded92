"""Writes a glTF scene with many copies of another scene at increasing depths, seen through a fast lens: for benches.

    scripts/figures copies SCENE [-n 20] [-o copies.gltf] [--program build/release/defocus]

The copies share the scene's meshes and files, whose paths are relative to the new file. The binary part of a .glb file goes to
a .bin file beside the new file. The copies' depths increase from 2 to 12 times the scene's size; sideways they fill the view of
the camera (50 mm f/0.95). The focal plane is at the fourth copy.
Animations, skins and cameras of the scene are left out.
"""

import json
import math
import os
import pathlib

from figures.command import add_program, parser_of, path, run
from figures.files import write_file
from figures.glb import read_glb

TANGENT = 18 / 50  # tangent of half the camera's horizontal field of view
SPREAD = (0.7548776662466927, 0.5698402909980532)  # increments of the R2 sequence


def copied(document, index):
    """Appends a copy of a node and its children to the document; returns the copy's index."""
    node = dict(document["nodes"][index])
    if "children" in node:
        node["children"] = [copied(document, child) for child in node["children"]]
    document["nodes"].append(node)
    return len(document["nodes"]) - 1


def add_copies(document, count, low, high, wanted=None):
    """Replaces the scene's root nodes by `count` copies of them and a camera. low, high: corners of the scene's
    bounding box. wanted: size of each copy in m; None: the scene's size."""
    scene = document["scenes"][document.get("scene", 0)]
    roots, scene["nodes"] = scene["nodes"], []
    size = max(high[axis] - low[axis] for axis in range(3))
    scale = wanted / size if wanted else 1
    size *= scale
    middle = [(low[axis] + high[axis]) / 2 for axis in range(3)]
    for node in document["nodes"]:
        node.pop("camera", None)
        node.pop("skin", None)
    depths = [size * 2 * 6 ** ((i + 0.5) / count) for i in range(count)]
    for i, depth in enumerate(depths):
        side = 0.9 * depth * TANGENT * (2 * ((i * SPREAD[0] + 0.5) % 1) - 1)
        up = 0.8 * depth * TANGENT * 0.75 * (2 * ((i * SPREAD[1] + 0.5) % 1) - 1)
        document["nodes"].append({"name": f"Copy {i + 1}", "children": [copied(document, root) for root in roots],
                                  "scale": [scale] * 3, "translation": [side - scale * middle[0], up - scale * middle[1],
                                                                             -depth - scale * middle[2]]})
        scene["nodes"].append(len(document["nodes"]) - 1)
    document["cameras"] = [{"name": "Camera", "type": "perspective",
                            "perspective": {"yfov": 2 * math.atan(TANGENT * 0.75), "aspectRatio": 4 / 3, "znear": size / 50},
                            "extras": {"fStop": 0.95, "focusDistance": depths[min(3, count - 1)]}}]
    document["nodes"].append({"name": "Camera", "camera": 0})
    scene["nodes"].append(len(document["nodes"]) - 1)
    for part in ("animations", "skins"):
        document.pop(part, None)


def document_of(scene, output):
    """Returns the document of a .gltf or .glb file, with paths relative to the file `output`."""
    data = scene.read_bytes()
    if data[:4] != b"glTF":
        document = json.loads(data)
        folder = os.path.relpath(scene.parent, output.parent)
        for entry in document.get("buffers", []) + document.get("images", []):
            if not entry.get("uri", "data:").startswith("data:"):
                entry["uri"] = pathlib.PurePosixPath(folder, entry["uri"]).as_posix()
        return document
    document, chunks = read_glb(data)
    binary = output.with_suffix(".bin")
    write_file(binary, chunks[8:])
    document["buffers"][0]["uri"] = binary.name
    return document


def write_copies(program, scene, count, output, size=None):
    bounds = json.loads(run(program, "info", scene, "--json"))["bounds"]
    document = document_of(scene, output)
    add_copies(document, count, bounds["minimum"], bounds["maximum"], size)
    write_file(output, json.dumps(document, indent=1))


def main(words):
    parser = parser_of("copies", __doc__)
    parser.add_argument("scene", type=path, help="a .gltf or .glb file")
    parser.add_argument("-n", type=int, default=20, metavar="COPIES", help="number of copies (default: 20)")
    parser.add_argument("-o", "--output", type=path, default="copies.gltf", help="default: copies.gltf")
    parser.add_argument("--size", type=float, metavar="M", help="size that each copy is scaled to, in m (default: as in the file)")
    add_program(parser)
    arguments = parser.parse_args(words)
    if arguments.n < 1:
        parser.error("-n: at least one copy")
    if arguments.size is not None and not arguments.size > 0:
        parser.error("--size: above 0 m")
    write_copies(arguments.program, arguments.scene, arguments.n, arguments.output, arguments.size)
