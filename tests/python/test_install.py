"""Tests that `cmake --install` installs the complete Python package."""

import os
import subprocess
import sys


def test_the_installed_package_stands_by_itself(tmp_path):
    subprocess.run(["cmake", "--install", os.environ["DEFOCUS_BUILD"], "--prefix", tmp_path, "--component", "python"],
                   check=True, capture_output=True)
    (package,) = tmp_path.glob("lib/python3*/*-packages/defocus")
    names = sorted(path.name.split(".")[0] + path.suffix for path in package.iterdir())
    assert names == ["__init__.py", "_defocus.pyi", "_defocus.so", "_scene_data.py", "_settings.py", "py.typed"]
    assert not any(path.is_symlink() for path in package.iterdir())
    script = "import defocus; print(defocus.__file__, len(defocus.plan(fish_count=1, triangles_per_fish=300)['objects']))"
    outcome = subprocess.run([sys.executable, "-B", "-c", script], capture_output=True, text=True, check=False,
                             env={**os.environ, "PYTHONPATH": str(package.parent)})
    assert outcome.returncode == 0, outcome.stderr
    assert outcome.stdout.split()[0] == str(package / "__init__.py") and int(outcome.stdout.split()[1]) >= 1
