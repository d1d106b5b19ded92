"""Tests figures.layers, which measures how much CPU time the data layers of a render add."""

import pytest

from figures import layers
from figures.results import RESULTS


def test_ratios_are_medians_of_rounds():
    """Each time is divided by the time without layers in the same round, so the slow second round changes no ratio."""
    rounds = [{"": 2, "depth": 2.2, "normal": 2.5}, {"": 8, "depth": 8.8, "normal": 16}, {"": 2, "depth": 9, "normal": 2.4}]
    assert layers.ratios_of(rounds) == {"depth": pytest.approx(1.1), "normal": pytest.approx(1.25)}


def test_rows_fit_the_header():
    rounds = [{"": 4.0, **{name: 4.0 + number for number, name in enumerate(layers.LAYERS)}}]
    row = layers.row_of("chess", rounds)
    assert row.split() == ["chess", "4.00", "s", "1.00", "1.25", "1.50", "1.75", "2.00", "2.25"]
    assert len(row) == len(layers.header())


def program(folder, commit, layers="for ((i = 0; i < 20000; ++i)); do :; done"):
    """Returns a script that replaces the program. The script writes a --stats file with the commit, and runs the bash
    commands `layers` if it gets --exr-layers.
    """
    file = folder / "program"
    stats = f'{{"commit": "{commit}", "device": "a device", "driver": "a driver"}}'
    file.write_text(f"""#!/bin/bash
for ((i = 0; i < 20000; ++i)); do :; done
while [ $# -gt 0 ]; do
    [ "$1" = --stats ] && echo '{stats}' >"$2"
    [ "$1" = --exr-layers ] && {{ {layers}; }}
    shift
done
exit 0
""")
    file.chmod(0o755)
    return str(file)


def test_a_record_needs_a_committed_program(tmp_path):
    words = ["school", "--runs", "1", "--output", str(tmp_path / "layers.txt"), "--program"]
    with pytest.raises(SystemExit, match="uncommitted changes"):
        layers.main([*words, program(tmp_path, "0123-changed")])
    with pytest.raises(SystemExit, match="'depth' failed with exit code 3"):
        layers.main([*words, program(tmp_path, "0123", "exit 3")])
    assert not (tmp_path / "layers.txt").exists()
    layers.main([*words, program(tmp_path, "0123")])
    record = (tmp_path / "layers.txt").read_text()
    assert record.startswith("Commit 0123, a device, a driver, ") and str(tmp_path) not in record


def test_the_committed_record_has_three_scenes():
    record = (RESULTS / "llvmpipe-layers.txt").read_text()
    assert "-changed" not in record and " /" not in record
    assert layers.header() in record and len(record.split(layers.header())[1].split("\n")) >= 5
