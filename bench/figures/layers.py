"""Measures the processor time that data layers in .exr files (`--exr-layers`) add to a picture.

    scripts/figures layers [SCENE …] [--runs 5] [--program build/release/defocus] [--output bench/results/llvmpipe-layers.txt]

SCENE is a .gltf or .glb file, or school, the built-in scene (default: school and the chess set). Each scene is rendered
by `--method accumulation`: without layers, with each layer, and with depth, normal and albedo together. The processor
time is the time of the whole program on all cores. Runs alternate between the layers. A first run of
each fills the caches and is not counted. Each time is divided by the time of the picture alone in the same round; the
table has the medians of these ratios.
"""

import pathlib
import statistics
import tempfile

from figures.command import add_program, parser_of, path
from figures.files import write_file
from figures.timed import facts, timed

SCENES = ("school", "meshes/chess.glb")
TOGETHER = "depth,normal,albedo"
LAYERS = ("depth", "normal", "albedo", TOGETHER, "position", "objects")
WIDTHS = (9, 9, 9, len(TOGETHER) + 3, 11, 10)  # widths of the columns, characters


def render(command, folder, layers):
    """Renders with these data layers (a text; empty: none). Returns the processor time in seconds."""
    words = [*command, "-o", folder / "image.exr", *(("--exr-layers", layers) if layers else ())]
    return timed(words, f"a picture with layers '{layers}'", folder).processor


def ratios_of(rounds):
    """Returns the median ratio of each layer's time to that of the picture. rounds: [{layers: seconds}]; "" is the picture."""
    return {layers: statistics.median(times[layers] / times[""] for times in rounds) for layers in rounds[0] if layers}


def row_of(name, rounds):
    picture = statistics.median(times[""] for times in rounds)
    return f"{name:24}{picture:9.2f} s" + "".join(f"{ratio:{width}.2f}" for ratio, width in zip(ratios_of(rounds).values(), WIDTHS))


def header():
    return f"{'scene':24}{'picture':>11}" + "".join(f"{layers:>{width}}" for layers, width in zip(LAYERS, WIDTHS))


def measure(command, runs, folder):
    """Renders all rounds. Returns the processor times of each round."""
    for layers in ("", *LAYERS):
        render(command, folder, layers)
    return [{layers: render(command, folder, layers) for layers in ("", *LAYERS)} for _ in range(runs)]


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
        lines = [facts(arguments.program, folder, arguments.output),
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
