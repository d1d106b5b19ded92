"""Measures the processor time that data layers in .exr files (`--exr-layers`) add to a picture.

    scripts/figures layers [SCENE …] [--runs 5] [--program build/release/defocus] [--output bench/results/llvmpipe-layers.txt]

SCENE is a .gltf or .glb file, or school, the built-in scene (default: school and the chess set). Each scene is rendered without layers,
with each layer and with depth, normal and albedo together, by `--method accumulation`. The processor time is that of the
whole program on all cores. Runs alternate between the layers, after a first run of each that fills caches of their own,
the driver's and the program's. Each time is divided by that of the picture alone in the same round; the table has the medians of these ratios.
"""

import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

from figures.command import ROOT, add_program, parser_of, path, run
from figures.files import read_json, write_file

SCENES = ("school", "meshes/chess.glb")
TOGETHER = "depth,normal,albedo"
LAYERS = ("depth", "normal", "albedo", TOGETHER, "position", "objects")
WIDTHS = (9, 9, 9, len(TOGETHER) + 3, 11, 10)  # of the columns


def render(command, folder, layers):
    """Renders with these layers, none if empty. Returns the processor time in seconds."""
    words = [*command, "-o", folder / "image.exr", *(("--exr-layers", layers) if layers else ())]
    environment = {**os.environ, "XDG_CACHE_HOME": str(folder)}  # other programs may empty the usual caches
    child = subprocess.Popen([str(word) for word in words], cwd=ROOT, env=environment)
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        sys.exit(f"a picture with layers '{layers}' failed with exit code {child.returncode}")
    return usage.ru_utime + usage.ru_stime


def ratios_of(rounds):
    """Returns the median ratio of each layer's time to that of the picture. rounds: [{layers: seconds}]; "" is the picture."""
    return {layers: statistics.median(times[layers] / times[""] for times in rounds) for layers in rounds[0] if layers}


def row_of(name, rounds):
    picture = statistics.median(times[""] for times in rounds)
    return f"{name:24}{picture:9.2f} s" + "".join(f"{ratio:{width}.2f}" for ratio, width in zip(ratios_of(rounds).values(), WIDTHS))


def header():
    return f"{'scene':24}{'picture':>11}" + "".join(f"{layers:>{width}}" for layers, width in zip(LAYERS, WIDTHS))


def measure(command, runs, folder):
    """Returns the times of each round."""
    for layers in ("", *LAYERS):
        render(command, folder, layers)
    return [{layers: render(command, folder, layers) for layers in ("", *LAYERS)} for _ in range(runs)]


def facts(program, folder):
    """Returns the statistics of a small picture, which name the program's commit, the device and the driver."""
    stats = folder / "stats.json"
    run(program, "render", "meshes/bokeh.gltf", "--size", "16x16", "--samples", 1, "--quiet", "--stats", stats, "-o", folder / "image.exr")
    return read_json(stats)


def processor():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        return next((line.split(":")[1].strip() for line in file if line.startswith("model name")), "unknown processor")


def main(words):
    parser = parser_of("layers", __doc__)
    parser.add_argument("scenes", nargs="*", metavar="SCENE")
    parser.add_argument("--runs", type=int, default=5, help="rounds of each scene (default: %(default)s)")
    parser.add_argument("--size", default="640x480", metavar="WxH", help="default: %(default)s")
    parser.add_argument("--samples", type=int, default=64, help="lens samples (default: %(default)s)")
    parser.add_argument("--output", type=path, help="text file for the table (default: none)")
    add_program(parser)
    arguments = parser.parse_args(words)
    scenes = arguments.scenes or SCENES
    options = ["--size", arguments.size, "--samples", arguments.samples, "--method", "accumulation"]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        stats = facts(arguments.program, folder)
        if arguments.output and stats["commit"].endswith("-changed"):
            sys.exit("the program has uncommitted changes; commit them, so that the run can be repeated")
        lines = [f"Commit {stats['commit']}, {stats['device']}, {stats['driver']}, {os.cpu_count()} cores of {processor()}.",
                 "Processor time of the whole program, as ratios to the picture alone. Other programs may run at the same time.", "",
                 f"$ scripts/figures layers {' '.join(pathlib.Path(scene).name for scene in scenes)} --size {arguments.size} "
                 f"--samples {arguments.samples} --runs {arguments.runs}", header()]
        print(*lines, sep="\n", flush=True)
        for scene in scenes:
            subject = [] if scene == "school" else [path(scene) if arguments.scenes else scene]
            rounds = measure([arguments.program, "render", *subject, *options, "--quiet"], arguments.runs, folder)
            lines.append(row_of(pathlib.Path(scene).stem, rounds))
            print(lines[-1], flush=True)
    if arguments.output:
        write_file(arguments.output, "\n".join(lines) + "\n")
