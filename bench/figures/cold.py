"""Measures the time to the first image of a scene, with empty caches.

    scripts/figures cold [SCENE …] [--runs 3] [--program build/release/defocus] [--output bench/results/llvmpipe-cold.txt]

SCENE is a .gltf or .glb file (default: the chess set). `defocus render SCENE` runs with its default settings, and with
`--lod fractional`, which always builds levels of detail. Runs alternate, each with empty caches of the driver and of the
program. The table has the medians of the wall-clock and of the processor times, from the start of the program to its end.
"""

import pathlib
import statistics
import tempfile

from figures.timed import Times, alternating, time_scenes, timed

FORMS = {"default": [], "fractional": ["--lod", "fractional"]}


def medians(runs):
    return Times(*(statistics.median(times) for times in zip(*runs)))


def row_of(name, times):
    """Returns a line of the table. times: {name in FORMS: Times}."""
    return f"{name:32}" + "".join(f"{of.wall:16.2f} s{of.processor:10.2f} s" for of in times.values())


def header():
    return f"{'scene':32}" + "".join(f"{form + ': wall':>18}{'processor':>12}" for form in FORMS)


def first_picture(program, scene, options):
    """Renders a scene once with empty caches, and returns the times of the run."""
    with tempfile.TemporaryDirectory() as name:
        words = [program, "render", scene, *options, "--quiet", "-o", pathlib.Path(name) / "image.png"]
        return timed(words, f"the picture of {scene.name}", name)


def rows(arguments, scene, _):
    times = alternating(arguments.runs, FORMS, lambda form: first_picture(arguments.program, scene, FORMS[form]))
    return [row_of(scene.stem, {form: medians(runs) for form, runs in times.items()})]


def main(words):
    time_scenes(words, "cold", __doc__, {"runs": 3}, "Empty caches.", header(), rows, ["meshes/chess.glb"])
