"""Compares two results of the same bench row by row.

    scripts/figures diff OLD NEW

OLD and NEW are JSON or CSV files of bench convergence, speedup, scaling, popping, stability or view. Only JSON contains
scene, size, lens and machine. A time has changed if the two spreads (10th to 90th percentile of at least three runs)
don't overlap. An error has changed if it differs by more than 1 %, because a program renders identical images on the
same driver. For SSIM, 1 - SSIM is compared; for PSNR, the RMSE. Results with another scene, camera, size, lens or
driver get no verdict, results of another machine none on times, and results with another reference none on errors
relative to the reference.
"""

import math
import re
import sys
from collections import Counter, namedtuple

from figures.command import parser_of, path
from figures.files import read_csv, read_json

MIN_RUNS = 3  # results with fewer runs get no verdict on times
TOLERANCE = 0.01  # errors count as equal if they differ by at most this fraction of the larger one
SSIM_ROUNDING = 1e-6  # max rounding error of the difference of two SSIM values; CSV files of version 0.1 round to six decimals
# Columns that identify a row, and columns that contain errors.
KEYS = ("sweep", "axis", "movement", "area", "case", "errorOf", "method", "setting", "varied", "value", "samples", "fStop",
        "focusDistance", "lod", "width", "height", "preset", "frame")
ERRORS = re.compile(r"(rmse|psnr|ssim|flip)(Full|Reference)?|(moving|still)Psnr|biasFlip|(change|step)(Rmse|Flip)(Image)?|(diameterE|energyE|e)rror")

# time: median, 10th and 90th percentile in ms; None: not measured
Row = namedtuple("Row", "key time runs errors limit reference_samples")
Results = namedtuple("Results", "measured_on subject rows")
Change = namedtuple("Change", "old new verdict beyond_limit", defaults=(False,))


# ---- read results ----------------------------------------------------------------------------------------------------


def numeric(value):
    """Returns a number for a number or its text, None for null, NaN and infinity, and other values unchanged."""
    try:
        return float(value) if math.isfinite(float(value)) else None
    except (TypeError, ValueError):
        return value


def cells_of(row):
    """Returns a row as {CSV column: value}, with additional errors that are computed from the row."""
    parts = {"milliseconds": "{}", "fromFullDetail": "{}Full", "fromReference": "{}Reference", "bias": "bias{}"}
    cells = {}
    for name, value in row.items():
        for part, inner in value.items() if isinstance(value, dict) else [("worst", value)]:
            if part in ("worst", "median"):
                cells[name] = numeric(inner)
            elif name in parts:
                cells[parts[name].format(part.capitalize() if name == "bias" else part)] = numeric(inner)
    if cells.get("mse") is not None:
        cells["rmse"] = math.sqrt(cells["mse"])
    if "measuredDiameter" in cells:
        cells["diameterError"] = abs(cells["measuredDiameter"] - cells["expectedDiameter"])
        cells["energyError"] = abs(cells["energy"] - 1)
    return cells


def row_of(cells):
    # Older sweeps have no column "method": they measured only accumulation. The keys of all sweeps omit "accumulation", so that rows of
    # older and newer sweeps have equal keys.
    skipped = (None, "", "accumulation") if "sweep" in cells else (None,)
    key = [f"{cells[name]:.6g}" if isinstance(cells[name], float) else cells[name] for name in KEYS if cells.get(name) not in skipped]
    time = [cells.get(name) for name in ("milliseconds", "low", "high")]
    errors = {name: value for name, value in cells.items() if ERRORS.fullmatch(name) and value is not None}
    if not key or (None in time and not errors):
        raise ValueError("not a result of bench convergence, speedup, scaling, popping, stability or view")
    return Row(" ".join(key), None if None in time else time, int(cells.get("runs") or 0), errors, cells.get("limit"),
               cells.get("referenceSamples") or 0)


def subject_of(document):
    """Returns {name: value} of the document's properties that must be equal in comparable results."""
    subject = {name: document[name] for name in ("scene", "camera", "device", "driver", "frames", "pathFrames") if name in document}
    if "width" in document:
        subject["size"] = f"{document['width']} x {document['height']} px"
    subject.update((f"lens {name}", value) for name, value in (document.get("lens") or {}).items())
    for name, text in (("machine", "{processor}, {threads} threads"), ("reference", "{samples} samples, hash {hash}")):
        if document.get(name):
            subject[name] = text.format(**document[name])
    return subject


def parse(document):
    """Converts a JSON document or a list of CSV rows to Results."""
    rows, measured_on, subject = document, "CSV does not name scene, size, lens and machine; they are taken to be equal", {}
    if isinstance(document, dict):
        rows = [{"runs": document.get("runs")} | row for name in ("rows", "cases", "lensHonesty") for row in document.get(name, [])
                if not row.get("leftOut")]
        named = ("program", "commit", "scene", "width", "height", "device", "driver")
        measured_on = ", ".join(str(document[name]) for name in named if name in document)
        subject = subject_of(document)
    if not rows:
        raise ValueError("holds no rows")
    return Results(measured_on, subject, [row_of(cells_of(row)) for row in rows])


def read(file):
    """Reads the Results in a file; exits with a message if it contains none."""
    try:
        return parse(read_json(file) if file.read_bytes().lstrip().startswith(b"{") else read_csv(file))
    except (OSError, ValueError, TypeError, AttributeError) as fault:
        sys.exit(f"{file}: {fault}")


