"""Defines fixtures that the Python tests share: small scenes, a separate cache, and the program."""

import os
import subprocess
from pathlib import Path

import pytest

import defocus

# Settings for two fish at 64×48 px, which render in under a second on a software driver.
SMALL = {"fish_count": 2, "triangles_per_fish": 500, "size": (64, 48), "samples": 8}
SMALL_OPTIONS = ["--fish", "2", "--fish-triangles", "500", "--size", "64x48", "--samples", "8"]


@pytest.fixture(autouse=True, scope="session")
def own_cache(tmp_path_factory):
    """Sets a temporary cache folder for this process and its children."""
    os.environ["XDG_CACHE_HOME"] = str(tmp_path_factory.mktemp("cache"))


@pytest.fixture(scope="session")
def gl(own_cache):
    """Skips the tests that use this fixture where OpenGL is not available."""
    try:
        defocus.render(**{**SMALL, "size": (8, 8), "samples": 1})
    except defocus.Error as error:
        if "cannot create an OpenGL 4.5 context" not in str(error):
            raise
        pytest.skip(str(error))


@pytest.fixture
def small():
    return dict(SMALL)


@pytest.fixture(scope="session")
def meshes():
    return Path(__file__).resolve().parents[2] / "meshes"


@pytest.fixture
def program(tmp_path):
    """Returns a function that runs `defocus` with arguments in the test's folder."""

    def run(*words):
        command = [os.environ["DEFOCUS_PROGRAM"], *map(str, words)]
        return subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)

    return run


@pytest.fixture
def rendered(program, tmp_path):
    """Returns a function that runs `defocus render` with some arguments and reads the image that it writes."""

    def image(*words):
        outcome = program("render", *words, "-o", "program.exr", "--quiet")
        assert outcome.returncode == 0, outcome.stderr
        return defocus.read_image(tmp_path / "program.exr")

    return image
