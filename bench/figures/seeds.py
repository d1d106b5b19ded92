"""Tables of docs/seeds.md: the claims of each publication, and the results of the runs in bench/results.

A row has the claim, our implementation, the test (`Suite.test`) or bench that checks it, the published result, and
ours. A dash means that there is no result.
"""

import functools
import re
import sys

from figures import line_rows
from figures.bench_tables import gain, lens_levels, lens_space_rows, method_rows, pyramid_sections, ending_in_numbers, scenes_of, span
from figures.command import ROOT
from figures.markdown import table
from figures.results import (accumulation_rows, error_ratio, lines_of, numbers, numbers_after, run_of, samples_sweep)

OWN = "llvmpipe-speedup-jeong2011"
LEAK = "`PostProcesses.aSharpObjectDoesNotLeakIntoTheBlurredBackground`"
HEADER = ["claim", "implementation", "checked by", "published result", "our result"]


def lines_with(name, beginning):
    return [numbers(line[len(beginning):]) for line in lines_of(name) if line.startswith(beginning)]


# ---- Jeong, Kim and Lee 2011: levels of detail -----------------------------------------------------------------------


def speeds(preset):
    """Returns the ranges of the speed-up and of the error relative to full detail, over the numbers of lens samples."""
    modes = [modes for _, modes in samples_sweep(OWN, preset)]
    return (span([mode["fractional"]["speedUp"] for mode in modes], 1), span([error_ratio(mode) for mode in modes], 2))


def layers_win():
    """Returns as text the min number of lens samples at which `layered` is faster than accumulation with levels."""
    layered = {row["samples"]: row["milliseconds"]["median"] for row in run_of(OWN)["rows"] if row.get("method", "").startswith("layered")}
    levels = {row["samples"]: row["milliseconds"]["median"] for row in accumulation_rows(OWN, "jeong2011") if row["lod"] == "fractional"}
    wins = [count for count in sorted(levels) if layered.get(count, float("inf")) < levels[count]]
    return f"from {wins[0]} lens samples, the fewest measured" if wins and wins[0] == min(levels) else f"from {wins[0]} lens samples" if wins else "at none of the measured numbers of lens samples"


def pops(mode):
    rows = [row for row in run_of("llvmpipe-popping")["rows"] if row["samples"] == 32 and row["lod"] == mode]
    return span([row["stepRmse"]["ofNearest"] for row in rows], 2)


def jeong():
    fish = scenes_of("llvmpipe-truth")[0]
    drawn, theirs = dict(samples_sweep(OWN))[64], dict(samples_sweep(OWN, "jeong2011"))[64]
    halton, sobol = (lines_with("llvmpipe-sequences", name)[1][6] / 1000 for name in ("halton  ", "sobol  "))
    fitted = [values[3] - values[5] for _, values in ending_in_numbers(pyramid_sections()[3], 9)]
    own, published = speeds(""), speeds("jeong2011")
    return [
        ["Accumulation over lens samples is the reference", "[accumulation.h](../src/render/accumulation/accumulation.h)",
         "`Truth.*` against a ray tracer that shares no code; `TruthBokeh.*` against the closed form of the bokeh", "–",
         f"PSNR {fish['psnrAtEqualLensPoints']:.1f} dB against the ray tracer with the same lens points, {fish['psnr']:.1f} dB with different ones (fish)"],
        ["Lens samples are Halton's points", "[lens_samples.h](../src/lens/lens_samples.h)", "`JeongPlan.samplesAreHaltonsPointsFrom1On`", "–",
         f"Sobol's points have a smaller error: RMSE {sobol:.5f} instead of {halton:.5f} with 64 samples"],
        ["The level grows in proportion to the CoC at the centre of an object's box, and to 1 / its projected size",
         "λ = K · CoC / size; we chose K = 10 ([level_selection.h](../src/lod/pyramid/level_selection.h))",
         "`JeongPlan.*`", "K isn't printed",
         f"school with 64 samples: {theirs['fractional']['triangles'] / 1e6:.1f} million triangles instead of "
         f"{drawn['off']['triangles'] / 1e6:.1f} at full detail; {drawn['fractional']['triangles'] / 1e6:.1f} million with our default levels"],
        ["Frames are several times as fast (Figure 2)", "`defocus bench speedup --preset jeong2011`", "the run in [Results](results.md)",
         "up to 3.5 times, on their GPU",
         f"as published, {published[0]} times as fast at {published[1]} times the RMSE of full detail; with our default levels, {own[0]} times "
         f"at {own[1]} times the RMSE (16 to 512 samples)"],
        ["Layers (Lee and others 2010) are faster above some number of samples (Figure 2)",
         "`--methods layered:pinholes=1` beside the preset, both with levels", "the same run", "near 32 samples", layers_win()],
        ["Samples are split between two levels without popping", "[level_selection.h](../src/lod/pyramid/level_selection.h)",
         "`SplitSamples.*`, `Popping.oneSamplesStepIsASmallPartOfALevels`, `defocus bench popping`", "–",
         f"the largest pop is {pops('fractional')} of the pop with one level per object; {pops('continuous')} with `--lod continuous`, in "
         "which one of the samples draws both levels, each in some of its pixels"],
        ["Levels are built beforehand; their vertices are vertices of the mesh", "[pyramid.h](../src/lod/pyramid/pyramid.h)",
         "`JeongPlan.levelsHaveTheValuesOfLevel0`", "–", f"PSNR with fitted normals is {gain(fitted).split(' dB')[0]} dB higher than with the normals of the mesh's vertices"],
    ]


