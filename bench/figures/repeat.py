"""Runs the commands of text results again and replaces their outputs.

    scripts/figures repeat bench/results/llvmpipe-circular.txt --program build/release/defocus

A text result has lines `$ defocus …` before each output. The new file starts with the commit of the program and the
number of cores. Text between an output and the next command is removed. Commands of version 0.1 are converted.
"""

import os
import re
import shlex
import subprocess
import sys
import tempfile

from figures.command import ROOT, add_program, parser_of, path, run
from figures.files import repeatable, write_file


def commit():
    if run("git", "status", "--porcelain", "--untracked-files=no"):
        sys.exit("the tree has uncommitted changes; commit them, so that the run can be repeated")
    return run("git", "rev-parse", "--short=12", "HEAD").strip()


def output_of(program, command):
    words = shlex.split(command)
    folder = program.parent if words[0] == "defocus" else program.parent / "bench"
    name = program.name if words[0] == "defocus" else words[0]
    with tempfile.TemporaryDirectory() as scratch:
        # bench convergence resumes an earlier run in its folder, so each command needs an empty folder
        output = ["--output", scratch] if words[1:3] == ["bench", "convergence"] else []
        done = subprocess.run([folder / name, *words[1:], *output], stdout=subprocess.PIPE, text=True, cwd=ROOT)
    if done.returncode != 0:
        sys.exit(f"{command}: exit code {done.returncode}")
    return done.stdout.strip()


def main(words):
    parser = parser_of("repeat", __doc__)
    parser.add_argument("files", nargs="+", type=path, metavar="FILE", help="a text result in bench/results")
    add_program(parser)
    arguments = parser.parse_args(words)
    for file in arguments.files:
        commands = re.findall(r"^\$ (.+)$", repeatable(file.read_text()), re.MULTILINE)
        if not commands:
            sys.exit(f"{file.name}: no line starts with '$ '")
        outputs = [f"$ {command}\n{output_of(arguments.program, command)}\n" for command in commands]
        write_file(file, f"Commit {commit()}, {os.cpu_count()} cores.\n\n" + "\n".join(outputs))
