"""Measures how fast `defocus view` reacts to the mouse: drags the school of fish on a separate X server.

    scripts/figures latency [--program build/release/defocus] [--size 1024x768] [--seconds 15] [-- options of view …]

Prints the milliseconds from an event to the end of the frame that shows its effect, as the window measures them. They
are upper bounds, because the arrival of an event during a frame is unknown. Held equal: scene, window size, mouse path
(30 steps a second).
Needs Xvfb and xdotool.
"""

import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import time

from figures.command import add_program, parser_of


def state_of(path):
    """Returns the state that the window writes to a file with --stats; empty before the window's first frame."""
    try:
        return json.loads(path.read_text())
    except (OSError, ValueError):
        return {}


def wait_for_scene(program, path):
    """Waits until the pyramids are built and the image has more than 64 samples."""
    while program.poll() is None:
        state = state_of(path)
        if state.get("samples", 0) > 64 and not state["draft"]:
            return
        time.sleep(0.2)
    sys.exit("defocus view ended early")


def drag(environment, size, seconds):
    def hand(*words):
        subprocess.run(["xdotool", *map(str, words)], env=environment, check=True)

    centre = [side // 2 for side in size]
    hand("mousemove", *centre, "mousedown", 1)
    begin = time.monotonic()
    step = 0
    while time.monotonic() < begin + seconds:
        angle = step / 12
        hand("mousemove", round(centre[0] + 0.2 * size[0] * math.sin(angle)), round(centre[1] + 0.1 * size[1] * math.sin(2 * angle)))
        step += 1
        time.sleep(max(0, begin + step / 30 - time.monotonic()))
    hand("mouseup", 1)


def main(words):
    parser = parser_of("latency", __doc__)
    add_program(parser)
    parser.add_argument("--size", default="1024x768", help="of the window, in pixels (default: %(default)s)")
    parser.add_argument("--seconds", type=float, default=15, help="of dragging (default: %(default)s)")
    parser.add_argument("options", nargs="*", help="of defocus view, after --")
    arguments = parser.parse_args(words)
    size = [int(side) for side in arguments.size.split("x")]

    with tempfile.TemporaryDirectory() as folder:
        server = subprocess.Popen(["Xvfb", "-displayfd", "1", "-screen", "0", "1920x1080x24", "-nolisten", "tcp"], text=True,
                                  stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        display = server.stdout.readline().strip()
        if not display:
            sys.exit("Xvfb does not start")
        environment = dict(os.environ, DISPLAY=f":{display}", XDG_CONFIG_HOME=folder)
        stats = pathlib.Path(folder) / "state.json"
        command = [arguments.program, "view", "--stats", str(stats), "--size", arguments.size, *arguments.options]
        program = subprocess.Popen(command, env=environment)
        try:
            wait_for_scene(program, stats)
            drag(environment, size, arguments.seconds)
            time.sleep(1)
            state = state_of(stats)
        finally:
            for process in (program, server):
                process.terminate()
                process.wait()
    found = state["inputMilliseconds"]
    print(f"{state['scene']}, {arguments.size}, {state['device']}, load {os.getloadavg()[0]:.1f} of {os.cpu_count()} cores")
    print(f"input to picture over the latest {found['count']} answers: median {found['median']:.0f} ms, worst {found['worst']:.0f} ms")
