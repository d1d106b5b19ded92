"""Tests that rendering returns the program's pixels, as arrays without copies."""

import itertools
import json
import shutil
import weakref

import numpy
import pytest

import defocus
from conftest import SMALL_OPTIONS

pytestmark = pytest.mark.usefixtures("gl")


def test_image_is_an_array_that_owns_the_renderer_s_pixels(small):
    image = defocus.render(**small)
    assert image.shape == (48, 64, 4)
    assert image.dtype == numpy.float32
    assert image.flags.c_contiguous and image.flags.writeable and image.flags.aligned
    assert not image.flags.owndata
    assert type(image.base).__name__ == "PyCapsule"
    assert numpy.isfinite(image).all() and image[..., :3].max() > 0
    image[10:20] = 0
    image *= 2
    assert image[10:20].sum() == 0


def test_renders_the_program_s_bits(small, rendered):
    assert numpy.array_equal(defocus.render(**small), rendered(*SMALL_OPTIONS))
    lens = {"f_stop": 0.95, "blade_count": 5, "background": (0.2, 0.1, 0.4), "focus_distance": 1.5}
    options = ["--fstop", "0.95", "--blades", "5", "--background", "0.2,0.1,0.4", "--focus-distance", "1.5"]
    assert numpy.array_equal(defocus.render(**small, **lens), rendered(*SMALL_OPTIONS, *options))


def test_renders_a_file_at_a_moment(meshes, rendered):
    swimmers = str(meshes / "swimmers.glb")
    settings = {"size": (64, 36), "samples": 4, "shutter": "1/48", "node_blur": {"Fish 1": 0}}
    options = [swimmers, "--size", "64x36", "--samples", "4", "--shutter", "1/48", "--node-blur", "Fish 1=0"]
    at_start = defocus.render(swimmers, **settings)
    later = defocus.render(meshes / "swimmers.glb", **settings, time=1.25)
    assert not numpy.array_equal(at_start, later)
    assert numpy.array_equal(later, rendered(*options, "--time", "1.25"))


def test_methods_take_their_settings_as_keywords(small, rendered):
    small["f_stop"] = 0.5
    image = defocus.render(**small, method="circular", near_components=1, far_components=5)
    options = ["--fstop", "0.5", "--method", "circular", "--near-components", "1", "--far-components", "5"]
    assert numpy.array_equal(image, rendered(*SMALL_OPTIONS, *options))
    assert numpy.array_equal(image, defocus.render(**small, method="circular:near-components=1,far-components=5"))
    assert not numpy.array_equal(image, defocus.render(**small, method="circular:near-components=1,far-components=1"))


def test_a_renderer_renders_frame_after_frame(small):
    with defocus.Renderer(**small, f_stop=1.4) as renderer:
        first = renderer.render()
        second = renderer.render(f_stop=8)
        kept = second.copy()
        again = renderer.render()
        assert renderer.samples == renderer.sample_total == 8
        assert renderer.statistics.samples == 8
        assert renderer.statistics.triangles_drawn > 0 and renderer.statistics.device
    assert numpy.array_equal(first, again)
    assert numpy.array_equal(first, defocus.render(**small, f_stop=1.4))
    assert numpy.array_equal(second, kept)  # a later frame does not overwrite the pixels of an earlier one
    assert numpy.array_equal(second, defocus.render(**small, f_stop=8))
    with pytest.raises(defocus.Error, match="the renderer is closed"):
        renderer.render()


def test_the_ground_follows_the_clip(meshes):
    fox = {"scene": meshes.parent / "tests/data/models/Fox.glb", "size": (64, 48), "samples": 4, "ground": True, "units": "0.01"}
    with defocus.Renderer(**fox, clip="Survey") as renderer:
        survey = renderer.render()
        run = renderer.render(clip="Run")
    assert not numpy.array_equal(survey, run)
    assert numpy.array_equal(run, defocus.render(**fox, clip="Run"))


