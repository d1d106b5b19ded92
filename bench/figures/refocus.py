"""Compares refocused with rendered pictures of the built-in school of fish.

    scripts/figures refocus [--program build/release/defocus]

For each size and focus distance the table has the PSNR of a picture rendered at that focus, and of one refocused from lens
images that were rendered with focus at 2 m. Both have 64 lens samples at full detail. The reference has 1,024 samples and
another seed. The last columns are the seconds of the lens images, of a rendered and of a refocused picture, program start
included, and how many times a focus pull of 96 frames is as fast by refocusing.
"""

import pathlib
import tempfile
import time

from figures.command import add_program, parser_of, run
from figures.frames import Frames

SCENES = (("3", "128x96"), ("4", "320x240"), ("20", "512x384"))  # fish, size
DISTANCES = ("1.4", "3")  # m
FRAMES = 96


def seconds_of(*words):
    begin = time.monotonic()
    run(*words)
    return time.monotonic() - begin


def measure(program, fish, size, folder):
    subject = ["--fish", fish, "--size", size, "--fstop", "0.95", "--lod", "off"]
    frames = Frames(program, folder, *subject, "--method", "accumulation")
    lens = folder / "scene.lens.exr"
    rendering = [program, "render", *subject, "--samples", "64", "--quiet"]
    run(*rendering, "-o", folder / "warm.exr")  # fills the driver's shader cache
    once = seconds_of(*rendering, "--focus-distance", "2", "--focus-range", "1.2:4", "--lens-images", lens)
    for distance in DISTANCES:
        frames.render("reference.exr", "--focus-distance", distance, "--samples", 1024, "--seed", 9)
        direct = seconds_of(*rendering, "--method", "accumulation", "--focus-distance", distance, "-o", folder / "direct.exr")
        refocused = seconds_of(program, "refocus", lens, "--focus-distance", distance, "-o", folder / "refocused.exr", "--quiet")
        rendered, moved = (frames.difference("reference.exr", file)["psnr"] for file in ("direct.exr", "refocused.exr"))
        ratio = FRAMES * direct / (once + FRAMES * refocused)
        print(f"{fish:>5}{size:>9}{distance + ' m':>8}{rendered:10.1f}{moved:11.1f}{once:12.2f}{direct:10.2f}{refocused:11.2f}{ratio:7.1f}",
              flush=True)


def main(words):
    parser = parser_of("refocus", __doc__)
    add_program(parser)
    program = parser.parse_args(words).program
    print(f"{'fish':>5}{'size':>9}{'focus':>8}{'rendered':>10}{'refocused':>11}{'lens images':>12}{'rendered':>10}{'refocused':>11}{'pull':>7}\n"
          f"{'':>5}{'px':>9}{'':>8}{'dB':>10}{'dB':>11}{'s':>12}{'s':>10}{'s':>11}{'times':>7}")
    for fish, size in SCENES:
        with tempfile.TemporaryDirectory() as folder:
            measure(program, fish, size, pathlib.Path(folder))
