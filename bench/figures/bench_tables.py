"""Makes the tables on levels of detail, correctness and the parts of a frame. Functions in TABLES return Markdown."""

import json
import re
from statistics import mean

from figures.markdown import run_table, source, table
from figures.results import lens_levels, lines_of, numbers, numbers_after, run_of


def span(values, digits):
    low, high = (f"{value:.{digits}f}" for value in (min(values), max(values)))
    return low if low == high else f"{low} to {high}"


def scaling(with_parts=True):
    axes = {"triangles": "triangles, 100 k to 10 M", "instances": "instances, 1 to 10,000", "samples": "lens samples, 2 to 64",
            "pixels": "pixels, 640 × 480 to 3840 × 2160", "blur": "blur, f/16 to f/1"}
    curves = {(curve["axis"], curve["lod"]): curve for curve in run_of("llvmpipe-scaling")["curves"]}
    rows = [[name, *(f"{curves[axis, lod]['time']['exponent']:.2f}" for lod in ("off", "fractional")),
             curves[axis, "fractional"]["bounds"]] for axis, name in axes.items()]
    header = ["what grows", "exponent, full detail", "exponent, levels", "what takes the time, with levels"]
    if not with_parts:
        return run_table("llvmpipe-scaling", header[:-1], [row[:-1] for row in rows])
    return run_table("llvmpipe-scaling", header, rows) + (
        "\nThe run chose levels by size (`--lod-metric size`). This bench has no option for it, so only the commit of the run repeats "
        "the figures.\n")


# ---- tables about pyramids ------------------------------------------------------------------------------------------


def ending_in_numbers(lines, count):
    """Returns (text before, numbers) of the lines that end with `count` numbers; remarks in brackets are ignored."""
    rows = []
    for line in lines:
        words = line.split("  (")[0].split()
        if len(words) > count and all(re.fullmatch(r"[\d.]+", word) for word in words[-count:]):
            rows.append((" ".join(words[:-count]), [float(word) for word in words[-count:]]))
    return rows


def gain(gains):
    return f"{mean(gains):.1f} dB better in the mean of {len(gains)} levels ({span(gains, 1)})"


def distance(rows):
    """Returns a sentence on how far levels are from the mesh. rows: a row for each mesh, and the row "all"."""
    rows = dict(rows)
    every = rows.pop("all")
    worst = max(rows, key=lambda name: rows[name][3])
    return (f"{every[2]:.2f} in the mean of {every[1]:.0f} levels of {len(rows)} meshes; at most 1.1 in "
            f"{100 * every[4] / every[1]:.0f} % of the levels; {every[3]:.1f} at worst ({worst})")


def pyramid_sections():
    return [section.splitlines() for section in "\n".join(line.strip() for line in lines_of("llvmpipe-pyramids")).split("\n\n")]


def pyramid_memory():
    """Returns the peak bytes per triangle of building pyramids: the range for large meshes, and {name: bytes}."""
    times = pyramid_sections()[0]
    timed = ending_in_numbers(times, 12)
    bytes_each = {name: values[1] for name, values in [*ending_in_numbers(times, 8), *timed]}
    return span([values[1] for name, values in timed if values[0] >= 50_000 and 'flat' not in name], 0), bytes_each


def memory():
    peaks = {line.split("  ")[0]: re.split(r"\s{2,}", line.strip())[-1] for line in lines_of("llvmpipe-demo")}
    rows = [[f"frame of the school, {mode}", peaks[mode], "demo", "scripts/demo"] for mode in ("full detail", "fractional levels")]
    large, bytes_each = pyramid_memory()
    rows.append(["building pyramids", f"{large} bytes per mesh triangle; {bytes_each['fish, flat-shaded']:.0f} with flat shading", "pyramids",
                 "defocus_pyramid_bench --million MODEL…"])
    return table(["what", "peak memory", "command"], [
        [what, figure, f"`{command}` ([run](../bench/results/llvmpipe-{run}.txt))"] for what, figure, run, command in rows])