# ---- Munkberg, Toth and Akenine-Möller 2012: artistic blur controls --------------------------------------------------


def limited_work():
    """Returns (scene, limit, speed-up, ratio of ray-triangle tests) of method `stochastic` for each row of Figure 7."""
    rows = []
    for line in (ROOT / "bench/results/lens/figure-7.md").read_text().splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if len(cells) == 6 and re.fullmatch(r"\d+ px", cells[1]):
            rows.append((cells[0], cells[1], cells[3], cells[5]))
    return rows


def times_longer():
    """Returns the range of time ratios of stochastic points to accumulation, over errors that both methods reach."""
    by_name = {method["name"]: [time["milliseconds"] for time in method["times"]]
               for method in run_of("llvmpipe-methods-lens-space")["timesToErrors"]}
    pairs = zip(by_name["stochastic at full detail"], by_name["accumulation at full detail"])
    return span([slow / fast for slow, fast in pairs if slow and fast], 1)


def munkberg():
    thicket = next(row for row in limited_work() if row[:2] == ("thicket", "3 px"))
    chess = [row for row in limited_work() if "chess" in row[0]][-1]
    total, away, outside, *rest = numbers_after(lines_of("llvmpipe-clusters")[:10], "off")
    return [
        ["Limiting the foreground blur leaves the sharp range, the background (Figure 3) and the motion blur (Figure 4) unchanged",
         "`--foreground-limit`, [circle_of_confusion.h](../src/lens/circle_of_confusion.h)",
         "`CircleOfConfusion.foregroundLimitHasItsKinkWhereThePaperSays`, `CocControls.limitInFrontLeavesFocusAndBackground`, "
         "`CocControls.limitInFrontLeavesTheMotion`", "images", "[images](../bench/results/lens/README.md)"],
        ["A range of depths is in focus, and near and far blur are preserved (Figure 5)", "`--focus-range-front`, `--focus-range-behind`",
         "`CircleOfConfusion.focusRangeIsSharpAndPreservesNearAndFarBlur`, `CocControls.focusRangePreservesNearAndFarBlur`, "
         "`CocControls.focusRangeIsSharpAsAPinhole`", "images", "images"],
        ["The focus plane is tilted (Figure 6)", "`--focus-tilt`",
         "`CircleOfConfusion.tiltedPlaneIsInFocus`, `CocControls.tiltedPlaneIsSharpAllAlong`", "images", "images"],
        ["The blur function C ([Concepts](concepts.md#one-lens-sample)) is given per vertex and linear inside a triangle",
         "`coc-interpolation=linear` (preset), [clip_blur.glsl](../shaders/lens_space/clip_blur.glsl); by default, triangles in which C "
         "isn't linear are divided", "`CocInterpolation.bendsOnlyInDividedTriangles`", "–", "–"],
        ["C is given at both ends of the shutter time, and linear between them: C(t) = (1 − t)·c₀ + t·c₁",
         "glTF attributes `_COC`, `_COC_OFFSET`, `_COC_0` and `_COC_1`, `_COC_SCALE`, `--node-blur` ([lens](lens.md#blur-controls))",
         "`VertexBlurs.*`, `CocControls.scaleOfAnObjectIsItsOwn`", "images", "images"],
        ["Example of a radial blur: C = (a + b·w)·(1 + x² + y²) in clip space", "`_COC_SCALE` as printed; `--radial-blur-gain` is our variant, "
         "which depends on the position in the image only", "`VertexBlurs.drawTheRadialExampleAsPrinted`", "–",
         "[images](../bench/results/lens/README.md#the-radial-example-of-the-text)"],
        ["A limited foreground saves work: tests of a triangle against a lens ray (Figures 4 and 7)", "`defocus_foreground_bench --stochastic`",
         "[the run](../bench/results/lens/figure-7.md)", "the tests fall by a factor of 4 to 9, or 3 with motion",
         f"thicket: {thicket[2]} times as fast, the tests fall by a factor of {thicket[3]}; chess board with motion: {chess[2]} times as "
         f"fast, the tests fall by a factor of {chess[3]}"],
        ["Triangles that face away for every lens point and moment are culled (Equations 5, 7 and 8, Appendix A)",
         "[bin.comp](../shaders/lens_space/bin.comp)", "`LensSpaceAlone.movingBacksAreCulled`: the same image, bit for bit", "–", "–"],
        ["Our extension: Equation 6 for clusters of rigid triangles, in all methods",
         "[visibility.h](../src/plan/visible/visibility.h)",
         "`Visibility.*`: no triangle that a random lens point sees is lost", "–",
         f"culls {100 * (away + outside) / total:.0f} % of the school's triangles, including those outside the image; {rest[3]:.2f} times as fast"],
        ["With aberrations, C varies over the lens: C = f(u, v) (named as future work)",
         "[aberrations.h](../src/lens/aberrations.h): Seidel's astigmatism and coma, `--astigmatism`, `--coma`, also in `stochastic`",
         "`Aberrations.*`: the moments of a point's blur in closed form, and the direction of each ray to the background; "
         "`LensSpaceAlone.stochasticPointsSeeAberrations`", "–", "[images](../bench/results/lens/README.md#beyond-the-paper-c--fu-v)"],
        ["A coverage test takes few multiply-adds",
         "`relativeTo` and `edgeFunctions` in [triangles.glsl](../shaders/lens_space/triangles.glsl)",
         "counted by hand: 2 operations per coordinate and corner, 2 per edge function; with motion, 2 for each interpolated component",
         "thin lens 16 (with motion 25), general C 18 (with motion 30); those with motion are quoted from another paper",
         "thin lens 18 (with motion 36), general C 18 (with motion 42). We interpolate between the positions at shutter open and close; "
         "with stored differences of these positions, motion would take 27 and 30"],
        ["Each pixel has its own points on the lens and in time", "[stochastic.h](../src/render/stochastic/stochastic.h)",
         "`LensSpaceAlone.stochasticPixelsHaveTheirOwnPoints`, `LensSpace.convergesToTheAccumulation`, "
         "`LensSpaceAlone.stochasticPointsBlurMotion`", "–", f"{times_longer()} times the time of the accumulation at equal error"],
    ]


