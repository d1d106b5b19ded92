"""Measures the noise of alpha-blended surfaces, sorted and drawn by stochastic transparency.

    scripts/figures blending SCENE … [--before PROGRAM] [--options "--fstop 2"] [--program build/release/defocus]

SCENE is a .gltf or .glb file. For each scene the table has the RMSE of 16, 64 and 256 lens samples against a reference of
the same program from another seed. With --before, an older program is measured, too, and the last column is the RMSE
between the references of both programs: the error that a wrong order of surfaces causes.
"""

import pathlib
import tempfile

from figures.command import add_options, add_program, executable, parser_of, path
from figures.frames import Frames

COUNTS = (16, 64, 256)


def main(words):
    parser = parser_of("blending", __doc__)
    parser.add_argument("scenes", nargs="+", type=path, metavar="SCENE")
    parser.add_argument("--before", type=executable, metavar="PROGRAM", help="older program to measure, too")
    add_options(parser, {"size": "256x192", "reference-samples": 4096, "options": ""})
    add_program(parser)
    arguments = parser.parse_args(words)
    programs = ([("before", arguments.before)] if arguments.before else []) + [("now", arguments.program)]
    print(f"{'scene':24}{'program':>9}" + "".join(f"{f'N = {count}':>10}" for count in COUNTS) + f"{'order':>10}")
    for scene in arguments.scenes:
        with tempfile.TemporaryDirectory() as folder:
            measure(arguments, scene, programs, pathlib.Path(folder))


def measure(arguments, scene, programs, folder):
    frames = Frames(arguments.program, folder, scene, "--size", arguments.size, "--method", "accumulation", "--lod", "off", "--keep-all",
                    *arguments.options.split())
    for name, program in programs:
        frames.render(f"{name}.exr", "--samples", arguments.reference_samples, "--seed", 9, program=program)
        row = f"{scene.stem:24}{name:>9}"
        for count in COUNTS:
            frames.render("image.exr", "--samples", count, program=program)
            row += f"{frames.difference(f'{name}.exr', 'image.exr')['rmse']:10.4f}"
        if name == "now" and len(programs) > 1:
            row += f"{frames.difference('before.exr', 'now.exr')['rmse']:10.4f}"
        print(row, flush=True)
