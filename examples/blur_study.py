#!/usr/bin/env python3
"""Shows how the f-number changes an image, and how many lens samples its blur needs.

Renders a scene with several f-numbers, shows each image with the circles of confusion of its pixels, and plots the
error of each image against its number of lens samples. Editors that support cells (# %%) can run one cell at a time.
To run all cells:

    python3 examples/blur_study.py meshes/chess.glb blur-study.png

The script needs the package `defocus` (docs/python.md) and matplotlib.
"""

# %% Import the packages, and choose the scene, the f-numbers and the numbers of lens samples.
import sys
from pathlib import Path

import matplotlib
import numpy

import defocus

matplotlib.use("agg")
import matplotlib.pyplot as plt  # noqa: E402 (must follow matplotlib.use)

SCENE = Path(sys.argv[1] if len(sys.argv) > 1 else "meshes/chess.glb")
OUTPUT = Path(sys.argv[2] if len(sys.argv) > 2 else "blur-study.png")
SIZE = (240, 180)
F_STOPS = (1.4, 2.8, 5.6, 11)
SAMPLES = (4, 8, 16, 32, 64, 128)
# Full detail. With seed 1, the lens points differ from those of the compared images, which use seed 0.
REFERENCE = {"samples": 512, "lod": "off", "seed": 1}

# %% Render the images, their references and their blur with one renderer, which reads and simplifies the scene once.
pictures, blurs, references = {}, {}, {}
errors = {f_stop: [] for f_stop in F_STOPS}
with defocus.Renderer(SCENE, size=SIZE) as renderer:
    for f_stop in F_STOPS:
        references[f_stop] = renderer.render(f_stop=f_stop, **REFERENCE)
        for samples in SAMPLES:
            pictures[f_stop] = renderer.render(f_stop=f_stop, samples=samples)
            errors[f_stop].append(defocus.compare(references[f_stop], pictures[f_stop]))
        blurs[f_stop] = renderer.aovs().coc
        print(f"f/{f_stop}: {errors[f_stop][-1].psnr:.1f} dB after {SAMPLES[-1]} samples, "
              f"largest blur {numpy.abs(blurs[f_stop]).max(where=numpy.isfinite(blurs[f_stop]), initial=0):.1f} px")


# %% Draw a contact sheet with two rows: the images, and the signed diameters of the circles of confusion.
def encoded(linear):
    """Returns the colour channels of a linear image, encoded for display with sRGB (IEC 61966-2-1)."""
    colour = numpy.clip(linear[..., :3], 0, 1)
    return numpy.where(colour <= 0.0031308, 12.92 * colour, 1.055 * colour ** (1 / 2.4) - 0.055)


figure = plt.figure(figsize=(3.1 * len(F_STOPS), 8.4), layout="constrained")
top, bottom = figure.subfigures(2, 1, height_ratios=(1.25, 1))
axes = top.subplots(2, len(F_STOPS))
for column, f_stop in enumerate(F_STOPS):
    axes[0, column].imshow(encoded(pictures[f_stop]))
    axes[0, column].set_title(f"f/{f_stop}")
    shown = axes[1, column].imshow(blurs[f_stop], cmap="RdBu", vmin=-20, vmax=20)
top.colorbar(shown, ax=list(axes[1]), label="circle of confusion, px\n(> 0: behind the focus)")
for axis in axes.flat:
    axis.set_axis_off()

# %% Plot the error against the number of samples. Small bright lamps need the most samples, because each sample draws
# only one dot of a lamp's blur disk.
left, right = bottom.subplots(1, 2)
for marker, f_stop in zip("osd^", F_STOPS):
    left.loglog(SAMPLES, [error.rmse for error in errors[f_stop]], marker=marker, label=f"f/{f_stop}")
    right.loglog(SAMPLES, [error.flip for error in errors[f_stop]], marker=marker, label=f"f/{f_stop}")
slope = errors[F_STOPS[0]][0].rmse * numpy.sqrt(SAMPLES[0] / numpy.array(SAMPLES))
left.loglog(SAMPLES, slope, "k:", label="$N^{-1/2}$, as of random samples")
left.set_ylabel("root mean squared error")
right.set_ylabel("mean FLIP")
for axis in (left, right):
    axis.set_xlabel("lens samples")
    axis.set_xticks(SAMPLES, [str(samples) for samples in SAMPLES])
    axis.minorticks_off()
    axis.grid(alpha=0.3)
    axis.legend()

# %% Write the figure.
figure.savefig(OUTPUT, dpi=110)
print(f"wrote {OUTPUT}")