def pyramids(summary=False):
    times, distances, looks, normals = pyramid_sections()
    timed = ending_in_numbers(times, 12)
    large = [(name, values) for name, values in timed if values[0] >= 50_000]
    fish = min((values for name, values in timed if name == "fish"), key=lambda values: values[0])
    fitted = [values for _, values in ending_in_numbers(normals, 9)]
    if summary:
        every = dict(ending_in_numbers(distances, 5))["all"]
        gains = [values[4] - values[5] for _, values in ending_in_numbers(looks, 8)]
        return table(["compared with", "what", "result"], [
            ["meshoptimizer", "PSNR with equal triangles, at the blur for which the level is chosen", f"{mean(gains):.1f} dB higher on average"],
            ["meshoptimizer", "distance to the full mesh, with equal triangles", f"{every[2]:.2f} times as large on average"],
            ["OpenMesh's DecimaterT", "simplification, one thread", f"{span([values[10] for _, values in large], 1)} times as fast"],
            ["OpenMesh's DecimaterT", "whole pyramids, one thread", f"{span([values[11] for _, values in large], 1)} times as fast"]
        ]) + source("defocus_pyramid_bench --million MODEL…", "mesh and number of triangles", "llvmpipe-pyramids.txt")
    memory_of_large, bytes_each = pyramid_memory()
    rows = [
        ["PSNR against meshoptimizer's level of as many triangles, under the blur that picks the level",
         gain([values[4] - values[5] for _, values in ending_in_numbers(looks, 8)])],
        ["PSNR of fitted normals against normals averaged over the level's faces", gain([values[3] - values[4] for values in fitted])],
        ["PSNR of fitted normals against those of the surviving vertices", gain([values[3] - values[5] for values in fitted])],
        ["mean distance to the mesh, over that of meshoptimizer's level of as many triangles", distance(ending_in_numbers(distances, 5))],
        [f"time of the levels of meshes of {min(values[0] for _, values in large) / 1000:.0f} k to 1 M triangles, against OpenMesh's "
         "DecimaterT, one thread",
         f"{span([values[10] for _, values in large], 1)} times as fast; {fish[4]:.2f} s for a fish of 90 k triangles"],
        ["time of whole pyramids of the same meshes, with all that is fitted and measured, against DecimaterT alone",
         f"{span([values[11] for _, values in large], 1)} times as fast; {fish[2]:.2f} s for the fish"],
        ["peak memory of building the same pyramids",
         f"{memory_of_large} bytes a triangle; with flat shading "
         f"{bytes_each['fish, flat-shaded']:.0f} (a fish of a million), with texture coordinates too {bytes_each['bike']:.0f} (bike), "
         f"of a small mesh {bytes_each['Suzanne']:.0f} (Suzanne)"]]
    return table(["what", "figure"], rows) + source(
        "defocus_pyramid_bench --million MODEL…", "mesh and number of triangles; for the images also camera, lens, level and lens samples",
        "llvmpipe-pyramids.txt")


# ---- tables about correctness ---------------------------------------------------------------------------------------


def scenes_of(name):
    return [json.loads(line) for line in lines_of(name) if line.startswith("{")]


def ray_tracer():
    rows = [[scene["scene"], f"{scene['psnr']:.1f} dB", f"{scene['psnrAtEqualLensPoints']:.1f} dB", f"{scene['flip']:.4f}"]
            for scene in scenes_of("llvmpipe-truth")]
    return table(["scene", "PSNR, different lens samples", "PSNR, same lens samples", "FLIP, different lens samples"], rows) + source(
        "defocus_truth_bench --sequence halton --samples 256 --size 512x384 [SCENE …]",
        "scene with painted light, camera, lens, number of samples", "llvmpipe-truth.txt")


def cycles():
    lines = [line for line in lines_of("llvmpipe-cycles")[4:] if line.strip()]
    rows = [[line[:18].strip(), *(f"{value} dB" for value in line[18:].split())] for line in lines]
    return table(["scene", "16 samples", "64 samples", "256 samples", "noise of Cycles", "256 samples, shadows"], rows) + source(
        "scripts/figures cycles", "scene, textures, lights, camera, lens, image size, shading equations", "llvmpipe-cycles.txt")


