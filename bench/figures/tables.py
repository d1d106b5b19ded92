"""Writes the tables of README.md, docs and bench/results from the results in bench/results.

    scripts/figures tables            write them
    scripts/figures tables --check    exit code 1 if a page differs

A table replaces the text between `<!-- NAME -->` and `<!-- end -->`. `<!-- methods: FILE -->` begins a table of
methods, and `<!-- equal error: FILE FILE … -->` a table of times to equal errors. FILE: a results.json of `defocus
bench convergence`, relative to the repository root.
"""

import pathlib
import re
import sys

from figures import bench_tables, line_rows, seeds, speed_tables
from figures.command import ROOT, parser_of
from figures.files import write_file
from figures.markdown import run_source, table
from figures.results import command_of, run_of
from figures.rows import time_to_error

TABLES = speed_tables.TABLES | bench_tables.TABLES | line_rows.TABLES | seeds.TABLES
PAGES = {"README.md": False, "docs/results.md": False, "docs/seeds.md": False, "bench/results/details.md": False,
         "bench/results/line-samples.md": False, "docs/window.md": False,
         "bench/results/llvmpipe-methods.md": True}  # value: whether the page's table of methods shows all rows
BLOCK = re.compile(rf"(<!-- ({'|'.join(['methods', 'equal error', *TABLES])})(?:: ([^>]+))? -->\n).*?(<!-- end -->)", re.DOTALL)
LEVELS = {"lod=off": "full detail", "lod=fractional metric=measured thresholds=1": "levels",
          "lod=fractional metric=size thresholds=1": "fractional levels"}
AS_PUBLISHED = {("llvmpipe-methods-lens-space", "line"): "line as published"}  # {(run, method): name in the tables}
PINHOLE_SETTINGS = ("default", "coc=thin-lens taps=64 max-coc=unlimited", "resolution=quarter kernel-taps=eight", "pinholes=1")


def shown(row, everything):
    if row["takesLensSamples"]:
        return row["setting"] in (*LEVELS, "default") and (everything or 8 <= row["samples"] <= 64)
    return everything or row["setting"] in PINHOLE_SETTINGS


def name_of(row):
    if row["setting"] in LEVELS:
        return f"{row['method']}, {LEVELS[row['setting']]}"
    return ", ".join([row["method"]] + [f"`{part}`" for part in row["setting"].split() if part != "default"])


def scene_of(results):
    return results["scene"] if "." in results["scene"] else results["scene"].capitalize()


def held_equal(results):
    runs = "one run" if results["runs"] == 1 else f"median of {results['runs']} interleaved runs"
    return (f"{results['width']} × {results['height']}, f/{results['lens']['fStop']:g}; reference: "
            f"{results['reference']['samples']:,} lens samples at full detail; {results['device'].split(' (')[0]}, "
            f"{results['machine']['threads']} cores, {runs}")


def seconds_to_error(time, first):
    return time_to_error(time, first, lambda milliseconds: f"{milliseconds / 1000:.3g} s")


def equal_error_table(names):
    rows = []
    for name in names:
        results = run_of(name)
        methods = results["timesToErrors"]
        first = methods[0]["times"]
        rows.append([f"**{scene_of(results)}**, {held_equal(results)}"] + [""] * len(first))
        rows += [[AS_PUBLISHED.get((name, method["name"]), method["name"]), *map(seconds_to_error, method["times"], first)] for method in methods]
    errors = [f"RMSE {time['rmse']:g}" for time in first]
    return table([f"seconds per frame (relative to {methods[0]['name']})", *errors], rows) + "".join(map(run_source, names))


def methods_table(name, everything):
    results = run_of(name)
    rows = []
    for row in sorted((row for row in results["rows"] if shown(row, everything)),
                      key=lambda row: (row["takesLensSamples"], row["method"], row["setting"] == "lod=off", row["samples"])):
        unit = "" if row["takesLensSamples"] else " pinholes" if row["samples"] > 1 else " pinhole"
        median, low, high = (f"{row['milliseconds'][value] / 1000:.2f}" for value in ("median", "low", "high"))
        rows.append([name_of(row), f"{row['samples']}{unit}", median, f"{low} to {high}", f"{row['psnr']:.1f}", f"{row['ssim']:.4f}",
                     f"{row['flip']:.4f}"])
    text = table(["method", "samples", "frame, s", "10 to 90 %", "PSNR, dB", "SSIM", "FLIP"], rows)
    end = f"\n    {command_of(name, results)}\n" if everything else run_source(name)
    return f"{scene_of(results)}, {held_equal(results)}:\n\n{text}{end}"


def block_text(kind, paths, everything):
    names = [pathlib.Path(path).stem for path in (paths or "").split()]
    if kind == "methods":
        return methods_table(names[0], everything)
    return equal_error_table(names) if kind == "equal error" else TABLES[kind]()


def fitted_to(page, text):
    """Returns a table's text with links that resolve from a page in docs/ or in bench/results/.

    docs/results.md has the sentence "Held equal" at the top, and leaves commits to the linked runs.
    """
    if page == "docs/results.md":
        return re.sub(r", commit \w+(?=\])", "", re.sub(r" Held equal: .*\n", "\n", text))
    return text.replace("](../bench/results/", "](") if page.startswith("bench/results/") else text


def main(words):
    parser = parser_of("tables", __doc__)
    parser.add_argument("--check", action="store_true", help="write nothing; exit code 1 if a page differs")
    arguments = parser.parse_args(words)
    for page, everything in PAGES.items():
        text = (ROOT / page).read_text()
        written = BLOCK.sub(lambda block: block[1] + fitted_to(page, block_text(block[2], block[3], everything)) + block[4], text)
        if written == text:
            continue
        if arguments.check:
            sys.exit(f"{page}: its tables differ from bench/results; run scripts/figures tables")
        write_file(ROOT / page, written)
