"""Tests that the keywords and values that Python accepts are exactly those of the table of settings."""

import ast
import fractions
import importlib.util
import inspect
import os
import pathlib
import subprocess
import sys
import typing

import numpy
import pytest

import defocus
from defocus import _settings


def texts(keyword, value):
    return list(_settings.texts(_settings.INFOS[keyword], value))


def test_completion_offers_only_the_public_names():
    assert dir(defocus) == sorted([*defocus.__all__, "__version__"])
    assert all(hasattr(defocus, name) for name in dir(defocus))


def test_values_go_as_the_command_line_has_them():
    assert texts("f_stop", 1.4) == ["1.4"]
    assert texts("f_stop", numpy.float64(0.95)) == ["0.95"]
    assert texts("f_stop", 2) == ["2"]
    assert texts("samples", numpy.int32(64)) == ["64"]
    assert texts("shutter", fractions.Fraction(1, 4)) == ["0.25"]
    assert texts("shutter", "1/48") == ["1/48"]
    assert texts("dof_enabled", False) == ["false"]
    assert texts("loop", numpy.bool_(True)) == ["true"]
    assert texts("lod", "off") == ["off"]
    assert texts("environment", pathlib.Path("a b.hdr")) == ["a b.hdr"]
    assert texts("size", (640, 480)) == ["640x480"]
    assert texts("size", "640x480") == ["640x480"]
    assert texts("camera_position", (0, 1.5, 3)) == ["0,1.5,3"]
    assert texts("camera_up", numpy.array([0.0, 1.0, 0.25])) == ["0.0,1.0,0.25"]
    assert texts("focus_pixel", (12, 34)) == ["12,34"]
    assert texts("focus_points", ((1, 2), (3, 4), (5, 6))) == ["1,2,3,4,5,6"]
    assert texts("node_blur", {"Fish=3": 0, "Weed": 0.5}) == ["Fish=3=0", "Weed=0.5"]
    assert texts("hide", ["Board", "Queen, white"]) == ["Board", "Queen, white"]
    assert texts("hide", "Board") == ["Board"]


def test_what_is_given_beside_a_preset_wins():
    small = {"fish_count": 1, "triangles_per_fish": 1000, "no_cache": True, "size": (64, 48)}
    for given in ({"preset": "jeong2011", "sequence": "r2"}, {"sequence": "r2", "preset": "jeong2011"}):
        plan = defocus.plan(**small, **given)
        assert plan["sequence"] == "r2"
        assert plan["lod"]["metric"] == "proportional" and plan["lod"]["vertices"] == "surviving"


# Every setting is a keyword argument that accepts the setting's own default.
@pytest.mark.parametrize("setting", [s for s in defocus.settings() if s.default is not None], ids=lambda s: s.keyword)
def test_every_setting_takes_its_default(setting):
    defocus._settings.request_of(None, {setting.keyword: setting.default})


def test_each_keyword_is_of_one_setting():
    keywords = [info.keyword for info in defocus._defocus.setting_infos()]
    assert len(keywords) == len(set(keywords)) > 50
    far = {setting.keyword: setting for setting in defocus.settings()}["far_components"]
    assert "circular" in far.methods and far.kind == "integer" and far.range[0] >= 1


def test_a_setting_tells_range_and_unit():
    rows = {setting.keyword: setting for setting in defocus.settings()}
    assert rows["focal_length"].unit == "mm"
    assert rows["focus_distance"].default is None
    assert rows["samples"].range == (1, 65536)
    assert rows["samples"].default == "auto"
    assert rows["tone_map"].choices == ("none", "aces", "agx", "neutral")
    assert rows["tone_map"].range is None
    assert rows["f_stop"].option == "--fstop"


def test_an_unknown_keyword_is_a_type_error_with_the_nearest():
    with pytest.raises(defocus.UsageError) as caught:
        defocus.plan(fstop=1.4)
    assert str(caught.value) == "there is no setting 'fstop'; did you mean 'f_stop'?"
    assert isinstance(caught.value, TypeError) and isinstance(caught.value, defocus.Error)
    with pytest.raises(TypeError, match="there is no setting 'zzzzzz'; defocus.settings\\(\\) lists them"):
        defocus.plan(zzzzzz=1)


def test_wrong_values_say_what_the_program_says(program):
    for keyword, option, value in [("f_stop", "--fstop", 0), ("samples", "--samples", 0), ("lod", "--lod", "of"),
                                   ("size", "--size", "12"), ("node_blur", "--node-blur", "Fish"),
                                   ("focus_pixel", "--focus-pixel", "1"), ("method", "--method", "circula")]:
        with pytest.raises(defocus.UsageError) as caught:
            defocus.plan(**{keyword: value})
        assert isinstance(caught.value, ValueError)
        assert str(caught.value).startswith(f"{keyword}: ")
        rule = str(caught.value)[len(f"{keyword}: "):]
        said = program("render", option, value).stderr
        assert rule in said, (rule, said)


