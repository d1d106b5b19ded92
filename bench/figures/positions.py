"""Measures the time that four pixel positions per lens sample save, and their effect on the error.

    scripts/figures positions SCENE … [--runs 3] [--options "--fstop 1.4"] [--program build/release/defocus] [--output FILE]

SCENE is a .gltf or .glb file. Each scene is rendered by `--method accumulation` at full detail, with the same total
number of pixel positions: by samples with one position each, and by a quarter as many samples with four. The table has
the processor time of drawing the samples, over all cores (median over the runs, which alternate), and RMSE and FLIP
against a reference of another seed.
"""

import pathlib
import statistics
import tempfile

from figures.command import add_program, parser_of, path
from figures.files import write_file
from figures.frames import Frames
from figures.timed import facts

DRAWN = ((32, 1), (8, 4), (64, 1), (16, 4))  # (lens samples, pixel positions per sample)


def name_of(drawn):
    return f"{drawn[0]} x {drawn[1]}"


def measure(frames, runs, reference_samples):
    """Returns a row of the table for each pair of DRAWN."""
    frames.render("reference.exr", "--samples", reference_samples, "--seed", 9)
    seconds = {drawn: [] for drawn in DRAWN}
    for _ in range(runs):
        for drawn in DRAWN:
            stats = frames.render(f"{name_of(drawn)}.exr", "--samples", drawn[0], "--positions", drawn[1])
            seconds[drawn].append(stats["cpuMilliseconds"] / 1000)
    rows = []
    for drawn in DRAWN:
        error = frames.difference("reference.exr", f"{name_of(drawn)}.exr")
        rows.append(f"{name_of(drawn):>20}{statistics.median(seconds[drawn]):10.2f}{error['rmse']:9.4f}{error['flip']:9.4f}")
    return [f"largest blur {stats['largestBlur']:.1f} px", *rows]


def main(words):
    parser = parser_of("positions", __doc__)
    parser.add_argument("scenes", nargs="+", metavar="SCENE", type=path)
    parser.add_argument("--runs", type=int, default=3, help="runs of each image (default: %(default)s)")
    parser.add_argument("--size", default="1024x768", metavar="WxH", help="default: %(default)s")
    parser.add_argument("--reference-samples", type=int, default=1024, help="lens samples of the reference (default: %(default)s)")
    parser.add_argument("--options", default="", metavar="TEXT", help="further options of defocus render")
    parser.add_argument("--output", type=path, help="text file for the table (default: none)")
    add_program(parser)
    arguments = parser.parse_args(words)
    options = ["--size", arguments.size, "--method", "accumulation", "--lod", "off", *arguments.options.split()]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        lines = [facts(arguments.program, folder, arguments.output),
                 "Processor time of drawing all samples; RMSE and FLIP against a reference. Other programs may run at the same time.", "",
                 f"$ scripts/figures positions {' '.join(scene.name for scene in arguments.scenes)} --size {arguments.size} "
                 f"--runs {arguments.runs} --reference-samples {arguments.reference_samples}"
                 + (f" --options '{arguments.options}'" if arguments.options else ""),
                 f"{'samples x positions':>20}{'seconds':>10}{'RMSE':>9}{'FLIP':>9}"]
        print(*lines, sep="\n", flush=True)
        for scene in arguments.scenes:
            rows = measure(Frames(arguments.program, folder, scene, *options), arguments.runs, arguments.reference_samples)
            lines += [f"{scene.stem}, {rows[0]}", *rows[1:]]
            print(*lines[-len(DRAWN) - 1:], sep="\n", flush=True)
    if arguments.output:
        write_file(arguments.output, "\n".join(lines) + "\n")