def shadows():
    def times(scene, renderer):
        return " → ".join(f"{scene[f'{renderer}Milliseconds{end}'] / 1000:.1f}" for end in ("WithoutShadows", "")) + " s"

    rows = [[scene["scene"], *(f"{scene[psnr]:.1f} dB" for psnr in ("psnr", "psnrWithoutShadows", "psnrIfLeftOut")),
             f"{scene['flip']:.4f}", times(scene, "accumulation"), times(scene, "embree")] for scene in scenes_of("llvmpipe-shadows")]
    return table(["scene", "PSNR", "without shadows", "if only the ray tracer has them", "FLIP", "accumulation, without → with",
                  "ray tracer, without → with"], rows) + source(
        "defocus_truth_bench --shadows 5 --samples 64 --size 512x384 [SCENE …]",
        "scene with matt colours under one sun of 5°, camera, lens, number of samples", "llvmpipe-shadows.txt")


def stability():
    areas = {}
    for case in run_of("llvmpipe-stability")["cases"]:
        if case["limit"] is not None and not case["leftOut"]:
            areas.setdefault(case["area"], []).append(case["passed"])
    return run_table("llvmpipe-stability", ["area", "cases", "within their limit"],
                     [[area, len(passed), sum(passed)] for area, passed in areas.items()],
                     "each case has its own truth and a limit that stands in the source")


def honesty(every_setting=True):
    methods = {}
    for row in run_of("llvmpipe-stability")["lensHonesty"]:
        if every_setting or not re.search(":|embree", row["method"]):
            methods.setdefault(row["method"], []).append(row)
    rows = []
    for method, cases in methods.items():
        if cases[-1].get("leftOut"):
            rows.append([f"`{method}`", f"left out: {cases[-1]['leftOut']}", ""])
            continue
        worst = max((row["measuredDiameter"] - row["expectedDiameter"] for row in cases), key=abs)
        rows.append([f"`{method}`", f"{worst:+.2f} px", f"{sum(row['followsLens'] for row in cases)} of {len(cases)}"])
    return run_table("llvmpipe-stability", ["method", "largest error of the disk's diameter",
                                            "cases: diameter within half a pixel, light within 5 %"], rows,
                     "a point of light; one value of the lens, the image or the sampling changes at a time")


# ---- tables about parts of a frame ----------------------------------------------------------------------------------


def sequences():
    lines = lines_of("llvmpipe-sequences")
    (begin,) = [index for index, line in enumerate(lines) if line.startswith("fish school")]
    rows = []
    for line in lines[begin + 3:begin + 7]:
        name, values = line.split(maxsplit=1)
        rows.append([f"`{name}`", *(f"{value / 1000:.5f}" for value in numbers(values)[2:16:4])])
    return table(["school of fish", "RMSE, 16 samples", "64", "256", "1,024"], rows) + source(
        "defocus_sequence_bench", "scene, camera, lens, 160 × 120 px, full detail", "llvmpipe-sequences.txt")


# Matches a row of `bench convergence`. Groups: method and setting, samples, milliseconds, PSNR, FLIP.
METHOD_ROW = re.compile(r"[*+f ]{3}(\S.*?)\s+(\d+)\s+([\d.]+)\s+[\d.]+ to [\d.]+\s+\d+\s+\d+\s+([\d.]+)\s+[\d.]+\s+([\d.]+)")


def method_rows(name):
    """Returns {scene: {(method and setting, samples): (milliseconds, PSNR, FLIP)}} from a text result.

    Only the first table of each scene is read.
    """
    scenes = {}
    for line in lines_of(name):
        if scene := re.match(r"(.+), \d+ x \d+ px, \d+ runs", line):
            rows = {}
            scenes.setdefault(scene[1], rows)
        elif row := METHOD_ROW.match(line):
            rows[row[1], int(row[2])] = tuple(map(float, row.groups()[2:]))
    return scenes


