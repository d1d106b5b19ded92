"""Measures the time to the first picture of a scene, with empty caches.

    scripts/figures cold [SCENE …] [--runs 3] [--program build/release/defocus] [--output bench/results/llvmpipe-cold.txt]

SCENE is a .gltf or .glb file (default: the chess set). `defocus render SCENE` runs with its default settings, and with
`--lod fractional`, which always builds levels of detail. Runs alternate, each with empty caches of the driver and of the
program. The table has the medians of the wall-clock and of the processor times, from the start of the program to its end.
"""

import pathlib
import statistics
import tempfile

from figures.command import add_program, parser_of, path
from figures.files import write_file
from figures.timed import Times, facts, timed

SCENES = ("meshes/chess.glb",)
FORMS = {"default": [], "fractional": ["--lod", "fractional"]}


def medians(runs):
    return Times(*(statistics.median(times) for times in zip(*runs)))


def row_of(name, times):
    """Returns a line of the table. times: {form of the command: Times}."""
    return f"{name:32}" + "".join(f"{of.wall:16.2f} s{of.processor:10.2f} s" for of in times.values())


def header():
    return f"{'scene':32}" + "".join(f"{form + ': wall':>18}{'processor':>12}" for form in FORMS)


def first_picture(program, scene, options):
    """Renders a scene once with empty caches, and returns the times of the run."""
    with tempfile.TemporaryDirectory() as name:
        words = [program, "render", scene, *options, "--quiet", "-o", pathlib.Path(name) / "image.png"]
        return timed(words, f"the picture of {pathlib.Path(scene).name}", name)


def main(words):
    parser = parser_of("cold", __doc__)
    parser.add_argument("scenes", nargs="*", metavar="SCENE")
    parser.add_argument("--runs", type=int, default=3, help="of each form (default: %(default)s)")
    parser.add_argument("--output", type=path, help="text file for the table (default: none)")
    add_program(parser)
    arguments = parser.parse_args(words)
    scenes = [path(scene) for scene in arguments.scenes] or SCENES
    with tempfile.TemporaryDirectory() as name:
        lines = [facts(arguments.program, pathlib.Path(name), arguments.output)]
    lines += ["Empty caches. Other programs may run at the same time.", "",
              f"$ scripts/figures cold {' '.join(pathlib.Path(scene).name for scene in scenes)} --runs {arguments.runs}", header()]
    print(*lines, sep="\n", flush=True)
    for scene in scenes:
        rounds = [{form: first_picture(arguments.program, scene, options) for form, options in FORMS.items()}
                  for _ in range(arguments.runs)]
        lines.append(row_of(pathlib.Path(scene).stem, {form: medians([times[form] for times in rounds]) for form in FORMS}))
        print(lines[-1], flush=True)
    if arguments.output:
        write_file(arguments.output, "\n".join(lines) + "\n")
