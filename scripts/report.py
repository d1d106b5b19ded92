#!/usr/bin/env python3
"""Draws the report of `defocus bench` as one index.html that needs nothing else.

    report.py RESULTS [REPORT]

RESULTS may hold results.json of `bench convergence` and the images that it names; index.html goes to REPORT (the same
folder, if not given). Further sections come from what else lies in REPORT:
    speedup.json                of `bench speedup`: speed-up against lens samples (Jeong, Kim and Lee 2011, Figure 2)
    popping.json, popping.csv   of `bench popping`: what levels add to each change from frame to frame
    scaling.json                of `bench scaling`: time against triangles, instances, samples, pixels, blur
    stability.json              of `bench stability`: extreme cases, and the blur against the lens
    strips.json                 pictures to show side by side: [{"title", "text", "images": [{"label", "file"}]}]

Needs matplotlib and Pillow (Debian: python3-matplotlib). The program carries this script and runs it for --report.
"""

import base64
import csv
import datetime
import fcntl
import html
import io
import json
import math
import os
import re
import sys
import tempfile
from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter
from PIL import Image

# After Okabe and Ito's palette, told apart with all kinds of colour blindness; darker on white, lighter on black. No line
# is told by its colour alone: each has a marker and a label of its own.
PALETTE = [("#0063a8", "#5db1f0"), ("#c24e00", "#ff8a4c"), ("#00805c", "#35cfa1"), ("#a8447f", "#ee9cc8"),
           ("#8a6000", "#f0c040"), ("#007e8a", "#5fd3df"), ("#5a5a5a", "#b8b8b8")]
MARKERS = "osD^vPX*<>h"
# Colours that stand for the page's own while matplotlib draws; no data has them.
INK, GRID = "#010203", "#010204"
STAND_INS = [f"#0102{i:02x}" for i in range(0x10, 0x10 + len(PALETTE))]

CROP_WIDTH = 176  # px on the page
LABEL_LETTERS = 42  # fit beside a plot; longer labels are smaller
BASELINE = ("accumulation", "lod=off")  # what all else is seen against
# Levels of detail in plots: label, number in the palette.
MODES = {"off": ("full detail", 6), "nearest": ("nearest level", 0), "fractional": ("fractional levels", 1),
         "continuous": ("continuous levels", 2), "multirate": ("multirate", 3)}


# ---- data -----------------------------------------------------------------------------------------------------------


def label_of(method, setting, form=""):
    """'accumulation', 'lod=fractional metric=size thresholds=2' -> 'accumulation, fractional levels ×2'."""
    parts = [part.partition("=") for part in setting.split()]
    values = {name: value for name, _, value in parts if value}
    words = [f"{method} ({form})" if form in ("published", "best") else method]
    if values.get("lod") == "off":
        words.append("full detail")
    elif "lod" in values:
        by_error = {"error": " by error", "halving": " in steps of half", "score": " by score"}.get(values.get("metric"), "")
        words.append(f"{values['lod']} levels{by_error} ×{values.get('thresholds', '1')}")
    rest = [name + sign + value for name, sign, value in parts if name not in ("lod", "metric", "thresholds", "standard")]
    return ", ".join(words + [" ".join(rest)] if rest else words)


def series_of(rows):
    """Sound rows by method and setting, in the order in which they come; each gets a colour (by method) and a marker."""
    series = {}
    for row in rows:
        if not row["fault"]:
            key = (row["method"], row["setting"])
            series.setdefault(key, {"label": label_of(*key, row.get("form", "")), "method": row["method"], "rows": []})["rows"].append(row)
    methods = list(dict.fromkeys(one["method"] for one in series.values()))
    for index, one in enumerate(series.values()):
        one["rows"].sort(key=lambda row: row["samples"])
        one["colour"] = STAND_INS[methods.index(one["method"]) % len(STAND_INS)]
        one["width"] = 1.6
        one["marker"] = MARKERS[index % len(MARKERS)]
    if BASELINE in series:
        series[BASELINE].update(colour=INK, width=2.4)
    return series


def rmse(entry):
    return math.sqrt(entry["mse"])


def flip(entry):
    return entry["flip"]


def number(value, digits):
    return "∞" if value is None else f"{value:.{digits}f}"


def samples_text(row):
    return f"{row['samples']} {'lens samples' if row['takesLensSamples'] else 'pinholes'}"


def time_text(milliseconds):
    return f"{milliseconds / 1000:.3g} s" if milliseconds >= 1000 else f"{milliseconds:.3g} ms"


def results_of(folder, bench):
    """What a bench wrote, or None."""
    try:
        return json.loads((folder / f"{bench}.json").read_text(encoding="utf-8"))
    except FileNotFoundError:
        return None


# ---- plots ----------------------------------------------------------------------------------------------------------


def told(line, texts):
    """Gives each point of a line a text that the page shows when a pointer is on it."""
    figure = line.figure
    figure.told = getattr(figure, "told", [])
    line.set_gid(f"told{len(figure.told)}")
    figure.told.append(list(texts))


def with_told_points(svg, told_lines):
    """The markers of the told lines carry their texts: matplotlib draws them in order, each a <use>."""
    for index, texts in enumerate(told_lines):
        begin = svg.find(f'<g id="told{index}">')
        end = svg.find('<g id="', begin + 1)
        part, left = svg[begin:end], iter(texts)
        part = re.sub(r"<use ", lambda _: f'<use tabindex="0" data-value="{html.escape(next(left, ""))}" ', part)
        svg = svg[:begin] + part + svg[end:]
    return svg


def as_svg(figure, name, description):
    """The figure as SVG inside a page: page colours, ids of its own, a text in its place for those who don't see it."""
    text = io.StringIO()
    figure.savefig(text, format="svg", transparent=True, metadata={"Date": None, "Creator": None})
    plt.close(figure)
    svg = text.getvalue()
    svg = with_told_points(svg[svg.index("<svg"):], getattr(figure, "told", []))
    svg = re.sub(r"<metadata>.*?</metadata>", "", svg, flags=re.S)
    svg = re.sub(r"'DejaVu Sans'[^;\"]*", "system-ui, sans-serif", svg)
    svg = re.sub(r'\bid="', f'id="{name}-', svg)
    svg = re.sub(r'(url\(#|href="#)', rf"\g<1>{name}-", svg)
    svg = svg.replace(INK, "currentColor").replace(GRID, "var(--grid)")
    for index, stand_in in enumerate(STAND_INS):
        svg = svg.replace(stand_in, f"var(--c{index})")
    svg = re.sub(r' (width|height)="[\d.]+pt"', "", svg, count=2)
    return svg.replace("<svg", f'<svg role="img" aria-label="{html.escape(description)}"', 1)