# ---- Scheuermann 2004: gather from a sharp image ---------------------------------------------------------------------


def flips(scene, *rows):
    """Returns the FLIP of rows of the result "llvmpipe-circular" as texts. rows: beginnings of the rows' names."""
    found = method_rows("llvmpipe-circular")[scene]
    return [next(f"{values[2]:.4f}" for (name, _), values in found.items() if name.startswith(row)) for row in rows]


def disk_errors(method):
    """Returns the largest error of a point's disk (px), and the numbers of cases within the limit and of all cases."""
    cases = [row for row in run_of("llvmpipe-stability")["lensHonesty"] if row["method"] == method]
    worst = max(abs(row["measuredDiameter"] - row["expectedDiameter"]) for row in cases)
    return worst, sum(row["followsLens"] for row in cases), len(cases)


def scheuermann():
    fish, chess = (flips(scene, "scheuermann (published)", "scheuermann (best)") for scene in ("fish school", "chess.glb"))
    worst, right, cases = disk_errors("scheuermann")
    return [
        ["Eight taps around the pixel are enough; the centre gives depth only", "[scheuermann.h](../src/render/scheuermann/scheuermann.h)",
         "`PoissonDisk.keepsItsDistanceAndLeavesNoGap`", "8 taps",
         f"FLIP {fish[0]} as published, {fish[1]} with 64 taps, the blur of the lens and 16 pinholes (fish); {chess[0]} and {chess[1]} (chess)"],
        ["Blur is linear in depth between three planes that the artist sets; behind the focus plane, it has its own maximum",
         "[blurriness.frag](../shaders/scheuermann/blurriness.frag)",
         "`BlurrinessPlanes.*`; keyframes in shots: `FrameSequence.settingsOfAMethodHaveKeys`", "largest blur diameter 10 px",
         f"the diameter of a point's disk differs from the lens equation by up to {worst:.0f} px; within half a pixel in {right} of {cases} cases"],
        ["A small pre-blurred copy hides the gaps between the taps",
         "[preblur.frag](../shaders/scheuermann/preblur.frag). The printed code reads the tap of the copy from the full-size image, which we "
         "take to be an error", "`ScheuermannImage.asPublishedReadsTheSmallImageAtItsOwnRadius` (in closed form)",
         "a quarter of the width and height; tap radius in pixels of the copy: 0.4 times the radius in pixels of the sharp image", "the same"],
        ["Sharp foreground doesn't leak into the blurred background", "[gather.frag](../shaders/scheuermann/gather.frag)", LEAK, "–", "–"],
        ["Blended surfaces write their depth in a second pass", "[pinhole_pass.h](../src/render/post_process/pinhole_pass.h)",
         "`PostProcesses.whatLiesBehindABlendedSurfaceIsBlurredAsThatSurface`", "–", "–"],
        ["A multisampled back buffer smooths edges", "`multisampling=4`: colour and blurriness are the means of four samples; the number is ours",
         "`ScheuermannImage.multisamplingSmoothsEdgesBeforeTheBlur`", "–", "–"],
        ["Bytes hold colour and blurriness", "`bits=8`", "`ScheuermannImage.inBytesRoundsEncodedColours`", "8 bits",
         "8 bits as published, half floats by default"],
    ]


