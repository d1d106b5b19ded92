"""Measures the noise of alpha-blended surfaces, sorted and drawn by stochastic transparency.

    scripts/figures blending SCENE … [--options "--fstop 2"] [--program build/release/defocus]

SCENE is a .gltf or .glb file. For each scene the table has the RMSE of 16, 64 and 256 lens samples against a reference
with another seed.
"""

import pathlib
import tempfile

from figures.command import add_options, add_program, parser_of, path
from figures.frames import Frames

COUNTS = (16, 64, 256)


def main(words):
    parser = parser_of("blending", __doc__)
    parser.add_argument("scenes", nargs="+", type=path, metavar="SCENE")
    add_options(parser, {"size": "256x192", "reference-samples": 4096, "options": ""})
    add_program(parser)
    arguments = parser.parse_args(words)
    print(f"{'scene':24}" + "".join(f"{f'N = {count}':>10}" for count in COUNTS))
    for scene in arguments.scenes:
        with tempfile.TemporaryDirectory() as folder:
            measure(arguments, scene, pathlib.Path(folder))


def measure(arguments, scene, folder):
    frames = Frames(arguments.program, folder, scene, "--size", arguments.size, "--method", "accumulation", "--lod", "off", "--keep-all",
                    *arguments.options.split())
    frames.render("reference.exr", "--samples", arguments.reference_samples, "--seed", 9)
    row = f"{scene.stem:24}"
    for count in COUNTS:
        frames.render("image.exr", "--samples", count)
        row += f"{frames.difference('reference.exr', 'image.exr')['rmse']:10.4f}"
    print(row, flush=True)
