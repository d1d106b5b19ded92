"""Runs of a program with their times, and the facts about program and machine that a record of times names."""

import os
import subprocess
import sys
import time
from typing import NamedTuple

from figures.command import ROOT, run
from figures.files import read_json


class Times(NamedTuple):
    """Seconds of one run."""
    wall: float
    processor: float  # of the whole program, on all cores


def timed(words, caches, what):
    """Runs a command with its own folder of caches, the driver's and the program's. what: the run's name for a message."""
    environment = {**os.environ, "XDG_CACHE_HOME": str(caches)}  # other programs may change the usual caches
    begin = time.monotonic()
    child = subprocess.Popen([str(word) for word in words], cwd=ROOT, env=environment)
    _, status, usage = os.wait4(child.pid, 0)
    wall = time.monotonic() - begin
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        sys.exit(f"{what} failed with exit code {child.returncode}")
    return Times(wall, usage.ru_utime + usage.ru_stime)


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