# ---- Garcia 2018: circular separable blur ----------------------------------------------------------------------------


def kernel_errors():
    """Returns (error, lowest value) of our kernels with one and two components, and of Niemitalo's kernels."""
    rows = {}
    wanted = False
    for line in lines_of("llvmpipe-circular-kernels"):
        if re.match(r"[A-Z]", line):
            wanted = line.startswith(("With the corners' guard", "Published, rescaled"))
        if wanted and re.match(r" \d  1\.000", line):
            values = numbers(line)
            rows.setdefault(int(values[0]), []).append((values[2], values[8]))
    return rows


def garcia():
    lines = lines_of("llvmpipe-post-process")
    head = lines.index(" radius px    separable       direct")
    times = {int(values[0]): values[1:] for values in map(numbers, lines[head + 1:head + 6])}
    separable, direct = numbers_after(lines_of("llvmpipe-post-process"), "  exponent")
    kernels = kernel_errors()
    (ours1, theirs1), (ours2, theirs2) = kernels[1], kernels[2]
    ten_bits = lines_with("llvmpipe-circular-kernels", "circular:near-components=1,storage=r10g10b10a2")[0][0]
    full_gather = lines_with("llvmpipe-post-process", "circular:near-components=1,kernel=published,convolution=direct")[0][-1]
    slide = [numbers(line)[-1] for line in lines_of("llvmpipe-post-process") if "max-coc=published" in line]
    one_pass = {(size, radius): share for size, _, radius, _, _, share in
                (numbers(line) for line in lines_of("llvmpipe-circular-kernels") if line.endswith(" %"))}
    fish, chess = (flips(scene, "circular (published)", "circular, default", "circular (best)") for scene in ("fish school", "chess.glb"))
    coverage = [flips(scene, "circular, default", "circular, near-field=coverage")
                for scene in ("fish school", "chess.glb", "artefact-half-discs.gltf")]
    bias = [values[1] for (name, _), values in method_rows("llvmpipe-circular")["artefact-ghosting.gltf"].items()
            if name in ("circular, blend-bias=2 bias-by=luminance", "circular, default", "circular, blend-bias=2")]
    by_luminance = flips("fish school", "circular, blend-bias=2 bias-by=luminance", "circular, default")
    return [
        ["A sum of complex Gaussians is a disk, and separable", "[circular_kernel.h](../src/render/circular/circular_kernel.h)",
         "`CircularKernel.factorsOfTwoAxesMultiplyToACircle`, `ComplexBlurs.twoPassesGiveTheWholeKernel`", "constants of two components",
         f"RMS difference from the disk over the square around it, relative to the disk: {theirs1[0]:.3f} and {theirs2[0]:.3f} for Niemitalo's "
         f"kernels of one and two components, {ours1[0]:.3f} and {ours2[0]:.3f} for ours ([the run](../bench/results/llvmpipe-circular-kernels.txt) of commit "
         f"45c048f6ba08); outside the disk, the kernel of two components falls to −{-ours2[1]:.2f} (ours) and −{-theirs2[1]:.2f} (Niemitalo's)"],
        ["The kernel at the eight taps has the printed constants", "`--kernel published`: exp(−a·x²) at x = tap / 8. With the printed sign, exp would grow with x; the sign and x = tap / 8 are our "
         "reading. The constants of one component are from Garcia's public generator",
         "`CircularKernel.*`", "the formula for two components gives 0.925 at the outermost tap, x = 1", "the same"],
        ["Our extension: with `--anamorphic-ratio`, the kernel is an oval", "a separable kernel with two radii",
         "`ComplexBlurs.twoPassesGiveTheWholeOval`, `ComplexBlurs.aPointBecomesAnOvalOfItsAxes`", "–",
         "other aperture shapes are ignored, with a message"],
        ["Time grows with the radius, not with its square", "[complex_blur.h](../src/render/circular/complex_blur.h)",
         "`defocus_post_process_bench`", "–",
         f"time grows with radius^{separable:.2f}, for a gather over the square with radius^{direct:.2f}; at 64 px, "
         f"{times[64][1] / times[64][0]:.0f} times as fast as the gather"],
        ["Performance: half size with one component, quarter size with two, and a brute-force baseline",
         "both settings, and a gather over the square at the same sizes and at full size",
         "`defocus_post_process_bench` ([the run](../bench/results/llvmpipe-post-process.txt))", "times of game consoles",
         f"half {slide[0]:.0f} ms, quarter {slide[1]:.0f} ms; gathers {slide[2]:.0f} and {slide[3]:.0f} ms, at full size {full_gather:.0f} ms"],
        ["Weighted sums are stored in [0, 1]: their weights G become (G − O) / S, with the smallest weight O and S = Σ(G − O)", "`bracketOf` in [complex_blur.h](../src/render/circular/complex_blur.h) returns O and S",
         "`Brackets.ofEightTapsAreGarcias`, `Brackets.ofEightTapsStoreAWhiteFieldAsOne`, `ComplexBlurs.publishedBracketsLoseLessThanRanges`",
         "offset −0.0387, scale 0.943 (real part, first of two components)",
         f"−0.0387 and 0.943; with ten bits per channel from the sharp image to the result "
         f"(`PostProcessesAlone.tenBitsHoldTheWholeImage`), PSNR {ten_bits:.1f} dB against 32-bit floats"],
        ["Eight taps on each side, quarter size, one near and two far components", "preset", "`bench convergence`", "–",
         f"FLIP {fish[0]} as published, {fish[1]} by default, {fish[2]} at its best ([fish](../bench/results/llvmpipe-circular.txt)); "
         f"{chess[0]}, {chess[1]}, {chess[2]} (chess)"],
        ["Far pixels are weighted by their blur, so that pixels in focus don't leak", "[split.frag](../shaders/circular/split.frag)",
         "`PostProcesses.whatIsInFocusStaysWhenOnlyTheBackgroundBlurs`, " + LEAK, "–", "–"],
        ["Near pixels are weighted by their blur, relative to the largest radius in their tile", "`near-field=premultiplied`",
         "`CircularNearField.lightsThatAreHardlyBlurredKeepOutOfWideBlurs`", "–",
         "FLIP, with and without: " + ", ".join(f"{ours} and {theirs} ({scene})" for (ours, theirs), scene in
                             zip(coverage, ("fish", "chess", "lights in front of the focus")))],
        ["A bias that favours near pixels in the final blend depends on luminance", "`bias-by=luminance`", "`PostProcessesAlone.biasByLuminanceLeavesEdges`", "–",
         f"PSNR {bias[2]:.1f} instead of {bias[0]:.1f} dB on a scene made to show ghosting, where a constant bias gives {bias[1]:.1f} dB; worse on "
         f"the fish (FLIP {by_luminance[0]} instead of {by_luminance[1]}), so off by default"],
        ["Near and far field are blurred in one pass through several targets", "not implemented, because it would not reduce the number of taps",
         "[the run](../bench/results/llvmpipe-circular-kernels.txt) of commit 45c048f6ba08", "–",
         "if both fields shared all work except the taps, at most " + ", ".join(f"{one_pass[512, radius]:.0f}" for radius in (2, 8, 32))
         + " % less time at radii of 2, 8 and 32 px"],
        ["Transparent surfaces are blurred in depth buckets",
         "`transparency-buckets`, [bucket_pass.h](../src/render/post_process/bucket_pass.h)", "`BlendedSurfaces.*` (closed forms), "
         "`TransparencyBuckets.*`", "– (suggested as an improvement, so the preset has none)", "the table below"],
    ]


