"""The rows of README's table of figures, each read from a committed run: what scripts/readme_tables writes there.

A row is (what, figure, command). Results are JSON where the bench writes it, else the table that it prints.
"""

import json
import pathlib
import re

RESULTS = pathlib.Path(__file__).resolve().parent.parent / "bench" / "results"
MOVEMENTS = ("focus-pull", "dolly", "turntable")


def results_of(name):
    return json.loads((RESULTS / f"llvmpipe-{name}.json").read_text())


def lines_of(name):
    return (RESULTS / f"llvmpipe-{name}.txt").read_text().splitlines()


def table_of(name):
    return f"[table](bench/results/llvmpipe-{name}.txt)"


def command_of(results):
    """As it was called, but for where it wrote."""
    return "`" + re.sub(r" (-o \S+|--quiet)", "", results["commands"][0]) + "`"


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


# ---- the renderer ---------------------------------------------------------------------------------------------------


def sequences():
    school = {}
    lines = lines_of("sequences")
    (begin,) = [index for index, line in enumerate(lines) if line.startswith("fish school")]
    for line in lines[begin + 3:begin + 7]:
        school[line.split()[0]] = numbers(line.split(maxsplit=1)[1])[::2]
    ratios = ", ".join(f"{school['sobol'][column] / school['halton'][column]:.2f}" for column in (1, 3, 5))
    return ("RMSE of `--sequence sobol` over that of `halton`, school of fish, 16, 64 and 256 samples", ratios,
            f"`defocus_sequence_bench` ({table_of('sequences')})")


def waves():
    lines = lines_of("waves")
    fastest = {}
    for sky in ("uniform", "gradient"):
        rows = [line.split() for line in lines if line.startswith(sky) and " rgba16f " in line]
        fastest[sky] = min(float(row[3]) for row in rows)
    return ("clear, compose and add a layer: nothing drawn, half floats, 1024 × 768",
            f"{fastest['uniform']:.1f} ms a sample, {fastest['gradient']:.1f} with a gradient sky",
            f"`defocus_wave_bench` ({table_of('waves')})")


def truth():
    scenes = [json.loads(line) for line in lines_of("truth") if line.startswith("{")]
    names = ", ".join(scene["scene"] for scene in scenes)
    sampled = " / ".join(f"{scene['psnr']:.0f}" for scene in scenes)
    equal = " / ".join(f"{scene['psnrAtEqualLensPoints']:.0f}" for scene in scenes)
    return (f"rasteriser against the Embree ray tracer, {scenes[0]['samples']} samples ({names}): PSNR; at the same lens points",
            f"{sampled} dB; {equal} dB",
            f"`defocus_truth_bench --sequence halton --samples 256 --size 512x384 [SCENE …]` ({table_of('truth')}); held above "
            "45 dB by the tests")


def clusters():
    lines = lines_of("clusters")
    shares, ratios = [], []
    for levels in ("off", "fractional"):
        whole, away, outside, _, _, _, ratio = numbers_after(lines, levels)[:7]
        shares.append(f"{100 * (away + outside) / whole:.0f}")
        ratios.append(f"{ratio:.2f}")
    return ("leaving out clusters that face away or lie outside, school of fish: full detail / fractional levels",
            f"{' / '.join(shares)} % of the triangles; {' / '.join(ratios)} times as fast, same image",
            f"`defocus_cluster_bench` ({table_of('clusters')})")


def elisions():
    lines = lines_of("elisions")
    culled = numbers_after(lines, "most fish out of view (culling)")[2]
    sharp = numbers_after(lines, "f/64: nothing blurred (lens samples)")[2]
    return ("leaving out what no lens sample sees / the lens when nothing is blurred",
            f"{culled:.1f} / {sharp:.1f} times as fast, where it applies",
            f"`defocus_elision_bench` ({table_of('elisions')})")


# ---- levels of detail -----------------------------------------------------------------------------------------------


def speedup(name, scene):
    results = results_of(f"speedup-{name}")
    rows = [row for row in results["rows"] if row["sweep"] == "samples" and row["samples"] == 64]
    by_mode = {row["lod"]: row for row in rows}
    figures = "; ".join(
        f"{mode} levels {by_mode[mode]['speedUp']:.1f} times as fast, {by_mode[mode]['fromFullDetail']['psnr']:.1f} dB, "
        f"FLIP {by_mode[mode]['fromFullDetail']['flip']:.4f}" for mode in ("nearest", "fractional"))
    return (f"{scene}, 64 samples, against full detail", figures, command_of(results))


