"""Tests all commands of scripts/figures, and the report script that is embedded in the program."""

import ast
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from figures import copies, lens
from figures.__main__ import COMMANDS
from figures.results import RESULTS

ROOT = Path(__file__).resolve().parents[2]


def figures(*words):
    return subprocess.run([sys.executable, ROOT / "scripts" / "figures", *words], capture_output=True, text=True, check=False)


def test_help_lists_every_command():
    for words in ((), ("--help",)):
        outcome = figures(*words)
        assert outcome.returncode == 0 and all(f"\n  {name} " in outcome.stdout for name in COMMANDS)
    assert figures("nothing").returncode == 2


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_describes_itself(name):
    if name in ("plots", "report", "first-pictures", "materials", "lines"):
        pytest.importorskip("matplotlib")
    if name == "circular-fit":
        pytest.importorskip("numpy")
    outcome = figures(name, "--help")
    assert outcome.returncode == 0, outcome.stderr
    assert f"scripts/figures {name}" in outcome.stdout


def test_the_report_draws_committed_results(tmp_path):
    pytest.importorskip("matplotlib")
    for bench in ("scaling", "stability"):
        shutil.copy(RESULTS / f"llvmpipe-{bench}.json", tmp_path / f"{bench}.json")
    shutil.copy(RESULTS / "llvmpipe-methods-fish.json", tmp_path / "results.json")
    shutil.copy(RESULTS / "h200-speedup.json", tmp_path / "speedup.json")
    outcome = figures("report", str(tmp_path))
    assert outcome.returncode == 0, outcome.stderr
    page = (tmp_path / "index.html").read_text()
    for heading in ("Error against run time", "Speed-up", "Scaling", "Stiff and extreme cases"):
        assert f">{heading}</h2>" in page
    assert [path.name for path in tmp_path.glob(".*")] == []


def test_modules_in_the_program_share_no_names():
    """The build joins these modules into one script, so their names must not collide."""
    modules = re.search(r"foreach\(MODULE IN ITEMS (files [^)]*)\)", (ROOT / "src" / "CMakeLists.txt").read_text())[1].split()
    names = []
    for module in modules:
        for node in ast.parse((ROOT / "bench" / "figures" / f"{module}.py").read_text()).body:
            if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
                names.append(node.name)
            elif isinstance(node, ast.Assign):
                names += [name.id for target in node.targets for name in ast.walk(target) if isinstance(name, ast.Name)]
            elif isinstance(node, ast.ImportFrom) and node.module.startswith("figures"):
                assert node.lineno == node.end_lineno and node.module.split(".")[1] in modules
    assert len(names) == len(set(names)) and "main" in names


def test_the_lens_page_has_a_command_for_every_picture():
    page = (lens.FOLDER / "README.md").read_text()
    commands = lens.commands_of(page)
    traced = {f"fig9-{image}.png" for image in ("accumulation", "embree", "difference")}
    assert set(re.findall(r"!\[\]\((.*?)\)", page)) == {*commands, *traced, "coc-curves.png"}
    assert all((lens.FOLDER / file).exists() for file in commands)
    common = ["--size", "400x300", "--background", "0.015,0.018,0.03", "--samples"]
    assert commands["thin-lens.png"] == ("meshes/chess.glb", [*common, "4096"])
    assert commands["fig5-closed.png"] == ("meshes/chess.glb", [*common, "4096", "--fstop", "11"])
    assert commands["fig10-fine.png"][0] == "on a finer board"
    assert commands["hairball-swing.png"] == ("meshes/hairball.py", [*common, "256", "--lod", "off", "--focus-swing", "65"])
    assert commands["painted-blur-off.png"] == ("meshes/painted-blur.glb", [*common, "4096", "--shutter", "1/50", "--blur-scale", "0"])


def test_copies_share_meshes_and_lose_what_they_cannot_have():
    document = {"scenes": [{"nodes": [0]}], "skins": [{}], "animations": [{}],
                "nodes": [{"children": [1, 2]}, {"mesh": 0, "skin": 0}, {"camera": 3}]}
    copies.add_copies(document, 2, (-1, 0, -1), (1, 4, 1))
    nodes = document["nodes"]
    roots = [nodes[index] for index in document["scenes"][0]["nodes"]]
    assert [root["name"] for root in roots] == ["Copy 1", "Copy 2", "Camera"]
    assert [root["translation"][2] for root in roots[:2]] == [pytest.approx(-8 * 6**0.25), pytest.approx(-8 * 6**0.75)]
    for root in roots[:2]:
        copy = nodes[root["children"][0]]
        assert [nodes[child].get("mesh") for child in copy["children"]] == [0, None]
    assert "skins" not in document and "animations" not in document
    assert [node for node in nodes if "skin" in node] == [] and [node["camera"] for node in nodes if "camera" in node] == [0]