def buckets():
    """Returns the table of the error (FLIP) by the number of buckets for transparency."""
    names = {"artefact-panes.gltf": "panes of glass (`artefact-panes.gltf`)", "AlphaBlendModeTest.glb": "AlphaBlendModeTest",
             "FlightHelmet.gltf": "FlightHelmet", "GlassVaseFlowers.glb": "GlassVaseFlowers"}
    counts = ["circular, transparency-buckets=0", "circular, default", "circular, transparency-buckets=2"]
    rows = []
    for scene, name in names.items():
        found = {method: values for (method, _), values in method_rows("llvmpipe-circular")[scene].items()}
        first = found[counts[0]]
        rows.append([name] + [f"{found[count][2]:.4f} ({found[count][0] / first[0]:.1f})" for count in counts])
    return table(["scene", "no buckets", "one (default)", "two"], rows)


# ---- Tzeng et al. 2012: line samples ---------------------------------------------------------------------------------


def tzeng():
    rows = lens_space_rows()
    three = {row[1]: row[7] for row in next(iter(lens_levels().values())) if row[0] == 16}
    return [
        ["Segments of a line through the lens must be weighted by κ, their share of the line's light (Figure 4)",
         "[weights.glsl](../shaders/line/weights.glsl), `--line-weights`",
         "`LensSpaceAlone.kappaMakesDisksUniform`, `LensSpace.convergesToTheAccumulation`", "images",
         "without κ, the middle of a blurred point is more than 1.5 times as bright as its rim"],
        ["Visibility along a line is exact", "[line.glsl](../shaders/line/line.glsl)",
         "`LensSpaceAlone.exactLinesFindIntersections`, `LensSpace.convergesToTheAccumulation`", "–", "–"],
        ["Several lines share a spatial sample (Figure 2)", "`--lines-per-position`; 4 in the preset, our choice",
         "`LensSpaceAlone.linesShareSpatialPositions`", "–", "–"],
        ["Tiles have bins of fixed size", "`--bin-size`; 65,536 triangles in the preset, our choice",
         "`LensSpaceAlone.binsOfFixedSizeCountTheirOverflow`", "–", "–"],
        ["A segment is compressed to 16 bits", "`--interval-bits 16`: 16 bits hold the interval; we chose to store colour and depth "
         "separately", "`LensSpaceAlone.shortIntervalsChangeLittle`", "16 bits", "16 bits for the interval"],
        ["A full buffer drops occluded segments, merges similar ones, drops short ones, then evicts the shortest", "[segment_buffer.glsl](../shaders/line/segment_buffer.glsl); the thresholds "
         "are ours", "`LensSpaceAlone.segmentsOfDifferentColoursStayApart`", "–", "–"],
        ["A buffer of fixed size with heuristics keeps the quality", "`--resolve published`",
         "`LensSpaceAlone.exactLinesAreTheBuffersWhereNothingWasDropped`, `LensSpaceAlone.fullBuffersCountWhatTheyDrop`", "–",
         f"{span([row[10] / row[8] for row in rows], 1)} times the RMSE of exact lines (five models, the same shading)"],
        ["16 lines are faster than 256 points (Table 1)", "`defocus_lens_space_bench`", "[the run](../bench/results/llvmpipe-lens-space.txt)",
         "4 to 5 times; 2.65 times for Teapot",
         f"{span([row[6] for row in rows], 1)} times as published, {span([row[4] for row in rows], 1)} times with exact lines (five models)"],
        ["16 lines have a better quality than 256 points", "as above", "as above", "better",
         f"not confirmed: 16 exact lines have {span([row[8] / row[7] for row in rows], 1)} times the RMSE of 256 points, and "
         f"{span([row[8] / row[11] for row in rows], 1)} times the RMSE of 64 points (five models); on three teapots, "
         f"{line_rows.quality_ratio(line_rows.EXACT):.2f} times the RMSE of 256 points, "
         f"and {line_rows.quality_ratio(line_rows.PUBLISHED):.2f} times as published ([images](../bench/results/line-samples.md))"],
        ["A choice of three levels by the score, blur over edge length, saves time at high blur (Figure 7)",
         "`--lod-metric score`; the constant of the score is ours",
         "`TzengPlan.drawsTheLevelNearestToTheScore`, `defocus_lens_space_bench --figure7`", "about 50 % of the time saved; twice as fast on teapots",
         f"slower ({three[0.1]:.2f} times as fast) at a blur of a tenth of the image's width; {three[0.2]:.2f} times as fast at a fifth"],
    ]