def command_in(name, scene):
    """Returns the first command that contains `scene` in a text result of `bench convergence`."""
    return next(line[2:] for line in lines_of(name) if line.startswith("$ ") and scene in line)


def few_images():
    """Returns the table of errors of methods that draw few images, with published, default and best settings."""
    name = "llvmpipe-circular"
    settings = {"published": "published", "best": "best", None: "default"}
    rows = []
    for (method, images), (_, psnr, flip) in method_rows(name)["fish school"].items():
        if parts := re.fullmatch(r"(\w+)(?: \((published|best)\), .+|, default|, lod=off)", method):
            rows.append([f"`{parts[1]}`", settings[parts[2]], images, f"{psnr:.1f}", f"{flip:.4f}"])
    return table(["method", "settings", "images or samples", "PSNR, dB", "FLIP"], rows) + source(
        command_in(name, "--fish 10"), "scene, camera, lens, image size, reference, process", f"{name}.txt")


def layers():
    """Returns the table of times and errors of the methods `layered` and accumulation, by number of lens samples."""
    methods = ("accumulation, lod=off", "layered, lod=off")
    scene = method_rows("llvmpipe-layered")["fish school"]
    counts = sorted({count for _, count in scene})
    rows = [[count, *(f"{scene[method, count][0] / 1000:.1f}" for method in methods),
             *(f"{scene[method, count][1]:.1f}" for method in methods)] for count in counts]
    return table(["lens samples", "`accumulation`, s", "`layered`, s", "`accumulation`, PSNR", "`layered`, PSNR"], rows) + source(
        command_in("llvmpipe-layered", "--size 512x384"),
        "scene, camera, lens, full detail, image size, reference, process", "llvmpipe-layered.txt")


def parts(summary=False):
    def of_both(texts):
        return f"{texts[0]} at full detail, {texts[1]} with levels"

    lines = lines_of("llvmpipe-clusters")
    (at,) = [index for index, line in enumerate(lines) if line.startswith("helmets")]
    clusters = [numbers_after(lines[:at], levels) for levels in ("off", "fractional")]
    hidden = [numbers_after(lines[at:], f"hidden, {levels}") for levels in ("off", "fractional")]
    elisions = lines_of("llvmpipe-elisions")
    out_of_view, sharp = (f"{numbers_after(elisions, beginning)[2]:.1f}" for beginning in
                          ("most fish out of view (culling)", "f/64: nothing blurred (lens samples)"))
    if summary:
        return table(["what is culled", "times as fast, full detail", "times as fast, levels"], [
            ["triangles that face away or lie outside, school of fish", *(f"{row[6]:.2f}" for row in clusters)],
            ["hidden triangles, on the CPU, twenty FlightHelmets", *(f"{row[4]:.2f}" for row in hidden)],
            ["objects that no lens sample sees, most fish out of view", "", out_of_view],
            ["48 of 64 samples where no blur reaches half a pixel (f/64)", "", sharp]
        ]) + ("\nCommand: `defocus_cluster_bench` ([run](../bench/results/llvmpipe-clusters.txt)), `defocus_elision_bench` "
              "of commit 74044bcd ([run](../bench/results/llvmpipe-elisions.txt)).\n")
    empty = max((row for row in run_of("llvmpipe-scaling")["rows"] if row["lod"] == "off"), key=lambda row: row["samples"])
    separable, direct = numbers_after(lines_of("llvmpipe-post-process"), "  exponent")
    rows = [
        [f"one lens sample of {empty['width']} × {empty['height']} px in which nothing is drawn: clear and add",
         f"{empty['layersMilliseconds'] / empty['samples']:.1f} ms", "defocus bench scaling", "scaling.json"],
        *([what, of_both(texts), "defocus_cluster_bench", "clusters.txt"] for what, texts in (
            ["clusters that face away or lie outside are left out: share of the triangles, school of fish",
             [f"{100 * (away + outside) / total:.0f} %" for total, away, outside, *_ in clusters]],
            ["the same: times as fast, same image", [f"{row[6]:.2f}" for row in clusters]],
            ["what lies behind others is left out, on the CPU: share of the triangles of twenty FlightHelmets",
             [f"{100 * row[1] / row[0]:.0f} %" for row in hidden]],
            ["the same: times as fast, same image", [f"{row[4]:.2f}" for row in hidden]])),
        ["objects that no lens sample sees are left out, most fish out of view: times as fast", out_of_view, "defocus_elision_bench",
         "elisions.txt"],
        ["16 samples instead of 64 if no blur reaches half a pixel (f/64): times as fast", sharp, "defocus_elision_bench", "elisions.txt"],
        ["cost of a circular disk over its radius, 8 to 64 px: exponent", f"{separable:.2f} separable, {direct:.2f} direct",
         "defocus_post_process_bench", "post-process.txt"]]
    return table(["what", "figure", "command"], [
        [what, figure, f"`{command}` ([run](../bench/results/llvmpipe-{run}))"] for what, figure, command, run in rows
    ]) + "\nCommit 74044bcd has the program `defocus_elision_bench`. The program chose levels by size (`--lod-metric size`).\n"


