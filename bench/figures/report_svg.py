"""Draws plots of the report with matplotlib: SVG elements in the page's colours with a tooltip for each point."""

import html
import io
import re

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter  # noqa: E402

# Palette of Okabe and Ito, darkened on white and lightened on black: (on white, on black). Its colours are
# distinguishable with all kinds of colour blindness. Lines also differ in their markers and labels.
PALETTE = [("#0063a8", "#5db1f0"), ("#c24e00", "#ff8a4c"), ("#00805c", "#35cfa1"), ("#a8447f", "#ee9cc8"),
           ("#8a6000", "#f0c040"), ("#007e8a", "#5fd3df"), ("#5a5a5a", "#b8b8b8")]
MARKERS = "osD^vPX*<>h"
# Placeholder colours that as_svg replaces with CSS colours of the page.
INK, GRID = "#010203", "#010204"
COLOURS = [f"#0102{i:02x}" for i in range(0x10, 0x10 + len(PALETTE))]
LABEL_LENGTH = 42  # number of characters of a label that fit beside a plot at full size; longer labels are drawn smaller


def add_tooltips(line, texts):
    """Adds to each point of a line a text that the page shows when the mouse pointer is over the point."""
    tooltips = line.figure.__dict__.setdefault("tooltips", [])
    line.set_gid(f"told{len(tooltips)}")
    tooltips.append(list(texts))


def with_tooltips(svg, tooltips):
    """Inserts the tooltips into the markers of an SVG; matplotlib draws these in order as <use> elements."""
    for index, texts in enumerate(tooltips):
        begin = svg.find(f'<g id="told{index}">')
        end = svg.find('<g id="', begin + 1)
        left = iter(texts)
        part = re.sub(r"<use ", lambda _: f'<use tabindex="0" data-value="{html.escape(next(left, ""))}" ', svg[begin:end])
        svg = svg[:begin] + part + svg[end:]
    return svg


def as_svg(figure, name, description):
    """Returns the figure as an SVG element with unique ids, and with a description for screen readers."""
    text = io.StringIO()
    figure.savefig(text, format="svg", transparent=True, metadata={"Date": None, "Creator": None})
    plt.close(figure)
    svg = text.getvalue()
    svg = with_tooltips(svg[svg.index("<svg"):], getattr(figure, "tooltips", []))
    svg = re.sub(r"<metadata>.*?</metadata>", "", svg, flags=re.S)
    svg = re.sub(r"'DejaVu Sans'[^;\"]*", "system-ui, sans-serif", svg)
    svg = re.sub(r'\bid="', f'id="{name}-', svg)
    svg = re.sub(r'(url\(#|href="#)', rf"\g<1>{name}-", svg)
    svg = svg.replace(INK, "currentColor").replace(GRID, "var(--grid)")
    for index, colour in enumerate(COLOURS):
        svg = svg.replace(colour, f"var(--c{index})")
    svg = re.sub(r' (width|height)="[\d.]+pt"', "", svg, count=2)
    return svg.replace("<svg", f'<svg role="img" aria-label="{html.escape(description)}"', 1)


def new_plots(count, right, height, rows=1):
    """Returns a figure and its plots by row and column; all plots of a row share the y axis."""
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


def plain_ticks(axis, text=lambda value: f"{value:g}"):
    axis.set_major_formatter(FuncFormatter(lambda value, _: text(value)))
    axis.set_minor_formatter(NullFormatter())


def logarithmic(axis, text):
    axis.set_major_locator(LogLocator(base=10, subs=(1, 2, 5), numticks=20))
    plain_ticks(axis, text)


def spread_apart(heights, step, top):
    """Moves ascending heights until they are at least `step` apart and at most `top`: first upwards, then downwards."""
    spread = []
    for height in heights:
        spread.append(max(height, spread[-1] + step) if spread else height)
    if spread and spread[-1] > top:
        for i in reversed(range(len(spread))):
            spread[i] = min(spread[i], top if i + 1 == len(spread) else spread[i + 1] - step)
    return spread


def label_beside(axes, ends):
    """Draws labels in the right margin, each with a line to its point. ends: (x, y, text, colour, marker)."""
    axes.figure.canvas.draw()
    box = axes.get_window_extent()
    beside, text_at = 1 + 15 / box.width, 1 + 24 / box.width
    placed = sorted(((axes.transData.transform(end[:2])[1], *end) for end in ends), key=lambda end: end[0])
    heights = spread_apart([height for height, *_ in placed], 15.0, box.y1)
    for (_, x, y, text, colour, marker), height in zip(placed, heights):
        share = (height - box.y0) / box.height
        axes.annotate("", xy=(x, y), xycoords="data", xytext=(beside, share), textcoords="axes fraction",
                      annotation_clip=False, arrowprops={"arrowstyle": "-", "color": colour, "linewidth": 0.7,
                                                         "linestyle": ":", "shrinkA": 4, "shrinkB": 4})
        axes.plot([beside], [share], marker, color=colour, markersize=6, transform=axes.transAxes, clip_on=False)
        axes.annotate(text, (text_at, share), xycoords="axes fraction", color=colour, va="center",
                      fontsize=min(9.5, 9.5 * LABEL_LENGTH / len(text)), annotation_clip=False)