# ---- compare rows ----------------------------------------------------------------------------------------------------


def unlike_subjects(old, new):
    """Returns {property: sentence} for each property that differs between two results."""
    effects = {"machine": "times", "reference": "errors from it"}
    return {name: f"{name} differs (old: {text}, new: {new[name]}): no verdict on {effects.get(name, 'times and errors')}"
            for name, text in old.items() if name in new and new[name] != text}


def time_change(old, new, unlike):
    runs = min(old.runs, new.runs)
    if set(unlike) - {"reference"}:
        verdict = "unknown: not comparable"
    elif runs < MIN_RUNS:
        verdict = "unknown: " + ("number of runs is missing" if runs == 0 else "one run" if runs == 1 else f"{runs} runs")
    elif new.time[2] < old.time[1]:
        verdict = "faster"
    else:
        verdict = "slower" if new.time[1] > old.time[2] else "within noise"
    return Change(old.time, new.time, verdict)


def distance(column, value):
    """Converts an error metric to one that is 0 for equal images: SSIM to 1 - SSIM, PSNR to RMSE."""
    if "psnr" in column.lower():
        return 10 ** (-value / 20)
    return 1 - value if column.startswith("ssim") else value


def error_change(column, old, new, unlike):
    before, after = old.errors[column], new.errors[column]
    of_reference = not column.startswith("bias") and not column.endswith("Full")
    other_reference = "reference" in unlike or old.reference_samples != new.reference_samples
    if set(unlike) - {"machine", "reference"} or (of_reference and other_reference):
        return Change(before, after, "unknown")
    change = distance(column, after) - distance(column, before)
    tolerance = TOLERANCE * max(distance(column, before), distance(column, after))
    if abs(change) <= tolerance + (SSIM_ROUNDING if column.startswith("ssim") else 0):
        verdict = "equal"
    else:
        verdict = "closer" if change < 0 else "farther"
    return Change(before, after, verdict, new.limit is not None and before <= new.limit < after)


def compare(old, new):
    """Returns the differing properties and, for each common row, (key, change of time, {column: change of error})."""
    unlike = unlike_subjects(old.subject, new.subject)
    pairs = [(row, other) for row in old.rows for other in new.rows if row.key == other.key]
    if not pairs:
        sys.exit("no row of OLD is in NEW; only results of one bench can be compared")
    return unlike, [(row.key, time_change(row, other, unlike) if row.time and other.time else None,
                     {name: error_change(name, row, other, unlike) for name in sorted(row.errors) if name in other.errors})
                    for row, other in pairs]


# ---- write the comparison as text ------------------------------------------------------------------------------------


def ratio(new, old):
    return new / old if old > 0 else math.inf


def time_text(time):
    (old, old_low, old_high), (new, new_low, new_high) = time.old, time.new
    spread = f"{ratio(new_low, old_high):.3f} to {ratio(new_high, old_low):.3f}"
    return f"{old:10.1f} {new:10.1f} {ratio(new, old):6.3f} {spread:>15} {time.verdict:22}"


def errors_text(errors):
    """Returns a text that lists the errors that changed or exceed their limits."""
    texts = [f"{name} {error.old:.4g} to {error.new:.4g} {error.verdict}" + (", BEYOND ITS LIMIT" if error.beyond_limit else "")
             for name, error in errors.items() if error.verdict != "equal" or error.beyond_limit]
    return "  ".join(texts) or ("equal" if errors else "")


def counts(changes, verdicts):
    found = Counter(change.verdict.partition(":")[0] for change in changes)
    return ", ".join(f"{found[verdict]} {verdict}" for verdict in verdicts)


def table(old, new):
    """Returns the comparison of two results as a text table."""
    unlike, rows = compare(old, new)
    lines = [f"old: {old.measured_on}", f"new: {new.measured_on}", *unlike.values()]
    width = max(len(key) for key, _, _ in rows)
    times = [time for _, time, _ in rows if time]
    head = f"{'old ms':>10} {'new ms':>10} {'ratio':>6} {'10-90 %':>15} {'time':22}" if times else ""
    lines.append(f"{'row':{width}} {head}  errors")
    lines += [f"{key:{width}} {time_text(time) if time else ''}  {errors_text(errors)}".rstrip() for key, time, errors in rows]
    compared = {key for key, _, _ in rows}
    lines += [f"only in {name}: {row.key}" for name, results in (("old", old), ("new", new)) for row in results.rows
              if row.key not in compared]
    if times:
        lines.append(f"{len(times)} times: " + counts(times, ("faster", "slower", "within noise", "unknown")))
    errors = [error for _, _, changes in rows for error in changes.values()]
    if errors:
        lines.append(f"{len(errors)} errors: " + counts(errors, ("closer", "farther", "equal", "unknown")))
    if beyond := sum(error.beyond_limit for error in errors):
        lines.append(f"{beyond} errors are beyond their limits in new but not in old")
    return "\n".join(lines) + "\n"


def main(words):
    parser = parser_of("diff", __doc__)
    for name in ("OLD", "NEW"):
        parser.add_argument(name.lower(), metavar=name, type=path)
    arguments = parser.parse_args(words)
    print(table(read(arguments.old), read(arguments.new)), end="")
