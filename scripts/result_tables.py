"""The tables of docs/results.md, each made from a committed run: what scripts/readme_tables writes there.

Each function of TABLES returns Markdown: a table, and under it the command for its figures, what was held equal, and a
link to the run. Results are JSON where the bench writes it, else the text that it prints.
"""

import json
import pathlib
import re

RESULTS = pathlib.Path(__file__).resolve().parent.parent / "bench" / "results"
MOVEMENTS = ("focus-pull", "dolly", "turntable")
MODES = {"off": "full detail", "nearest": "nearest level", "fractional": "split samples", "continuous": "split pixels",
         "multirate": "multirate"}


def results_of(name):
    return json.loads((RESULTS / f"llvmpipe-{name}.json").read_text())


def lines_of(name):
    return (RESULTS / f"llvmpipe-{name}.txt").read_text().splitlines()


# What these runs' commands need since levels are chosen by measured error: the runs had levels by size without being told.
BY_SIZE = {"methods-fish": " --metrics size", "speedup-fish": " --lod-metric size"}
# These runs had one near component and a near field of coverage where nothing was said of them.
CIRCULAR_BY_COVERAGE = ("methods-fish", "methods-lens-space")


def command_of(name, results):
    """As it was called, but for where it wrote, and with what it needs today to measure the same."""
    command = re.sub(r" (-o \S+|--report \S+|--quiet)", "", results["commands"][0]) + BY_SIZE.get(name, "")
    if name not in CIRCULAR_BY_COVERAGE:
        return command
    return re.sub(r"(?<=[ ,])circular(:?)",
                  lambda found: "circular:near-components=1,near-field=coverage" + ("," if found[1] else ""), command)


def warning(results):
    """What must stand above figures that nobody can check out and repeat."""
    if not results["commit"].endswith("-changed"):
        return ""
    return (f"**These figures come from a program with uncommitted changes ({results['commit']}). They can't be repeated exactly, and "
            "they are due to be measured again.**\n\n")


def numbers(text):
    return [float(word) for word in re.findall(r"-?\d+\.?\d*(?:e[+-]\d+)?", text)]


def numbers_after(lines, beginning):
    """All numbers of the only line that begins so, without those in the beginning itself."""
    (line,) = [line for line in lines if line.startswith(beginning)]
    return numbers(line[len(beginning):])


def span(values, digits):
    low, high = (f"{value:.{digits}f}" for value in (min(values), max(values)))
    return low if low == high else f"{low} to {high}"


def mean_of(values):
    values = list(values)
    return sum(values) / len(values)


def table(header, rows):
    return "\n".join("| " + " | ".join(row) + " |" for row in [header, ["---"] * len(header), *rows]) + "\n"


def source(command, held_equal, file):
    return f"\nCommand: `{command}` ([the run](../bench/results/{file})). Held equal: {held_equal}.\n"


def only_then(benches_have):
    """Of runs that no command repeats today."""
    return (f"\nLevels were chosen by size, which was the default then. {benches_have} no option for it, so only the program of that time "
            "measures them again.\n")


def source_of(name):
    results = results_of(name)
    held = results["heldEqual"].rstrip(".")
    commit = f", commit {results['commit']}"
    return warning(results), source(command_of(name, results), held, f"llvmpipe-{name}.json").replace("the run]", f"the run{commit}]")


# ---- speed ----------------------------------------------------------------------------------------------------------


def accumulation_rows(name, preset=""):
    """What `bench speedup` measured with a preset, or without one, of no other method."""
    return [row for row in results_of(name)["rows"]
            if (row.get("preset", ""), row.get("method", "accumulation")) == (preset, "accumulation")]


def samples_sweep(name, preset=""):
    """(samples, {mode: row}) of the view's own lens."""
    rows = [row for row in accumulation_rows(name, preset) if row["sweep"] == "samples"]
    counts = sorted({row["samples"] for row in rows})
    return [(count, {row["lod"]: row for row in rows if row["samples"] == count}) for count in counts]


def seconds(row):
    return row["milliseconds"]["median"] / 1000


def error_ratio(modes):
    return modes["fractional"]["fromReference"]["rmse"] / modes["off"]["fromReference"]["rmse"]


def missed(value, aim):
    """In bold where it is above its aim."""
    return f"**{value:.2f}**" if value > aim else f"{value:.2f}"