def test_a_failure_says_what_the_program_says(program, meshes, tmp_path):
    (tmp_path / "broken.glb").write_bytes(b"glTF but not really")
    for scene, more, options in [(tmp_path / "missing.glb", {}, []), (tmp_path / "broken.glb", {}, []),
                                 (meshes / "chess.glb", {"focus_node": "Kwueen"}, ["--focus-node", "Kwueen"]),
                                 (meshes / "chess.glb", {"camera": "Left"}, ["--camera", "Left"])]:
        with pytest.raises(defocus.Error) as caught:
            defocus.plan(scene, **more)
        outcome = program("plan", scene, *options)
        assert outcome.returncode == 1
        assert outcome.stderr == f"defocus: {caught.value}\n"


def test_none_leaves_a_value_open(meshes):
    plan = defocus.plan(meshes / "chess.glb", f_stop=None, camera=None, node_blur=None)
    assert plan == defocus.plan(meshes / "chess.glb")
    assert plan != defocus.plan(meshes / "chess.glb", f_stop=8)


def test_the_school_has_no_file_and_a_scene_must_be_one(meshes):
    with pytest.raises(defocus.UsageError, match="fish_count applies only to the built-in school"):
        defocus.plan(meshes / "chess.glb", fish_count=3)
    with pytest.raises(defocus.UsageError, match="5 is neither a path nor a Scene"):
        defocus.render(5)
    with pytest.raises(defocus.UsageError, match="progress: 7 is not a callable"):
        defocus.render(progress=7)


def test_help_shows_the_keywords():
    for function in (defocus.render, defocus.progressive, defocus.plan, defocus.pyramid, defocus.Renderer):
        assert {"f_stop", "focus_node", "far_components"} <= set(inspect.signature(function).parameters)
    assert list(inspect.signature(defocus.render).parameters)[:2] == ["scene", "progress"]


def test_stubs_have_the_keywords_of_the_table():
    script = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "python_stubs.py"
    outcome = subprocess.run([sys.executable, "-B", script, "--check"], capture_output=True, text=True, check=False)
    assert outcome.returncode == 0, outcome.stderr


# Script that runs with a copy of the package whose table of settings also contains the setting of tests/new_setting.h.
# The value of this setting is stored in the member `clip` of Request.
NEW_SETTING = """
import inspect, sys
import defocus, pytest, python_stubs
row = {setting.keyword: setting for setting in defocus.settings()}["new_setting"]
assert row.range == (0, 10) and row.option == "--new-setting"
assert "new_setting" in inspect.signature(defocus.render).parameters
assert "    new_setting: Optional[float]  # mm\\n" in python_stubs.keywords()
with pytest.raises(defocus.UsageError, match="new_setting cannot be combined with seed"):
    defocus.plan(new_setting=4, seed=1)
with pytest.raises(defocus.UsageError, match="new_setting: "):
    defocus.plan(new_setting=11)
with pytest.raises(defocus.Error, match="there is no animation '4'"):
    defocus.plan(sys.argv[1], new_setting=4)
"""


def test_a_new_row_of_the_table_is_a_keyword(meshes):
    package = pathlib.Path(os.environ["DEFOCUS_BUILD"]) / "tests" / "python_with_new_setting"
    scripts = pathlib.Path(__file__).resolve().parents[2] / "scripts"
    outcome = subprocess.run([sys.executable, "-B", "-c", NEW_SETTING, meshes / "orrery.glb"], capture_output=True, text=True,
                             env={**os.environ, "PYTHONPATH": f"{package}:{scripts}"}, check=False)
    assert outcome.returncode == 0, outcome.stderr


def test_stub_of_scene_has_its_members():
    tree = ast.parse((pathlib.Path(defocus.__file__).parent / "_defocus.pyi").read_text())
    (scene,) = [node for node in tree.body if isinstance(node, ast.ClassDef) and node.name == "Scene"]
    names = {node.name for node in scene.body if isinstance(node, ast.FunctionDef)} - {"__init__"}
    assert names == {name for name in vars(defocus.Scene) if not name.startswith("_")}


def test_the_binding_uses_the_public_headers_alone():
    source = pathlib.Path(__file__).resolve().parents[2] / "python" / "module.cpp"
    included = [line.split('"')[1] for line in source.read_text().splitlines() if line.startswith('#include "')]
    assert included == ["defocus/defocus.h"]


def test_version_is_the_program_s(program):
    assert program("--version").stdout.strip() == f"defocus {defocus.__version__}"


def test_typed():
    package = pathlib.Path(importlib.util.find_spec("defocus").origin).parent
    assert (package / "py.typed").exists()


def test_type_hints_can_be_read_at_run_time():
    for name in defocus.__all__:
        value = getattr(defocus, name)
        if inspect.isfunction(value) or inspect.isclass(value) and not issubclass(value, BaseException):
            typing.get_type_hints(value)
