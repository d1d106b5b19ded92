"""Draws the plots in the sections of the report."""

from matplotlib.ticker import NullFormatter

from figures.rows import MODES, drawn_text, label_of, median, samples_text, time_text
from figures.report_svg import COLOURS, GRID, INK, MARKERS
from figures.report_svg import add_tooltips, as_svg, label_beside, logarithmic, new_plots, plain_ticks

BASELINE = ("accumulation", "lod=off")


# ---- convergence ----------------------------------------------------------------------------------------------------


def series_of(rows):
    """Groups valid rows by (method, setting). Each method gets a colour, each group a marker."""
    series = {}
    for row in rows:
        if not row["fault"]:
            key = (row["method"], row["setting"])
            series.setdefault(key, {"label": label_of(row), "rows": []})["rows"].append(row)
    methods = list(dict.fromkeys(method for method, _ in series))
    for index, ((method, _), one) in enumerate(series.items()):
        one["rows"].sort(key=lambda row: row["samples"])
        one.update(colour=COLOURS[methods.index(method) % len(COLOURS)], width=1.6, marker=MARKERS[index % len(MARKERS)])
    if BASELINE in series:
        series[BASELINE].update(colour=INK, width=2.4)
    return series


def draw_front(axes, rows, error_of):
    front = sorted((median(row), error_of(row)) for row in rows)
    if front:
        axes.step(*zip(*front), where="post", color=INK, linewidth=0.8, alpha=0.55, zorder=1)
        axes.plot(*zip(*front), "o", markersize=12, markerfacecolor="none", markeredgecolor=INK, markeredgewidth=0.9,
                  zorder=4)


def draw_counts(axes, rows, error_of):
    for row in rows:
        axes.annotate(str(row["samples"]), (median(row), error_of(row)), textcoords="offset points", xytext=(0, 9), ha="center",
                      fontsize=8.5, color=INK)


def draw_own_error(axes, error):
    """Marks the range of errors below the reference's own error."""
    axes.axhspan(axes.get_ylim()[0], error, facecolor=GRID, alpha=0.45, zorder=0)
    axes.axhline(error, color=INK, linewidth=1, linestyle=(0, (1, 2)))
    axes.annotate("below this line: the reference's own error", (0.01, error), fontsize=9, color=INK,
                  xycoords=("axes fraction", "data"), textcoords="offset points", xytext=(0, -11))


def bars(values, spreads):
    """Returns the lengths of the error bars below and above each value. spreads: a range (low, high) for each value."""
    return [[max(0, value - low) for value, (low, _) in zip(values, spreads)],
            [max(0, high - value) for value, (_, high) in zip(values, spreads)]]


def draw_series(axes, one, rows, error_of, name):
    """Draws a line with error bars (times over runs, errors over seeds). Returns the times and errors of its points."""
    times, errors = [median(row) for row in rows], [error_of(row) for row in rows]
    over_runs = [(row["milliseconds"]["low"], row["milliseconds"]["high"]) for row in rows]
    over_seeds = [row.get("errorsOverSeeds", {}).get(name) for row in rows]
    seed_bars = bars(errors, [(spread["low"], spread["high"]) if spread else (error, error)
                              for spread, error in zip(over_seeds, errors)]) if any(over_seeds) else None
    drawn = axes.errorbar(times, errors, xerr=bars(times, over_runs), yerr=seed_bars, color=one["colour"], marker=one["marker"],
                          markersize=6, linewidth=one["width"], elinewidth=0.9, zorder=3)
    add_tooltips(drawn[0], (f"{one['label']}, {samples_text(row)}: {error:.4g} in {time_text(time)}"
                            for row, error, time in zip(rows, errors, times)))
    return times, errors