# ---- Lee, Eisemann and Seidel 2010: depth layers ---------------------------------------------------------------------


def lee():
    scenes = method_rows("llvmpipe-layered")
    at_128 = {name: values[1] for (name, count), values in scenes["fish school"].items() if count == 128}
    thicket = {name: values[1] for (name, count), values in scenes["thicket.gltf"].items() if count == 128}
    counts = sorted({count for _, count in scenes["fish school"]})
    first = {name: next(count for count in counts if scenes["fish school"][name, count][0] < scenes["fish school"]["accumulation, lod=off", count][0])
             for name in ("layered, lod=off", "layered, pinholes=1 lod=off")}
    four, eight, sixteen = (thicket[f"layered, {layers}lod=off"] for layers in ("layers=4 ", "", "layers=16 "))
    return [
        ["Depth layers leave out surfaces that no lens point sees", "[depth_layers.h](../src/render/layered/depth_layers.h)",
         "`Layered.aBlurredBarShowsWhatItHidesFromThePinhole`, `Layered.moreLayersComeCloserToTheAccumulation`", "–",
         f"the fish need 4 layers, the thicket 8 (PSNR with 128 samples: {four:.1f}, {eight:.1f} and {sixteen:.1f} dB with 4, 8 and 16 layers)"],
        ["Lens rays of each pixel are traced through the layers", "[trace.frag](../shaders/layered/trace.frag)",
         "`Layered.aPointOfLightBecomesADiskOfTheCircleOfConfusion`, `Layered.slopingAndRoundSurfacesAreAsTheAccumulationHasThem`",
         "“mostly indistinguishable from offline rendering”",
         f"PSNR with 128 samples: {at_128['layered, pinholes=1 lod=off']:.1f} dB with one pinhole, {at_128['layered, lod=off']:.1f} dB with "
         f"four; the accumulation has {at_128['accumulation, lod=off']:.1f} dB"],
        ["N-buffers bound where a ray may hit a surface", "mipmaps: a fifth of the memory, slightly wider bounds "
         "([lens_rays.h](../src/render/layered/lens_rays.h))",
         "`Layered.everyLensShapeAndControlIsTheAccumulations`: RMSE at most 0.02 from the accumulation", "N-buffers", "–"],
        ["Drawing the layers has a constant cost, so they are faster above some number of samples", "`bench convergence`, at full detail",
         "[the run](../bench/results/llvmpipe-layered.txt)", "near 32 samples (Figure 2 of Jeong, Kim and Lee)",
         f"faster at the same number of samples, not at the same error: from {first['layered, lod=off']} samples with four pinholes, from "
         f"{first['layered, pinholes=1 lod=off']} with one; never on the thicket, which has wide blurs and few triangles"],
        ["The lens has aberrations", "[wavelengths.h](../src/lens/wavelengths.h), [aperture.h](../src/lens/aperture.h)",
         "`Layered.everyLensShapeAndControlIsTheAccumulations`", "spherical, chromatic", "the same"],
        ["Focus control: each pixel has its own focus, fitted by least squares to marks of the user",
         "`--focus-points`, for all methods that use C: a tilted plane through three pixels, or a tilted and curved surface fitted to 4 to 16 "
         "([focus.h](../src/frame/setup/focus.h)); the published surface may have any shape", "`FocusThrough.findsTheCurvedSurfaceOfManyPoints`, `FocusThrough.leavesTheMinBlur`", "images", "–"],
    ]


