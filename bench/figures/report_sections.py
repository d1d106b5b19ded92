"""Makes the sections of the report, one per bench, as HTML from the results, their folder and the report's folder."""

import math
import sys
from html import escape

from figures.files import read_csv
from figures.report_html import artefact_strips, crop_strip, facts, overview, plot_figure, subject, table
from figures.report_plots import error_plot, frame_time_plot, popping_plot, scaling_plot, series_of, speedup_plot
from figures.rows import MODES, below_reference, common_time, drawn_text, equal_error_speedup, flip, label_of, median, number, rmse
from figures.rows import seeds_text, speedup_headline, spread_text, time_text, time_to_error

# ---- convergence ----------------------------------------------------------------------------------------------------


def note_text(row):
    """Returns a row's fault, or else its Pareto fronts and the errors that are below the reference's own error."""
    if row["fault"]:
        return f"<b>{escape(row['fault'])}</b>"
    fronts = ["all" if row["front"] else "method" if row["frontOfMethod"] else "", "FLIP" if row["frontByFlip"] else ""]
    words = [", ".join(filter(None, fronts)), below_reference(row["mseBelowReference"], row["flipBelowReference"])]
    return "; ".join(filter(None, words))


def rows_table(rows):
    header = ["method, setting", "lens samples (or pinholes)", "frame, ms", "10–90 %, ms", "runs", "set-up, ms", "pyramids, ms",
              "RMSE", "over seeds", "PSNR, dB", "SSIM", "FLIP", "bias, PSNR dB", "triangles, millions", "peak, MiB",
              "on the front of; notes"]
    return table(header, [[
        escape(label_of(row)), row["samples"], f"{median(row):.1f}", spread_text(row["milliseconds"]), row["runs"],
        f"{row['setupMilliseconds']['median']:.0f}", f"{row['pyramidMilliseconds']:.0f}", f"{rmse(row):.5f}", seeds_text(row),
        number(row["psnr"], 2), f"{row['ssim']:.4f}", f"{flip(row):.4f}", number(row["bias"]["psnr"], 2) if row["bias"] else "",
        f"{row['triangles'] / 1e6:.2f}", f"{row['peakBytes'] / 2**20:.0f}", note_text(row)]
        for row in sorted(rows, key=lambda row: (row["method"], row["setting"], row["samples"]))])


def floors_table(floors):
    if not floors:
        return "<p>No levels were measured.</p>"
    return table(["method, setting", "at lens samples", "RMSE", "PSNR, dB", "SSIM", "FLIP"],
                 [[escape(label_of(floor)), floor["samples"], f"{rmse(floor):.5f}", number(floor["psnr"], 2), f"{floor['ssim']:.4f}",
                   f"{flip(floor):.4f}"] for floor in floors])


def equal_error_table(competitors):
    if len(competitors) < 2:
        return ""
    first = competitors[0]["times"]
    return ("<h2>Time to equal error</h2>" +
            table(["each with its best settings"] + [f"RMSE {time['rmse']:g}" for time in first],
                  [[escape(one["name"]), *map(time_to_error, one["times"], first)] for one in competitors]) +
            "<p>Time of a frame, between measured rows by a power law; in brackets, its ratio to the first row.</p>")


def left_out_list(entries):
    items = "".join(f"<li>{escape(label_of(entry))}: {escape(entry['reason'])}</li>" for entry in entries)
    return f"<h3>Left out</h3><ul>{items}</ul>" if entries else ""