def speedup_over_samples():
    results = results_of("speedup-fish")
    sweep = [row for row in results["rows"] if row["lod"] == "fractional" and row["sweep"] == "samples"]
    figures = ", ".join(f"{row['speedUp']:.1f} at {row['samples']}" for row in sweep)
    errors = span([row["fromFullDetail"]["psnr"] for row in sweep], 0)
    return ("school of fish, fractional levels: times as fast over lens samples (thresholds follow them)",
            f"{figures} ({errors} dB from full detail)", command_of(results))


def scaling():
    results = results_of("scaling")
    curves = {curve["lod"]: curve["time"] for curve in results["curves"] if curve["axis"] == "triangles"}
    return ("time over triangles, 1 to 10 M at a fixed view: exponent with levels (aim: at most 0.2), at full detail",
            f"{curves['fractional']['exponent']:.2f}, {curves['off']['exponent']:.2f}", command_of(results))


def popping():
    results = results_of("popping")
    steps = [step["measured"] for step in results["sampleSteps"] if step["samples"] == 32]
    rows = {(row["movement"], row["lod"]): row for row in results["rows"] if row["samples"] == 32}

    def shares(kind, mode):
        return ", ".join(f"{rows[movement, mode][kind]['ofNearest']:.2f}" for movement in MOVEMENTS)

    speed = 32 * rows["focus-pull", "fractional"]["largestSpeed"]
    largest = rows["focus-pull", "fractional"]["stepRmse"]["ofNearest"]
    return [("one sample's step from level to level at N = 32, as a share of the whole level's pop", f"{max(steps):.2f}",
             command_of(results)),
            ("largest pop in a frame of a focus pull, dolly, turntable at N = 32 (several fish may step in one), as a share of "
             "the nearest level's: split samples", f"RMSE {shares('stepRmse', 'fractional')} (aim: 0.25), FLIP "
             f"{shares('stepFlip', 'fractional')}", "same"),
            ("the same with `--lod continuous`",
             f"RMSE {shares('stepRmse', 'continuous')} (aim: 0.05; λ moves {speed:.2f} samples a frame in the focus pull, so even "
             f"a boundary sample that faded without any screen door would leave {speed:.2f} × {largest:.2f}), FLIP "
             f"{shares('stepFlip', 'continuous')}", "same"),
            ("the whole change from frame to frame against full detail's, as a share of the nearest level's; pops are the smaller "
             "part of it, what coarse levels get wrong and the camera moves the larger: split, continuous",
             f"RMSE {shares('changeRmse', 'fractional')}; {shares('changeRmse', 'continuous')}", "same")]


# ---- pyramids -------------------------------------------------------------------------------------------------------


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

    whole = list(values_of(times, 9))
    large = [values for _, values in whole if values[0] >= 50_000]
    bytes_each = {name: values[1] for name, values in [*values_of(times, 6), *whole]}
    fish = min((values for name, values in whole if name == "fish"), key=lambda values: values[0])
    rows = dict(values_of(distances, 5))
    all_levels = rows.pop("all")
    worst = max(rows, key=lambda name: rows[name][3])
    gains = [values[4] - values[5] for _, values in values_of(looks, 8)]
    fitted = [(values[3] - values[4], values[3] - values[5]) for _, values in values_of(normals, 9)]
    command = "`defocus_pyramid_bench MODEL…`"
    return [("pyramid levels against meshoptimizer's at the same triangles, under the blur that picks them: PSNR",
             f"{mean_of(gains):.0f} dB better in the mean of {len(gains)} levels ({span(gains, 1)})",
             f"{command} ({table_of('pyramids')})"),
            ("normals fitted to the mesh against averages over the level's faces, against the surviving vertices' own: PSNR",
             f"{mean_of(gain for gain, _ in fitted):.1f} and {mean_of(gain for _, gain in fitted):.1f} dB better in the mean of "
             f"{len(fitted)} levels ({span([gain for gain, _ in fitted], 1)}, {span([gain for _, gain in fitted], 1)})", "same"),
            (f"mean distance of a level to its mesh, as a share of meshoptimizer's at the same triangles: {len(rows)} meshes",
             f"{all_levels[2]:.2f} in the mean of {all_levels[1]:.0f} levels, at most 1.1 (the aim) in "
             f"{100 * all_levels[4] / all_levels[1]:.0f} % of them, at worst {all_levels[3]:.1f} ({worst})", "same"),
            (f"pyramids of {min(values[0] for values in large) / 1000:.0f} k to 1 M triangles, one thread, against OpenMesh's "
             "DecimaterT alone, which fits and measures nothing",
             f"{span([values[8] for values in large], 1)} times as fast ({fish[2]:.2f} s for a fish of 90 k; aim: 5 times), "
             f"{span([values[1] for values in large], 0)} bytes a triangle at the peak (aim: 250; flat-shaded meshes have two or "
             f"three vertices a triangle and take more: bike {bytes_each['bike']:.0f}, Suzanne {bytes_each['Suzanne']:.0f})",
             "same, `--million` for the largest")]


