"""Compares the time that defocus, Embree, Cycles and EEVEE need for an equal error.

    scripts/figures peers [SCENE …] [--size 512x384] [--program build/release/bench/defocus_peers_bench] [--output FILE]

SCENE is school, helmets (twenty copies of FlightHelmet), school-f11 or chess-f16 (both mostly in focus); default: all.
Needs Blender 3.4 (Debian: apt-get install blender). EEVEE also needs a display, or Xvfb.

Held equal: geometry, colours (baked lighting, unlit materials), camera, lens (round aperture), image size, pixel filter
(box of one pixel; EEVEE: a similar one), colour transform. Cycles has no adaptive sampling, no denoising and no bounces.
Levels of detail are those of `--lod fractional`, the default for a given number of samples. The row auto-4 is method auto
with four pixel positions per lens sample (`--positions 4`).

Errors are RMSE and FLIP of sRGB-encoded values in [0, 1]. Each renderer is compared with its own image of many samples
and another seed, at full detail; EEVEE with that of Cycles. The differences between these references show that all draw
the same image. Times are CPU seconds of all threads to draw an image, and in brackets wall-clock seconds. They
exclude start-up, loading, pyramids and ray-tracing hierarchies. Up to 32 samples, each time is the minimum over three
images, except for EEVEE. Times between two numbers of samples are interpolated, logarithm over logarithm. The row
"first" names the renderer with the lowest CPU time, and the ratio of the CPU time of embree-shared to this time. The
row is "undecided" if another renderer reaches the error with its smallest number of samples, whose time is only an
upper bound.
"""

import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
from typing import NamedTuple

from figures.command import ROOT, executable, parser_of, path
from figures.copies import write_copies
from figures.cycles import blender, size, start_blender
from figures.files import write_file
from figures.frames import Frames
from figures.timed import processor

COUNTS = (2, 4, 8, 16, 32, 64, 128, 256)
EEVEE_COUNTS = (4, 16)  # more samples hardly change EEVEE's image
TARGETS = [("rmse", 0.01), ("rmse", 0.005), ("rmse", 0.0033), ("flip", 0.03), ("flip", 0.015), ("flip", 0.01)]
REFERENCES = {"auto": "accumulation", "auto-4": "accumulation", "accumulation": "accumulation", "embree-shared": "embree", "embree": "embree",
              "cycles": "cycles", "eevee": "cycles"}
# {name of the scene: arguments of defocus_peers_bench}
SCENES = {"school": [], "helmets": ["helmets.gltf"], "school-f11": ["--fstop", "11"],
          "chess-f16": [ROOT / "meshes/chess.glb", "--fstop", "16"]}


class Point(NamedTuple):
    """Errors of an image, and the times in s to render it."""
    cpu: float
    wall: float
    rmse: float
    flip: float


class Time(NamedTuple):
    cpu: float
    wall: float
    at_most: bool = False  # True: upper bound, because the first image already reaches the target error


def time_to(points, metric, target):
    """Returns the interpolated Time at which the error reaches the target, or None. points: by number of samples."""
    before = None
    for point in points:
        error = getattr(point, metric)
        if error <= target:
            if not before:
                return Time(point.cpu, point.wall, True)
            far = getattr(before, metric)
            share = math.log(far / target) / math.log(far / max(error, 1e-9))
            return Time(*(early * (late / early) ** share for early, late in zip(before[:2], point[:2])))
        before = point
    return None


def without_overhead(images):
    """Subtracts from Blender's times the part that does not grow with the samples. Returns all images but the first.

    images: [{samples, seconds, cpuSeconds}]; the first has one sample.
    """
    first, last = images[0], images[-1]
    result = [dict(image) for image in images[1:]]
    for name in ("seconds", "cpuSeconds"):
        slope = (last[name] - first[name]) / (last["samples"] - 1)
        for image in result:
            image[name] = max(image[name] - (first[name] - slope), 1e-3)
    return result


def cell(time):
    return f"{'< ' if time.at_most else ''}{time.cpu:.3f} ({time.wall:.3f})" if time else "not reached"


def winner(times):
    """Returns the renderer with the smallest time, and its speed-up over embree-shared. times: {name: Time or None}."""
    reached = {name: time for name, time in times.items() if time}
    if not reached:
        return "none"
    first = min(reached, key=lambda name: reached[name].cpu)
    if any(time.at_most for name, time in reached.items() if name != first):
        return "undecided"  # another renderer may be faster, because its time is only an upper bound
    rival = reached.get("embree-shared")
    if first.startswith("embree") or not rival or reached[first].at_most:
        return first
    return f"{first}, {rival.cpu / reached[first].cpu:.1f}x"


def table(points):
    """Returns the lines of a table. points: {name of a renderer: [Point]}."""
    columns = [{name: time_to(of, *target) for name, of in points.items()} for target in TARGETS]
    lines = [f"{'CPU s (wall-clock s) to':24}" + "".join(f"{f'{metric.upper()} {error}':>18}" for metric, error in TARGETS)]
    lines += [f"{name:24}" + "".join(f"{cell(column[name]):>18}" for column in columns) for name in points]
    return lines + [f"{'first':24}" + "".join(f"{winner(column):>18}" for column in columns)]


def json_lines(process, what):
    """Returns the lines of JSON that a process prints; exits if it fails."""
    output, _ = process.communicate()
    lines = output.splitlines()
    if process.returncode:
        sys.exit(f"{what} failed:\n" + "\n".join(lines[-8:]))
    return [json.loads(line) for line in lines if line.startswith("{")]


