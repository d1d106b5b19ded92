"""Renders eight lit and textured scenes with Cycles and with defocus, and prints the PSNR of defocus against Cycles.

    scripts/figures cycles [-o FOLDER] [--samples 1024] [SCENE …] [--program build/release/defocus]

Needs Blender 3.4 (Debian: apt-get install blender). Blender makes the scenes, exports them as .glb and renders each one
twice with direct light. The noise of the two images is subtracted from the error. Held equal: geometry, textures,
lights, lens, image size, pixel filter and glTF's shading equations. Errors are measured on sRGB-encoded values in
[0, 1]. The last column is with shadows, the others are without.
"""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

from figures.command import ROOT, add_program, parser_of, path

COUNTS = (16, 64, 256)


def blender():
    """Returns the path and the version of Blender 3.4; exits if Blender is missing or has another version."""
    program = shutil.which("blender")
    if not program:
        sys.exit("Blender is missing; install version 3.4 (Debian: apt-get install blender)")
    version = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout.splitlines()[0]
    if not version.startswith("Blender 3.4"):
        sys.exit(f"{program} is {version}; the comparison needs Blender 3.4, whose shading it matches")
    return program, version


def start_blender(program, script, settings, under=()):
    """Starts a script of this folder in Blender's Python. settings: its last argument, as JSON.

    under: words before the command, such as xvfb-run.
    """
    # Debian's Blender uses the first Python in PATH. Put the folder of the Blender program first, because Debian's
    # Python is in the same folder.
    environment = os.environ | {"PATH": f"{pathlib.Path(program).parent}:{os.environ['PATH']}"}
    return subprocess.Popen([*under, program, "-b", "-noaudio", "--factory-startup", "--python-exit-code", "1",
                             "-P", pathlib.Path(__file__).with_name(script), "--", json.dumps(settings)],
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, cwd=ROOT, env=environment)


def size(text):
    width, height = map(int, text.split("x"))
    return width, height


def main(words):
    parser = parser_of("cycles", __doc__)
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help="such as 'metal spheres' (default: all)")
    parser.add_argument("-o", "--output", type=path, help="folder for the scenes and for strips: Cycles, defocus, 5 times the difference")
    parser.add_argument("--samples", type=int, default=1024, help="samples per pixel of each image of Cycles (default: 1024)")
    parser.add_argument("--size", type=size, default=(192, 144), metavar="WxH", help="default: 192x144")
    add_program(parser)
    arguments = parser.parse_args(words)
    program, version = blender()
    with tempfile.TemporaryDirectory() as folder:
        if arguments.output:
            folder = arguments.output
            folder.mkdir(parents=True, exist_ok=True)
        settings = {"scenes": arguments.scenes, "width": arguments.size[0], "height": arguments.size[1],
                    "samples": arguments.samples, "counts": COUNTS, "folder": str(folder), "program": str(arguments.program)}
        process = start_blender(program, "cycles_render.py", settings)
        header = [f"{count} samples" for count in COUNTS] + ["Cycles' noise", f"{COUNTS[-1]}, shadows"]
        device, messages = "", []
        for line in process.stdout:
            if not line.startswith("{"):
                messages.append(line)
                continue
            row = json.loads(line)
            if not device:
                device = row["device"]
                print(f"{version}, Cycles: mean of 2 images of {arguments.samples:,} samples; defocus: {device}\n"
                      f"{arguments.size[0]} x {arguments.size[1]} px; PSNR in dB of sRGB-encoded values, without Cycles' noise\n\n"
                      f"{'scene':18}" + "".join(f"{text:>15}" for text in header))
            print(f"{row['scene']:18}" + "".join(f"{value:15.1f}" for value in [*row["plain"], row["shadows"][0]]), flush=True)
        if process.wait():
            sys.exit(f"Blender failed:\n{''.join(messages[-8:])}")
