"""Makes the tables of speed, error and popping. Each function in TABLES returns a table as Markdown."""

import re
import textwrap

from figures.markdown import run_table, source, table
from figures.results import (accumulation_rows, command_of, error_ratio, lines_of, numbers, numbers_after, run_of, samples_sweep,
                             seconds)

FISH, OWN, H200 = "llvmpipe-speedup-fish", "llvmpipe-speedup-jeong2011", "h200-speedup"
MODES = {"nearest": "nearest level", "fractional": "split samples", "continuous": "split pixels", "multirate": "multirate"}
MAX_ERROR_RATIO = 1.2  # limit on the error with levels of detail, relative to the error at full detail
# Limit on the pop in each level-of-detail mode, relative to the pop in mode "nearest". A pop is the change in the image
# when an object switches its level.
MAX_POP_RATIO = {"fractional": 0.25, "continuous": 0.05, "multirate": 0.25}


def limited(value, limit):
    """Returns a number as text, in bold if it exceeds its limit."""
    return f"**{value:.2f}**" if value > limit else f"{value:.2f}"


def time_of(row, unit="s"):
    return f"{seconds(row):.2f} s" if unit == "s" else f"{1000 * seconds(row):.0f} ms"


def columns_of(modes, unit):
    """Returns {column: text}, with the speed and error of levels at one number of samples. modes: {level mode: row}."""
    full, levels = modes["off"], modes["fractional"]
    speed_ups = {"times as fast": levels, "size only": levels.get("sizeOnly"), "blur only": levels.get("blurOnly")}
    columns = {name: f"{part['speedUp']:.1f}" if part else "–" for name, part in speed_ups.items()}
    for name, row in (("full detail", full), ("levels", levels)):
        columns |= {name: time_of(row, unit), f"triangles, {name}": f"{row['triangles'] / 1e6:.1f} M",
                    **{f"{error.upper()}, {name}": f"{row['fromReference'][error]:.4f}" for error in ("rmse", "flip")}}
    for error in ("rmse", "flip"):
        columns[f"times the {error.upper()}"] = limited(error_ratio(modes, error), MAX_ERROR_RATIO)
    other = levels["fromFullDetail"]
    return columns | {"PSNR between the two": f"{other['psnr']:.1f} dB", "FLIP between the two": f"{other['flip']:.4f}"}


def speed_rows(name, columns, preset=""):
    """Returns {number of lens samples: texts of these columns}."""
    rows = {count: columns_of(modes, "ms" if name == H200 else "s") for count, modes in samples_sweep(name, preset)}
    return {count: [row[column] for column in columns] for count, row in rows.items()}


def speed_table(name, *columns):
    return run_table(name, ["lens samples", *columns], [[count, *row] for count, row in speed_rows(name, columns).items()])


SPEED, RATIOS, PARTS = ("full detail", "levels", "times as fast"), ("times the RMSE", "times the FLIP"), ("size only", "blur only")
ERRORS = ("RMSE, full detail", "RMSE, levels", "times the RMSE")
BOTH = (*SPEED, *ERRORS, "PSNR between the two", "FLIP between the two")


def levels():
    """Returns the table of times and errors with levels and at full detail, on two machines."""
    card = speed_rows(H200, SPEED)
    return run_table(OWN, ["lens samples", *SPEED, *RATIOS, *(f"H200: {column}" for column in SPEED)],
                     [[count, *row, *card[count]] for count, row in speed_rows(OWN, (*SPEED, *RATIOS)).items()])


def published_ratios():
    """Returns the table of speed-ups and errors of levels as published, from the run of levels()."""
    columns = ("times as fast", "times the RMSE")
    return table(["lens samples", *columns], [[count, *row] for count, row in speed_rows(OWN, columns, "jeong2011").items()]) + (
        "\nThe table above has the defaults, from the same run.\n")


def published():
    """Returns the table of frame times over lens samples, as published and by default, like Figure 2 of Jeong et al."""
    columns = (*SPEED, *PARTS, *ERRORS)
    own = speed_rows(OWN, columns)
    rows = [[count, *row] for count, theirs in speed_rows(OWN, columns, "jeong2011").items()
            for row in (["`jeong2011`, Halton", *theirs], ["default, Sobol", *own[count]])]
    return run_table(OWN, ["lens samples", "settings", *columns], rows)