def lens_space_rows():
    """Returns (model, numbers) for each row of the first table of the lens-space bench."""
    rows = []
    for line in lines_of("llvmpipe-lens-space"):
        cells = [cell.strip() for cell in line.split("|")[1:-1]]
        if len(cells) == 15 and cells[1].isdigit():
            rows.append([f"`{cells[0].removesuffix('.glb')}`", *(float(cell) for cell in cells[1:])])
    return rows


def lens_space_source(options, held_equal):
    return source(f"defocus_lens_space_bench --size {options} MODEL…", held_equal, "llvmpipe-lens-space.txt")


def lens_space():
    rows = [[name, f"{triangles:,.0f}", f"{points / 1000:.2f} s", f"{lines / 1000:.2f} s", f"{ratio:.1f}", f"{buffered:.1f}",
             f"{rmse:.4f}", f"{few:.4f}", f"{line:.4f}", f"{published:.4f}"]
            for name, triangles, points, lines, ratio, _, buffered, rmse, line, published, _, few, *_ in lens_space_rows()]
    return table(["model", "triangles", "256 points", "16 lines", "times as fast", "as published", "RMSE, 256 points", "64 points",
                  "16 lines", "as published"], rows) + lens_space_source(
        "160x160", "scene, camera, light, image size, process; the blur of the most blurred "
        "object is a tenth of the image's width; errors are against 1,600 samples of the accumulation")


def strobes():
    rows = [[row[0], *(f"{row[column]:.4f}" for column in (8, 12, 13, 14))] for row in lens_space_rows()]
    return table(["RMSE, 16 lines", "pixels, turned wheels", "pixels, one wheel", "8 × 8 px, turned wheels", "8 × 8 px, one wheel"],
                 rows) + lens_space_source("160x160", "as above")


def lens_level_table():
    rows = [[f"`{model}`", f"{lines:.0f}", f"{100 * blur:.0f} %", f"{full / 1000:.2f} s", f"{ours:.2f}", f"{our_error:.4f}",
             f"{three:.2f}", f"{three_error:.4f}"]
            for model, measured in lens_levels().items()
            for lines, blur, full, _, ours, our_error, _, three, three_error in measured]
    return table(["model", "lines", "blur, of the width", "full detail", "fractional levels: times as fast", "RMSE", "three levels: "
                  "times as fast", "RMSE"], rows) + lens_space_source(
        "128x128 --figure7", "scene, camera, light, image size, process, threshold of the score; errors are against full detail with as "
        "many lines")


TABLES = {"scaling": scaling, "pyramids": pyramids, "truth": ray_tracer, "cycles": cycles, "shadows": shadows,
          "stability": stability, "honesty": honesty,
          "lens equation": lambda: honesty(every_setting=False), "memory": memory, "few images": few_images, "layers": layers,
          "exponents": lambda: scaling(with_parts=False), "pyramid summary": lambda: pyramids(summary=True),
          "parts summary": lambda: parts(summary=True),
          "sequences": sequences, "parts": parts, "lens-space": lens_space, "strobes": strobes, "lens-levels": lens_level_table}