def error_plot(results, series, error_of, name, axis_label, front_key):
    figure, ((axes,),) = new_plots(1, 0.62, 5.6)
    axes.set_xscale("log")
    axes.set_yscale("log")
    own_error = error_of(results["reference"]["remaining"])
    floors = {(floor["method"], floor["setting"]): error_of(floor) for floor in results["biasFloors"]}
    drawn = {key: [row for row in one["rows"] if error_of(row) > 0] for key, one in series.items()}
    rows = [row for rows in drawn.values() for row in rows]
    errors = [error for error in (*map(error_of, rows), *floors.values(), own_error) if error > 0]
    axes.set_ylim(min(errors) / 1.6, max(errors) * 1.6)
    highest = max(row["milliseconds"]["high"] for row in rows)
    axes.set_xlim(min(row["milliseconds"]["low"] for row in rows) / 1.4, highest * 1.6)

    ends, described = [], []
    for key, one in series.items():
        if not drawn[key]:
            continue
        times, errors = draw_series(axes, one, drawn[key], error_of, name)
        end = (times[-1], errors[-1])
        if floors.get(key, 0) > 0:
            axes.plot([times[-1], highest * 1.6], [floors[key]] * 2, "--", color=one["colour"], linewidth=1.3, zorder=2)
            end = (highest * 1.6, floors[key])
        ends.append((*end, one["label"], one["colour"], one["marker"]))
        described.append(f"{one['label']}: {errors[0]:.3g} in {time_text(times[0])}"
                         + (f" to {errors[-1]:.3g} in {time_text(times[-1])}" if len(times) > 1 else ""))
    draw_front(axes, [row for row in rows if row[front_key]], error_of)
    if BASELINE in series:
        draw_counts(axes, series[BASELINE]["rows"], error_of)
    if own_error > 0:
        draw_own_error(axes, own_error)
    logarithmic(axes.xaxis, time_text)
    logarithmic(axes.yaxis, lambda value: f"{value:g}")
    axes.set_xlabel("a frame, wall clock (median; bars: 10 to 90 % of the runs)")
    axes.set_ylabel(axis_label)
    label_beside(axes, ends)
    return as_svg(figure, name, f"{axis_label} against the time of a frame, both logarithmic. " + "; ".join(described))


# ---- speed-up -------------------------------------------------------------------------------------------------------


def samples_plot(name, axis_label, lines, text, scale):
    """Plots lines of (label, [(samples, value)]) as SVG; returns an empty text if there are no lines."""
    if not lines:
        return ""
    figure, ((axes,),) = new_plots(1, 0.74, 5.6)
    axes.set_xscale("log", base=2)
    ends, described = [], []
    for index, (label, points) in enumerate(lines):
        colour, marker = COLOURS[index % len(COLOURS)], MARKERS[index % len(MARKERS)]
        drawn, = axes.plot(*zip(*points), color=colour, marker=marker, markersize=6, linewidth=1.6)
        add_tooltips(drawn, (f"{label}, {samples} samples: {text(value)}" for samples, value in points))
        ends.append((*points[-1], label, colour, marker))
        described.append(f"{label}: {text(points[0][1])} at {points[0][0]} samples, {text(points[-1][1])} at {points[-1][0]}")
    axes.set_yscale(scale)
    if scale == "log":
        logarithmic(axes.yaxis, text)
    else:
        axes.set_ylim(0, None)
    axes.set_xticks(sorted({samples for _, points in lines for samples, _ in points}))
    plain_ticks(axes.xaxis)
    axes.set_xlabel("lens samples")
    axes.set_ylabel(axis_label)
    label_beside(axes, ends)
    return as_svg(figure, name, f"{axis_label} against lens samples. " + "; ".join(described))


def speedup_series(rows):
    """Returns [(label, rows sorted by lens samples)] for each preset, method and level mode."""
    series = {}
    for row in rows:
        if row["sweep"] == "samples":
            series.setdefault(drawn_text(row), []).append(row)
    return [(label, sorted(lines, key=lambda row: row["samples"])) for label, lines in series.items()]


def frame_time_plot(rows):
    lines = [(label, [(row["samples"], median(row)) for row in line]) for label, line in speedup_series(rows)]
    return samples_plot("frametimes", "a frame, wall clock", lines, time_text, "log")