def speed_table(name):
    above, below = source_of(name)
    rows = []
    for count, modes in samples_sweep(name):
        off, levels = modes["off"], modes["fractional"]
        rows.append([str(count), f"{seconds(off):.2f} s", f"{seconds(levels):.2f} s", f"{levels['speedUp']:.1f}",
                     f"{off['fromReference']['rmse']:.4f}", f"{levels['fromReference']['rmse']:.4f}", missed(error_ratio(modes), 1.2),
                     f"{levels['fromFullDetail']['psnr']:.1f} dB", f"{levels['fromFullDetail']['flip']:.4f}"])
    header = ["lens samples", "full detail", "levels", "times as fast", "RMSE, full detail", "RMSE, levels", "times the error",
              "PSNR between the two", "FLIP between the two"]
    return above + table(header, rows) + below


def speedup():
    return speed_table("speedup-fish")


def helmets():
    return speed_table("speedup-helmets")


def flip_ratio(modes):
    return modes["fractional"]["fromReference"]["flip"] / modes["off"]["fromReference"]["flip"]


def measured():
    """What levels by measured error save and cost."""
    above, below = source_of("speedup-jeong2011")
    rows = []
    for count, modes in samples_sweep("speedup-jeong2011"):
        full, levels = modes["off"], modes["fractional"]
        rows.append([str(count), f"{full['triangles'] / 1e6:.1f} M", f"{levels['triangles'] / 1e6:.1f} M", f"{seconds(full):.2f} s",
                     f"{seconds(levels):.2f} s", f"{levels['speedUp']:.1f}", f"{levels['sizeOnly']['speedUp']:.1f}",
                     f"{levels['blurOnly']['speedUp']:.1f}", f"{full['fromReference']['rmse']:.4f}", missed(error_ratio(modes), 1.2),
                     f"{full['fromReference']['flip']:.4f}", missed(flip_ratio(modes), 1.2)])
    header = ["lens samples", "triangles, full detail", "triangles, levels", "full detail", "levels", "times as fast", "size only", "blur only",
              "RMSE, full detail", "times that, levels", "FLIP, full detail", "times that, levels"]
    return above + table(header, rows) + below


def published():
    """The published algorithm beside this program's own: frame times over lens samples, as in the paper's Figure 2."""
    above, below = source_of("speedup-jeong2011")
    own = dict(samples_sweep("speedup-jeong2011"))
    rows = []
    for count, theirs in samples_sweep("speedup-jeong2011", "jeong2011"):
        for name, modes in (("`jeong2011`, Halton", theirs), ("today's default, Sobol", own[count])):
            full, levels = modes["off"], modes["fractional"]
            rows.append([str(count), name, f"{seconds(full):.2f} s", f"{seconds(levels):.2f} s", f"{levels['speedUp']:.1f}",
                         f"{levels['sizeOnly']['speedUp']:.1f}", f"{levels['blurOnly']['speedUp']:.1f}",
                         f"{full['fromReference']['rmse']:.4f}", f"{levels['fromReference']['rmse']:.4f}", missed(error_ratio(modes), 1.2)])
    header = ["lens samples", "settings", "full detail", "levels", "times as fast", "size only", "blur only", "RMSE, full detail",
              "RMSE, levels", "times the error"]
    return above + table(header, rows) + below


def lenses():
    above, below = source_of("speedup-lenses")
    measured = accumulation_rows("speedup-lenses")
    rows = []
    for row in measured:
        if row["lod"] != "fractional" or row["samples"] != 64:
            continue
        (full,) = [other for other in measured if other["lod"] == "off" and
                   all(other[key] == row[key] for key in ("sweep", "samples", "fStop", "focusDistance"))]
        rows.append([f"f/{row['fStop']:g}", f"{row['focusDistance']:g} m", f"{seconds(full):.2f} s", f"{seconds(row):.2f} s",
                     f"{row['speedUp']:.1f}", f"{row['fromFullDetail']['psnr']:.1f} dB"])
    return above + table(["f-number", "focus", "full detail", "levels", "times as fast", "PSNR between the two"], rows) + below


