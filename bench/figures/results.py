"""Reads the results in bench/results for tables and plots of the documents."""

import re
import sys

from figures.command import ROOT
from figures.files import read_json, repeatable

RESULTS = ROOT / "bench" / "results"
# Options to append to the commands of runs that were measured when `size` was the default LOD metric.
BY_SIZE = {"llvmpipe-methods-fish": " --metrics size", "llvmpipe-speedup-fish": " --lod-metric size"}
# Runs that were measured with near-components=1 and near-field=coverage as defaults of method "circular".
CIRCULAR_BY_COVERAGE = ("llvmpipe-methods-fish", "llvmpipe-methods-lens-space")


def run_of(name):
    """Returns a JSON result; exits if the program had uncommitted changes, because such a run cannot be repeated."""
    results = read_json(RESULTS / f"{name}.json")
    if results["commit"].endswith("-changed"):
        sys.exit(f"{name}.json: measured with uncommitted changes; commit them and measure again")
    return results


def lines_of(name):
    """Returns the lines of a recorded text. Rows and commands of version 0.1 are converted."""
    return repeatable((RESULTS / f"{name}.txt").read_text()).replace(", standard", ", default").splitlines()


def numbers(text):
    return [float(word) for word in re.findall(r"-?\d+\.?\d*(?:e[+-]\d+)?", text)]


def numbers_after(lines, beginning):
    """Returns the numbers after `beginning` in the only line that starts with it."""
    (line,) = [line for line in lines if line.startswith(beginning)]
    return numbers(line[len(beginning):])


def command_of(name, results):
    """Returns the command of a run, without output options and with the options that reproduce the run."""
    command = re.sub(r" (-o \S+|--report \S+|--quiet)", "", results["commands"][0]) + BY_SIZE.get(name, "")
    if name not in CIRCULAR_BY_COVERAGE:
        return command
    return re.sub(r"(?<=[ ,])circular(:?)",
                  lambda found: "circular:near-components=1,near-field=coverage" + ("," if found[1] else ""), command)


def accumulation_rows(name, preset=""):
    """Returns the rows of `bench speedup` for accumulation with the preset."""
    return [row for row in run_of(name)["rows"]
            if (row.get("preset", ""), row.get("method", "accumulation")) == (preset, "accumulation")]


def samples_sweep(name, preset=""):
    """Returns [(samples, {level mode: row})] of the sweep over the number of lens samples."""
    rows = [row for row in accumulation_rows(name, preset) if row["sweep"] == "samples"]
    counts = sorted({row["samples"] for row in rows})
    return [(count, {row["lod"]: row for row in rows if row["samples"] == count}) for count in counts]


def seconds(row):
    return row["milliseconds"]["median"] / 1000


def rmse(row):
    return 10 ** (-row["psnr"] / 20)


def error_ratio(modes, error="rmse"):
    """Returns the error with levels divided by the error at full detail. modes: {level mode: row}."""
    return modes["fractional"]["fromReference"][error] / modes["off"]["fromReference"][error]


def lens_levels():
    """Returns {model: rows of numbers} of Figure 7 from the lens-space bench."""
    models = {}
    for line in lines_of("llvmpipe-lens-space"):
        if ": milliseconds of line samples" in line:
            rows = models.setdefault(line.split(".glb")[0], [])
        cells = [cell.strip() for cell in line.split("|")[1:-1]]
        if len(cells) == 9 and cells[0].isdigit():
            rows.append([float(cell) for cell in cells])
    return models