def test_a_target_error_leaves_the_number_of_samples_to_the_picture(small):
    del small["samples"]
    with defocus.Renderer(**small, f_stop=1.4) as renderer:
        renderer.render()
        assert renderer.statistics.stopped == "samples" and 0 < renderer.statistics.estimated_error < 0.1
        renderer.render(target_error=0.1)
        assert renderer.statistics.samples == 128 and renderer.statistics.stopped == "target error"
        assert 0 < renderer.statistics.estimated_error <= 0.1
        renderer.render(time_limit=0.001)
        assert renderer.statistics.samples == 64 and renderer.statistics.stopped == "time limit"
    with pytest.raises(defocus.UsageError, match="target_error"):
        defocus.render(**small, target_error=2)


def test_none_opens_a_renderer_s_value_again(small):
    with defocus.Renderer(**small, f_stop=16) as renderer:
        assert numpy.array_equal(renderer.render(f_stop=None), defocus.render(**small))


def test_a_renderer_keeps_to_its_scene(small, meshes):
    with defocus.Renderer(**small) as renderer:
        with pytest.raises(defocus.UsageError, match="another scene"):
            renderer.render(fish_count=3)


def test_an_open_scene_renders_as_its_file(meshes):
    chess = meshes / "chess.glb"
    scene = defocus.Scene(chess)
    assert "Near queen" in scene.nodes and scene.cameras == ["Camera"] and scene.clips == ["Move"]
    assert scene.triangles > 1000
    settings = {"size": (64, 48), "samples": 4, "focus_node": "Near queen"}
    assert numpy.array_equal(defocus.render(scene, **settings), defocus.render(chess, **settings))
    school = defocus.Scene.school_of_fish(2, triangles_per_fish=500)
    own = {"size": (64, 48), "samples": 4}
    assert numpy.array_equal(defocus.render(school, **own),
                             defocus.render(fish_count=2, triangles_per_fish=500, **own))
    with defocus.Renderer(school, **own) as renderer:
        assert renderer.scene.triangles == school.triangles


def test_progressive_converges_to_the_image(small):
    images = list(defocus.progressive(**small, wave=2))
    assert [samples for _, samples in images] == [2, 4, 6, 8]
    assert numpy.array_equal(images[-1][0], defocus.render(**small))
    for (a, _), (b, _) in itertools.combinations(images, 2):
        assert not numpy.shares_memory(a, b) and not numpy.array_equal(a, b)


def test_closing_the_generator_frees_the_renderer(small, monkeypatch):
    made = []
    native = defocus._defocus.Renderer

    def noted(*arguments):
        renderer = native(*arguments)
        made.append(weakref.ref(renderer))
        return renderer

    monkeypatch.setattr(defocus._defocus, "Renderer", noted)
    images = defocus.progressive(**small, wave=1)
    assert not made  # no frame is rendered before the first step of the iterator
    image, samples = next(images)
    assert samples == 1 and made[0]() is not None
    images.close()
    assert made[0]() is None
    assert image.shape == (48, 64, 4) and numpy.isfinite(image).all()

    for _ in defocus.progressive(**small, wave=1):
        break
    assert len(made) == 2 and made[1]() is None


def test_progressive_reports_wrong_keywords_at_once():
    with pytest.raises(defocus.UsageError, match="did you mean 'f_stop'"):
        defocus.progressive(f_stpo=2)


def test_aovs_tell_depth_blur_and_level(small):
    with defocus.Renderer(**small, f_stop=1.4, focus_distance=2) as renderer:
        with pytest.raises(defocus.Error, match="no frame has been started"):
            renderer.aovs()
        renderer.start()
        depth, coc, level = aovs = renderer.aovs()
    assert aovs.depth is depth
    for image in aovs:
        assert image.shape == (48, 64) and image.dtype == numpy.float32 and not image.flags.owndata
    seen = numpy.isfinite(depth)
    assert seen.any()
    assert (depth[seen] > 0).all()
    assert ((depth > 2) == (coc > 0))[seen].all()
    assert ((level >= 0) == seen).all() and (level[~seen] == -1).all()