def speed_sentence():
    """README's line on speed and quality."""
    results = results_of("speedup-fish")
    by_size = dict(samples_sweep("speedup-fish"))[64]
    levels, full = by_size["fractional"], by_size["off"]
    drawn = dict(samples_sweep("speedup-jeong2011"))[64]
    text = (f"With 64 lens samples, the built-in scene is drawn from {drawn['fractional']['triangles'] / 1e6:.0f} instead of "
            f"{drawn['off']['triangles'] / 1e6:.0f} million triangles, at {error_ratio(drawn):.2f} times the error of full meshes (FLIP: "
            f"{flip_ratio(drawn):.2f} times). On {results['machine']['threads']} CPU cores without a GPU this takes "
            f"{seconds(drawn['fractional']):.1f} s instead of {seconds(drawn['off']):.1f} s, {drawn['fractional']['speedUp']:.1f} times as fast. "
            f"Coarser levels (`--lod-metric size`) are {levels['speedUp']:.1f} times as fast, at {error_ratio(by_size):.1f} times the error. "
            "[Results](docs/results.md) has all measurements, also against a CPU ray tracer")
    return wrapped(text + " and on [a GPU](docs/results.md#on-a-gpu).")


def wrapped(text, width=128):
    lines, line = [], ""
    for word in text.split(" "):
        if line and len(line) + 1 + len(word) > width:
            lines.append(line)
            line = word
        else:
            line = f"{line} {word}".strip()
    return "\n".join([*lines, line]) + "\n"


def demo():
    lines = lines_of("demo")
    rows = []
    for name in ("full detail", "fractional levels"):
        (line,) = [line for line in lines if line.startswith(name)]
        rows.append([name, *re.split(r"\s{2,}", line.strip())[1:]])
    ratio = numbers_after(lines, "speed-up of the frame")[0]
    psnr, ssim, flip = numbers_after(lines, "image difference")
    text = table(["1024 × 768, 64 lens samples", "frame", "a sample", "triangles drawn", "peak memory"], rows)
    text += f"\nThe second frame is {ratio:.1f} times as fast. The two images differ by PSNR {psnr:.1f} dB, SSIM {ssim:.3f}, FLIP {flip:.4f}.\n"
    return text + source("scripts/demo", "program, renderer, lens samples, buffers, and the removal of triangles that face away or lie "
                         "outside the image", "llvmpipe-demo.txt")


def seeds():
    """What the demo's difference is as large as."""
    rows, name = [], ""
    for line in lines_of("seeds"):
        if line.startswith("$ "):
            name = line.split()[-1].removesuffix(".exr")
            rows.append([{"seed": "full detail, other lens samples (`--seed 1`)", "levels": "levels, same lens samples"}[name]])
        elif line.startswith(("rmse", "psnr", "ssim", "flip")):
            value = numbers(line)[0]
            rows[-1].append(f"{value:.1f} dB" if line.startswith("psnr") else f"{value:.4f}")
    return table(["against full detail", "RMSE", "PSNR", "SSIM", "FLIP"], rows) + source(
        "defocus render --samples 64 --lod off -o full.exr; defocus render --samples 64 --lod off --seed 1 -o seed.exr; defocus render "
        "--samples 64 -o levels.exr; defocus compare full.exr seed.exr; defocus compare full.exr levels.exr", "scene, camera, lens, image size, number of lens samples", "llvmpipe-seeds.txt")


def scaling():
    above, below = source_of("scaling")
    axes = {"triangles": "triangles, 100 k to 10 M", "instances": "instances, 1 to 10,000", "samples": "lens samples, 2 to 64",
            "pixels": "pixels, 640 × 480 to 3840 × 2160", "blur": "blur, f/16 to f/1"}
    curves = {(curve["axis"], curve["lod"]): curve for curve in results_of("scaling")["curves"]}
    rows = [[name, *(f"{curves[axis, lod]['time']['exponent']:.2f}" for lod in ("off", "fractional")),
             curves[axis, "fractional"]["bounds"]] for axis, name in axes.items()]
    header = ["what grows", "exponent, full detail", "exponent, levels", "what takes the time, with levels"]
    return above + table(header, rows) + below + only_then("This bench has")


# ---- popping --------------------------------------------------------------------------------------------------------


def popping():
    above, below = source_of("popping")
    rows = {(row["movement"], row["lod"]): row for row in results_of("popping")["rows"] if row["samples"] == 32}
    cells = []
    for movement in MOVEMENTS:
        for mode in ("nearest", "fractional", "continuous", "multirate"):
            row = rows[movement, mode]
            aims = {"stepRmse": {"fractional": 0.25, "continuous": 0.05, "multirate": 0.25}.get(mode, 1)}
            cells.append([movement.replace("-", " "), MODES[mode], *(
                f"{row[kind]['worst']:.4f}" + ("" if mode == "nearest" else f" ({missed(row[kind]['ofNearest'], aims.get(kind, 1))})")
                for kind in ("stepRmse", "stepFlip", "changeRmse"))])
    header = ["movement", "levels", "largest pop, RMSE", "largest pop, FLIP", "largest change, RMSE"]
    return above + table(header, cells) + below