def new_plots(count, right, height, rows=1):
    """Plots beside and below each other as an array of rows; those of a row share their heights."""
    plt.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "defocus", "font.size": 10})
    figure, plots = plt.subplots(rows, count, figsize=(10, height), sharex="col" if rows > 1 else False, sharey="row",
                                 squeeze=False)
    figure.subplots_adjust(left=0.085, right=right, top=0.97, bottom=0.11)
    for axes in plots.flat:
        for spine in axes.spines.values():
            spine.set_color(GRID)
        axes.tick_params(colors=INK, which="both", length=3)
        axes.grid(True, which="major", color=GRID, linewidth=0.8)
        axes.set_axisbelow(True)
        for axis in (axes.xaxis, axes.yaxis):
            axis.label.set_color(INK)
    return figure, plots


def new_plot(right=0.62):
    figure, plots = new_plots(1, right, 5.6)
    return figure, plots[0][0]


def draw_mode(axes, mode, points, size=6):
    """A line of one of MODES; returns its end for label_beside."""
    label, colour = MODES[mode]
    marker = MARKERS[list(MODES).index(mode)]
    line, = axes.plot(*zip(*points), color=STAND_INS[colour], marker=marker, markersize=size,
                      linewidth=1.6 if size > 4 else 1.2)
    told(line, (f"{label}: {x:g}, {y:.4g}" for x, y in points))
    return (*points[-1], label, STAND_INS[colour], marker)


def logarithmic(axis, text):
    axis.set_major_locator(LogLocator(base=10, subs=(1, 2, 5), numticks=20))
    axis.set_major_formatter(FuncFormatter(lambda value, _: text(value)))
    axis.set_minor_formatter(NullFormatter())


def label_beside(axes, ends):
    """Labels in the right margin with their markers, pushed apart, each led to from where its line ends.

    ends: (x, y, text, colour, marker).
    """
    axes.figure.canvas.draw()
    box = axes.get_window_extent()
    step = 15.0
    beside, text_at = 1 + 15 / box.width, 1 + 24 / box.width
    placed = sorted(((axes.transData.transform(end[:2])[1], *end) for end in ends), key=lambda end: end[0])
    heights = []
    for height, *_ in placed:
        heights.append(max(height, heights[-1] + step) if heights else height)
    overflow = max(0.0, heights[-1] - box.y1) if heights else 0.0
    for i in range(len(heights) - 1, -1, -1):  # and down again from the top
        limit = (box.y1 if i + 1 == len(heights) else heights[i + 1] - step) if overflow else heights[i]
        heights[i] = min(heights[i], limit)
    for (_, x, y, text, colour, marker), height in zip(placed, heights):
        share = (height - box.y0) / box.height
        axes.annotate("", xy=(x, y), xycoords="data", xytext=(beside, share), textcoords="axes fraction",
                      annotation_clip=False, arrowprops={"arrowstyle": "-", "color": colour, "linewidth": 0.7,
                                                         "linestyle": ":", "shrinkA": 4, "shrinkB": 4})
        axes.plot([beside], [share], marker, color=colour, markersize=6, transform=axes.transAxes, clip_on=False)
        axes.annotate(text, (text_at, share), xycoords="axes fraction", color=colour, va="center",
                      fontsize=min(9.5, 9.5 * LABEL_LETTERS / len(text)),
                      annotation_clip=False)


def draw_front(axes, rows, error_of):
    front = sorted((row["milliseconds"]["median"], error_of(row)) for row in rows)
    if front:
        axes.step(*zip(*front), where="post", color=INK, linewidth=0.8, alpha=0.55, zorder=1)
        axes.plot(*zip(*front), "o", markersize=12, markerfacecolor="none", markeredgecolor=INK, markeredgewidth=0.9,
                  zorder=4)


def draw_counts(axes, rows, error_of):
    for row in rows:
        axes.annotate(str(row["samples"]), (row["milliseconds"]["median"], error_of(row)), textcoords="offset points",
                      xytext=(0, 9), ha="center", fontsize=8.5, color=INK)


def error_bars(rows, error_of, name):
    """From the least to the most over the seeds; None where each row has one."""
    spreads = [row.get("errorsOverSeeds", {}).get(name) for row in rows]
    if not any(spreads):
        return None
    ends = [(spread["low"], spread["high"]) if spread else (error_of(row),) * 2 for row, spread in zip(rows, spreads)]
    return [[max(0, error_of(row) - low) for row, (low, _) in zip(rows, ends)],
            [max(0, high - error_of(row)) for row, (_, high) in zip(rows, ends)]]


def error_plot(results, series, error_of, name, axis_label, front_key):
    figure, axes = new_plot()
    axes.set_xscale("log")
    axes.set_yscale("log")
    own_error = error_of(results["reference"]["remaining"])
    floors = {(f["method"], f["setting"]): error_of(f) for f in results["biasFloors"]}
    points = [(row, one) for one in series.values() for row in one["rows"] if error_of(row) > 0]
    errors = [error_of(row) for row, _ in points] + [value for value in floors.values() if value > 0]
    if own_error > 0:
        errors.append(own_error)
    axes.set_ylim(min(errors) / 1.6, max(errors) * 1.6)
    most = max(row["milliseconds"]["high"] for row, _ in points)
    axes.set_xlim(min(row["milliseconds"]["low"] for row, _ in points) / 1.4, most * 1.6)

    ends = []
    described = []
    for key, one in series.items():
        rows = [row for row in one["rows"] if error_of(row) > 0]
        if not rows:
            continue
        times = [row["milliseconds"]["median"] for row in rows]
        values = [error_of(row) for row in rows]
        spread = [[row["milliseconds"]["median"] - row["milliseconds"]["low"] for row in rows],
                  [row["milliseconds"]["high"] - row["milliseconds"]["median"] for row in rows]]
        bars = axes.errorbar(times, values, xerr=spread, yerr=error_bars(rows, error_of, name), color=one["colour"],
                             marker=one["marker"], markersize=6, linewidth=one["width"], elinewidth=0.9, zorder=3)
        told(bars[0], (f"{one['label']}, {samples_text(row)}: {value:.4g} in {time_text(time)}"
                       for row, value, time in zip(rows, values, times)))
        end = (times[-1], values[-1])
        if floors.get(key, 0) > 0:
            axes.plot([times[-1], most * 1.6], [floors[key]] * 2, "--", color=one["colour"], linewidth=1.3, zorder=2)
            end = (most * 1.6, floors[key])
        ends.append((*end, one["label"], one["colour"], one["marker"]))
        described.append(f"{one['label']}: {values[0]:.3g} in {time_text(times[0])}"
                         + (f" to {values[-1]:.3g} in {time_text(times[-1])}" if len(rows) > 1 else ""))
    draw_front(axes, [row for row, _ in points if row[front_key]], error_of)
    if BASELINE in series:
        draw_counts(axes, series[BASELINE]["rows"], error_of)
    if own_error > 0:
        axes.axhspan(axes.get_ylim()[0], own_error, facecolor=GRID, alpha=0.45, zorder=0)
        axes.axhline(own_error, color=INK, linewidth=1, linestyle=(0, (1, 2)))
        axes.annotate("below this line: the reference's own error", (0.01, own_error), fontsize=9, color=INK,
                      xycoords=("axes fraction", "data"), textcoords="offset points", xytext=(0, -11))
    logarithmic(axes.xaxis, time_text)
    logarithmic(axes.yaxis, lambda value: f"{value:g}")
    axes.set_xlabel("a frame, wall clock (median; bars: 10 to 90 % of the runs)")
    axes.set_ylabel(axis_label)
    label_beside(axes, ends)
    return as_svg(figure, name, f"{axis_label} against the time of a frame, both logarithmic. " + "; ".join(described))