def test_plan_is_the_program_s(small, program):
    plan = defocus.plan(**small)
    assert plan == json.loads(program("plan", *SMALL_OPTIONS, "--json").stdout)
    with defocus.Renderer(**small) as renderer:
        renderer.start()
        assert renderer.plan() == plan
        renderer.start(f_stop=1)
        assert renderer.plan() == defocus.plan(**small, f_stop=1)


def test_writes_an_image_as_the_program_does(meshes, tmp_path, program):
    settings = {"size": (64, 48), "samples": 4, "tone_map": "agx", "exposure": 0.5}
    with defocus.Renderer(meshes / "staircase.gltf", **settings) as renderer:
        image = renderer.render()
        renderer.write(tmp_path / "python.png", image)
        renderer.write(tmp_path / "python.exr", image)
    defocus.write_image(tmp_path / "plain.png", image, tone_map="agx", exposure=0.5)
    outcome = program("render", meshes / "staircase.gltf", "--size", "64x48", "--samples", "4", "--tonemap", "agx",
                      "--exposure", "0.5", "-o", "program.png")
    assert outcome.returncode == 0, outcome.stderr
    wanted = defocus.read_image(tmp_path / "program.png")
    assert numpy.array_equal(defocus.read_image(tmp_path / "python.png"), wanted)
    assert numpy.array_equal(defocus.read_image(tmp_path / "plain.png"), wanted)
    assert b"defocus:samples" in (tmp_path / "python.exr").read_bytes()


def test_warnings_are_python_s_and_come_once(meshes, tmp_path):
    file = json.loads((meshes / "staircase.gltf").read_text())
    file["cameras"][0]["extras"]["fStop"] = -1
    (tmp_path / "odd.gltf").write_text(json.dumps(file))
    settings = {"size": (16, 12), "samples": 1}
    with pytest.warns(UserWarning, match="fStop") as caught:
        defocus.render(tmp_path / "odd.gltf", **settings)
    assert caught[0].filename == __file__
    with defocus.Renderer(tmp_path / "odd.gltf", **settings) as renderer:
        with pytest.warns(UserWarning) as caught:
            renderer.render()
            renderer.render()
        messages = [str(warning.message) for warning in caught]
        assert len(messages) == len(set(messages)) and set(messages) == set(renderer.warnings)


def test_a_clipped_picture_is_warned_of(meshes, tmp_path):
    with defocus.Renderer(meshes / "staircase.gltf", size=(16, 12), samples=1, exposure=-20) as renderer:
        image = renderer.render()
        renderer.write(tmp_path / "linear.exr", image)
        with pytest.warns(UserWarning, match="of the image is black"):
            renderer.write(tmp_path / "black.png", image)


def test_names_of_files_may_hold_anything(meshes, small, tmp_path):
    odd = tmp_path / "späť ❤ a b.gltf"
    shutil.copy(meshes / "staircase.gltf", odd)
    image = defocus.render(odd, size=(16, 12), samples=1)
    defocus.write_image(tmp_path / "❤.exr", image)
    assert numpy.array_equal(defocus.read_image(tmp_path / "❤.exr"), image)


def test_plan_and_pyramid_refuse_an_open_scene(meshes):
    scene = defocus.Scene(meshes / "fish.glb")
    for function in (defocus.plan, defocus.pyramid):
        with pytest.raises(defocus.UsageError, match="use Renderer"):
            function(scene)


def test_pyramid_halves_the_triangles(small):
    pyramid = defocus.pyramid(fish_count=1, triangles_per_fish=2000)
    counts = [[level["triangles"] for level in mesh["levels"]] for mesh in pyramid["meshes"]]
    assert all(count == sorted(set(count), reverse=True) for count in counts)
    assert max(map(len, counts)) > 3
    assert all({"meanEdge", "error"} <= set(level) for mesh in pyramid["meshes"] for level in mesh["levels"])