def cache():
    rows = [numbers(line) for line in lines_of("cache") if re.match(r" *\d+ ", line)]
    return ("the pyramids of 1.8 M triangles from the cache", f"{span([row[5] / 1000 for row in rows], 2)} s",
            f"`defocus_cache_bench` ({table_of('cache')})")


# ---- numbers --------------------------------------------------------------------------------------------------------


def stability():
    results = results_of("stability")
    cases = [case for case in results["cases"] if case["limit"] is not None and not case["leftOut"]]
    passed = "all within their limits" if all(case["passed"] for case in cases) else "NOT ALL WITHIN THEIR LIMITS"
    disks = [abs(row["measuredDiameter"] - row["expectedDiameter"]) for row in results["lensHonesty"]
             if row["method"] == "accumulation" and "samples" not in row["varied"]]
    error = {case["case"]: case["error"] for case in results["cases"]}
    command = f"{command_of(results)} ({table_of('stability')})"
    return [(f"{len(cases)} stiff and extreme cases, each against a closed form, double precision, the ray tracer or the same "
             "scene told otherwise", passed, f"{command}; held by a test"),
            ("disk of a point of light, f/0.95 to f/5.6, any focus, sensor, size: diameter off by",
             f"at most {max(disks):.2f} px (256 samples)", "same"),
            ("sum of 65,536 samples of 0.1: relative error; a plain 32-bit sum",
             f"{'below 1e-7' if error['65536 samples of 0.1'] < 1e-7 else format(error['65536 samples of 0.1'], '.1e')}; "
             f"{error['65,536 samples of 0.1, plain 32-bit sum']:.1e}", "same")]


def circular_cost():
    separable, direct = numbers_after(lines_of("post-process"), "  exponent")
    return ("a circular disk's cost over its radius, 8 to 64 px, separable and direct: exponent",
            f"{separable:.2f} and {direct:.2f}", f"`defocus_post_process_bench` ({table_of('post-process')})")


def rows():
    return [sequences(), waves(), truth(),
            speedup_over_samples(),
            speedup("helmets", "FlightHelmet × 20 (`scripts/copies FlightHelmet.gltf -o helmets.gltf`)"),
            scaling(), *popping(), *pyramids(), cache(), *stability(), circular_cost(), clusters(), elisions()]


# ---- scripts/demo ---------------------------------------------------------------------------------------------------


def demo():
    """Its table, and what it says of speed and image."""
    lines = lines_of("demo")
    table = ["| school of fish, 1024 × 768, 64 lens samples | frame | a sample | triangles drawn | peak memory |",
             "| --- | --- | --- | --- | --- |"]
    for name in ("full detail", "fractional levels"):
        (line,) = [line for line in lines if line.startswith(name)]
        table.append(f"| {name} | " + " | ".join(re.split(r"\s{2,}", line.strip())[1:]) + " |")
    ratio = numbers_after(lines, "speed-up of the frame")[0]
    psnr, ssim, flip = numbers_after(lines, "image difference")
    (full, many), (fast, few) = ([numbers(cell)[0] for cell in line.split("|")[3:5]] for line in table[2:])
    none = fast - (full - fast) / (many - few) * few
    return "\n".join([*table, "", f"That is {ratio:.1f} times as fast, with a difference of PSNR {psnr:.1f} dB, SSIM {ssim:.3f}, "
                                  f"FLIP {flip:.4f}.",
                      f"A straight line through both leaves {none:.0f} ms a sample for no triangle at all: fewer triangles alone "
                      f"would end at {full / none:.1f} times.", ""])
