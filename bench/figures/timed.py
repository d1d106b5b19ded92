"""Times runs of a program, and describes the program and the machine."""

import os
import subprocess
import sys
import time
from typing import NamedTuple

from figures.command import ROOT, run
from figures.files import read_json


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