def speedup_series(rows):
    """(label, rows over the lens samples) of each preset, method and mode."""
    series = {}
    for row in rows:
        if row["sweep"] == "samples":
            series.setdefault(drawn_text(row), []).append(row)
    return [(label, sorted(lines, key=lambda row: row["samples"])) for label, lines in series.items()]


def drawn_text(row, part=""):
    """'jeong2011, fractional levels': what a row of `bench speedup` draws, or a part of it."""
    method = row.get("method", "accumulation")
    drawn = part or (MODES[row["lod"]][0] if method == "accumulation" else method)
    return f"{row['preset']}, {drawn}" if row.get("preset") else drawn


def samples_plot(name, axis_label, lines, text, limits):
    """Values of `bench speedup` against lens samples, lines of (label, [(samples, value)]); empty without any."""
    if not lines:
        return ""
    figure, axes = new_plot(right=0.74)
    axes.set_xscale("log", base=2)
    ends, described = [], []
    for index, (label, points) in enumerate(lines):
        colour, marker = STAND_INS[index % len(STAND_INS)], MARKERS[index % len(MARKERS)]
        drawn, = axes.plot(*zip(*points), color=colour, marker=marker, markersize=6, linewidth=1.6)
        told(drawn, (f"{label}, {samples} samples: {text(value)}" for samples, value in points))
        ends.append((*points[-1], label, colour, marker))
        described.append(f"{label}: {text(points[0][1])} at {points[0][0]} samples, {text(points[-1][1])} at {points[-1][0]}")
    limits(axes)
    axes.set_xticks(sorted({samples for _, points in lines for samples, _ in points}))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.set_xlabel("lens samples")
    axes.set_ylabel(axis_label)
    label_beside(axes, ends)
    return as_svg(figure, name, f"{axis_label} against lens samples. " + "; ".join(described))


def frame_time_plot(rows):
    def limits(axes):
        axes.set_yscale("log")
        logarithmic(axes.yaxis, time_text)
    lines = [(label, [(row["samples"], row["milliseconds"]["median"]) for row in line]) for label, line in speedup_series(rows)]
    return samples_plot("frametimes", "a frame, wall clock", lines, time_text, limits)


def speedup_plot(rows):
    lines = []
    for label, line in speedup_series(rows):
        if all(row["speedUp"] == 1 for row in line):  # full detail itself
            continue
        lines.append((label, [(row["samples"], row["speedUp"]) for row in line]))
        for part, name in (("sizeOnly", "size only"), ("blurOnly", "blur only")):
            points = [(row["samples"], row[part]["speedUp"]) for row in line if row.get(part)]
            lines += [(drawn_text(line[0], name), points)] if points else []
    return samples_plot("speedup", "times as fast as full detail", lines, lambda value: f"{value:.2f}",
                        lambda axes: axes.set_ylim(0, None))


def popping_plot(rows, samples):
    """Frame by frame, a movement beside the other: the pop, the whole change, how fast levels change."""
    kinds = [("stepRmse", "pop, RMSE"), ("changeRmse", "change, RMSE"), ("speed", "levels a frame")]
    movements = list(dict.fromkeys(row["movement"] for row in rows))
    figure, plots = new_plots(len(movements), 0.8, 7.5, len(kinds))
    figure.subplots_adjust(top=0.95, bottom=0.08, wspace=0.06, hspace=0.12)
    described = []
    for (kind, kind_label), line in zip(kinds, plots):
        for axes, movement in zip(line, movements):
            ends = []
            for mode, (label, _) in MODES.items():
                points = sorted((int(row["frame"]), float(row[kind])) for row in rows
                                if (row["movement"], row["lod"]) == (movement, mode))
                if not points or (kind == "speed" and mode != "fractional"):
                    continue
                ends.append(draw_mode(axes, mode, points, 3))
                described.append(f"{movement}, {label}: {kind_label} at most {max(value for _, value in points):.3g}")
        line[0].set_ylim(0, None)
        line[0].set_ylabel(kind_label)
        if kind != "speed":
            label_beside(line[-1], ends)
    for axes, movement in zip(plots[0], movements):
        axes.set_title(movement, color=INK, fontsize=10)
    for axes in plots[-1]:
        axes.set_xlabel("frame")
    return as_svg(figure, "popping", f"Pops frame by frame at {samples} lens samples. " + "; ".join(described))


def scaling_plot(results):
    axes_names = list(dict.fromkeys(row["axis"] for row in results["rows"]))
    units = {"pixels": "pixels", "blur": "blur, px"}
    figure, plots = new_plots(len(axes_names), 0.84, 4.2)
    figure.subplots_adjust(top=0.92, bottom=0.14, wspace=0.08)
    described = []
    for axes, name in zip(plots[0], axes_names):
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_title(name, color=INK, fontsize=10)
        axes.set_xlabel(units.get(name, name))
        ends = []
        for mode, (label, _) in MODES.items():
            points = [(row["value"], row["milliseconds"]["median"]) for row in results["rows"]
                      if (row["axis"], row["lod"]) == (name, mode)]
            if points:
                ends.append(draw_mode(axes, mode, points, 5))
                described.append(f"{name}, {label}: {time_text(points[0][1])} to {time_text(points[-1][1])}")
        axes.xaxis.set_minor_formatter(NullFormatter())
    logarithmic(plots[0][0].yaxis, time_text)
    plots[0][0].set_ylabel("a frame (median)")
    label_beside(plots[0][-1], ends)
    return as_svg(figure, "scaling", "Time of a frame against what grows, both logarithmic. " + "; ".join(described))


# ---- pictures -------------------------------------------------------------------------------------------------------


def data_uri(image, as_jpeg=False):
    data = io.BytesIO()
    if as_jpeg:
        image.convert("RGB").save(data, "JPEG", quality=88)
    else:
        image.save(data, "PNG", optimize=True)
    kind = "jpeg" if as_jpeg else "png"
    return f"data:image/{kind};base64," + base64.b64encode(data.getvalue()).decode()


def crop_of(folder, file, crop):
    """The part of a picture as a data URI; None where the picture is gone."""
    try:
        with Image.open(folder / file) as image:
            x, y = crop["x"], crop["y"]
            return data_uri(image.convert("RGB").crop((x, y, x + crop["width"], y + crop["height"])))
    except OSError:
        return None


def picture(uri, alternative):
    if uri is None:
        return '<div class="gone">no picture</div>'
    return f'<img src="{uri}" width="{CROP_WIDTH}" alt="{html.escape(alternative)}">'


