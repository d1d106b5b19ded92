"""Makes the tables of speed, error and popping. Each function in TABLES returns a table as Markdown."""

import re
import textwrap

from figures.markdown import run_source, run_table, source, table
from figures.results import (accumulation_rows, command_of, error_ratio, lines_of, numbers, numbers_after, run_of, samples_sweep,
                             seconds)

FISH, OWN, H200 = "llvmpipe-speedup-fish", "llvmpipe-speedup-jeong2011", "h200-speedup"
MODES = {"nearest": "nearest level", "fractional": "split samples", "continuous": "split pixels", "multirate": "multirate"}
MAX_ERROR_RATIO = 1.2  # max error with levels of detail, relative to the error at full detail
# Max pop, the change of the image where an object switches its level, relative to mode nearest.
MAX_POP_RATIO = {"fractional": 0.25, "continuous": 0.05, "multirate": 0.25}


def limited(value, limit):
    """Returns a number as text, in bold if it exceeds its limit."""
    return f"**{value:.2f}**" if value > limit else f"{value:.2f}"


def error_ratios(modes):
    return [limited(error_ratio(modes, error), MAX_ERROR_RATIO) for error in ("rmse", "flip")]


def times(modes, unit="s"):
    return [f"{seconds(modes[mode]):.2f} s" if unit == "s" else f"{1000 * seconds(modes[mode]):.0f} ms" for mode in ("off", "fractional")]


def speed_ups(levels):
    """Returns the speed-ups of levels chosen by size and blur, by size only, and by blur only; a dash if not measured."""
    return [f"{part['speedUp']:.1f}" if part else "–" for part in (levels, levels["sizeOnly"], levels["blurOnly"])]


def speed_table(name):
    rows = []
    for count, modes in samples_sweep(name):
        off, levels = modes["off"], modes["fractional"]
        rows.append([count, *times(modes), f"{levels['speedUp']:.1f}",
                     f"{off['fromReference']['rmse']:.4f}", f"{levels['fromReference']['rmse']:.4f}", error_ratios(modes)[0],
                     f"{levels['fromFullDetail']['psnr']:.1f} dB", f"{levels['fromFullDetail']['flip']:.4f}"])
    return run_table(name, ["lens samples", "full detail", "levels", "times as fast", "RMSE, full detail", "RMSE, levels",
                            "times the error", "PSNR between the two", "FLIP between the two"], rows)


def measured():
    """Returns the table of speed-ups and errors of levels that are chosen by measured error."""
    rows = []
    for count, modes in samples_sweep(OWN):
        full, levels = modes["off"], modes["fractional"]
        rmse_ratio, flip_ratio = error_ratios(modes)
        rows.append([count, f"{full['triangles'] / 1e6:.1f} M", f"{levels['triangles'] / 1e6:.1f} M", *times(modes), *speed_ups(levels),
                     f"{full['fromReference']['rmse']:.4f}", rmse_ratio, f"{full['fromReference']['flip']:.4f}", flip_ratio])
    return run_table(OWN, ["lens samples", "triangles, full detail", "triangles, levels", "full detail", "levels", "times as fast",
                           "size only", "blur only", "RMSE, full detail", "times that, levels", "FLIP, full detail",
                           "times that, levels"], rows)


def levels():
    """Returns the table of times and errors, on two machines, of levels chosen by measured error from size and blur."""
    def own_times(modes):
        return [*(f"{seconds(modes[mode]):.2f}" for mode in ("off", "fractional")), f"{modes['fractional']['speedUp']:.1f}"]

    card = dict(samples_sweep(H200))
    rows = [[count, *own_times(modes), *error_ratios(modes), *own_times(card[count])] for count, modes in samples_sweep(OWN)]
    return run_table(OWN, ["lens samples", "full detail, s", "levels, s", "times as fast", "times the RMSE", "times the FLIP",
                           "H200: full detail, s", "levels, s", "times as fast"], rows)


def published_ratios():
    """Returns the table of speed-ups and errors of levels, as published and by default."""
    def ratios(modes):
        return [f"{modes['fractional']['speedUp']:.1f}", error_ratios(modes)[0]]

    own = dict(samples_sweep(OWN))
    rows = [[count, *ratios(theirs), *ratios(own[count])] for count, theirs in samples_sweep(OWN, "jeong2011")]
    return run_table(OWN, ["lens samples", "`jeong2011`: times as fast", "times the RMSE", "default: times as fast", "times the RMSE"],
                     rows)