def speedup_plot(rows):
    lines = []
    for label, line in speedup_series(rows):
        if all(row["speedUp"] == 1 for row in line):  # skip full detail, whose speed-up is 1 by definition
            continue
        lines.append((label, [(row["samples"], row["speedUp"]) for row in line]))
        for part, name in (("sizeOnly", "size only"), ("blurOnly", "blur only")):
            points = [(row["samples"], row[part]["speedUp"]) for row in line if row.get(part)]
            lines += [(drawn_text(line[0], name), points)] if points else []
    return samples_plot("speedup", "times as fast as full detail", lines, lambda value: f"{value:.2f}", "linear")


# ---- popping and scaling --------------------------------------------------------------------------------------------


def draw_modes(axes, points_of, size):
    """Draws a line for each level mode that has points. Returns [(label, points, argument for label_beside)]."""
    drawn = []
    for index, (mode, (label, colour)) in enumerate(MODES.items()):
        if points := points_of(mode):
            line, = axes.plot(*zip(*points), color=COLOURS[colour], marker=MARKERS[index], markersize=size,
                              linewidth=1.6 if size > 4 else 1.2)
            add_tooltips(line, (f"{label}: {x:g}, {y:.4g}" for x, y in points))
            drawn.append((label, points, (*points[-1], label, COLOURS[colour], MARKERS[index])))
    return drawn


def popping_plot(rows, samples):
    """Plots pops, image changes and level changes of each frame, with one column of plots per movement."""
    kinds = [("stepRmse", "pop, RMSE"), ("changeRmse", "change, RMSE"), ("speed", "levels a frame")]
    movements = list(dict.fromkeys(row["movement"] for row in rows))
    figure, plots = new_plots(len(movements), 0.8, 7.5, len(kinds))
    figure.subplots_adjust(top=0.95, bottom=0.08, wspace=0.06, hspace=0.12)
    described = []
    for (kind, kind_label), line in zip(kinds, plots):
        for axes, movement in zip(line, movements):
            def points_of(mode):
                return sorted((int(row["frame"]), float(row[kind])) for row in rows if (row["movement"], row["lod"]) == (movement, mode)
                              and (kind != "speed" or mode == "fractional"))

            drawn = draw_modes(axes, points_of, 3)
            described += [f"{movement}, {label}: {kind_label} at most {max(value for _, value in points):.3g}" for label, points, _ in drawn]
        line[0].set_ylim(0, None)
        line[0].set_ylabel(kind_label)
        if kind != "speed":
            label_beside(line[-1], [end for _, _, end in drawn])
    for axes, movement in zip(plots[0], movements):
        axes.set_title(movement, color=INK, fontsize=10)
    for axes in plots[-1]:
        axes.set_xlabel("frame")
    return as_svg(figure, "popping", f"Pops frame by frame at {samples} lens samples. " + "; ".join(described))


def scaling_plot(results):
    names = list(dict.fromkeys(row["axis"] for row in results["rows"]))
    figure, plots = new_plots(len(names), 0.84, 4.2)
    figure.subplots_adjust(top=0.92, bottom=0.14, wspace=0.08)
    described = []
    for axes, name in zip(plots[0], names):
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_title(name, color=INK, fontsize=10)
        axes.set_xlabel("blur, px" if name == "blur" else name)
        drawn = draw_modes(axes, lambda mode: [(row["value"], median(row)) for row in results["rows"]
                                               if (row["axis"], row["lod"]) == (name, mode)], 5)
        described += [f"{name}, {label}: {time_text(points[0][1])} to {time_text(points[-1][1])}" for label, points, _ in drawn]
        axes.xaxis.set_minor_formatter(NullFormatter())
    logarithmic(plots[0][0].yaxis, time_text)
    plots[0][0].set_ylabel("a frame (median)")
    label_beside(plots[0][-1], [end for _, _, end in drawn])
    return as_svg(figure, "scaling", "Time of a frame against what grows, both logarithmic. " + "; ".join(described))
