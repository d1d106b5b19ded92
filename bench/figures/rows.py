"""Describes and compares rows of results: labels, texts for values, times at equal error."""

import math

MODES = {  # level mode: (label, index into the palette)
    "off": ("full detail", 6), "nearest": ("nearest level", 0), "fractional": ("fractional levels", 1),
    "continuous": ("continuous levels", 2), "multirate": ("multirate", 3)}
METRICS = {"error": " by error", "proportional": " by blur over box", "score": " by score"}


# ---- labels, and values as text --------------------------------------------------------------------------------------


def label_of(row):
    """Returns a label such as "accumulation, fractional levels ×2" for the setting "lod=fractional thresholds=2"."""
    method, parts = row["method"], [part.partition("=") for part in row["setting"].split()]
    values = {name: value for name, _, value in parts if value}
    words = [f"{method} ({row['form']})" if row.get("form") in ("published", "best") else method]
    if values.get("lod") == "off":
        words.append("full detail")
    elif "lod" in values:
        words.append(f"{values['lod']} levels{METRICS.get(values.get('metric'), '')} ×{values.get('thresholds', '1')}")
    rest = [name + sign + value for name, sign, value in parts if name not in ("lod", "metric", "thresholds", "default")]
    return ", ".join(words + ([" ".join(rest)] if rest else []))


def drawn_text(row, part=""):
    """Returns a label of a `bench speedup` row, such as "jeong2011, nearest level". part: replaces the mode's name."""
    drawn = part or (MODES[row["lod"]][0] if row["method"] == "accumulation" else row["method"])
    return f"{row['preset']}, {drawn}" if row["preset"] else drawn


def number(value, digits):
    return "∞" if value is None else f"{value:.{digits}f}"


def samples_text(row):
    return f"{row['samples']} {'lens samples' if row['takesLensSamples'] else 'pinholes'}"


def time_text(milliseconds):
    return f"{milliseconds / 1000:.3g} s" if milliseconds >= 1000 else f"{milliseconds:.3g} ms"


def time_to_error(time, first, text=time_text):
    """Returns the time to reach an error as text, with its ratio to the first method's time."""
    if time["milliseconds"] is None:
        return "not reached"
    cell = ("under " if time["atMost"] else "") + text(time["milliseconds"])
    if time is first or first["milliseconds"] is None or time["atMost"] or first["atMost"]:
        return cell
    return f"{cell} ({time['milliseconds'] / first['milliseconds']:.2f})"


def spread_text(time):
    return f"{time['low']:.1f}–{time['high']:.1f}"


def seeds_text(row):
    spread = row.get("errorsOverSeeds", {}).get("rmse")
    return f"{spread['low']:.5f}–{spread['high']:.5f}" if spread else ""


def below_reference(rmse_below, flip_below):
    """Returns a text that names the errors of a row that are smaller than the reference's own error."""
    words = [name for name, below in (("RMSE", rmse_below), ("FLIP", flip_below)) if below]
    return f"{' and '.join(words)} below the reference’s own error" if words else ""


# ---- values computed from rows --------------------------------------------------------------------------------------


def median(row):
    return row["milliseconds"]["median"]


def rmse(row):
    return math.sqrt(row["mse"])


def flip(row):
    return row["flip"]


def common_time(series):
    """Returns a frame time (ms) that is close to a row of each series: the middle of the range that all series share.

    Series with a single row are ignored. Without a shared range, returns the median of all times.
    """
    several = [one for one in series if len(one["rows"]) > 1] or series
    times = [[median(row) for row in one["rows"]] for one in several]
    low, high = max(map(min, times)), min(map(max, times))
    if low <= high:
        return math.sqrt(low * high)
    times = sorted(time for row in times for time in row)
    return times[len(times) // 2]


def time_at_error(rows, error):
    """Returns the time (ms) at which rows reach an RMSE, by power laws between rows; None outside their range."""
    points = sorted((row["fromReference"]["rmse"], median(row)) for row in rows if row["fromReference"])
    for (low, slow), (high, fast) in zip(points, points[1:]):
        if low <= error <= high:
            share = math.log(error / low) / math.log(high / low) if high > low else 0
            return slow * (fast / slow) ** share
    return next((time for rmse, time in points if rmse == error), None)


def equal_error_speedup(row, rows):
    """Returns the row's speed-up over full detail with the same RMSE; None if not measured."""
    if not row["fromReference"]:
        return None
    full = [other for other in rows if other["lod"] == "off" and other["sweep"] == "samples" and
            all(other[name] == row[name] for name in ("fStop", "focusDistance"))]
    time = time_at_error(full, row["fromReference"]["rmse"])
    return time / median(row) if time else None


def speedup_headline(results):
    """Returns a sentence with the speed-up of the row whose number of samples is nearest to 64; empty without rows."""
    rows = [row for row in results["rows"] if row["sweep"] == "samples" and row["lod"] == "fractional" and not row["preset"]]
    if not rows:
        return ""
    row = min(rows, key=lambda row: abs(math.log(row["samples"] / 64)))
    equal = equal_error_speedup(row, results["rows"])
    text = f"Levels are {row['speedUp']:.2f} times as fast as full detail at equal N ({row['samples']} lens samples)"
    return text + (f", and {equal:.2f} times at equal error." if equal else "; at equal error: not measured.")