# ---- multirate ------------------------------------------------------------------------------------------------------

def rates():
    """What each of multirate's rates gives, alone and with levels, over the number of lens samples."""
    above, below = source_of("multirate-rates")
    named = {("accumulation", ""): "none", ("multirate", "cells=off "): "shared images", ("multirate", ""): "cells"}
    cells = []
    for row in sorted(results_of("multirate-rates")["rows"], key=lambda row: row["samples"]):
        rate = named[row["method"], "cells=off " if row["setting"].startswith("cells=off ") else ""]
        levels = "no" if row["setting"].endswith("lod=off") else "yes"
        cells.append([str(row["samples"]), rate, levels, f"{row['milliseconds']['median'] / 1000:.2f} s",
                      f"{10 ** (-row['psnr'] / 20):.4f}", f"{row['ssim']:.4f}", f"{row['flip']:.4f}"])
    return above + table(["lens samples", "rate", "levels", "frame", "RMSE", "SSIM", "FLIP"], cells) + below


# ---- pyramids -------------------------------------------------------------------------------------------------------

def cache():
    rows = [numbers(line) for line in lines_of("cache") if re.match(r" *\d+ ", line)]
    return span([row[5] / 1000 for row in rows], 2)


def pyramids():
    lines = lines_of("pyramids")
    blank = [index for index, line in enumerate(lines) if not line.strip()]
    times, distances, looks, normals = (lines[begin:end] for begin, end in zip([0, *blank], [*blank, None]))

    def values_of(section, count):
        """(name, numbers) of the lines that end in so many numbers, what stands in brackets aside."""
        for line in section:
            words = line.split("  (")[0].split()
            if len(words) > count and all(re.fullmatch(r"[\d.]+", word) for word in words[-count:]):
                yield " ".join(words[:-count]), [float(word) for word in words[-count:]]

    whole = list(values_of(times, 12))
    large = [values for _, values in whole if values[0] >= 50_000]
    smooth = [values for name, values in whole if values[0] >= 50_000 and "flat" not in name]
    bytes_each = {name: values[1] for name, values in [*values_of(times, 8), *whole]}
    fish = min((values for name, values in whole if name == "fish"), key=lambda values: values[0])
    rows = dict(values_of(distances, 5))
    all_levels = rows.pop("all")
    worst = max(rows, key=lambda name: rows[name][3])
    gains = [values[4] - values[5] for _, values in values_of(looks, 8)]
    fitted = [(values[3] - values[4], values[3] - values[5]) for _, values in values_of(normals, 9)]
    rows = [
        ["PSNR against meshoptimizer's level of as many triangles, under the blur that picks the level",
         f"{mean_of(gains):.1f} dB better in the mean of {len(gains)} levels ({span(gains, 1)})"],
        ["PSNR of fitted normals against normals averaged over the level's faces",
         f"{mean_of(gain for gain, _ in fitted):.1f} dB better in the mean of {len(fitted)} levels "
         f"({span([gain for gain, _ in fitted], 1)})"],
        ["PSNR of fitted normals against those of the surviving vertices",
         f"{mean_of(gain for _, gain in fitted):.1f} dB better in the mean of {len(fitted)} levels "
         f"({span([gain for _, gain in fitted], 1)})"],
        ["mean distance to the mesh, over that of meshoptimizer's level of as many triangles",
         f"{all_levels[2]:.2f} in the mean of {all_levels[1]:.0f} levels of {len(rows)} meshes; at most 1.1 in "
         f"{100 * all_levels[4] / all_levels[1]:.0f} % of the levels; {all_levels[3]:.1f} at worst ({worst})"],
        [f"time of the levels of meshes of {min(values[0] for values in large) / 1000:.0f} k to 1 M triangles, against OpenMesh's "
         "DecimaterT, one thread", f"{span([values[10] for values in large], 1)} times as fast; {fish[4]:.2f} s for a fish of 90 k triangles"],
        ["time of whole pyramids of the same meshes, with all that is fitted and measured, against DecimaterT alone",
         f"{span([values[11] for values in large], 1)} times as fast; {fish[2]:.2f} s for the fish"],
        ["peak memory of building the same pyramids", f"{span([values[1] for values in smooth], 0)} bytes a triangle; with flat shading "
         f"{bytes_each['fish, flat-shaded']:.0f} (a fish of a million), with texture coordinates too {bytes_each['bike']:.0f} (bike), "
         f"of a small mesh {bytes_each['Suzanne']:.0f} (Suzanne)"],
        ["loading the pyramids of 1.8 M triangles from the cache (`defocus_cache_bench`)", f"{cache()} s"]]
    return table(["what", "figure"], rows) + source(
        "defocus_pyramid_bench --million MODEL…", "mesh and number of triangles; for the images also camera, lens, level and lens samples",
        "llvmpipe-pyramids.txt")


