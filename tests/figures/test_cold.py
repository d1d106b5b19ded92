"""Tests figures.cold, which times the first render with empty caches."""

import pytest

from figures import cold
from figures.timed import Times


def test_rows_fit_the_header():
    row = cold.row_of("chess", {"default": Times(1, 2), "fractional": Times(3.5, 4)})
    assert row.split() == ["chess", "1.00", "s", "2.00", "s", "3.50", "s", "4.00", "s"]
    assert len(row) == len(cold.header())


def program(folder, commit):
    """Returns a script that replaces the program, and that fails if the cache folder has a file of an earlier run."""
    file = folder / "program"
    file.write_text(f"""#!/bin/bash
while [ $# -gt 0 ]; do
    [ "$1" = --stats ] && echo '{{"commit": "{commit}", "device": "a device", "driver": "a driver"}}' >"$2" && exit 0
    shift
done
[ -z "$(ls "$XDG_CACHE_HOME")" ] && touch "$XDG_CACHE_HOME/used"
""")
    file.chmod(0o755)
    return str(file)


def test_each_run_has_empty_caches(tmp_path):
    words = ["meshes/chess.glb", "--runs", "2", "--output", str(tmp_path / "cold.txt"), "--program"]
    with pytest.raises(SystemExit, match="uncommitted changes"):
        cold.main([*words, program(tmp_path, "0123-changed")])
    cold.main([*words, program(tmp_path, "0123")])
    record = (tmp_path / "cold.txt").read_text()
    assert record.startswith("Commit 0123, a device, a driver, ") and "\nchess " in record and str(tmp_path) not in record
