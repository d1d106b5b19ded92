"""Draws the curves in bench/results/lens: the circle of confusion C over depth, for each control of the lens."""

import json

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

from figures.command import run

LENS = ["--fstop", "2", "--focus-distance", "1", "--units", "m"]
RANGE = ["--focus-range-front", "0.3", "--focus-range-behind", "0.8"]
CURVES = [
    ("thin lens", "lightgrey", "-", []),
    ("--foreground-limit 12", "tab:red", "-", ["--foreground-limit", "12"]),
    ("--background-limit 12", "tab:blue", "-", ["--background-limit", "12"]),
    ("focus range 0.7 m to 1.8 m", "tab:green", "-", RANGE),
    ("the same, --focus-range-refocuses", "tab:green", "--", [*RANGE, "--focus-range-refocuses"]),
]
DEPTHS = [0.2 + 0.02 * step for step in range(241)]  # plotted depths, m


def blurs(program, options):
    """Returns the signed diameters of the blur (px) at DEPTHS, and the width of the image (px)."""
    report = json.loads(run(program, "info", "--camera", "meshes/chess.glb", "--json", *LENS, *options, "--depths",
                            ",".join(f"{depth:.2f}" for depth in DEPTHS)))
    return [row["pixels"] for row in report["blur"]], report["width"]


def draw_curves(program, file):
    """Plots over depth w. Left: C in clip space, which is w · c / W for a blur of c px in an image W px wide. Right: c.

    C has the opposite sign in Munkberg, Toth and Akenine-Möller 2012.
    """
    figure, (clip, image) = plt.subplots(1, 2, figsize=(10, 3.8), dpi=100, layout="constrained")
    for name, color, style, options in CURVES:
        pixels, width = blurs(program, options)
        line = {"color": color, "linestyle": style, "linewidth": 1.5 if options else 6}
        clip.plot(DEPTHS, [depth * value / width for depth, value in zip(DEPTHS, pixels)], **line)
        image.plot(DEPTHS, pixels, **line, label=name)
    clip.set(xlabel="depth w, m", ylabel="C in clip space, m", xlim=(0, 5))
    image.set(xlabel="depth w, m", ylabel="blur c, px", xlim=(0, 5), ylim=(-45, 45))
    for axes in (clip, image):
        axes.axhline(0, color="grey", linewidth=0.6)
        axes.spines[["top", "right"]].set_visible(False)
    image.legend(frameon=False, fontsize=8, loc="lower right")
    figure.savefig(file, metadata={"Software": None})