# ---- correctness ----------------------------------------------------------------------------------------------------


def truth():
    scenes = [json.loads(line) for line in lines_of("truth") if line.startswith("{")]
    rows = [[scene["scene"], f"{scene['psnr']:.1f} dB", f"{scene['psnrAtEqualLensPoints']:.1f} dB", f"{scene['flip']:.4f}"]
            for scene in scenes]
    return table(["scene", "PSNR, other lens points", "PSNR, same lens points", "FLIP, other lens points"], rows) + source(
        "defocus_truth_bench --sequence halton --samples 256 --size 512x384 [SCENE …]",
        "scene with painted light, camera, lens, number of samples", "llvmpipe-truth.txt")


def shadows():
    scenes = [json.loads(line) for line in lines_of("shadows") if line.startswith("{")]
    def seconds(scene, renderer):
        with_shadows, without = (scene[f"{renderer}Milliseconds{end}"] / 1000 for end in ("", "WithoutShadows"))
        return f"{without:.1f} → {with_shadows:.1f} s"
    rows = [[scene["scene"], f"{scene['psnr']:.1f} dB", f"{scene['psnrWithoutShadows']:.1f} dB", f"{scene['psnrIfLeftOut']:.1f} dB",
             f"{scene['flip']:.4f}", seconds(scene, "accumulation"), seconds(scene, "embree")] for scene in scenes]
    return table(["scene", "PSNR", "without shadows", "if only the ray tracer has them", "FLIP", "accumulation, without → with",
                  "ray tracer, without → with"], rows) + source(
        "defocus_truth_bench --shadows 5 --samples 64 --size 512x384 [SCENE …]",
        "scene with matt colours under one sun of 5°, camera, lens, number of samples", "llvmpipe-shadows.txt")


def stability():
    results = results_of("stability")
    areas = {}
    for case in results["cases"]:
        if case["limit"] is not None and not case["leftOut"]:
            areas.setdefault(case["area"], []).append(case)
    rows = [[area, str(len(cases)), str(sum(case["passed"] for case in cases))] for area, cases in areas.items()]
    return warning(results) + table(["area", "cases", "within their limit"], rows) + source(
        command_of("stability", results), "each case has its own truth and a limit that stands in the source", "llvmpipe-stability.json")


def honesty():
    results = results_of("stability")
    rows = []
    for method in dict.fromkeys(row["method"] for row in results["lensHonesty"]):
        cases = [row for row in results["lensHonesty"] if row["method"] == method]
        if cases[-1].get("leftOut"):
            rows.append([f"`{method}`", f"left out: {cases[-1]['leftOut']}", ""])
            continue
        worst = max((row["measuredDiameter"] - row["expectedDiameter"] for row in cases), key=abs)
        rows.append([f"`{method}`", f"{worst:+.2f} px", f"{sum(row['followsLens'] for row in cases)} of {len(cases)}"])
    return warning(results) + table(["method", "largest error of the disk's diameter", "cases within half a pixel and 5 % of the energy"],
                                    rows) + source(command_of("stability", results), "a point of light; one value of the lens, the image or "
                                                   "the sampling changes at a time", "llvmpipe-stability.json")


# ---- parts ----------------------------------------------------------------------------------------------------------


def sequences():
    lines = lines_of("sequences")
    (begin,) = [index for index, line in enumerate(lines) if line.startswith("fish school")]
    rows = []
    for line in lines[begin + 3:begin + 7]:
        rmse = numbers(line.split(maxsplit=1)[1])[::2]
        rows.append([f"`{line.split()[0]}`", *(f"{rmse[column] / 1000:.5f}" for column in (1, 3, 5, 7))])
    return table(["RMSE, school of fish", "16 samples", "64", "256", "1,024"], rows) + source(
        "defocus_sequence_bench", "scene, camera, lens, 160 × 120 px, full detail", "llvmpipe-sequences.txt")


