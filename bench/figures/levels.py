"""Compares images with levels of detail with images at full detail, over the number of lens samples.

    scripts/figures levels [OBJECT …] [-n 5] [--counts 16,64,256] [--program build/release/defocus]

Each scene has copies of one object, 1 m in size, as `scripts/figures copies` places them: one in focus, the others blurred.
OBJECT is a .gltf or .glb file, or an object of meshes/thin_parts.py: wires, leaves, relief, lattice (default: these four).
FILE:COPIES sets another number of copies. The table has the errors with levels divided by the errors at full
detail with the same samples, both against a converged reference at full detail. It also has the time at full detail
divided by the time with levels.
"""

import json
import pathlib
import statistics
import sys
import tempfile

from figures.command import ROOT, add_options, add_program, parser_of, path, run
from figures.copies import write_copies

OBJECTS = ("wires", "leaves", "relief", "lattice")


def measured(arguments, subject, folder):
    """Returns (name, results) of `defocus bench speedup` for the copies of an object."""
    name, _, count = subject.rpartition(":") if subject.rpartition(":")[2].isdigit() else (subject, "", arguments.n)
    source = folder / f"{name}.gltf" if name in OBJECTS else path(name)
    if name in OBJECTS:
        run(sys.executable, ROOT / "meshes/thin_parts.py", name, source)
    scene = folder / "copies.gltf"
    write_copies(arguments.program, source, int(count), scene, size=1)
    run(arguments.program, "bench", "speedup", scene, "--size", arguments.size, "--counts", arguments.counts, "--runs", arguments.runs,
        "--reference-samples", arguments.reference_samples, "-o", folder, *arguments.options.split())
    return source.stem, json.loads((folder / "speedup.json").read_text())


def main(words):
    parser = parser_of("levels", __doc__)
    parser.add_argument("objects", nargs="*", metavar="OBJECT", help="default: wires leaves relief lattice")
    parser.add_argument("-n", type=int, default=5, metavar="COPIES", help="number of copies (default: 5)")
    parser.add_argument("--counts", default="16,64,256", help="numbers of lens samples (default: 16,64,256)")
    add_options(parser, {"size": "384x288", "runs": 1, "reference-samples": 1024, "options": ""})
    add_program(parser)
    arguments = parser.parse_args(words)
    print(f"{'object':34}{'samples':>8}{'triangles':>11}{'times RMSE':>12}{'times FLIP':>12}{'times fast':>12}")
    speeds = {}
    for subject in arguments.objects or OBJECTS:
        with tempfile.TemporaryDirectory() as folder:
            name, results = measured(arguments, subject, pathlib.Path(folder))
        rows = {(row["samples"], row["lod"]): row for row in results["rows"]}
        for samples in sorted({samples for samples, _ in rows}):
            full, levels = rows[samples, "off"], rows[samples, "fractional"]
            ratio = {key: levels["fromReference"][key] / full["fromReference"][key] for key in ("rmse", "flip")}
            speed = full["milliseconds"]["median"] / levels["milliseconds"]["median"]
            speeds.setdefault(samples, []).append(speed)
            print(f"{name:34}{samples:8}{levels['triangles'] / full['triangles']:11.2f}{ratio['rmse']:12.3f}{ratio['flip']:12.3f}"
                  f"{speed:12.2f}", flush=True)
    for samples, values in speeds.items():
        print(f"{'median':34}{samples:8}{statistics.median(values):47.2f}")