# ---- checks of tests and links --------------------------------------------------------------------------------------


@functools.cache
def test_names():
    """Returns the names `Suite.test` of all tests, without prefixes of parameterized suites."""
    sources = (ROOT / "tests").rglob("*_test.cpp")
    return {f"{suite}.{test}" for source in sources for suite, test in re.findall(r"TEST(?:_F|_P)?\((\w+),\s*(\w+)\)", source.read_text())}


def checked(rows):
    """Returns the rows as a table; exits if a named test or a linked file doesn't exist."""
    text = table(HEADER, rows)
    suites = {name.split(".")[0] for name in test_names()}
    for suite, test in re.findall(r"`([A-Z]\w+)\.(\w+|\*)`", text):
        if f"{suite}.{test}" not in test_names() and not (test == "*" and suite in suites):
            sys.exit(f"docs/seeds.md: there is no test {suite}.{test}")
    for link in re.findall(r"\]\(([^)#]+)[^)]*\)", text):
        if not (ROOT / "docs" / link).exists():
            sys.exit(f"docs/seeds.md: {link} does not exist")
    return text


CLAIMS = {"jeong2011": jeong, "munkberg2012": munkberg, "scheuermann2004": scheuermann, "garcia2018": garcia, "tzeng2012": tzeng,
          "lee2010": lee}
TABLES = {f"claims {name}": functools.partial(lambda rows: checked(rows()), rows) for name, rows in CLAIMS.items()} | {"buckets": buckets}
