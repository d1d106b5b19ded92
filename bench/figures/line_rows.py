"""Defines the runs that compare line samples with points on meshes/teapots.py; makes the tables of line-samples.md."""

import math

from figures.files import read_json
from figures.markdown import table
from figures.results import RESULTS, command_of, run_of
from figures.rows import median, rmse

# Names of the results, keyed by --blur-scale.
VIEWS = {0.5: "llvmpipe-teapots-half-blur", 1: "llvmpipe-teapots", 2: "llvmpipe-teapots-double-blur"}
# Method and settings (default or published) of the rows.
EXACT, PUBLISHED, POINTS = ("line", "default"), ("line", "published"), ("stochastic", "default")
NAMES = {EXACT: "lines", PUBLISHED: "lines, as published", POINTS: "points"}
COUNTS = {EXACT: (4, 16), PUBLISHED: (4, 16), POINTS: (16, 64, 256)}
COMMON = ["--lod", "off", "--focus-breathing", "--background", "0.25,0.28,0.33", "--reference-samples", "1600", "--runs", "3",
          "--seeds", "1"]
# Images whose details are shown beside the reference: (method and settings, number of samples).
DETAILS = [(EXACT, 4), (EXACT, 16), (PUBLISHED, 16), (POINTS, 64), (POINTS, 256)]


def runs():
    """Returns {name: options of bench convergence}, with a run of line samples and a run of points for each view."""
    options = {}
    for blur, name in VIEWS.items():
        for run, method, form in ((name, "line", EXACT), (f"{name}-points", "stochastic:shading=surfaces", POINTS)):
            options[run] = ["--methods", method, "--rows", "published,default" if form == EXACT else "default", "--counts",
                            ",".join(map(str, COUNTS[form])), "--blur-scale", f"{blur:g}", *COMMON]
    return options


def run_name(blur, method):
    return VIEWS[blur] + ("-points" if method == POINTS else "")


def row_of(blur, method, samples):
    """Returns the row of a method with this number of lines or points, at a blur scale."""
    (row,) = [row for row in run_of(run_name(blur, method))["rows"]
              if (row["method"], row["form"]) == method and row["samples"] == samples]
    return row


def text_of(method, samples):
    return f"{samples} {NAMES[method]}"


def equal_time_points():
    """Returns the number of points whose render time is nearest to that of 16 lines."""
    lines = median(row_of(1, EXACT, 16))
    return min(COUNTS[POINTS], key=lambda count: abs(math.log(median(row_of(1, POINTS, count)) / lines)))


def quality_ratio(method):
    """Returns the RMSE of 16 lines divided by the RMSE of 256 points."""
    return rmse(row_of(1, method, 16)) / rmse(row_of(1, POINTS, 256))


def cells(blur, method, samples):
    row = row_of(blur, method, samples)
    times = f"{median(row_of(blur, POINTS, 256)) / median(row):.2f}"
    return [text_of(method, samples), f"{median(row) / 1000:.2f} s", times, f"{rmse(row):.4f}", f"{row['flip']:.4f}"]


HEADER = ["method", "frame", "times as fast as 256 points", "RMSE", "FLIP"]


def commands(blurs):
    names = [run_name(blur, method) for blur in blurs for method in (EXACT, POINTS)]
    return "\n" + "".join(f"    {command_of(name, run_of(name))}\n" for name in names)


def qualities():
    """Returns the table of time and error by number of lines or points."""
    return table(HEADER, [cells(1, method, count) for method in NAMES for count in COUNTS[method]]) + commands([1])


def details():
    errors = read_json(RESULTS / "lines" / "details.json")
    texts = [text_of(*column) for column in DETAILS]
    return table(["RMSE", *texts], [[name, *(f"{part[text]:.4f}" for text in texts)] for name, part in errors.items()])


def blurs():
    """Returns the table of time and error by blur scale."""
    rows = [[f"{blur:g}", *cells(blur, method, count)] for blur in VIEWS
            for method, count in ((EXACT, 16), (PUBLISHED, 16), (POINTS, 64), (POINTS, 256))]
    return table(["blur", *HEADER], rows) + commands(VIEWS)


TABLES = {"line qualities": qualities, "line details": details, "line blurs": blurs}