def parts():
    fastest = {}
    for sky in ("uniform", "gradient"):
        rows = [line.split() for line in lines_of("waves") if line.startswith(sky) and " rgba16f " in line]
        fastest[sky] = min(float(row[3]) for row in rows)
    lines = lines_of("clusters")
    (at,) = [index for index, line in enumerate(lines) if line.startswith("helmets")]
    school, helmets = lines[:at], lines[at:]
    shares, ratios = [], []
    for levels in ("off", "fractional"):
        whole, away, outside, _, _, _, ratio = numbers_after(school, levels)[:7]
        shares.append(f"{100 * (away + outside) / whole:.0f}")
        ratios.append(f"{ratio:.2f}")
    hidden = [numbers_after(helmets, f"hidden, {levels}") for levels in ("off", "fractional")]
    culled = numbers_after(lines_of("elisions"), "most fish out of view (culling)")[2]
    sharp = numbers_after(lines_of("elisions"), "f/64: nothing blurred (lens samples)")[2]
    separable, direct = numbers_after(lines_of("post-process"), "  exponent")

    def printed_by(name):
        return f"`defocus_{name.replace('-', '_')}_bench` ([run](../bench/results/llvmpipe-{PRINTED[name]}.txt))"

    return table(["what", "figure", "command"], [
        ["one lens sample of 1024 × 768 px in which nothing is drawn: clear, compose, add",
         f"{fastest['uniform']:.1f} ms; {fastest['gradient']:.1f} ms with a gradient sky", printed_by("wave")],
        ["clusters that face away or lie outside are left out: share of the triangles, school of fish",
         f"{shares[0]} % at full detail, {shares[1]} % with levels", printed_by("cluster")],
        ["the same: times as fast, same image", f"{ratios[0]} at full detail, {ratios[1]} with levels", printed_by("cluster")],
        ["what lies behind others is left out, on the CPU: share of the triangles of twenty FlightHelmets",
         f"{100 * hidden[0][1] / hidden[0][0]:.0f} % at full detail, {100 * hidden[1][1] / hidden[1][0]:.0f} % with levels",
         printed_by("cluster")],
        ["the same: times as fast, same image", f"{hidden[0][4]:.2f} at full detail, {hidden[1][4]:.2f} with levels",
         printed_by("cluster")],
        ["objects that no lens sample sees are left out, most fish out of view: times as fast", f"{culled:.1f}", printed_by("elision")],
        ["16 samples instead of 64 if no blur reaches half a pixel (f/64): times as fast", f"{sharp:.1f}", printed_by("elision")],
        ["cost of a circular disk over its radius, 8 to 64 px: exponent", f"{separable:.2f} separable, {direct:.2f} direct",
         printed_by("post-process")]]) + only_then("`defocus_elision_bench` has")


PRINTED = {"wave": "waves", "cluster": "clusters", "elision": "elisions", "post-process": "post-process"}
def lens_space_rows(columns):
    """The rows of the runs' tables with so many columns, as text and numbers."""
    rows = []
    for line in lines_of("lens-space"):
        cells = [cell.strip() for cell in line.split("|")[1:-1]]
        if len(cells) == columns and cells[1].isdigit():
            rows.append([cells[0].removesuffix(".glb"), *(float(cell) for cell in cells[1:])])
    return rows


def lens_space():
    rows = [[f"`{name}`", f"{triangles:,.0f}", f"{points / 1000:.2f} s", f"{lines / 1000:.2f} s", f"{ratio:.1f}", f"{buffered:.1f}",
             f"{rmse:.4f}", f"{few:.4f}", f"{line:.4f}", f"{published:.4f}"]
            for name, triangles, points, lines, ratio, _, buffered, rmse, line, published, few, *_ in lens_space_rows(14)]
    return table(["model", "triangles", "256 points", "16 lines", "times as fast", "as published", "RMSE, 256 points", "64 points",
                  "16 lines", "as published"], rows) + source(
        "defocus_lens_space_bench --size 160x160 MODEL…", "scene, camera, light, image size, process; the blur of the most blurred "
        "object is a tenth of the image's width; errors are against 1,600 samples of the accumulation", "llvmpipe-lens-space.txt")


