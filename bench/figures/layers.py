"""Measures the processor time that data layers in .exr files (`--exr-layers`) add to an image.

    scripts/figures layers [SCENE …] [--runs 5] [--program build/release/defocus] [--output bench/results/llvmpipe-layers.txt]

SCENE is a .gltf or .glb file, or school, the built-in scene (default: school and the chess set). Each scene is rendered
by `--method accumulation`: without layers, with each layer, and with depth, normal and albedo together. The processor
time is the time of the whole program on all cores. Runs with different layers alternate. The
first run with each layer fills the caches and is not counted. Each time is divided by the time without layers in the
same round; the table has the medians of these ratios.
"""

import statistics

from figures.timed import time_scenes, timed

TOGETHER = "depth,normal,albedo"
LAYERS = ("depth", "normal", "albedo", TOGETHER, "position", "objects")
WIDTHS = (9, 9, 9, len(TOGETHER) + 3, 11, 10)  # widths of the columns in characters


def render(command, folder, layers):
    """Renders with these data layers (a text; empty: none). Returns the processor time in seconds."""
    words = [*command, "-o", folder / "image.exr", *(("--exr-layers", layers) if layers else ())]
    return timed(words, f"a picture with layers '{layers}'", folder).processor


def ratios_of(rounds):
    """Returns the median over the rounds of each time divided by the time without layers. rounds: [{layers: s}]."""
    return {layers: statistics.median(times[layers] / times[""] for times in rounds) for layers in rounds[0] if layers}


def row_of(name, rounds):
    picture = statistics.median(times[""] for times in rounds)
    return f"{name:24}{picture:9.2f} s" + "".join(f"{ratio:{width}.2f}" for ratio, width in zip(ratios_of(rounds).values(), WIDTHS))


def header():
    return f"{'scene':24}{'picture':>11}" + "".join(f"{layers:>{width}}" for layers, width in zip(LAYERS, WIDTHS))


def rows(arguments, scene, folder):
    """Renders all rounds of a scene. Returns the line of the table."""
    command = [arguments.program, "render", *([] if scene.name == "school" else [scene]), "--size", arguments.size,
               "--samples", arguments.samples, "--method", "accumulation", "--quiet"]
    for layers in ("", *LAYERS):
        render(command, folder, layers)
    rounds = [{layers: render(command, folder, layers) for layers in ("", *LAYERS)} for _ in range(arguments.runs)]
    return [row_of(scene.stem, rounds)]


def main(words):
    time_scenes(words, "layers", __doc__, {"size": "640x480", "samples": 64, "runs": 5},
                "Processor time of the whole program, as ratios to the picture alone.", header(), rows, ["school", "meshes/chess.glb"])
