"""Compares refocused with rendered images of the built-in school of fish and the chess board.

    scripts/figures refocus [--program build/release/defocus]

For each scene, focus distance and number of lens samples, the first table has the PSNR of three images: rendered at
that focus distance, refocused from lens images with another focus (--no-fill-gaps), and refocused with filled gaps. All
have full detail. The reference has 1,024 samples and another seed.

The second table has the seconds of a video of 96 frames in which only the focus changes, with 64 lens samples per
frame, program start included: `capture`, `capture --refocus`, and their ratio. For `capture`, only 1 and 4 frames are
timed, and the video's time is extrapolated. The last columns are the seconds of one rendered and of one refocused image
in these videos.
"""

import json
import pathlib
import tempfile
from typing import NamedTuple

from figures.command import add_program, parser_of, run
from figures.frames import Frames
from figures.timed import timed

FRAMES = 96


class Scene(NamedTuple):
    name: str
    subject: tuple  # command-line arguments that select the scene
    size: str
    focus: str  # focus distance of the lens images, m
    near: str  # near end of the focus range, m
    far: str
    distances: tuple  # focus distances of the refocused images, m

    def words(self):
        return [*self.subject, "--size", self.size, "--lod", "off"]


def school(fish, size):
    return Scene(f"{fish} fish", ("--fish", str(fish), "--fstop", "0.95"), size, "2", "1.2", "4", ("1.4", "3"))


SCENES = (school(3, "128x96"), school(4, "320x240"), school(20, "512x384"),
          Scene("chess", ("meshes/chess.glb", "--fstop", "1.4"), "128x96", "1", "0.5", "5", ("0.5", "5")))


def print_errors(program, scene, folder):
    frames = Frames(program, folder, *scene.words(), "--method", "accumulation")
    for distance in scene.distances:
        frames.render("reference.exr", "--focus-distance", distance, "--samples", 1024, "--seed", 9)
        for samples in (16, 64):
            lens = folder / "scene.lens.exr"
            run(program, "render", *scene.words(), "--samples", samples, "--quiet", "--focus-distance", scene.focus,
                "--focus-range", f"{scene.near}:{scene.far}", "--lens-images", lens)
            frames.render("direct.exr", "--focus-distance", distance, "--samples", samples)
            refocusing = [program, "refocus", lens, "--focus-distance", distance, "--quiet"]
            run(*refocusing, "--no-fill-gaps", "-o", folder / "refocused.exr")
            run(*refocusing, "-o", folder / "filled.exr")
            errors = [frames.difference("reference.exr", f"{name}.exr")["psnr"] for name in ("direct", "refocused", "filled")]
            print(f"{scene.name:>8}{scene.size:>9}{distance + ' m':>8}{samples:>8}"
                  + "".join(f"{error:12.1f}" for error in errors), flush=True)


def print_film(program, scene, folder):
    keys = [{"frame": 0, "distance": float(scene.near)}, {"frame": FRAMES - 1, "distance": float(scene.far)}]
    shot = folder / "pull.json"
    shot.write_text(json.dumps({"range": [0, FRAMES - 1], "samples": 64, "focus": {"keys": keys}}))
    filming = [program, "capture", shot, *scene.words(), "--quiet", "-o", folder / "####.png"]
    rendering = [*filming, "--method", "accumulation", "--range"]
    run(*rendering, "0")  # fills the driver's shader cache
    one, four = (timed([*rendering, frames], f"the film of {scene.name}").wall for frames in ("0", "0:3"))
    each = (four - one) / 3
    rendered = one + (FRAMES - 1) * each
    refocused = timed([*filming, "--refocus"], f"the refocused film of {scene.name}").wall
    times = [json.loads(line)["renderMilliseconds"] for line in (folder / "timings.jsonl").read_text().splitlines()]
    picture = sum(times[1:]) / (len(times) - 1) / 1000
    print(f"{scene.name:>8}{scene.size:>9}{rendered:10.1f}{refocused:11.1f}{rendered / refocused:7.1f}{each:10.3f}{picture:11.3f}",
          flush=True)


def main(words):
    parser = parser_of("refocus", __doc__)
    add_program(parser)
    program = parser.parse_args(words).program
    print(f"{'scene':>8}{'size':>9}{'focus':>8}{'samples':>8}{'rendered':>12}{'refocused':>12}{'filled':>12}\n"
          f"{'':>8}{'px':>9}{'':>8}{'':>8}" + f"{'dB':>12}" * 3)
    for scene in SCENES:
        with tempfile.TemporaryDirectory() as folder:
            print_errors(program, scene, pathlib.Path(folder))
    print(f"\n{'scene':>8}{'size':>9}{'capture':>10}{'--refocus':>11}{'ratio':>7}{'rendered':>10}{'refocused':>11}\n"
          f"{'':>8}{'px':>9}{'s':>10}{'s':>11}{'':>7}{'s/frame':>10}{'s/frame':>11}")
    for scene in SCENES[:3]:  # not the chess board, which is animated
        with tempfile.TemporaryDirectory() as folder:
            print_film(program, scene, pathlib.Path(folder))
