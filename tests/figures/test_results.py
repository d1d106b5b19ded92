"""Tests the commands of recorded results, which must repeat the runs with the current program."""

import re

import pytest

from figures import repeat
from figures.bench_tables import command_in
from figures.files import repeatable
from figures.results import RESULTS, command_of, lines_of, run_of

ROWS = re.compile(r"--rows[ =](\S+)")
KNOWN_ROWS = {"published", "best", "default"}


def rows_of(text):
    return {row for rows in ROWS.findall(text) for row in rows.split(",")}


@pytest.mark.parametrize("old, new", [
    ("defocus bench convergence --rows published,standard --runs 3", "defocus bench convergence --rows published,default --runs 3"),
    ("defocus bench convergence --rows=standard,best", "defocus bench convergence --rows=default,best"),
    ("defocus bench convergence standard.glb --rows best -o standard", "defocus bench convergence standard.glb --rows best -o standard")])
def test_commands_of_version_0_1_are_converted(old, new):
    assert repeatable(old) == new


def test_recorded_commands_name_known_rows():
    for file in RESULTS.glob("*.json"):
        assert rows_of(command_of(file.stem, run_of(file.stem))) <= KNOWN_ROWS
    for file in RESULTS.glob("*.txt"):
        assert rows_of("\n".join(lines_of(file.stem))) <= KNOWN_ROWS
    assert rows_of(command_in("llvmpipe-circular", "artefact-ghosting")) == {"published", "default"}
    assert rows_of(command_of("llvmpipe-teapots", run_of("llvmpipe-teapots"))) == {"published", "default"}


def test_repeat_runs_converted_commands(tmp_path, monkeypatch):
    file = tmp_path / "result.txt"
    file.write_text("Commit 0, 2 cores.\n\n$ defocus bench convergence --rows published,standard\nan old output\n")
    program = tmp_path / "defocus"
    program.write_text('#!/bin/sh\necho "options: $*"\n')
    program.chmod(0o755)
    monkeypatch.setattr(repeat, "commit", lambda: "1")
    repeat.main([str(file), "--program", str(program)])
    lines = file.read_text().splitlines()
    assert lines[2] == "$ defocus bench convergence --rows published,default"
    assert lines[3].startswith("options: bench convergence --rows published,default")
