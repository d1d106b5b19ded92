"""Measures the processor time that lighting and its textures add to a picture.

    scripts/figures lighting SCENE … [--runs 5] [--samples 64] [--program build/release/defocus] [--output FILE]

SCENE is a .gltf or .glb file. Each scene is rendered by `--method accumulation` as it is, and with KHR_materials_unlit on
all materials, which leaves only the base colour and its texture. The table has the processor time of drawing the samples,
over all cores (medians; the runs alternate).
"""

import json
import pathlib
import statistics
import struct
import tempfile

from figures.command import add_program, parser_of, path
from figures.files import write_file
from figures.frames import Frames
from figures.timed import facts

EXTENSION = "KHR_materials_unlit"
GLB_HEADER, CHUNK_HEADER = struct.Struct("<4sII"), struct.Struct("<I4s")


def unlit(document):
    """Returns a glTF document whose materials are unlit."""
    materials = [{**material, "extensions": {**material.get("extensions", {}), EXTENSION: {}}} for material in document.get("materials", [])]
    return {**document, "materials": materials, "extensionsUsed": sorted({*document.get("extensionsUsed", []), EXTENSION})}


def write_unlit(scene, folder):
    """Writes the scene with unlit materials to a folder. Returns the path of the file."""
    written = folder / scene.name
    if scene.suffix == ".glb":
        data = scene.read_bytes()
        start = GLB_HEADER.size + CHUNK_HEADER.size
        length, _ = CHUNK_HEADER.unpack_from(data, GLB_HEADER.size)
        text = json.dumps(unlit(json.loads(data[start:start + length]))).encode()
        text += b" " * (-len(text) % 4)
        rest = data[start + length:]
        written.write_bytes(GLB_HEADER.pack(b"glTF", 2, start + len(text) + len(rest)) + CHUNK_HEADER.pack(len(text), b"JSON") + text + rest)
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


def main(words):
    parser = parser_of("lighting", __doc__)
    parser.add_argument("scenes", nargs="+", metavar="SCENE", type=path)
    parser.add_argument("--runs", type=int, default=5, help="runs of each image (default: %(default)s)")
    parser.add_argument("--samples", type=int, default=64, help="lens samples (default: %(default)s)")
    parser.add_argument("--size", default="1024x768", metavar="WxH", help="default: %(default)s")
    parser.add_argument("--output", type=path, help="text file for the table (default: none)")
    add_program(parser)
    arguments = parser.parse_args(words)
    options = ["--size", arguments.size, "--method", "accumulation", "--samples", arguments.samples]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        lines = [facts(arguments.program, folder, arguments.output), "Other programs may run at the same time.", "",
                 f"$ scripts/figures lighting {' '.join(scene.name for scene in arguments.scenes)} --runs {arguments.runs} "
                 f"--samples {arguments.samples} --size {arguments.size}",
                 f"{'scene':32}{'lit, s':>10}{'unlit, s':>10}{'ratio':>10}"]
        print(*lines, sep="\n", flush=True)
        for scene in arguments.scenes:
            variant = folder / scene.stem
            variant.mkdir()
            forms = {"lit": Frames(arguments.program, folder, scene, *options),
                     "unlit": Frames(arguments.program, folder, write_unlit(scene, variant), *options)}
            times = {form: [] for form in forms}
            for _ in range(arguments.runs):
                for form, frames in forms.items():
                    times[form].append(frames.render(f"{form}.exr")["cpuMilliseconds"] / 1000)
            lines.append(row_of(scene.stem, times))
            print(lines[-1], flush=True)
    if arguments.output:
        write_file(arguments.output, "\n".join(lines) + "\n")
