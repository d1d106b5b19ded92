"""Measures how well the automatic number of lens samples meets the error limit of a quality.

    scripts/figures quality [SCENE …] [--quality good] [--options "--fstop 1.4"] [--program build/release/defocus]

SCENE is a .gltf or .glb file, or school, the built-in scene (default: school and five scenes of meshes/). For each scene the
table has the method and the number of samples that `--quality` chose, the time, and FLIP against a reference of full detail
from another seed. The last column is the smallest of 16, 32, 64 … samples with which the same method meets the FLIP
limit of the quality; "more" if none of these numbers up to the chosen number meets it.
"""

import pathlib
import tempfile

from figures.command import ROOT, add_program, parser_of, path
from figures.frames import Frames

SCENES = ("school", "chess.glb", "swimmers.glb", "bokeh.gltf", "thicket.gltf", "staircase.gltf")
FLIP = {"draft": 0.03, "good": 0.01, "fine": 0.005}


def main(words):
    parser = parser_of("quality", __doc__)
    parser.add_argument("scenes", nargs="*", metavar="SCENE")
    parser.add_argument("--quality", choices=FLIP, default="good", help="default: good")
    parser.add_argument("--size", default="512x384", metavar="WxH", help="default: 512x384")
    parser.add_argument("--reference-samples", type=int, default=2048, help="lens samples of the reference (default: 2048)")
    parser.add_argument("--options", type=str.split, default=[], metavar="TEXT", help="further options of defocus render")
    add_program(parser)
    arguments = parser.parse_args(words)
    scenes = [name if name == "school" else path(name) for name in arguments.scenes]
    print(f"{'scene':24}{'method':>14}{'samples':>9}{'seconds':>9}{'FLIP':>9}{'needed':>9}")
    for scene in scenes or [name if name == "school" else ROOT / "meshes" / name for name in SCENES]:
        with tempfile.TemporaryDirectory() as folder:
            measure(arguments, scene, pathlib.Path(folder))


def measure(arguments, scene, folder):
    subject = [] if scene == "school" else [scene]
    frames = Frames(arguments.program, folder, *subject, "--size", arguments.size, *arguments.options)

    def flip(file):
        return frames.difference("reference.exr", file)["flip"]

    frames.render("reference.exr", "--method", "accumulation", "--samples", arguments.reference_samples, "--seed", 9, "--lod", "off")
    chosen = frames.render("chosen.exr", "--quality", arguments.quality)
    needed = 16
    while needed <= chosen["samples"]:
        frames.render("counted.exr", "--method", chosen["method"], "--samples", needed)
        if flip("counted.exr") <= FLIP[arguments.quality]:
            break
        needed *= 2
    print(f"{pathlib.Path(scene).stem:24}{chosen['method']:>14}{chosen['samples']:9}{chosen['renderMilliseconds'] / 1000:9.1f}"
          f"{flip('chosen.exr'):9.4f}{needed if needed <= chosen['samples'] else 'more':>9}", flush=True)
