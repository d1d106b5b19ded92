"""Edits the exporter's glTF file: restores the user's names, and writes the poses and motion of its nodes."""

import copy
import dataclasses
import json
import os

from .motion import SEGMENTS, add_motion, transforms

NAME = "scene.gltf"
LIGHTS = "KHR_lights_punctual"


@dataclasses.dataclass
class GltfFile:
    folder: str  # folder that contains the file, its buffers and its images
    content: dict
    nodes: list  # list of (node index, key of its instance, whether the exporter rotates its axes)
    words: list  # command-line options of `defocus` that are the same for all frames
    notes: list  # one line for each item that is not exported

    @property
    def path(self):
        return os.path.join(self.folder, NAME)

    def write(self, now, seconds, poses):
        """Writes the file with the poses `now` and an animation through `poses` over `seconds`; returns the options."""
        content = copy.deepcopy(self.content)
        for index, key, turned in self.nodes:
            if key in now:
                content["nodes"][index] |= {name: list(rows[0]) for name, rows in transforms([now[key]], turned).items()}
        moves = add_motion(content, self.nodes, seconds, poses)
        with open(self.path, "w", encoding="utf-8") as stream:
            json.dump(content, stream, ensure_ascii=False)
        if not moves:
            return self.words
        return [*self.words, "--time", "0", "--shutter", f"{seconds:.7g}", "--shutter-position", "start",
                "--motion-segments", str(SEGMENTS)]


def restore_names(content, scene_copy):
    """Restores the user's names of nodes, their data and materials, because messages and options refer to them."""
    lights = content.get("extensions", {}).get(LIGHTS, {}).get("lights")
    for node in content.get("nodes", []):
        node["name"] = scene_copy.names.get(node["name"], node["name"])
        light = node.get("extensions", {}).get(LIGHTS, {}).get("light")
        for kind, index in ((content.get("meshes"), node.get("mesh")), (content.get("cameras"), node.get("camera")), (lights, light)):
            if index is not None:
                kind[index]["name"] = node["name"]
    for material in content.get("materials", []):
        material["name"] = scene_copy.material_names.get(material.get("name"), material.get("name", ""))


def read_gltf(folder, scene_copy, words):
    """Returns the GltfFile of an exported SceneCopy."""
    with open(os.path.join(folder, NAME), encoding="utf-8") as stream:
        content = json.load(stream)
    nodes = [(index, *scene_copy.moving[node["name"]]) for index, node in enumerate(content.get("nodes", []))
             if node["name"] in scene_copy.moving]
    restore_names(content, scene_copy)
    return GltfFile(folder, content, nodes, words, scene_copy.notes)
