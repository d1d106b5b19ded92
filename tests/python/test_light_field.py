"""Tests images that are refocused from lens images, and the example that makes a data set with them.

Lens images are views from points of the lens.
"""

import inspect
import json
import pathlib
import subprocess
import sys

import numpy
import pytest

import defocus

pytestmark = pytest.mark.usefixtures("gl")

SCHOOL = {"fish_count": 2, "triangles_per_fish": 500, "size": (64, 48), "samples": 16, "f_stop": 0.95}


@pytest.fixture(scope="module")
def path(tmp_path_factory, gl):
    file = tmp_path_factory.mktemp("field") / "a.lens.exr"
    defocus.LightField.render(file, **SCHOOL, focus_distance=2, focus_range=(1.5, 3)).close()
    return file


def test_pictures_are_the_program_s(path, program, tmp_path):
    with defocus.LightField(path) as field:
        picture = field.refocus(focus_distance=2.5, f_stop=1.4, blade_count=5)
    assert picture.shape == (48, 64, 4) and picture.dtype == numpy.float32 and picture.flags.writeable
    words = ["--focus-distance", "2.5", "--fstop", "1.4", "--blades", "5", "-o", "p.exr", "--quiet"]
    outcome = program("refocus", path, *words)
    assert outcome.returncode == 0, outcome.stderr
    assert numpy.array_equal(picture, defocus.read_image(tmp_path / "p.exr"))


def test_info_stack_and_data(path):
    field = defocus.LightField(path)
    info = field.info
    assert (info.width, info.height, info.focus_distance, info.f_stop) == (64, 48, 2, 0.95)
    assert info.focus_range == pytest.approx((1.5, 3)) and info.full_disk and len(info.lens_points) == 16
    stack = field.stack(3, f_stop=1.4)
    assert stack.focus_distances == pytest.approx([1.5, 2, 3])
    assert numpy.array_equal(stack.pictures[2], field.refocus(focus_distance=stack.focus_distances[2], f_stop=1.4))
    depth, coc = field.depth(), field.coc(focus_distance=2.5)
    assert depth.shape == coc.shape == (48, 64) and field.all_in_focus().shape == (48, 64, 4)
    assert numpy.allclose(coc, 2 * info.pixels_per_dioptre * (1 / 2.5 - 1 / depth), atol=1e-4)


def test_wrong_use(path, tmp_path):
    field = defocus.LightField(path)
    for keywords, message in [({"focus_distance": 9}, "rendered range"), ({"f_stop": 0.5}, "wider than"),
                              ({"samples": 8}, "samples cannot be changed after rendering"),
                              ({"fstop": 2}, "did you mean 'f_stop'"), ({"blade_count": 2}, "not 2")]:
        with pytest.raises(defocus.Error, match=message):
            field.refocus(**keywords)
    field.close()
    with pytest.raises(defocus.UsageError, match="the light field is closed"):
        field.refocus()
    with pytest.raises(defocus.Error, match="missing.exr"):
        defocus.LightField(tmp_path / "missing.exr")
    with pytest.raises(defocus.UsageError, match="3 to 2 m"):
        defocus.LightField.render(tmp_path / "b.exr", **SCHOOL, focus_range=(3, 2))
    assert not (tmp_path / "b.exr").exists()


def test_progress_can_cancel_a_render(tmp_path):
    def stop(stage, done, total):
        if stage == "lens images" and done == 3:
            raise KeyError(stage)

    with pytest.raises(KeyError):
        defocus.LightField.render(tmp_path / "a.exr", **SCHOOL, progress=stop)
    assert not list(tmp_path.iterdir())


def test_help_shows_the_choices():
    assert set(inspect.signature(defocus.LightField.refocus).parameters) == {
        "self", "fill_gaps", "progress", "focus_distance", "focus_pixel", "f_stop", "blade_count", "blade_rotation",
        "blade_curvature", "anamorphic_ratio", "obstruction", "spherical_aberration", "aperture_image"}


def test_the_example_makes_a_data_set(tmp_path, meshes):
    example = pathlib.Path(__file__).resolve().parents[2] / "examples" / "defocus_data_set.py"
    output = tmp_path / "set"
    outcome = subprocess.run([sys.executable, "-B", example, meshes / "chess.glb", output, "--size", "64x48",
                              "--samples", "16", "--pictures", "3"], capture_output=True, text=True, check=False)
    assert outcome.returncode == 0, outcome.stderr
    assert sorted(path.name for path in output.iterdir()) == [
        "coc.00.exr", "coc.01.exr", "coc.02.exr", "depth.exr", "lens.json", "scene.lens.exr", "sharp.exr",
        "stack.00.exr", "stack.01.exr", "stack.02.exr"]
    lens = json.loads((output / "lens.json").read_text())
    assert len(lens["focus_distances"]) == 3 and lens["width"] == 64
    depth = defocus.read_image(output / "depth.exr")
    coc = defocus.read_image(output / "coc.01.exr")
    # The CoC in px is A·(1/s − 1/z)·W/(2·tan(θx/2)), with aperture diameter A, focus distance s and depth z in m, image
    # width W in px and horizontal field of view θx.
    aperture = lens["focal_length"] / 1000 / lens["f_stop"]
    tangent = lens["horizontal_aperture"] / 2 / lens["focal_length"]
    expected = aperture * (1 / lens["focus_distances"][1] - 1 / depth) * lens["width"] / (2 * tangent)
    assert numpy.allclose(coc, expected, rtol=1e-4, atol=1e-4)
    sharp = defocus.read_image(output / "sharp.exr")
    blur = [numpy.abs(defocus.read_image(output / f"stack.{i:02}.exr") - sharp).mean() for i in range(3)]
    assert min(blur) > 0
