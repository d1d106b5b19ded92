"""Measures the time that four pixel positions per lens sample save, and their effect on the error.

    scripts/figures positions SCENE … [--runs 3] [--options "--fstop 1.4"] [--program build/release/defocus] [--output FILE]

SCENE is a .gltf or .glb file. Each scene is rendered by `--method accumulation` at full detail, with the same total
number of pixel positions: by samples with one position each, and by a quarter as many samples with four. The table has
the processor time of drawing the samples, over all cores (median over the runs, which alternate), and RMSE and FLIP
against a reference with another seed.
"""

import statistics

from figures.frames import Frames
from figures.timed import alternating, time_scenes

DRAWN = ((32, 1), (8, 4), (64, 1), (16, 4))  # (lens samples, pixel positions per sample)


def name_of(drawn):
    return f"{drawn[0]} x {drawn[1]}"


def rows(arguments, scene, folder):
    """Returns a line with the scene's largest blur, and a line of the table for each pair in DRAWN."""
    frames = Frames(arguments.program, folder, scene, "--size", arguments.size, "--method", "accumulation", "--lod", "off",
                    *arguments.options.split())
    frames.render("reference.exr", "--samples", arguments.reference_samples, "--seed", 9)
    drawn = alternating(arguments.runs, DRAWN, lambda drawn: frames.render(
        f"{name_of(drawn)}.exr", "--samples", drawn[0], "--positions", drawn[1]))
    lines = []
    for pair, runs in drawn.items():
        seconds = statistics.median(stats["cpuMilliseconds"] / 1000 for stats in runs)
        error = frames.difference("reference.exr", f"{name_of(pair)}.exr")
        lines.append(f"{name_of(pair):>20}{seconds:10.2f}{error['rmse']:9.4f}{error['flip']:9.4f}")
    return [f"{scene.stem}, largest blur {runs[-1]['largestBlur']:.1f} px", *lines]


def main(words):
    time_scenes(words, "positions", __doc__, {"size": "1024x768", "runs": 3, "reference-samples": 1024, "options": ""},
                "Processor time of drawing all samples; RMSE and FLIP against a reference.",
                f"{'samples x positions':>20}{'seconds':>10}{'RMSE':>9}{'FLIP':>9}", rows)