def strobes():
    rows = [[f"`{row[0]}`", f"{row[8]:.4f}", f"{row[11]:.4f}", f"{row[12]:.4f}", f"{row[13]:.4f}"] for row in lens_space_rows(14)]
    return table(["RMSE, 16 lines", "pixels, turned wheels", "pixels, one wheel", "8 × 8 px, turned wheels", "8 × 8 px, one wheel"],
                 rows) + source("defocus_lens_space_bench --size 160x160 MODEL…", "as above", "llvmpipe-lens-space.txt")


def lens_levels_of():
    """Rows of each model of Figure 7."""
    models = {}
    for line in lines_of("lens-space"):
        if ": milliseconds of line samples" in line:
            rows = models.setdefault(line.split(".glb")[0], [])
        cells = [cell.strip() for cell in line.split("|")[1:-1]]
        if len(cells) == 9 and cells[0].isdigit():
            rows.append([float(cell) for cell in cells])
    return models


def lens_levels():
    rows = [[f"`{model}`", f"{lines:.0f}", f"{100 * blur:.0f} %", f"{full / 1000:.2f} s", f"{ours:.2f}", f"{our_error:.4f}",
             f"{three:.2f}", f"{three_error:.4f}"]
            for model, measured in lens_levels_of().items()
            for lines, blur, full, _, ours, our_error, _, three, three_error in measured]
    return table(["model", "lines", "blur, of the width", "full detail", "fractional levels: times as fast", "RMSE", "three levels: "
                  "times as fast", "RMSE"], rows) + source(
        "defocus_lens_space_bench --size 128x128 --figure7 MODEL…", "scene, camera, light, image size, process, threshold of the "
        "score; errors are against full detail with as many lines", "llvmpipe-lens-space.txt")


# ---- a GPU ----------------------------------------------------------------------------------------------------------


def on_gpu(name):
    """The results, and what stands below their table."""
    file = f"h200-{name}.json"
    results = json.loads((RESULTS / file).read_text())
    held = results["heldEqual"].rstrip(".")
    return results, source(results["commands"][0], held, file).replace("the run]", f"the run, commit {results['commit']}]")


def gpu_speed():
    results, below = on_gpu("speedup")
    rows = []
    for count in sorted({row["samples"] for row in results["rows"]}):
        modes = {row["lod"]: row for row in results["rows"] if row["samples"] == count}
        off, levels = modes["off"], modes["fractional"]
        rows.append([str(count), f"{off['milliseconds']['median']:.0f} ms", f"{levels['milliseconds']['median']:.0f} ms",
                     f"{levels['speedUp']:.1f}", f"{levels['sizeOnly']['speedUp']:.1f}", f"{levels['blurOnly']['speedUp']:.1f}",
                     missed(error_ratio(modes), 1.2), missed(flip_ratio(modes), 1.2)])
    return table(["lens samples", "full detail", "levels", "times as fast", "size only", "blur only", "times the RMSE", "times the FLIP"],
                 rows) + below


def gpu_equal_error():
    text, below = [], []
    for name, scene in [("school", "Fish school"), ("helmets", "FlightHelmet 20 times")]:
        results, command = on_gpu(name)
        methods = results["timesToErrors"]
        if not text:
            text = [["milliseconds a frame", *(f"RMSE {time['rmse']}" for time in methods[0]["times"])]]
        text.append([f"**{scene}**", "", "", ""])
        for method in methods:
            text.append([method["name"], *(gpu_time(time) for time in method["times"])])
        below.append(command)
    return table(text[0], text[1:]) + "".join(below)


def gpu_time(time):
    if time["milliseconds"] is None:
        return "not reached"
    return f"{'< ' if time['atMost'] else ''}{time['milliseconds']:.0f}"


TABLES = {"gpu speed": gpu_speed, "gpu equal error": gpu_equal_error,
          "speed": speed_sentence, "demo": demo, "seeds": seeds, "speedup": speedup, "measured": measured, "published": published,
          "lenses": lenses, "helmets": helmets, "scaling": scaling, "popping": popping, "rates": rates, "pyramids": pyramids, "truth": truth, "shadows": shadows,
          "stability": stability, "honesty": honesty, "sequences": sequences, "parts": parts,
          "lens-space": lens_space, "strobes": strobes, "lens-levels": lens_levels}