def convergence_section(results, folder, report):
    series = series_of(results["rows"])
    if not series:
        sys.exit(f"{folder / 'results.json'}: holds no valid rows")
    time = common_time(list(series.values()))
    nearest = [min(one["rows"], key=lambda row: abs(math.log(max(median(row), 1e-6) / time))) for one in series.values()]
    own = results["reference"]["remaining"]
    return [
        "<h2>Error against run time</h2>",
        '<p>Each line is a method with one setting; along it the number of lens samples grows. Rings: no other row is both '
        'as fast and as close (the Pareto front). A dashed line at the right is the bias of the levels of detail: however many more lens samples '
        'these thresholds get, the image comes no closer to full detail. Numbers: lens samples of accumulation at full '
        f'detail. Nothing can be read below the reference’s own error (RMSE {rmse(own):.5f}, FLIP {flip(own):.4f}).</p>',
        "<h3>RMSE</h3>", plot_figure(error_plot(results, series, rmse, "rmse", "RMSE from the reference", "front"),
                                     "Root mean square difference on display-encoded values. Set-up is not in these times: see the "
                                     "table."),
        "<h3>FLIP</h3>", plot_figure(error_plot(results, series, flip, "flip", "mean FLIP from the reference", "frontByFlip"),
                                     "FLIP weighs what a person sees when the two images alternate: ghosts and bands that RMSE hides."),
        "<h3>Pictures at about equal time</h3>",
        f"<p>The frame of each line that is nearest to {time_text(time)}, and its FLIP map from 0 (black) to "
        f"{results['errorMapFullScale']:g} and more (pale yellow).</p>",
        overview(results, folder), *(crop_strip(results, nearest, folder, crop) for crop in results["crops"]),
        equal_error_table(results["timesToErrors"]), artefact_strips(report), "<h3>Bias of the levels of detail</h3>",
        "<p>The difference between the image with levels and the one at full detail, at the same lens samples, so that "
        "sampling noise cancels; at the largest number measured. The standard thresholds shrink as samples grow, so "
        "that the floor sinks with them; with these thresholds held, it stays.</p>",
        floors_table(results["biasFloors"]), "<h3>All rows</h3>", rows_table(results["rows"]),
        "<p>Set-up is what a renderer takes before its first frame; pyramids are simplified once for a scene and kept "
        "on disk by other commands. Neither is part of a frame’s time. Bias: difference from full detail at the same "
        "lens samples.</p>",
        left_out_list(results["leftOut"]), "<h3>How it was measured</h3>", subject(results)]


# ---- speed-up -------------------------------------------------------------------------------------------------------


def difference_cells(difference):
    if difference is None:
        return ["", "", ""]
    return [number(difference["psnr"], 1), f"{difference['ssim']:.4f}", f"{difference['flip']:.4f}"]


def reference_cell(row):
    error, own = row["fromReference"], row["referenceRemaining"]
    if error is None or own is None:
        return ""
    return f"{row['referenceSamples']} samples<br>{below_reference(error['rmse'] < own['rmse'], error['flip'] < own['flip'])}"


def speedup_table(rows):
    references = [(key, name) for key, name in (("fromFullDetail", "full detail"), ("fromReference", "the reference"))
                  if any(row[key] for row in rows)]
    lines = []
    for row in rows:
        equal = equal_error_speedup(row, rows)
        lines.append([
            escape(drawn_text(row)), row["samples"], f"{row['fStop']:g}", f"{row['focusDistance']:.3g}",
            f"{median(row):.1f}<br>{spread_text(row['milliseconds'])}", f"{row['speedUp']:.2f}", "—" if equal is None else f"{equal:.2f}",
            *(f"{row[part]['speedUp']:.2f}" if row.get(part) else "" for part in ("sizeOnly", "blurOnly")),
            f"{row['triangles'] / 1e6:.2f}", f"{row['gpuBytes'] / 2**20:.0f}", f"{row['setupMilliseconds']:.0f}",
            f"{row['pyramidMilliseconds']:.0f}", *(cell for key, _ in references for cell in difference_cells(row[key])),
            seeds_text(row), reference_cell(row)])
    return table([
        "levels", "lens samples", "f-number", "focus, m", "frame, ms; 10–90 %", "times as fast at equal N", "at equal error",
        "size only", "blur only", "triangles, millions", "GPU, MiB", "set-up, ms", "pyramids, ms",
        *(f"{name} from {reference}" for _, reference in references for name in ("PSNR, dB,", "SSIM", "FLIP")),
        "RMSE from the reference over seeds", "the reference"], lines)


def speedup_section(results, *_):
    rows = results["rows"]
    return ["<h2>Speed-up</h2>",
            plot_figure(frame_time_plot(rows), "Time of a frame, both axes logarithmic (Figure 2 of Jeong, Kim and Lee 2011)."),
            plot_figure(speedup_plot(rows), "Frame time at full detail over frame time with levels, at equal N: the same lens "
                        f"samples, but another error. {speedup_headline(results)} The table has both for each row. "
                        "Size only: with a blur threshold of 0; blur only: with a size threshold of 0."),
            speedup_table(rows),
            "<p>Times as fast as full detail: at equal N, with the same number of lens samples; at equal error, with as many as "
            "full detail needs to come as close to the reference (RMSE), its time between measured rows by a power law; —: that "
            f"error lies beyond what was measured, or there is no reference. Times are medians of {results['runs']} runs, each "
            "with its 10th and 90th percentile; errors from the reference are means over the seeds of the lens samples, each "
            "with its least and most.</p>", facts(results)]


# ---- popping, scaling and stability ----------------------------------------------------------------------------------