def lenses():
    name = "llvmpipe-speedup-lenses"
    lens = ("sweep", "samples", "fStop", "focusDistance")
    full = {tuple(row[key] for key in lens): row for row in accumulation_rows(name) if row["lod"] == "off"}
    rows = [[f"f/{row['fStop']:g}", f"{row['focusDistance']:g} m",
             time_of(full[tuple(row[key] for key in lens)]), time_of(row), f"{row['speedUp']:.1f}",
             f"{row['fromFullDetail']['psnr']:.1f} dB"]
            for row in accumulation_rows(name) if row["lod"] == "fractional" and row["samples"] == 64]
    return run_table(name, ["f-number", "focus", "full detail", "levels", "times as fast", "PSNR between the two"], rows)


def speed_sentence():
    """Returns the paragraph of README.md on speed and error."""
    by_size, drawn = dict(samples_sweep(FISH))[64], dict(samples_sweep(OWN))[64]
    full, levels = drawn["off"], drawn["fractional"]
    return textwrap.fill(
        f"Over 64 lens samples at {run_of(OWN)['width']:,} × {run_of(OWN)['height']:,} px, the built-in scene is drawn with "
        f"{levels['triangles'] / 1e6:.0f} million triangles in all. Full meshes would need {full['triangles'] / 1e6:.0f} million; culled "
        f"triangles aren't counted. Against a converged image, the RMSE is {error_ratio(drawn):.2f} times the RMSE of full meshes, and the "
        f"perceptual error FLIP is {error_ratio(drawn, 'flip'):.2f} times as large. On {run_of(OWN)['machine']['threads']} CPU cores "
        f"without a GPU, a frame takes {seconds(levels):.1f} s instead of {seconds(full):.1f} s, {levels['speedUp']:.1f} times as fast. "
        f"With the coarser levels of `--lod-metric size`, it is {by_size['fractional']['speedUp']:.1f} times as fast, at "
        f"{error_ratio(by_size):.1f} times the RMSE. [Results](docs/results.md) has more measurements, including a comparison with a "
        "CPU ray tracer and timings on [a GPU](docs/results.md#on-a-gpu).", 128, break_long_words=False, break_on_hyphens=False) + "\n"


def demo():
    lines = lines_of("llvmpipe-demo")
    rows = [[name, *re.split(r"\s{2,}", line.strip())[1:]] for name in ("full detail", "fractional levels")
            for line in lines if line.startswith(name)]
    ratio = numbers_after(lines, "speed-up of the frame")[0]
    psnr, ssim, flip = numbers_after(lines, "image difference")
    text = table(["1024 × 768, 64 lens samples", "frame", "a sample", "triangles drawn", "peak memory"], rows)
    text += f"\nThe second frame is {ratio:.1f} times as fast. The two images differ by PSNR {psnr:.1f} dB, SSIM {ssim:.3f}, FLIP {flip:.4f}.\n"
    return text + source("scripts/demo", "program, renderer, lens samples, buffers, and the removal of triangles that face away or lie "
                         "outside the image", "llvmpipe-demo.txt")


def seeds():
    """Returns the table that compares the effect of other lens samples with the effect of levels of detail."""
    names = {"seed": "full detail, other lens samples (`--seed 1`)", "levels": "levels, same lens samples"}
    rows = []
    for line in lines_of("llvmpipe-seeds"):
        if line.startswith("$ "):
            rows.append([names[line.split()[-1].removesuffix(".exr")]])
        elif line.startswith(("rmse", "psnr", "ssim", "flip")):
            value = numbers(line)[0]
            rows[-1].append(f"{value:.1f} dB" if line.startswith("psnr") else f"{value:.4f}")
    return table(["against full detail", "RMSE", "PSNR", "SSIM", "FLIP"], rows) + source(
        "defocus render --samples 64 --lod off -o full.exr; defocus render --samples 64 --lod off --seed 1 -o seed.exr; defocus render "
        "--samples 64 -o levels.exr; defocus compare full.exr seed.exr; defocus compare full.exr levels.exr",
        "scene, camera, lens, image size, number of lens samples", "llvmpipe-seeds.txt")


def popping():
    rows = {(row["movement"], row["lod"]): row for row in run_of("llvmpipe-popping")["rows"] if row["samples"] == 32}

    def cell(error, limit):
        return f"{error['worst']:.4f}" + ("" if limit is None else f" ({limited(error['ofNearest'], limit)})")

    cells = [[movement.replace("-", " "), text, cell(rows[movement, mode]["stepRmse"], MAX_POP_RATIO.get(mode)),
              *(cell(rows[movement, mode][kind], None if mode == "nearest" else 1) for kind in ("stepFlip", "changeRmse"))]
             for movement in ("focus-pull", "dolly", "turntable") for mode, text in MODES.items()]
    return run_table("llvmpipe-popping", ["movement", "levels", "largest pop, RMSE", "largest pop, FLIP", "largest change, RMSE"], cells)