def published():
    """Returns the table of frame times over lens samples, as published and by default, like Figure 2 of the paper."""
    own = dict(samples_sweep(OWN))
    rows = [[count, name, *times(modes), *speed_ups(modes["fractional"]), f"{modes['off']['fromReference']['rmse']:.4f}",
             f"{modes['fractional']['fromReference']['rmse']:.4f}", error_ratios(modes)[0]]
            for count, theirs in samples_sweep(OWN, "jeong2011")
            for name, modes in (("`jeong2011`, Halton", theirs), ("default, Sobol", own[count]))]
    return run_table(OWN, ["lens samples", "settings", "full detail", "levels", "times as fast", "size only", "blur only",
                           "RMSE, full detail", "RMSE, levels", "times the error"], rows)


def lenses():
    name = "llvmpipe-speedup-lenses"
    lens = ("sweep", "samples", "fStop", "focusDistance")
    full = {tuple(row[key] for key in lens): row for row in accumulation_rows(name) if row["lod"] == "off"}
    rows = [[f"f/{row['fStop']:g}", f"{row['focusDistance']:g} m",
             *times({"off": full[tuple(row[key] for key in lens)], "fractional": row}), f"{row['speedUp']:.1f}",
             f"{row['fromFullDetail']['psnr']:.1f} dB"]
            for row in accumulation_rows(name) if row["lod"] == "fractional" and row["samples"] == 64]
    return run_table(name, ["f-number", "focus", "full detail", "levels", "times as fast", "PSNR between the two"], rows)


def speed_sentence():
    """Returns the paragraph of README.md on speed and error."""
    by_size, drawn = dict(samples_sweep(FISH))[64], dict(samples_sweep(OWN))[64]
    full, levels = drawn["off"], drawn["fractional"]
    return textwrap.fill(
        f"With 64 lens samples of the built-in scene, {levels['triangles'] / 1e6:.0f} million triangles are drawn instead of "
        f"{full['triangles'] / 1e6:.0f} million; culled triangles aren't counted. The RMSE from a converged image is "
        f"{error_ratio(drawn):.2f} times that of full meshes, and FLIP is {error_ratio(drawn, 'flip'):.2f} times as "
        f"large. On {run_of(FISH)['machine']['threads']} CPU cores without a GPU, a frame takes "
        f"{seconds(levels):.1f} s instead of {seconds(full):.1f} s, {levels['speedUp']:.1f} times as fast. Coarser levels "
        f"(`--lod-metric size`) are {by_size['fractional']['speedUp']:.1f} times as fast, at {error_ratio(by_size):.1f} times the "
        "RMSE. [Results](docs/results.md) has more measurements, also against a CPU ray tracer and on [a "
        "GPU](docs/results.md#on-a-gpu).", 128, break_long_words=False, break_on_hyphens=False) + "\n"


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
    """Returns the table of differences that other lens samples cause, beside the differences that levels cause."""
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
    return run_table("llvmpipe-popping", ["movement", MODES["nearest"], *(f"share, {MODES[mode]}" for mode in MAX_POP_RATIO)], cells)


def gpu_speed():
    rows = [[count, *times(modes, "ms"), *speed_ups(modes["fractional"]), *error_ratios(modes)] for count, modes in samples_sweep(H200)]
    return run_table(H200, ["lens samples", "full detail", "levels", "times as fast", "size only", "blur only", "times the RMSE",
                            "times the FLIP"], rows)


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

    rows = [[f"`{row['method']}`", f"{row['framesPerSecond']:.1f}", f"{row['firstPictureMilliseconds']:.0f} ms",
             f"{row['movingSamples']}, {100 * row['movingResolution']:.0f} %", f"{row['movingPsnr']:.1f} dB", waited(row["stillPictureSeconds"]),
             waited(row["convergedSeconds"]), row["stillSamples"], f"{row['stillPsnr']:.1f} dB"] for row in run_of("llvmpipe-view")["rows"]]
    return run_table("llvmpipe-view", ["method", "moving: frames per second", "first picture after an input", "samples, size", "PSNR",
                                       "at rest: first picture after", "converged after", "samples after 10 s", "PSNR"], rows)


TABLES = {"window": window, "gpu speed": gpu_speed, "speed": speed_sentence, "demo": demo, "seeds": seeds,
          "speedup": lambda: speed_table(FISH), "helmets": lambda: speed_table("llvmpipe-speedup-helmets"), "measured": measured,
          "levels": levels, "pop shares": pop_shares, "error times": error_times, "published ratios": published_ratios,
          "published": published, "lenses": lenses, "popping": popping, "peers": peers}