def rendered_with_eevee(program, settings):
    """Returns EEVEE's images, or a text that says why there are none."""
    if not os.environ.get("DISPLAY") and not shutil.which("xvfb-run"):
        return "EEVEE is left out: it needs a display, or xvfb-run"
    process = start_blender(program, "peers_blender.py", settings, () if os.environ.get("DISPLAY") else ("xvfb-run", "-a"))
    try:
        output, _ = process.communicate(timeout=600)
    except subprocess.TimeoutExpired:
        process.kill()
        return "EEVEE is left out: it takes more than ten minutes"
    images = [json.loads(line) for line in output.splitlines() if line.startswith("{")]
    return without_overhead(images) if process.returncode == 0 else f"EEVEE is left out: Blender fails with exit code {process.returncode}"


def measure(arguments, name, folder):
    """Measures a scene. Returns its lines of the table, and the facts about its file."""
    words = [folder / word if word == "helmets.gltf" else word for word in SCENES[name]]
    if name == "helmets":
        write_copies(arguments.defocus, arguments.models / "FlightHelmet/FlightHelmet.gltf", 20, words[0])
    width, height = arguments.size
    facts, *images = json_lines(subprocess.Popen(
        [str(word) for word in [arguments.program, folder, *words, "--size", f"{width}x{height}", "--counts", ",".join(map(str, COUNTS)),
                                "--reference-samples", arguments.reference_samples]],
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, cwd=ROOT), f"defocus_peers_bench with {name}")
    if arguments.output and facts["commit"].endswith("-changed"):
        sys.exit("the program has uncommitted changes; commit them, so that the run can be repeated")
    facts["file"] = str(folder / facts["file"])
    settings = {"facts": facts, "folder": str(folder), "width": width, "height": height}
    program, _ = blender()
    images += without_overhead(json_lines(start_blender(program, "peers_blender.py", settings | {
        "method": "cycles", "counts": COUNTS, "referenceSamples": arguments.reference_samples}), "Cycles"))
    eevee = rendered_with_eevee(program, settings | {"method": "eevee", "counts": EEVEE_COUNTS, "referenceSamples": 0})
    notes = [eevee] if isinstance(eevee, str) else []
    points, frames = {}, Frames(arguments.defocus, folder)
    for image in images + (eevee if not notes else []):
        method = image["method"]
        error = frames.difference(f"{REFERENCES[method]}-reference.exr", f"{method}-{image['samples']}.exr")
        points.setdefault(method, []).append(Point(image["cpuSeconds"], image["seconds"], error["rmse"], error["flip"]))
    if "eevee" in points:
        notes.append(f"EEVEE's image of {EEVEE_COUNTS[-1]} samples is {-20 * math.log10(points['eevee'][-1].rmse):.1f} dB from Cycles' reference.")
    distances = [f"{second} {frames.difference('accumulation-reference.exr', f'{second}-reference.exr')['psnr']:.1f} dB"
                 for second in ("embree", "cycles")]
    drawn = ", then ".join(dict.fromkeys(image["drawnBy"] for image in images if image["method"] == "auto"))
    return [f"{name}: {facts['triangles']:,} triangles, f/{facts['fStop']:.3g}; auto draws with {drawn}", *table(points),
            f"Distance between the references of accumulation and of: {', '.join(distances)}", *notes, ""], facts


def main(words):
    parser = parser_of("peers", __doc__)
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help=", ".join(SCENES))
    parser.add_argument("--size", type=size, default=(512, 384), metavar="WxH", help="default: 512x384")
    parser.add_argument("--reference-samples", type=int, default=1024, help="samples per pixel of the references (default: 1024)")
    parser.add_argument("--models", type=path, default=ROOT.parent / "shared/models", help="folder with FlightHelmet/, for helmets")
    parser.add_argument("--program", type=executable, default=str(ROOT / "build/release/bench/defocus_peers_bench"),
                        help="the bench (default: build/release/bench/defocus_peers_bench); defocus lies in the folder above")
    parser.add_argument("--output", type=path, help="text file for the tables (default: none)")
    parser.add_argument("--pictures", type=path, help="folder that keeps the images (default: none)")
    arguments = parser.parse_args(words)
    if unknown := set(arguments.scenes) - set(SCENES):
        parser.error(f"there is no scene '{unknown.pop()}'; the scenes are: {', '.join(SCENES)}")
    arguments.program = pathlib.Path(arguments.program)
    arguments.defocus = arguments.program.parent.parent / "defocus"
    _, version = blender()
    scenes = arguments.scenes or list(SCENES)
    lines = [f"$ scripts/figures peers {' '.join(scenes)} --size {'x'.join(map(str, arguments.size))}"
             f" --reference-samples {arguments.reference_samples}", ""]
    for name in scenes:
        with tempfile.TemporaryDirectory() as scratch:
            folder = pathlib.Path(scratch)
            if arguments.pictures:
                folder = arguments.pictures / name
                folder.mkdir(parents=True, exist_ok=True)
            more, facts = measure(arguments, name, folder)
        if name == scenes[0]:
            lines.insert(0, f"Commit {facts['commit']}, {version}, {os.cpu_count()} cores of {processor()}. Other programs may run at the same time.")
            print(lines[0])
        lines += more
        print(*more, sep="\n", flush=True)
        if arguments.output:  # write after each scene, so that a killed run keeps its tables
            write_file(arguments.output, "\n".join(lines).rstrip() + "\n")
