"""Measures how defocus endures long runs, kills, fuzzing and files of many parts (nodes, meshes or materials).

    scripts/fuzz --minutes 10 >fuzz.txt
    scripts/figures endurance --fuzz fuzz.txt [--program build/release/defocus] [--frames 2500] [--kills 20]
                              [--output bench/results/endurance.md]
    scripts/figures endurance --only "A long film"

Writes bench/results/endurance.md. Takes about half an hour on two cores. Exits with 1 if a measurement fails.
"""

import datetime
import json
import os
import pathlib
import random
import re
import signal
import statistics
import struct
import subprocess
import sys
import tempfile
import time

from figures.command import ROOT, add_program, parser_of, path
from figures.glb import glb
from figures.markdown import table
from figures.results import run_of
from figures.timed import timed

RUNS = 3  # number of times that each test file of MANY is rendered
# (kind of element, number of these elements in the test file)
MANY = [("roots", 300_000), ("nodes in a chain", 100_000), ("materials", 65_000), ("meshes", 65_000)]
TRIANGLE = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)


def place(number, count):
    """Returns the position of part `number` of `count` parts of a scene, in a square grid with a spacing of 2 units."""
    side = int(count**0.5) + 1
    return [2 * (number % side) - side, 2 * (number // side) - side, 0]


def many(kind, count):
    """Returns a .glb file with `count` parts of a kind in MANY, such as meshes."""
    data = TRIANGLE
    accessor = {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}
    document = {"asset": {"version": "2.0"}, "scene": 0, "accessors": [accessor]}
    parts = range(count)
    triangle = {"primitives": [{"attributes": {"POSITION": 0}}]}
    if kind == "nodes in a chain":
        document["nodes"] = [{"mesh": 0, "translation": [1e-3, 0, 0], "children": [i + 1]} for i in parts]
        del document["nodes"][-1]["children"]
        document["scenes"] = [{"nodes": [0]}]
        document["meshes"] = [triangle]
    elif kind == "materials":
        positions = [[x + dx, y + dy, 0] for x, y, _ in (place(i, count) for i in parts) for dx, dy in ((0, 0), (1, 0), (0, 1))]
        data = b"".join(struct.pack("<3f", *position) for position in positions)
        document["accessors"] = [dict(accessor, byteOffset=36 * i, min=positions[3 * i], max=[p + d for p, d in zip(positions[3 * i], (1, 1, 0))])
                                 for i in parts]
        document["materials"] = [{"pbrMetallicRoughness": {"baseColorFactor": [i % 251 / 250, i % 241 / 240, i % 239 / 238, 1]}} for i in parts]
        document["meshes"] = [{"primitives": [{"attributes": {"POSITION": i}, "material": i} for i in parts]}]
        document["nodes"] = [{"mesh": 0}]
        document["scenes"] = [{"nodes": [0]}]
    else:
        document["meshes"] = [triangle] * (count if kind == "meshes" else 1)
        document["nodes"] = [{"mesh": i if kind == "meshes" else 0, "translation": place(i, count)} for i in parts]
        document["scenes"] = [{"nodes": list(parts)}]
    document["bufferViews"] = [{"buffer": 0, "byteLength": len(data)}]
    document["buffers"] = [{"byteLength": len(data)}]
    return glb(document, struct.pack("<I4s", len(data), b"BIN\0") + data)  # no padding: the length is a multiple of 4


def cost(program, scene, picture):
    """Renders a scene. Returns the elapsed and the processor time in seconds, and the peak memory in MiB."""
    words = [program, "render", scene, "--no-cache", "--samples", "4", "--size", "320x240", "--quiet", "-o", picture]
    return timed(words, f"the picture of {scene.name}")


def costs(program, folder, _):
    """Renders each file in MANY. Returns the lines of the page, and True, because the times have no limit."""
    rows = []
    for kind, count in MANY:
        scene = folder / "many.glb"
        scene.write_bytes(many(kind, count))
        seconds, processor, memory = map(statistics.median, zip(*(cost(program, scene, folder / "many.png") for _ in range(RUNS))))
        rows.append([f"{count:,} {kind}", f"{seconds:.1f} s", f"{processor:.1f} s", f"{memory:,.0f} MiB"])
    return ["Each file has one triangle per part. `defocus render FILE --no-cache --samples 4 --size 320x240`, "
            f"medians of {RUNS} runs:", "", table(["parts", "time", "time of all cores", "peak memory"], rows).rstrip()], True


def resident(process):
    """Returns the resident memory of a process without file pages, in MiB; None once it has ended."""
    try:
        status = pathlib.Path(f"/proc/{process}/status").read_text()
    except OSError:
        return None
    kilobytes = [int(line.split()[1]) for line in status.splitlines() if line.startswith(("RssAnon:", "RssShmem:"))]
    return sum(kilobytes) / 1024 if kilobytes else None


def write_shot(folder, frames):
    """Writes a shot whose focus moves back and forth every 25 frames. Thus the first 100 frames need all levels of detail that the film needs."""
    keys = [{"frame": frame, "distance": 4 if frame % 50 else 1.5} for frame in range(0, frames + 25, 25)]
    shot = {"scene": str(ROOT / "meshes/bokeh.gltf"), "range": [0, frames - 1], "size": [64, 48], "samples": 4, "focus": {"keys": keys}}
    (folder / "shot.json").write_text(json.dumps(shot))


def long_film(program, folder, arguments):
    """Captures a long film. Returns the lines of the page, and whether the program's memory stays within 1 %."""
    write_shot(folder, arguments.frames)
    child = subprocess.Popen([program, "capture", "shot.json", "--quiet", "-o", "film/####.exr"], cwd=folder,
                             env=dict(os.environ, LP_NUM_THREADS="0"))
    frame = 0
    held = {}  # memory in MiB, keyed by frame
    begin = time.monotonic()
    while child.poll() is None:
        while (folder / "film" / f"{frame:04}.exr").exists():
            frame += 1
        memory = resident(child.pid)
        if memory is not None:
            held[frame] = memory
        time.sleep(0.02)
    seconds = time.monotonic() - begin
    complete = child.returncode == 0 and len(list((folder / "film").glob("*.exr"))) == arguments.frames

    def around(first, end):
        return statistics.median(memory for at, memory in held.items() if first <= at < end)

    early, late = around(90, 111), around(arguments.frames - 20, arguments.frames + 1)
    growth = 100 * (late / early - 1)
    return [f"A film of {arguments.frames:,} frames of 64 × 48 px, whose focus moves back and forth every 25 frames, took {seconds:.0f} s. "
            f"At its 100th frame the program held {early:.1f} MiB, at its last {late:.1f} MiB ({growth:+.2f} %; medians of 20 frames, "
            f"without file pages). llvmpipe rasterized in the program's thread: with threads of its own, it allocates a further scene "
            f"whenever they fall behind. {made(program)}"], complete and abs(growth) <= 1


def kills(program, folder, arguments):
    """Kills captures at random times and resumes them. Returns the page's lines, and whether all frames are equal."""
    frames, chance = 60, random.Random(1)
    write_shot(folder, frames)
    environment = dict(os.environ, SOURCE_DATE_EPOCH="0")  # with this variable, images contain no run times

    def start(name, *words):
        return subprocess.Popen([program, "capture", "shot.json", "--quiet", "-o", f"{name}/####.exr", *words], cwd=folder, env=environment)

    begin = time.monotonic()
    if start("whole").wait() != 0:
        sys.exit("cannot capture the film that is killed")
    seconds = time.monotonic() - begin
    done = within = lost = 0
    for number in range(arguments.kills):
        child = start(f"killed{number}")
        time.sleep(chance.uniform(0.1, 0.95) * seconds)
        child.send_signal(signal.SIGKILL)
        within += child.wait() == -signal.SIGKILL
        for file in (folder / f"killed{number}").glob("[0-9]*.exr"):
            done += 1
            lost += file.read_bytes() != (folder / "whole" / file.name).read_bytes()
        if start(f"killed{number}", "--resume").wait() != 0:
            sys.exit(f"capture {number} cannot be resumed")
        lost += sum(not (folder / f"killed{number}" / file.name).exists() or
                    (folder / f"killed{number}" / file.name).read_bytes() != file.read_bytes() for file in (folder / "whole").glob("*.exr"))
    return [f"{arguments.kills} captures of {frames} frames were killed (SIGKILL) at random times, {within} of them before their end, and resumed. "
            f"{lost} frames were lost or differ from those of a capture that nothing interrupts; the {done} frames that existed at "
            "the kills were complete."], lost == 0


def stability(*_):
    """Returns the lines of the page from the latest run of bench stability, and whether all cases passed."""
    result = run_of("llvmpipe-stability")
    cases = [case["passed"] for case in result["cases"] if not case["leftOut"]]
    lenses = [case["followsLens"] for case in result["lensHonesty"] if "followsLens" in case]
    return [f"`defocus bench stability` ([the run](llvmpipe-stability.json), commit {result['commit']}): {sum(cases)} of {len(cases)} extreme "
            f"cases are within their limits. The blur follows the lens in {sum(lenses)} of {len(lenses)} cases of all methods "
            "([why the others do not](../../docs/results.md#blur-and-the-lens-equation))."], all(cases)


def fuzzing(_, __, arguments):
    """Returns the table that scripts/fuzz printed, and whether no input failed."""
    text = arguments.fuzz.read_text()
    rows = re.findall(r"^(\w+) +(\d+) runs, +(\d+) edges, +(\d+) features covered(.*)$", text, re.MULTILINE)
    run = re.search(r"^Fuzzed .*$", text, re.MULTILINE)
    if not rows or not run:
        sys.exit(f"{arguments.fuzz}: no output of scripts/fuzz")
    shown = [[f"`{name}`", f"{int(runs):,}", f"{int(edges):,}", find.strip() or "none"] for name, runs, edges, _, find in rows]
    shown.append(["all", f"{sum(int(row[1]) for row in rows):,}", "", ""])
    return [f"`scripts/fuzz`, with the address and undefined-behaviour sanitizers. {run[0]}", "",
            table(["target", "executions", "edges covered", "findings"], shown).rstrip()], not any(row[4].strip() for row in rows)


PARTS = [("Extreme cases", stability), ("A long film", long_film), ("Kills", kills), ("Fuzzing", fuzzing), ("Files of many parts", costs)]


def made(program):
    """Returns the sentence that states the date of the run and the version of the program."""
    driver = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout.split("\n")[0]
    commit = subprocess.run(["git", "rev-parse", "--short=12", "HEAD"], capture_output=True, text=True, cwd=ROOT, check=True).stdout.strip()
    return f"Made on {datetime.date.today()} at commit {commit} ({driver})."


def replaced(page, title, lines):
    """Returns the page with the section of this title replaced by `lines`."""
    begin = page.index(f"## {title}\n")
    end = page.find("\n## ", begin)
    return page[:begin] + "\n".join([f"## {title}", "", *lines, ""]) + (page[end:] if end >= 0 else "")


def main(words):
    parser = parser_of("endurance", __doc__)
    add_program(parser)
    parser.add_argument("--fuzz", type=path, help="output of scripts/fuzz")
    parser.add_argument("--frames", type=int, default=2500, help="of the long film (default: %(default)s)")
    parser.add_argument("--kills", type=int, default=20, help="captures to kill (default: %(default)s)")
    parser.add_argument("--only", choices=[title for title, _ in PARTS], help="measure this part and leave the others as the page has them")
    parser.add_argument("--output", type=path, default=ROOT / "bench/results/endurance.md", help="page (default: bench/results/endurance.md)")
    arguments = parser.parse_args(words)
    if arguments.fuzz is None and arguments.only in (None, "Fuzzing"):
        parser.error("the table of the fuzzer needs --fuzz")
    page = arguments.output.read_text() if arguments.only else "\n".join(
        ["# Endurance", "", "This page says how defocus endures long runs, kills, broken files and files of many parts. "
         "`scripts/figures endurance` writes it, on shared CPU cores with Mesa's llvmpipe, so times vary by half.", "",
         made(arguments.program), *(f"\n## {title}\n" for title, _ in PARTS)])
    good = True
    for title, measure in PARTS:
        if arguments.only not in (None, title):
            continue
        with tempfile.TemporaryDirectory() as folder:
            more, passed = measure(arguments.program, pathlib.Path(folder), arguments)
        print(f"{title}: {'passed' if passed else 'FAILED'}", *more, sep="\n", flush=True)
        page = replaced(page, title, more)
        good &= passed
    arguments.output.write_text(page.rstrip("\n") + "\n")
    sys.exit(0 if good else 1)
