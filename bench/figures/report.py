"""Draws the report of `defocus bench` as a single, self-contained index.html.

    scripts/figures report RESULTS [REPORT]

The folder RESULTS may contain results.json of `bench convergence` with its images. index.html is written to the folder
REPORT (default: RESULTS). Other sections are made from these files in REPORT:

    speedup.json                `bench speedup`: speed-up against lens samples (Jeong, Kim and Lee 2011, Figure 2)
    popping.json, popping.csv   `bench popping`: changes from frame to frame
    scaling.json                `bench scaling`: time against triangles, instances, samples, pixels, blur
    stability.json              `bench stability`: numerically difficult cases, and the blur compared with the lens
    strips.json                 `scripts/figures artefacts`: [{"title", "text", "images": [{"label", "file"}]}]

Needs matplotlib and Pillow (Debian: python3-matplotlib). The program `defocus` contains the modules of the report, and
runs them for --report.
"""

import argparse
import datetime
import re
import sys
from html import escape
from pathlib import Path

from figures.files import read_json, write_file
from figures.rows import speedup_headline, time_text
from figures.report_sections import convergence_section, popping_section, scaling_section, speedup_section, stability_section
from figures.report_style import SCRIPT, style

SECTIONS = {"results": convergence_section, "speedup": speedup_section, "popping": popping_section, "scaling": scaling_section,
            "stability": stability_section}


def contents(html):
    """Returns a list of links to the headings as HTML, and the HTML with an id for each heading."""
    links = []

    def named(match):
        name = re.sub(r"[^a-z]+", "-", match[1].lower()).strip("-")
        links.append(f'<li><a href="#{name}">{match[1]}</a></li>')
        return f'<h2 id="{name}">{match[1]}</h2>'
    text = re.sub(r"<h2>(.*?)</h2>", named, html)
    return f'<nav aria-label="Contents"><ul>{"".join(links)}</ul></nav>', text


def headline(results):
    """Returns a sentence on the main result; an empty text if there is none."""
    if "speedup" in results and (text := speedup_headline(results["speedup"])):
        return text
    competitors = results.get("results", {}).get("timesToErrors", [])
    for times in reversed(list(zip(*(one["times"] for one in competitors)))):
        reached = [(time["milliseconds"], one["name"]) for time, one in zip(times, competitors) if time["milliseconds"]]
        if len(reached) > 1:
            fastest, slowest = min(reached), max(reached)
            return (f"An RMSE of {times[0]['rmse']:g} takes {time_text(fastest[0])} by {escape(fastest[1])} and "
                    f"{time_text(slowest[0])} by {escape(slowest[1])}.")
    return ""


def downloads(report):
    files = [f"{name}.{ending}" for name in SECTIONS for ending in ("json", "csv")]
    files.insert(2, "runs.csv")
    links = ", ".join(f'<a href="{name}">{name}</a>' for name in files if (report / name).exists())
    return f"<p>Data beside this page: {links}.</p>" if links else ""


def citation(program, commit, year):
    entry = (f"@software{{defocus,\n  title = {{defocus: depth of field of a real lens}},\n"
             f"  author = {{{{the defocus authors}}}},\n  version = {{{program.split()[-1]}}},\n  year = {{{year}}},\n"
             f"  note = {{commit {commit}}}\n}}")
    return f"<h2>Citation</h2><pre>{escape(entry)}</pre>"


def page(results, folder, report):
    now = datetime.datetime.now(datetime.timezone.utc)
    first = next(iter(results.values()))
    program, commit = first["program"], first["commit"] or "unknown commit"
    parts = [part for bench, measured in results.items() for part in SECTIONS[bench](measured, folder, report)]
    links, text = contents("".join(parts) + citation(program, commit, now.year))
    sentence = headline(results)
    return (f'<!doctype html>\n<html lang="en"><head><meta charset="utf-8"><meta name="viewport" '
            f'content="width=device-width, initial-scale=1"><title>defocus bench</title><style>{style()}</style></head><body>'
            f'<main><h1>defocus bench</h1>{f"<p class=headline>{sentence}</p>" if sentence else ""}<p class="lead">'
            f"{escape(program)}, commit {escape(commit)}; drawn {now:%Y-%m-%d %H:%M} UTC. A click on a column’s head sorts its table; "
            f"points of plots show their values under the pointer.</p>{links}{downloads(report)}"
            f'{text}</main><div id="tip" role="status" hidden></div><script>{SCRIPT}</script></body></html>\n')


def main(words):
    parser = argparse.ArgumentParser(prog="scripts/figures report", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, metavar="RESULTS")
    parser.add_argument("report", type=Path, metavar="REPORT", nargs="?")
    arguments = parser.parse_args(words)
    folder, report = arguments.folder, arguments.report or arguments.folder
    places = {bench: (folder if bench == "results" else report) / f"{bench}.json" for bench in SECTIONS}
    try:
        results = {bench: read_json(path) for bench, path in places.items() if path.exists()}
        if not results:
            sys.exit(f"{folder}: no results of a bench")
        write_file(report / "index.html", page(results, folder, report))
    except (OSError, ValueError, KeyError, TypeError) as fault:
        sys.exit(f"{folder}: its results cannot be drawn: {fault!r}")


if __name__ == "__main__":
    main(sys.argv[1:])
