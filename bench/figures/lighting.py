"""Measures the processor time that lighting and its textures add to an image.

    scripts/figures lighting SCENE … [--runs 5] [--samples 64] [--program build/release/defocus] [--output FILE]

SCENE is a .gltf or .glb file. Each scene is rendered by `--method accumulation` as it is, and with KHR_materials_unlit on
all materials, which leaves only the base colour and its texture. The table has the processor time of drawing the samples,
over all cores (medians; the runs alternate).
"""

import json
import statistics

from figures.frames import Frames
from figures.glb import glb, read_glb
from figures.timed import alternating, time_scenes

EXTENSION = "KHR_materials_unlit"


def unlit(document):
    """Returns a glTF document whose materials are unlit."""
    materials = [{**material, "extensions": {**material.get("extensions", {}), EXTENSION: {}}} for material in document.get("materials", [])]
    return {**document, "materials": materials, "extensionsUsed": sorted({*document.get("extensionsUsed", []), EXTENSION})}


def write_unlit(scene, folder):
    """Writes the scene with unlit materials to a folder. Returns the path of the file."""
    written = folder / scene.name
    if scene.suffix == ".glb":
        document, chunks = read_glb(scene.read_bytes())
        written.write_bytes(glb(unlit(document), chunks))
        return written
    for other in scene.parent.iterdir():
        if other != scene:
            (folder / other.name).symlink_to(other)
    written.write_text(json.dumps(unlit(json.loads(scene.read_text("utf-8")))), "utf-8")
    return written


def row_of(name, times):
    """Returns a line of the table. times: {"lit" or "unlit": [s]}."""
    lit, plain = (statistics.median(times[form]) for form in ("lit", "unlit"))
    return f"{name:32}{lit:10.2f}{plain:10.2f}{lit / plain:10.2f}"


def rows(arguments, scene, folder):
    variant = folder / "unlit"
    variant.mkdir()
    options = ["--size", arguments.size, "--method", "accumulation", "--samples", arguments.samples]
    forms = {"lit": Frames(arguments.program, folder, scene, *options),
             "unlit": Frames(arguments.program, folder, write_unlit(scene, variant), *options)}
    return [row_of(scene.stem, alternating(arguments.runs, forms,
                                           lambda form: forms[form].render(f"{form}.exr")["cpuMilliseconds"] / 1000))]


def main(words):
    time_scenes(words, "lighting", __doc__, {"runs": 5, "samples": 64, "size": "1024x768"}, "",
                f"{'scene':32}{'lit, s':>10}{'unlit, s':>10}{'ratio':>10}", rows)
