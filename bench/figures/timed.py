"""Times runs of a program by scene, and describes the program and the machine."""

import os
import pathlib
import shlex
import subprocess
import sys
import tempfile
import time
from typing import NamedTuple

from figures.command import ROOT, add_options, add_program, parser_of, path, run
from figures.files import read_json, write_file


class Times(NamedTuple):
    """Times of one run, in seconds, and the memory that it used."""
    wall: float
    processor: float  # CPU time of the program, summed over all cores
    memory: float = 0  # peak memory, MiB


def timed(words, what, caches=None):
    """Runs a command. what: the run's name for a message. caches: folder for the caches of the driver and of the program;
    None: the usual folders, which other programs may change."""
    environment = {**os.environ, **({"XDG_CACHE_HOME": str(caches)} if caches else {})}
    begin = time.monotonic()
    child = subprocess.Popen([str(word) for word in words], cwd=ROOT, env=environment)
    _, status, usage = os.wait4(child.pid, 0)
    wall = time.monotonic() - begin
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        sys.exit(f"{what} failed with exit code {child.returncode}")
    return Times(wall, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024)


def facts(program, folder, recorded):
    """Returns a line that names the program's commit, device, driver and processor. recorded: whether the times are stored;
    then a program with uncommitted changes is refused."""
    stats = folder / "stats.json"
    run(program, "render", "meshes/bokeh.gltf", "--size", "16x16", "--samples", 1, "--quiet", "--stats", stats, "-o", folder / "image.exr")
    known = read_json(stats)
    if recorded and known["commit"].endswith("-changed"):
        sys.exit("the program has uncommitted changes; commit them, so that the run can be repeated")
    return f"Commit {known['commit']}, {known['device']}, {known['driver']}, {os.cpu_count()} cores of {processor()}."


def processor():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        return next((line.split(":")[1].strip() for line in file if line.startswith("model name")), "unknown processor")


def alternating(runs, forms, measure):
    """Returns {form: results of measure(form) in each run}. forms: variants of a command; their runs alternate."""
    return dict(zip(forms, zip(*[[measure(form) for form in forms] for _ in range(runs)])))


def time_scenes(words, name, text, options, remark, header, rows, scenes=()):
    """Runs `scripts/figures NAME`, which prints a table of times by scene, and writes the table to --output.

    text: the parser's description. options: {option: default} for add_options(), in the order of the recorded command.
    rows(arguments, scene, folder): returns the lines of a scene. It may write to the folder, which is empty.
    scenes: the default scenes, relative to the repository root; without them, the user must name a scene.
    """
    parser = parser_of(name, text)
    parser.add_argument("scenes", nargs="*" if scenes else "+", type=path, default=[ROOT / scene for scene in scenes], metavar="SCENE")
    add_options(parser, options)
    parser.add_argument("--output", type=path, help="text file for the table (default: none)")
    add_program(parser)
    arguments = parser.parse_args(words)
    values = {option: getattr(arguments, option.replace("-", "_")) for option in options}
    command = ["scripts/figures", name, *(scene.name for scene in arguments.scenes),
               *(word for option, value in values.items() if value for word in (f"--{option}", shlex.quote(str(value))))]
    with tempfile.TemporaryDirectory() as folder:
        lines = [facts(arguments.program, pathlib.Path(folder), arguments.output)]
    lines += [f"{remark} Other programs may run at the same time.".lstrip(), "", f"$ {' '.join(command)}", header]
    print(*lines, sep="\n", flush=True)
    for scene in arguments.scenes:
        with tempfile.TemporaryDirectory() as folder:
            lines += (found := rows(arguments, scene, pathlib.Path(folder)))
        print(*found, sep="\n", flush=True)
    if arguments.output:
        write_file(arguments.output, "\n".join(lines) + "\n")