def pop_shares():
    """Returns the table of the largest pop (RMSE) of the nearest level, and of the other modes relative to it."""
    rows = {(row["movement"], row["lod"]): row["stepRmse"] for row in run_of("llvmpipe-popping")["rows"] if row["samples"] == 32}
    cells = [[movement.replace("-", " "), f"{rows[movement, 'nearest']['worst']:.4f}",
              *(limited(rows[movement, mode]["ofNearest"], limit) for mode, limit in MAX_POP_RATIO.items())]
             for movement in ("focus-pull", "dolly", "turntable")]
    return run_table("llvmpipe-popping", ["movement", "RMSE, one level per object", *(f"share, {MODES[mode]}" for mode in MAX_POP_RATIO)], cells)


def error_times():
    """Returns the table of times to an RMSE of 0.005 on both machines."""
    runs = {"llvmpipe-multirate-fish": "school", "llvmpipe-multirate-helmets": "helmets", "h200-school": "school, H200",
            "h200-helmets": "helmets, H200"}
    by_method = {}
    for name in runs:
        for method in run_of(name)["timesToErrors"]:
            (time,) = [time for time in method["times"] if time["rmse"] == 0.005]
            milliseconds = time["milliseconds"]
            by_method.setdefault(method["name"], []).append(
                "not reached" if milliseconds is None else f"{milliseconds / 1000:.2f} s" if name.startswith("llvmpipe")
                else f"{milliseconds:.0f} ms")
    links = ", ".join(f"[{scene}](../bench/results/{name}.json)" for name, scene in runs.items())
    return table(["RMSE 0.005", *runs.values()], [[method, *cells] for method, cells in by_method.items()]) + (
        f"\nCommand of the school on the H200: `{command_of('h200-school', run_of('h200-school'))}` (runs: {links}).\n")


def peers():
    """Returns the table of the times to equal errors of defocus, Embree, Cycles and EEVEE."""
    rows, header, commands = [], [], []
    for line in lines_of("llvmpipe-peers"):
        cells = [line[:24].strip(), *(line[24 + 18 * i:42 + 18 * i].strip() for i in range(6))]
        if line.startswith("$ "):
            commands.append(line.removeprefix("$ "))
        elif "; auto draws with " in line:
            rows.append([f"**{line}**", *[""] * 6])
        elif line.startswith("CPU s"):
            header = cells
        elif len(line) == 132:
            rows.append([f"**{cell}**" for cell in cells] if cells[0] == "first" else cells)
    return table(header, rows) + source("`, `".join(commands), "geometry, colours, camera, lens, image size", "llvmpipe-peers.txt")


def window():
    """Returns the table of the window's frame rate, response and error for each method."""
    def waited(value):
        return "–" if value is None else f"{value:.1f} s"

    results = run_of("llvmpipe-view")
    rows = [[f"`{row['method']}`", f"{row['framesPerSecond']:.1f}", f"{row['firstPictureMilliseconds']:.0f} ms",
             f"{row['movingSamples']}, {100 * row['movingResolution']:.0f} %", f"{row['movingPsnr']:.1f} dB", waited(row["stillPictureSeconds"]),
             waited(row["convergedSeconds"]), row["stillSamples"], f"{row['stillPsnr']:.1f} dB"] for row in results["rows"]]
    header = ["method", "moving: frames per second", "moving: first image after an input", "moving: samples, resolution", "moving: PSNR",
              "still: first image after", "still: complete after", "still: samples after 10 s", "still: PSNR after 10 s"]
    held_equal = "scene, camera path, lens, image size and reference. The methods were measured one after another in one process"
    return table(header, rows) + source(command_of("llvmpipe-view", results), held_equal, "llvmpipe-view.json", results["commit"])


TABLES = {"window": window, "gpu speed": lambda: speed_table(H200, *SPEED, *PARTS, *RATIOS), "speed": speed_sentence, "demo": demo, "seeds": seeds,
          "speedup": lambda: speed_table(FISH, *BOTH), "helmets": lambda: speed_table("llvmpipe-speedup-helmets", *BOTH),
          "measured": lambda: speed_table(OWN, "triangles, full detail", "triangles, levels", *SPEED, *PARTS,
                                          "RMSE, full detail", "times the RMSE", "FLIP, full detail", "times the FLIP"),
          "levels": levels, "pop shares": pop_shares, "error times": error_times, "published ratios": published_ratios,
          "published": published, "lenses": lenses, "popping": popping, "peers": peers}