def common_time(series):
    """A time that all methods with several numbers of samples come near to: the middle of what they share, else of all."""
    several = [[row["milliseconds"]["median"] for row in one["rows"]] for one in series.values() if len(one["rows"]) > 1]
    if not several:
        several = [[row["milliseconds"]["median"] for row in one["rows"]] for one in series.values()]
    low, high = max(map(min, several)), min(map(max, several))
    if low > high:
        times = sorted(time for times in several for time in times)
        return times[len(times) // 2]
    return math.sqrt(low * high)


def nearest_row(rows, time):
    return min(rows, key=lambda row: abs(math.log(max(row["milliseconds"]["median"], 1e-6) / time)))


def crop_strip(results, series, folder, crop, time):
    reference = picture(crop_of(folder, results["reference"]["image"], crop), f"reference, {crop['title']}")
    cells = [f'<figure class="crop">{reference}<figcaption><b>reference</b><br>{results["reference"]["samples"]} lens '
             'samples at full detail</figcaption></figure>']
    for one in series.values():
        row = nearest_row(one["rows"], time)
        what = f"{one['label']}, {samples_text(row)}"
        image = picture(crop_of(folder, row["image"], crop), f"{what}, {crop['title']}")
        error = picture(crop_of(folder, row["errorMap"], crop), f"FLIP error of {what}: mean {row['flip']:.4f}")
        cells.append(f'<figure class="crop">{image}{error}<figcaption><b>{html.escape(one["label"])}</b><br>'
                     f'{samples_text(row)}, {time_text(row["milliseconds"]["median"])}<br>'
                     f'RMSE {rmse(row):.4f}<br>FLIP {row["flip"]:.4f}</figcaption></figure>')
    title = html.escape(crop["title"][:1].upper() + crop["title"][1:])
    return f'<h3>{title}</h3><div class="strip">{"".join(cells)}</div>'


def overview(results, folder):
    """The reference with the crops framed."""
    try:
        with Image.open(folder / results["reference"]["image"]) as image:
            uri = data_uri(image, as_jpeg=True)
    except OSError:
        return ""
    width, height = results["width"], results["height"]
    frames = "".join(f'<rect x="{c["x"]}" y="{c["y"]}" width="{c["width"]}" height="{c["height"]}"/>'
                     for c in results["crops"])
    numbers = "".join(f'<text x="{c["x"] + 0.012 * width}" y="{c["y"] + 0.042 * width}">{i}</text>'
                      for i, c in enumerate(results["crops"], 1))
    names = html.escape("; ".join(f"{i}: {c['title']}" for i, c in enumerate(results["crops"], 1)))
    return (f'<figure class="overview"><svg viewBox="0 0 {width} {height}" role="img"><title>The reference; framed: '
            f'{names}</title><image href="{uri}" width="{width}" height="{height}"/>'
            f'<g fill="none" stroke="#fff" stroke-width="{width / 256}">{frames}</g>'
            f'<g fill="#fff" stroke="#000" stroke-width="{width / 128}" paint-order="stroke" font-size="{0.04 * width}">'
            f'{numbers}</g></svg><figcaption>The reference. Framed: {names}.</figcaption></figure>')


def strips_section(folder):
    try:
        strips = json.loads((folder / "strips.json").read_text(encoding="utf-8"))
    except FileNotFoundError:
        return ""
    parts = ["<h2>Known artefacts</h2>"]
    for strip in strips:
        cells = []
        for entry in strip["images"]:
            with Image.open(folder / entry["file"]) as image:
                uri = data_uri(image)
                size = f'width="{image.width}" height="{image.height}"'
            label = html.escape(entry["label"])
            cells.append(f'<figure class="wide"><img src="{uri}" {size} alt="{html.escape(strip["title"])}: {label}">'
                         f"<figcaption>{label}</figcaption></figure>")
        parts.append(f'<h3>{html.escape(strip["title"])}</h3><p>{html.escape(strip["text"])}</p>'
                     f'<div class="pictures">{"".join(cells)}</div>')
    return "".join(parts)


# ---- tables ---------------------------------------------------------------------------------------------------------


def table(header, rows, left=1):
    """`left`: how many columns hold text. A column without a single cell is left out."""
    full = [i for i in range(len(header)) if any(str(row[i]) for row in rows)]
    header, rows = [header[i] for i in full], [[row[i] for i in full] for row in rows]
    head = "".join(f'<th scope="col"{" class=text" if i < left else ""}>{cell}</th>' for i, cell in enumerate(header))
    lines = []
    for row in rows:
        cells = [f'<th scope="row">{row[0]}</th>']
        cells += [f'<td{" class=text" if i < left else ""}>{cell}</td>' for i, cell in enumerate(row[1:], 1)]
        lines.append(f"<tr>{''.join(cells)}</tr>")
    return f'<div class="scroll"><table><thead><tr>{head}</tr></thead><tbody>{"".join(lines)}</tbody></table></div>'


def below_reference(mse, flip):
    """What of a row can't be told from the reference's own error."""
    words = [name for name, below in (("RMSE", mse), ("FLIP", flip)) if below]
    return f"{' and '.join(words)} below the reference’s own error" if words else ""


def front_text(row):
    words = []
    if row["front"]:
        words.append("all")
    elif row["frontOfMethod"]:
        words.append("method")
    if row["frontByFlip"]:
        words.append("FLIP")
    return ", ".join(words)


def note_text(row):
    if row["fault"]:
        return f"<b>{html.escape(row['fault'])}</b>"
    below = below_reference(row.get("mseBelowReference"), row.get("flipBelowReference"))
    return "; ".join(words for words in (front_text(row), below) if words)


def seeds_text(row):
    spread = row.get("errorsOverSeeds", {}).get("rmse")
    return f"{spread['low']:.5f}–{spread['high']:.5f}" if spread else ""


def rows_table(rows):
    header = ["method, setting", "lens samples (or pinholes)", "frame, ms", "10–90 %, ms", "runs", "set-up, ms", "pyramids, ms",
              "RMSE", "over seeds", "PSNR, dB", "SSIM", "FLIP", "bias, PSNR dB", "triangles, millions", "peak, MiB",
              "on the front of; notes"]
    lines = []
    for row in sorted(rows, key=lambda row: (row["method"], row["setting"], row["samples"])):
        time = row["milliseconds"]
        lines.append([
            html.escape(label_of(row["method"], row["setting"], row.get("form", ""))), row["samples"], f"{time['median']:.1f}",
            f"{time['low']:.1f}–{time['high']:.1f}", row["runs"], f"{row['setupMilliseconds']['median']:.0f}",
            f"{row['pyramidMilliseconds']:.0f}", f"{rmse(row):.5f}", seeds_text(row), number(row["psnr"], 2),
            f"{row['ssim']:.4f}", f"{row['flip']:.4f}", number(row["bias"]["psnr"], 2) if row["bias"] else "", f"{row['triangles'] / 1e6:.2f}",
            f"{row['peakBytes'] / 2**20:.0f}", note_text(row)])
    return table(header, lines)


def floors_table(results):
    lines = [[html.escape(label_of(f["method"], f["setting"])), f["samples"], f"{rmse(f):.5f}", number(f["psnr"], 2),
              f"{f['ssim']:.4f}", f"{f['flip']:.4f}"] for f in results["biasFloors"]]
    return table(["method, setting", "at lens samples", "RMSE", "PSNR, dB", "SSIM", "FLIP"], lines) if lines else ""


def equal_error_table(results):
    competitors = results.get("timesToErrors", [])
    if len(competitors) < 2:
        return ""
    first = competitors[0]["times"]

    def cell(time, best):
        if time["milliseconds"] is None:
            return "not reached"
        text = ("under " if time["atMost"] else "") + time_text(time["milliseconds"])
        if time is best or best["milliseconds"] is None or time["atMost"] or best["atMost"]:
            return text
        return f"{text} ({time['milliseconds'] / best['milliseconds']:.2f} times)"

    lines = [[html.escape(c["name"])] + [cell(*pair) for pair in zip(c["times"], first)] for c in competitors]
    return ("<h2>Time to equal error</h2>" +
            table(["each with its best settings"] + [f"RMSE {time['rmse']:g}" for time in first], lines) +
            "<p>A frame's time, between measured rows by a power law; beside it, how many times the first row's.</p>")


def subject_table(results):
    lens, reference = results["lens"], results["reference"]
    remaining = reference["remaining"]
    lens_text = (f"{lens['focalLength']:g} mm, f/{lens['fStop']:g}, focused at {lens['focusDistance']:g} m"
                 if lens["focusDistance"] else f"{lens['focalLength']:g} mm, f/{lens['fStop']:g}, focused at infinity")
    return facts(results | {"scene": ""}, [
        ["scene", f"{results['scene']}; camera “{results['camera']}”, {lens_text}; {results['width']} × {results['height']} px"],
        ["reference", f"{reference['samples']} lens samples at full detail from number {reference['firstSample']} of their "
                      f"sequence on, 32-bit layers; hash {reference['hash']}; {reference['milliseconds'] / 1000:.1f} s"
                      f"{', kept from an earlier run' if reference['reused'] else ''}. Its own remaining error, from its two "
                      f"halves: RMSE {rmse(remaining):.5f}, PSNR {number(remaining['psnr'], 2)} dB, FLIP {remaining['flip']:.4f}"],
        ["errors", results["errorsMeasuredOn"]],
    ])


def optional(row, name):
    return f"{row[name]:.0f}" if name in row else ""


def spread_text(time):
    return f"{time['low']:.1f}–{time['high']:.1f}"


def differences(difference):
    """PSNR, SSIM, FLIP as cells."""
    if difference is None:
        return ["", "", ""]
    return [number(difference["psnr"], 1), f"{difference['ssim']:.4f}", f"{difference['flip']:.4f}"]


def facts(results, more=()):
    """What a bench was run on and with."""
    machine = results["machine"]
    lines = [["scene", f"{results['scene']}, {results['width']} × {results['height']} px"]] if results.get("scene") else []
    lines += [["runs", f"{results['runs']} of each; medians"]] if results.get("runs") else []
    lines += [["held equal", results["heldEqual"]]] if "heldEqual" in results else []
    lines += more
    lines += [
        ["program", f"{results['program']}, commit {results['commit'] or 'unknown'}"],
        ["device", f"{results['device']}; driver {results['driver']}"],
        ["machine", f"{machine['processor'] or 'unknown processor'}, {machine['threads']} threads, "
                    f"{machine['memoryBytes'] / 2**30:.1f} GiB; {machine['system']}"],
    ]
    rows = "".join(f'<tr><th scope="row">{name}</th><td class="text">{html.escape(text)}</td></tr>' for name, text in lines)
    commands = "".join(f"<pre>{html.escape(command)}</pre>" for command in results["commands"])
    return (f'<table class="facts"><tbody>{rows}<tr><th scope="row">commands</th><td class="text">{commands}</td></tr>'
            "</tbody></table>")


# ---- page -----------------------------------------------------------------------------------------------------------


def style():
    light = "".join(f"--c{i}:{pair[0]};" for i, pair in enumerate(PALETTE))
    dark = "".join(f"--c{i}:{pair[1]};" for i, pair in enumerate(PALETTE))
    return f"""
:root {{ color-scheme: light dark; --page:#fff; --ink:#1c1e21; --soft:#565b62; --grid:#d8dce1; --band:#f4f5f7; {light} }}
@media (prefers-color-scheme: dark) {{
  :root {{ --page:#15171a; --ink:#e9ebee; --soft:#a8aeb6; --grid:#3a3f46; --band:#1e2125; {dark} }}
}}
* {{ box-sizing: border-box; }}
body {{ margin: 0 auto; padding: 2rem 1.2rem 4rem; max-width: 80rem; background: var(--page); color: var(--ink);
  font: 16px/1.5 system-ui, sans-serif; }}
h1 {{ margin: 0; font-size: 1.9rem; line-height: 1.2; }}
h2 {{ margin: 3rem 0 .6rem; font-size: 1.35rem; }}
h3 {{ margin: 1.6rem 0 .5rem; font-size: 1.05rem; }}
p {{ max-width: 46rem; }}
.lead, figcaption {{ color: var(--soft); }}
figure {{ margin: 0; }}
figure.plot {{ overflow-x: auto; }}
figure.plot svg {{ width: 100%; min-width: 44rem; height: auto; display: block; }}
figcaption, li {{ font-size: .85rem; line-height: 1.35; }}
figure.plot figcaption {{ max-width: 46rem; margin-top: .4rem; }}
figure.overview svg {{ width: 100%; max-width: 40rem; height: auto; display: block; }}
.strip {{ display: flex; flex-wrap: wrap; gap: 1.1rem .9rem; }}
.crop {{ width: {CROP_WIDTH}px; }}
.crop img, .gone {{ display: block; width: {CROP_WIDTH}px; image-rendering: pixelated; margin-bottom: 3px; }}
.gone {{ height: 4rem; background: var(--band); text-align: center; padding-top: 1.2rem; }}
.pictures {{ display: grid; grid-template-columns: repeat(auto-fill, minmax(18rem, 1fr)); gap: 12px; }}
.pictures figure {{ margin: 0; }}
.wide img {{ display: block; max-width: 100%; height: auto; margin-bottom: 3px; }}
.scroll {{ overflow-x: auto; }}
.scroll, .facts {{ margin-top: 1rem; }}
table {{ border-collapse: collapse; font-size: .82rem; font-variant-numeric: tabular-nums; }}
th, td {{ padding: .28rem .42rem; text-align: right; border-bottom: 1px solid var(--grid); vertical-align: top; }}
thead th {{ vertical-align: bottom; background: var(--band); }}
th:first-child, .text {{ text-align: left; }}
tbody th {{ font-weight: normal; }}
.scroll table {{ font-size: .76rem; }}
.scroll th, .scroll td {{ padding: .28rem .26rem; }}
thead th {{ hyphens: auto; }}
.scroll tbody th {{ min-width: 8rem; }}
.facts th {{ color: var(--soft); }}
thead th {{ cursor: pointer; }}
thead th[aria-sort=ascending]::after {{ content: " ↑"; }}
thead th[aria-sort=descending]::after {{ content: " ↓"; }}
.scroll th:first-child {{ position: sticky; left: 0; background: var(--page); }}
.scroll thead th:first-child {{ background: var(--band); }}
.headline {{ font-size: 1.2rem; margin: .6rem 0; }}
nav ul {{ display: flex; flex-wrap: wrap; gap: .2rem 1.2rem; padding: 0; list-style: none; }}
a {{ color: var(--c0); }}
[data-value] {{ cursor: help; }}
#tip {{ position: fixed; max-width: min(24rem, 92vw); padding: .25rem .5rem; border-radius: 4px; background: var(--ink);
  color: var(--page); font-size: .82rem; pointer-events: none; }}
@media (max-width: 40rem) {{
  body {{ padding: 1rem .8rem 3rem; }}
  figure.plot svg {{ min-width: 0; }}
  figure.plot.large svg {{ min-width: 44rem; }}
  .facts th {{ min-width: 0; }}
  .facts, .facts tbody, .facts tr, .facts th, .facts td {{ display: block; }}
  .facts th {{ border: 0; padding-bottom: 0; }}
}}
pre {{ margin: 0 0 .3rem; white-space: pre-wrap; overflow-wrap: anywhere; font-size: .8rem; }}
"""


def convergence_section(results, folder, extra):
    series = series_of(results["rows"])
    if not series:
        sys.exit(f"report.py: {folder / 'results.json'}: holds no rows")
    time = common_time(series)
    own = results["reference"]["remaining"]
    parts = [
        "<h2>Error against run time</h2>",
        '<p>Each line is a method with one setting; along it the number of lens samples grows. Rings: no other row is both '
        'as fast and as close (the Pareto front). A dashed line at the right is a bias floor: however many more lens samples '
        'these thresholds get, the image comes no closer to full detail. Numbers: lens samples of accumulation at full '
        f'detail. Nothing can be read below the reference’s own error (RMSE {rmse(own):.5f}, FLIP {own["flip"]:.4f}).</p>',
        "<h3>RMSE</h3>", f'<figure class="plot">{error_plot(results, series, rmse, "rmse", "RMSE from the reference", "front")}'
        "<figcaption>Root mean square difference on display-encoded values. Set-up is not in these times: see the table."
        "</figcaption></figure>",
        "<h3>FLIP</h3>", f'<figure class="plot">{error_plot(results, series, flip, "flip", "mean FLIP from the reference", "frontByFlip")}'
        "<figcaption>FLIP weighs what a person sees when the two images alternate: ghosts and bands that RMSE hides."
        "</figcaption></figure>",
        "<h3>Pictures at about equal time</h3>",
        f"<p>Of each line the frame nearest to {time_text(time)}; below it FLIP, from 0 (black) to "
        f"{results['errorMapFullScale']:g} and more (pale yellow).</p>",
        overview(results, folder)]
    parts += [crop_strip(results, series, folder, crop, time) for crop in results["crops"]]
    parts += [equal_error_table(results), strips_section(extra), "<h3>Bias floors</h3>",
              "<p>The difference between the image with levels and the one at full detail, at the same lens samples, so that "
              "sampling noise cancels; at the largest number measured. The standard thresholds shrink as samples grow, so "
              "that the floor sinks with them; with these thresholds held, it stays.</p>",
              floors_table(results) or "<p>No levels were measured.</p>",
              "<h3>All rows</h3>", rows_table(results["rows"]),
              "<p>Set-up is what a renderer takes before its first frame; pyramids are simplified once for a scene and kept "
              "on disk by other commands. Neither is part of a frame’s time. Bias: difference from full detail at the same "
              "lens samples.</p>"]
    if results["leftOut"]:
        entries = "".join(f"<li>{html.escape(label_of(e['method'], e['setting']))}: {html.escape(e['reason'])}</li>"
                          for e in results["leftOut"])
        parts.append(f"<h3>Left out</h3><ul>{entries}</ul>")
    return parts + ["<h3>How it was measured</h3>", subject_table(results)]


def time_at_error(rows, error):
    """When rows of one line of samples reach an error, ms, by power laws between them; None beyond what was measured."""
    points = sorted((row["fromReference"]["rmse"], row["milliseconds"]["median"]) for row in rows if row["fromReference"])
    for (low, slow), (high, fast) in zip(points, points[1:]):
        if low <= error <= high:
            share = math.log(error / low) / math.log(high / low) if high > low else 0
            return slow * (fast / slow) ** share
    return next((time for rmse, time in points if rmse == error), None)


def equal_error_speedup(row, rows):
    """How many times as fast as full detail with as many samples as it needs for the row's own error."""
    if not row["fromReference"]:
        return None
    full = [other for other in rows if other["lod"] == "off" and other["sweep"] == "samples" and
            all(other.get(name) == row.get(name) for name in ("fStop", "focusDistance"))]
    time = time_at_error(full, row["fromReference"]["rmse"])
    return time / row["milliseconds"]["median"] if time else None


def speedup_headline(results):
    """What the section comes to, of the row whose number of samples is nearest to 64."""
    rows = [row for row in results["rows"] if row["sweep"] == "samples" and row["lod"] == "fractional" and not row.get("preset")]
    if not rows:
        return ""
    row = min(rows, key=lambda row: abs(math.log(row["samples"] / 64)))
    equal = equal_error_speedup(row, results["rows"])
    text = f"Levels are {row['speedUp']:.2f} times as fast as full detail at equal N ({row['samples']} lens samples)"
    return text + (f", and {equal:.2f} times at equal error." if equal else "; at equal error: not measured.")


def reference_cells(row):
    truth, own = row["fromReference"], row.get("referenceRemaining")
    if truth is None or own is None:
        return [""]
    return [f"{row['referenceSamples']} samples<br>{below_reference(truth['rmse'] < own['rmse'], truth['flip'] < own['flip'])}"]


def speedup_section(results):
    truths = [(key, name) for key, name in (("fromFullDetail", "full detail"), ("fromReference", "the reference"))
              if any(row[key] for row in results["rows"])]
    lines = []
    for row in results["rows"]:
        time = row["milliseconds"]
        parts = [f"{row[part]['speedUp']:.2f}" if row.get(part) else "" for part in ("sizeOnly", "blurOnly")]
        equal = equal_error_speedup(row, results["rows"])
        lines.append([html.escape(drawn_text(row)), row["samples"], f"{row['fStop']:g}", f"{row['focusDistance']:.3g}",
                      f"{time['median']:.1f}<br>{spread_text(time)}", f"{row['speedUp']:.2f}",
                      "—" if equal is None else f"{equal:.2f}", *parts, f"{row['triangles'] / 1e6:.2f}",
                      f"{row['gpuBytes'] / 2**20:.0f}", optional(row, "setupMilliseconds"), optional(row, "pyramidMilliseconds")]
                     + [cell for key, _ in truths for cell in differences(row[key])]
                     + [seeds_text(row)] + reference_cells(row))
    header = ["levels", "lens samples", "f-number", "focus, m", "frame, ms; 10–90 %", "times as fast at equal N",
              "at equal error", "size only", "blur only", "triangles, millions", "GPU, MiB", "set-up, ms", "pyramids, ms"] + [
                  f"{name} from {truth}" for _, truth in truths for name in ("PSNR, dB,", "SSIM", "FLIP")] + [
                  "RMSE from the reference over seeds", "the reference"]
    captions = [(frame_time_plot(results["rows"]), "Time of a frame, both axes logarithmic (Figure 2 of Jeong, Kim and Lee 2011)."),
                (speedup_plot(results["rows"]), "Frame time at full detail over frame time with levels, at equal N: the same lens "
                 f"samples, but another error. {speedup_headline(results)} The table has both for each row. "
                 "Size only: with a blur threshold of 0; blur only: with a size threshold of 0.")]
    figures = [f'<figure class="plot">{plot}<figcaption>{caption}</figcaption></figure>' for plot, caption in captions if plot]
    return ["<h2>Speed-up</h2>", *figures, table(header, lines),
            "<p>Times as fast as full detail: at equal N, with the same number of lens samples; at equal error, with as many as "
            "full detail needs to come as close to the reference (RMSE), its time between measured rows by a power law; —: that "
            f"error lies beyond what was measured, or there is no reference. Times are medians of {results['runs']} runs, each "
            "with its 10th and 90th percentile; errors from the reference are means over the seeds of the lens samples, each "
            "with its least and most.</p>", facts(results)]


def popping_section(results, path):
    with open(path, newline="", encoding="utf-8") as file:
        frames = list(csv.DictReader(file))
    samples = max(int(row["samples"]) for row in frames)
    plot = popping_plot([row for row in frames if int(row["samples"]) == samples], samples)
    lines = []
    for row in results["rows"]:
        line = [row["movement"], MODES[row["lod"]][0], row["samples"], f"{row['largestSpeed']:.4f}"]
        for name in ("stepRmse", "stepFlip", "changeRmse", "changeFlip"):
            error = row[name]
            line += [f"{error['worst']:.5f}", f"{error['percentile99']:.5f}",
                     "" if error["ofNearest"] is None else f"{error['ofNearest']:.2f}"]
        lines.append(line)
    header = ["movement", "levels", "lens samples", "levels a frame"] + [
        f"{name}, {what}" for name in ("pop, RMSE", "pop, FLIP", "change, RMSE", "change, FLIP")
        for what in ("worst", "99 %", "of nearest’s")]
    text = "".join(f"<li>{name}: {html.escape(what)}</li>" for name, what in results["definitions"].items())
    return ["<h2>Popping</h2>", f'<figure class="plot">{plot}<figcaption>{samples} lens samples. Pop: the frame against the same '
            "view at the levels of the frame before. Change: what the step from frame to frame differs from the reference’s by, "
            "which also holds what coarse levels get wrong that moves with the camera. Display-encoded values, over the objects’ "
            "pixels.</figcaption></figure>", table(header, lines, 2), f"<ul>{text}</ul>", facts(results)]


def scaling_section(results):
    def fitted(fit):
        return f"{fit['exponent']:.2f} ± {fit['residual']:.2f}" if fit else ""
    curves = [[curve["axis"], MODES[curve["lod"]][0], fitted(curve["time"]), fitted(curve["gpuMemory"]),
               html.escape(curve["bounds"])] for curve in results["curves"]]
    rows = [[row["axis"], MODES[row["lod"]][0], f"{row['value']:g}", row["samples"], f"{row['width']} × {row['height']}",
             f"{row['milliseconds']['median']:.1f}", spread_text(row["milliseconds"]), f"{row['layersMilliseconds']:.1f}",
             f"{row['verticesMilliseconds']:.1f}", f"{row['fillMilliseconds']:.1f}", f"{row['triangles'] / 1e6:.2f}",
             f"{row['gpuBytes'] / 2**20:.0f}", f"{row['pyramidBytes'] / 2**20:.0f}"] for row in results["rows"]]
    return ["<h2>Scaling</h2>", f'<figure class="plot">{scaling_plot(results)}<figcaption>Time of a frame, both axes '
            "logarithmic.</figcaption></figure>",
            table(["what grows", "levels", "exponent of time", "of GPU memory", "bound by"], curves, 2),
            table(["what grows", "levels", "value", "lens samples", "pixels", "frame, ms", "10–90 %, ms", "layers, ms",
                   "vertices, ms", "fill, ms", "triangles, millions", "GPU, MiB", "pyramids, MiB"], rows, 2),
            facts(results, [["parts", results["parts"]]])]


def verdict(case):
    if case.get("leftOut"):
        return "left out: needs the ray tracer"
    if case["limit"] is None:
        return "for comparison"
    return "within" if case["passed"] else "<b>beyond</b>"


def honesty_cells(row):
    if row.get("leftOut"):
        return [html.escape(row["method"]), "", "", "", "", "", f"left out: {html.escape(row['leftOut'])}"]
    return [html.escape(row["method"]), html.escape(row["varied"]), f"{row['expectedDiameter']:.2f}",
            f"{row['measuredDiameter']:.2f}", f"{row['measuredDiameter'] - row['expectedDiameter']:+.2f}",
            f"{row['energy']:.4f}", "follows" if row.get("followsLens") else "differs"]


def stability_section(results):
    cases = [[html.escape(case["area"]), html.escape(case["case"]), html.escape(case["errorOf"]), html.escape(case["against"]),
              "" if case["limit"] is None else f"{case['limit']:.3g}",
              "" if case.get("leftOut") else "∞" if case["error"] is None else f"{case['error']:.3g}", verdict(case)]
             for case in results["cases"]]
    honesty = [honesty_cells(row) for row in results["lensHonesty"]]
    return ["<h2>Stiff and extreme cases</h2>",
            table(["area", "case", "error", "against", "limit", "measured", "verdict"], cases, 4),
            "<h3>Blur against the lens</h3>",
            "<p>The disk of a point of light: its diameter by the formula and as each method shows it, and its energy over that "
            "of the point in focus. What differs by more than 0.5 px or 5 % of the energy is the method's own.</p>",
            table(["method", "varied", "expected, px", "measured, px", "off by, px", "energy", "verdict"], honesty, 2), facts(results)]


# Sorting by a click on a column's head; the value of a point under the pointer or the finger.
SCRIPT = r"""
for (const table of document.querySelectorAll('.scroll table')) {
  const heads = table.tHead.rows[0].cells, body = table.tBodies[0];
  const value = (row, i) => { const text = row.cells[i].textContent, n = parseFloat(text.replace(/^under /, ''));
    return ['', '—', '∞', 'not reached'].includes(text) ? Infinity : isNaN(n) ? text : /^[^a-z]* s\b/.test(text) ? 1000 * n : n; };
  [...heads].forEach((head, i) => {
    const sort = () => {
      const up = head.getAttribute('aria-sort') !== 'ascending';
      for (const each of heads) each.removeAttribute('aria-sort');
      head.setAttribute('aria-sort', up ? 'ascending' : 'descending');
      const order = (a, b) => typeof a === 'number' && typeof b === 'number' ? (a === b ? 0 : a - b) : String(a).localeCompare(String(b));
      body.append(...[...body.rows].sort((a, b) => (up ? 1 : -1) * order(value(a, i), value(b, i))));
    };
    head.tabIndex = 0;
    head.addEventListener('click', sort);
    head.addEventListener('keydown', event => { if (event.key === 'Enter') sort(); });
  });
}
const tip = document.getElementById('tip');
const show = event => {
  const text = event.target.dataset && event.target.dataset.value;
  tip.hidden = !text;
  if (!text) return;
  tip.textContent = text;
  const box = event.target.getBoundingClientRect();
  tip.style.left = Math.max(4, Math.min(box.left, innerWidth - tip.offsetWidth - 4)) + 'px';
  tip.style.top = Math.max(4, box.top - tip.offsetHeight - 6) + 'px';
};
for (const kind of ['pointerover', 'focusin', 'pointerdown']) document.addEventListener(kind, show);
addEventListener('scroll', () => tip.hidden = true, true);
// On a phone a plot fits the screen, and a tap makes it large enough to read.
for (const plot of document.querySelectorAll('figure.plot'))
  plot.addEventListener('click', event => event.target.dataset.value || plot.classList.toggle('large'));
"""

# The results of benches and what else they write, by section.
FILES = {"results": ["results.json", "results.csv", "runs.csv"], "speedup": ["speedup.json", "speedup.csv"],
         "popping": ["popping.json", "popping.csv"], "scaling": ["scaling.json", "scaling.csv"],
         "stability": ["stability.json", "stability.csv"]}


def contents(parts):
    """The parts with a name for each heading, and a list of links to them."""
    links = []

    def named(match):
        name = re.sub(r"[^a-z]+", "-", match[1].lower()).strip("-")
        links.append(f'<li><a href="#{name}">{match[1]}</a></li>')
        return f'<h2 id="{name}">{match[1]}</h2>'
    text = re.sub(r"<h2>(.*?)</h2>", named, "".join(parts))
    return f'<nav aria-label="Contents"><ul>{"".join(links)}</ul></nav>', text


def headline(folder, report):
    """The one sentence that the page comes to."""
    results = results_of(report, "speedup")
    text = speedup_headline(results) if results else ""
    if text:
        return text
    results = results_of(folder, "results")
    competitors = (results or {}).get("timesToErrors", [])
    times = [[time["milliseconds"] for time in one["times"]] for one in competitors]
    for i in reversed(range(len(times[0]) if times else 0)):
        reached = [(one[i], name["name"]) for one, name in zip(times, competitors) if one[i]]
        if len(reached) > 1:
            fastest, slowest = min(reached), max(reached)
            error = competitors[0]["times"][i]["rmse"]
            return (f"An RMSE of {error:g} takes {time_text(fastest[0])} by {html.escape(fastest[1])} and "
                    f"{time_text(slowest[0])} by {html.escape(slowest[1])}.")
    return ""


def measured_with(folder, report):
    """Program and commit of the first results, for the head of the page and the citation."""
    for place, bench in ((folder, "results"), (report, "speedup"), (report, "popping"), (report, "scaling"), (report, "stability")):
        if results := results_of(place, bench):
            return results["program"], results["commit"] or "unknown commit"
    return "defocus", "unknown commit"


def downloads(folder, report):
    names = [name for files in FILES.values() for name in files if (report / name).exists()]
    if not names:
        return ""
    links = ", ".join(f'<a href="{name}">{name}</a>' for name in names)
    return f"<p>Data beside this page: {links}.</p>"


def citation(program, commit, year):
    version = program.split()[-1]
    entry = (f"@software{{defocus,\n  title = {{defocus: depth of field of a real lens}},\n"
             f"  author = {{{{the defocus authors}}}},\n  version = {{{version}}},\n  year = {{{year}}},\n"
             f"  note = {{commit {commit}}}\n}}")
    return f"<h2>Citation</h2><pre>{html.escape(entry)}</pre>"


def sections(folder, report):
    """Of all that there are results of."""
    parts = []
    if results := results_of(folder, "results"):
        parts += convergence_section(results, folder, report)
    if results := results_of(report, "speedup"):
        parts += speedup_section(results)
    if (report / "popping.csv").exists() and (results := results_of(report, "popping")):
        parts += popping_section(results, report / "popping.csv")
    if results := results_of(report, "scaling"):
        parts += scaling_section(results)
    if results := results_of(report, "stability"):
        parts += stability_section(results)
    return parts


def page(parts, folder, report):
    now = datetime.datetime.now(datetime.timezone.utc)
    program, commit = measured_with(folder, report)
    links, text = contents(parts + [citation(program, commit, now.year)])
    sentence = headline(folder, report)
    return (f'<!doctype html>\n<html lang="en"><head><meta charset="utf-8"><meta name="viewport" '
            f'content="width=device-width, initial-scale=1"><title>defocus bench</title><style>{style()}</style></head><body>'
            f'<main><h1>defocus bench</h1>{f"<p class=headline>{sentence}</p>" if sentence else ""}<p class="lead">'
            f"{html.escape(program)}, commit {html.escape(commit)}; drawn {now:%Y-%m-%d %H:%M} UTC. Tables are sorted by a "
            f"click on a column’s head; points of plots tell their values.</p>{links}{downloads(folder, report)}"
            f'{text}</main><div id="tip" role="status" hidden></div><script>{SCRIPT}</script></body></html>\n')


def remove_abandoned(path):
    """Goes unless somebody is writing it."""
    try:
        with open(path, "rb") as file:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            path.unlink()
    except OSError:
        pass


def write_whole(path, text):
    """The file appears whole or not at all; what a run that was killed has left in the making goes."""
    prefix = f".{path.name}."
    for left in path.parent.glob(f"{prefix}*"):
        remove_abandoned(left)
    with tempfile.NamedTemporaryFile("w", encoding="utf-8", dir=path.parent, prefix=prefix, delete=False) as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            pass  # a file system without locks: nobody else gets one either
        file.write(text)
        file.flush()
        os.fsync(file.fileno())
        os.chmod(file.name, 0o644)
        os.replace(file.name, path)


def main(arguments):
    if len(arguments) not in (1, 2):
        sys.exit("usage: report.py RESULTS [REPORT]")
    folder = Path(arguments[0])
    report = Path(arguments[-1])
    try:
        parts = sections(folder, report)
    except (OSError, ValueError, KeyError) as fault:
        sys.exit(f"report.py: the results in {folder} can't be read: {fault!r}")
    if not parts:
        sys.exit(f"report.py: there are no results in {folder}")
    write_whole(report / "index.html", page(parts, folder, report))


if __name__ == "__main__":
    main(sys.argv[1:])
