"""Draws the plots of bench/results/details.md, from results in bench/results, as SVG files in docs/plots.

    scripts/figures plots

Needs matplotlib (Debian: python3-matplotlib).
"""

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402

from figures.command import ROOT, parser_of
from figures.results import error_ratio, lens_levels, rmse, run_of, samples_sweep, seconds

METHODS = {  # (method, setting): (label, colour, marker)
    ("accumulation", "lod=fractional metric=size thresholds=1"): ("accumulation, levels", "tab:blue", "o"),
    ("accumulation", "lod=off"): ("accumulation, full detail", "tab:cyan", "s"),
    ("embree", "default"): ("ray tracer", "tab:orange", "^"),
    ("embree-shared", "default"): ("ray tracer, shared lens samples", "tab:red", "v"),
    ("scheuermann", "default"): ("Scheuermann 2004", "tab:green", "D"),
    ("circular", "default"): ("circular (Garcia 2018)", "tab:purple", "P"),
}
LENS_SPACE = {
    ("accumulation", "lod=off"): ("accumulation", "tab:cyan", "s"),
    ("stochastic", "lod=off"): ("stochastic points", "tab:orange", "^"),
    ("line", "lod=off"): ("lines", "tab:blue", "o"),
    ("line", "resolve=published shading-step=0 wheel=shared lod=off"): ("lines as published", "tab:red", "v"),
    ("scheuermann", "coc=thin-lens taps=64 max-coc=unlimited"): ("Scheuermann 2004, lens's blur", "tab:green", "D"),
    ("circular", "default"): ("circular (Garcia 2018)", "tab:purple", "P"),
}


def axes_of(width, height, columns=1, **labels):
    figure, plots = plt.subplots(1, columns, figsize=(width, height), sharey=True, squeeze=False)
    for axes in plots[0]:
        axes.grid(True, which="major", alpha=0.3)
        axes.spines[["top", "right"]].set_visible(False)
    plots[0][0].set(**labels)
    return figure, *plots[0]


def ticks_on(axis, ticks):
    axis.set_major_locator(matplotlib.ticker.FixedLocator(ticks))
    axis.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_locator(matplotlib.ticker.NullLocator())


def save(figure, name):
    file = ROOT / "docs" / "plots" / name
    figure.savefig(file, bbox_inches="tight", metadata={"Date": None}, facecolor="white")
    print(file)


def draw_speedup():
    sweep = samples_sweep("llvmpipe-speedup-fish")
    counts = [count for count, _ in sweep]
    figure, axes = axes_of(6.4, 3.2, xscale="log", xlabel="lens samples", ylabel="levels over full detail")
    axes.axhline(1, color="grey", linewidth=0.8)
    axes.plot(counts, [modes["fractional"]["speedUp"] for _, modes in sweep], "o-", color="tab:blue", label="times as fast")
    axes.plot(counts, [error_ratio(modes) for _, modes in sweep], "s--", color="tab:red", label="times the error (RMSE)")
    ticks_on(axes.xaxis, counts)
    axes.set_ylim(0)
    axes.legend(frameon=False)
    save(figure, "speedup.svg")


def draw_methods(run, series, name, times, errors):
    rows = run_of(run)["rows"]
    figure, axes = axes_of(6.4, 4.2, xscale="log", yscale="log", xlabel="seconds a frame", ylabel="RMSE from the reference")
    for (method, setting), (label, colour, marker) in series.items():
        points = sorted((seconds(row), rmse(row)) for row in rows if (row["method"], row["setting"]) == (method, setting))
        axes.plot(*zip(*points), color=colour, marker=marker, label=label, linewidth=1.4)
    ticks_on(axes.xaxis, times)
    ticks_on(axes.yaxis, errors)
    axes.legend(frameon=False, fontsize=8)
    save(figure, name)


def draw_lens_levels():
    figure, over_lines, over_blur = axes_of(7.6, 3.2, 2, xlabel="lines, at a blur of a tenth of the width", ylabel="seconds a frame",
                                            xscale="log", yscale="log")
    over_blur.set(xlabel="blur, % of the width, at 16 lines", xscale="log")
    for (model, rows), colour in zip(lens_levels().items(), ("tab:blue", "tab:red")):
        for column, label, style in ((2, "full detail", "o-"), (3, "fractional levels", "s--"), (6, "three levels", "v:")):
            for axes, points in ((over_lines, [(row[0], row[column]) for row in rows if row[1] == 0.1]),
                                 (over_blur, [(100 * row[1], row[column]) for row in rows if row[0] == 16])):
                axes.plot([x for x, _ in points], [time / 1000 for _, time in points], style, color=colour,
                          label=f"{model}, {label}", markersize=4, linewidth=1.2)
    ticks_on(over_lines.xaxis, (4, 8, 16, 32))
    ticks_on(over_blur.xaxis, (2, 5, 10, 20))
    ticks_on(over_lines.yaxis, (0.1, 0.2, 0.5, 1, 2, 5))
    over_lines.legend(frameon=False, fontsize=7)
    save(figure, "lens-levels.svg")


def main(words):
    parser_of("plots", __doc__).parse_args(words)
    matplotlib.rcParams.update({"svg.hashsalt": "defocus", "svg.fonttype": "none", "font.size": 9, "font.family": "sans-serif"})
    draw_speedup()
    draw_methods("llvmpipe-methods-fish", METHODS, "methods.svg", (0.2, 0.5, 1, 2, 5, 10), (0.002, 0.005, 0.01, 0.02, 0.05))
    draw_methods("llvmpipe-methods-lens-space", LENS_SPACE, "lens-space.svg", (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5),
                 (0.001, 0.002, 0.005, 0.01, 0.02))
    draw_lens_levels()
