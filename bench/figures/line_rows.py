"""The runs of line samples and points on meshes/teapots.py, and the tables of bench/results/line-samples.md."""

import math

from figures.command import ROOT
from figures.files import read_json
from figures.markdown import table
from figures.results import command_of, run_of

NAME = "llvmpipe-teapots"
COMMON = ["--lod", "off", "--focus-breathing", "--background", "0.25,0.28,0.33", "--reference-samples", "1600", "--runs", "1",
          "--seeds", "1"]
LINES = ["--methods", "line,stochastic:shading=surfaces", "--rows", "published,standard", "--counts"]
# Options of bench convergence for each run. 256 points have a run of their own, because 256 lines would take minutes.
RUNS = {NAME: [*LINES, "4,16,64", *COMMON],
        f"{NAME}-points": ["--methods", "stochastic:shading=surfaces", "--counts", "256", *COMMON],
        f"{NAME}-half-blur": ["--blur-scale", "0.5", *LINES, "16,64", *COMMON],
        f"{NAME}-double-blur": ["--blur-scale", "2", *LINES, "16,64", *COMMON]}
# method and form of the rows
EXACT, PUBLISHED, POINTS = ("line", "standard"), ("line", "published"), ("stochastic", "standard")
NAMES = {EXACT: "lines", PUBLISHED: "lines, as published", POINTS: "points"}
# Columns of the details beside the reference: run, method, samples.
DETAILS = {"4 lines": (NAME, EXACT, 4), "16 lines": (NAME, EXACT, 16), "16, as published": (NAME, PUBLISHED, 16),
           "64 points": (NAME, POINTS, 64), "256 points": (f"{NAME}-points", POINTS, 256)}


def row_of(name, method, samples):
    """Returns the row of a method, full detail in its standard form, with a number of lines or points."""
    (row,) = [row for row in run_of(name)["rows"] if (row["method"], row["form"]) == method and row["samples"] == samples]
    return row


def equal_time_points():
    """Returns the number of points whose time is nearest to the time of 16 lines."""
    lines = milliseconds(row_of(NAME, EXACT, 16))
    counts = [row["samples"] for row in run_of(NAME)["rows"] if (row["method"], row["form"]) == POINTS]
    return min(counts, key=lambda count: abs(math.log(milliseconds(row_of(NAME, POINTS, count)) / lines)))


def milliseconds(row):
    return row["milliseconds"]["median"]


def cells(row):
    return [f"{milliseconds(row) / 1000:.2f} s", f"{math.sqrt(row['mse']):.4f}", f"{row['flip']:.4f}"]


def commands(names):
    return "\n" + "".join(f"    {command_of(name, run_of(name))}\n" for name in names)


def qualities():
    """Returns the table of time and error over the number of lines or points."""
    rows = [[f"{count} {NAMES[method]}", *cells(row_of(NAME, method, count))] for method in NAMES for count in (4, 16, 64)]
    rows.append([f"256 {NAMES[POINTS]}", *cells(row_of(f"{NAME}-points", POINTS, 256))])
    return table(["blur of the lens", "frame", "RMSE", "FLIP"], rows) + commands([NAME, f"{NAME}-points"])


def details():
    errors = read_json(ROOT / "bench" / "results" / f"{NAME}-details.json")
    return table(["RMSE", *DETAILS], [[name, *(f"{part[text]:.4f}" for text in DETAILS)] for name, part in errors.items()])


def blur_runs():
    """Returns the names of the runs with all methods, from the smallest to the largest blur."""
    return sorted((name for name in RUNS if not name.endswith("-points")), key=lambda name: run_of(name)["lens"]["blurScale"])


def blurs():
    """Returns the table of time and error over the blur."""
    rows = []
    for name in blur_runs():
        for method, count in ((EXACT, 16), (PUBLISHED, 16), (POINTS, 16), (POINTS, 64)):
            rows.append([f"{run_of(name)['lens']['blurScale']:g}", f"{count} {NAMES[method]}", *cells(row_of(name, method, count))])
    return table(["blur", "method", "frame", "RMSE", "FLIP"], rows) + commands(blur_runs())


TABLES = {"line qualities": qualities, "line details": details, "line blurs": blurs}