def popping_section(results, _, report):
    frames = read_csv(report / "popping.csv")
    samples = max(int(row["samples"]) for row in frames)
    plot = popping_plot([row for row in frames if int(row["samples"]) == samples], samples)
    lines = []
    for row in results["rows"]:
        line = [row["movement"], MODES[row["lod"]][0], row["samples"], f"{row['largestSpeed']:.4f}"]
        for error in (row[name] for name in ("stepRmse", "stepFlip", "changeRmse", "changeFlip")):
            line += [f"{error['worst']:.5f}", f"{error['percentile99']:.5f}",
                     "" if error["ofNearest"] is None else f"{error['ofNearest']:.2f}"]
        lines.append(line)
    header = ["movement", "levels", "lens samples", "levels a frame"] + [
        f"{name}, {what}" for name in ("pop, RMSE", "pop, FLIP", "change, RMSE", "change, FLIP")
        for what in ("worst", "99 %", "of nearest’s")]
    text = "".join(f"<li>{name}: {escape(what)}</li>" for name, what in results["definitions"].items())
    caption = (f"{samples} lens samples. Pop: the frame against the same view at the levels of the frame before. Change: the difference "
               "of the step from frame to frame from the reference’s step, which includes errors of coarse levels that move with the "
               "camera. Display-encoded values, over the objects’ pixels.")
    return ["<h2>Popping</h2>", plot_figure(plot, caption), table(header, lines, 2), f"<ul>{text}</ul>", facts(results)]


def scaling_section(results, *_):
    def fitted(fit):
        return f"{fit['exponent']:.2f} ± {fit['residual']:.2f}" if fit else ""
    curves = [[curve["axis"], MODES[curve["lod"]][0], fitted(curve["time"]), fitted(curve["gpuMemory"]), escape(curve["bounds"])]
              for curve in results["curves"]]
    rows = [[row["axis"], MODES[row["lod"]][0], f"{row['value']:g}", row["samples"], f"{row['width']} × {row['height']}",
             f"{median(row):.1f}", spread_text(row["milliseconds"]),
             *(f"{row[part + 'Milliseconds']:.1f}" for part in ("layers", "vertices", "fill")), f"{row['triangles'] / 1e6:.2f}",
             f"{row['gpuBytes'] / 2**20:.0f}", f"{row['pyramidBytes'] / 2**20:.0f}"] for row in results["rows"]]
    return ["<h2>Scaling</h2>", plot_figure(scaling_plot(results), "Time of a frame, both axes logarithmic."),
            table(["what grows", "levels", "exponent of time", "of GPU memory", "bound by"], curves, 2),
            table(["what grows", "levels", "value", "lens samples", "pixels", "frame, ms", "10–90 %, ms", "layers, ms",
                   "vertices, ms", "fill, ms", "triangles, millions", "GPU, MiB", "pyramids, MiB"], rows, 2),
            facts(results, [["parts", results["parts"]]])]


def verdict(case):
    if case.get("leftOut"):
        return "left out: needs the ray tracer"
    if case["limit"] is None:
        return "for comparison"
    return "within" if case["passed"] else "<b>beyond</b>"


def honesty_cells(row):
    if row.get("leftOut"):
        return [escape(row["method"]), "", "", "", "", "", f"left out: {escape(row['leftOut'])}"]
    return [escape(row["method"]), escape(row["varied"]), f"{row['expectedDiameter']:.2f}", f"{row['measuredDiameter']:.2f}",
            f"{row['measuredDiameter'] - row['expectedDiameter']:+.2f}", f"{row['energy']:.4f}",
            "follows" if row.get("followsLens") else "differs"]


def stability_section(results, *_):
    cases = [[*(escape(case[name]) for name in ("area", "case", "errorOf", "against")),
              "" if case["limit"] is None else f"{case['limit']:.3g}",
              "" if case.get("leftOut") else "∞" if case["error"] is None else f"{case['error']:.3g}", verdict(case)]
             for case in results["cases"]]
    return ["<h2>Stiff and extreme cases</h2>",
            table(["area", "case", "error", "against", "limit", "measured", "verdict"], cases, 4),
            "<h3>Blur against the lens</h3>",
            "<p>The disk of a point of light: its diameter by the formula and in the image of each method, and its energy over that "
            "of the point in focus. Verdict: “differs” above 0.5 px or 5 % of the energy.</p>",
            table(["method", "varied", "expected, px", "measured, px", "off by, px", "energy", "verdict"],
                  [honesty_cells(row) for row in results["lensHonesty"]], 2), facts(results)]
