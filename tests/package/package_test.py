#!/usr/bin/env python3
"""Tests the installed library from an outside project.

    package_test.py BUILD SOURCE CMAKE COMPILER

Installs the library of the build tree BUILD, once static and once shared. The programs of examples/ are copied to a
folder outside the tree, built with find_package and with pkg-config, and run. Their images must have the requested
size, show something, and have the same bits for both kinds of library.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

EXAMPLES = ["render", "progressive", "animation", "scene_data"]


def run(*words, **options):
    words = [str(word) for word in words]
    result = subprocess.run(words, capture_output=True, text=True, **options)
    if result.returncode != 0:
        sys.exit(f"{' '.join(words)}\nexit code {result.returncode}\n{result.stdout}{result.stderr}")
    return result.stdout


def check(holds, message):
    if not holds:
        sys.exit(message)


def check_headers(prefix, source):
    """Checks that only public headers are installed, and that they include only the standard library and each other."""
    include = prefix / "include"
    installed = sorted(str(path.relative_to(include)) for path in include.rglob("*") if path.is_file())
    public = sorted(str(path.relative_to(source / "include")) for path in (source / "include").rglob("*.h"))
    check(installed == sorted(public + ["defocus/version.h"]), f"installed headers: {installed}")
    check("defocus/defocus.h" in installed, "there is no defocus.h")
    for name in installed:
        for included in re.findall(r'^\s*#\s*include\s*(\S+)', (include / name).read_text(), re.MULTILINE):
            ours = re.fullmatch(r'"(defocus/\w+\.h)"', included)
            check((ours and ours[1] in installed) or re.fullmatch(r"<[a-z_]+>", included), f"{name} includes {included}")


def check_package_files(prefix, kind):
    """Checks the dependencies that the CMake and pkg-config files of the package list: none for the shared library, the
    linked libraries for the static library, and never the libraries of the window.
    """
    files = list(prefix.rglob("*.cmake")) + list(prefix.rglob("*.pc"))
    check(len(files) >= 4, f"package files: {files}")
    foreign = ["glfw", "imgui", "CLI11", "glm", "nlohmann"]
    if kind == "shared":
        foreign += ["OpenImageIO", "TinyGLTF", "fmt", "draco", "epoxy", "find_dependency"]
    for path in files:
        for word in foreign:
            check(word.lower() not in path.read_text().lower(), f"{path.name} of the {kind} library mentions {word}")


def check_shared_library(prefix, version):
    libraries = [path for path in prefix.rglob("libdefocus.so.*") if not path.is_symlink()]
    check([path.name for path in libraries] == [f"libdefocus.so.{version}"], f"libraries: {libraries}")
    dynamic = run("readelf", "-d", "-W", libraries[0])
    check(f"[libdefocus.so.{'.'.join(version.split('.')[:2])}]" in dynamic, dynamic)
    for needed in re.findall(r"\(NEEDED\).*\[(.*)\]", dynamic):
        check(not re.search("glfw|imgui|X11", needed), f"the library needs {needed}")
    # Weak symbols belong to templates of the standard library; all other symbols must belong to the library's API.
    for line in run("nm", "-D", "-C", "--defined-only", libraries[0]).splitlines():
        kind, name = line.split(None, 2)[1:]
        api = re.match(r"((typeinfo|vtable|typeinfo name) for )?defocus::", name)
        check(kind in "WVu" or (api and "::State::" not in name), f"the library shows {name}")
        check(not re.search("tinygltf|glm::|fmt::|nlohmann|OpenImageIO", name) or kind in "WVu", f"the library shows {name}")


def cmake_programs(folder, prefix, cmake, compiler):
    run(cmake, "-S", folder, "-B", folder / "build", "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={prefix}",
        f"-DCMAKE_CXX_COMPILER={compiler}", "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_COMPILER_LAUNCHER=")
    run(cmake, "--build", folder / "build")
    return folder / "build"


def pkg_config_programs(folder, prefix, compiler, kind):
    environment = dict(os.environ, PKG_CONFIG_PATH=str(next(prefix.rglob("pkgconfig"))))
    query = ["pkg-config"] + (["--static"] if kind == "static" else []) + ["--cflags", "--libs", "defocus"]
    flags = run(*query, env=environment).split()
    libraries = next(path.parent for path in prefix.rglob("libdefocus.*"))
    programs = folder / "by-hand"
    programs.mkdir()
    for name in EXAMPLES[:1]:
        run(compiler, "-std=c++20", folder / f"{name}.cpp", "-o", programs / name, *flags, f"-Wl,-rpath,{libraries}")
    return programs


def render_all(programs, output, scene, environment):
    """Renders the images of all examples in `programs` into the folder `output`."""
    output.mkdir(parents=True)
    arguments = {"render": "render.exr", "progressive": "progressive.png", "animation": "frames"}
    for name, result in arguments.items():
        if (programs / name).exists():
            run(programs / name, scene, output / result, env=environment, cwd=output)
    if (programs / "scene_data").exists():
        run(programs / "scene_data", output / "floor.png", env=environment, cwd=output)
    return output


def check_documentation(source):
    """Checks that docs/library.md shows examples/scene_data.cpp unchanged."""
    example = (source / "examples" / "scene_data.cpp").read_text()
    check(example[example.index("#include"):] in (source / "docs" / "library.md").read_text(),
          "docs/library.md shows another program than examples/scene_data.cpp")


def png_data(path):
    """Returns the stored pixels of a PNG without its metadata."""
    data, at, file = b"", 8, path.read_bytes()
    while at < len(file):
        size = int.from_bytes(file[at : at + 4], "big")
        if file[at + 4 : at + 8] == b"IDAT":
            data += file[at + 8 : at + 8 + size]
        at += 12 + size
    return data


def main():
    build, source, cmake, compiler = (Path(word) for word in sys.argv[1:5])
    check_documentation(source)
    with tempfile.TemporaryDirectory(prefix="defocus-package-") as name:
        root = Path(name)
        scene = root / "scene.glb"  # the scene has an animation
        shutil.copy(source / "meshes" / "reed.glb", scene)
        environment = dict(os.environ, XDG_CACHE_HOME=str(root / "cache"))
        outputs = []
        for kind in ["static", "shared"]:
            prefix = root / kind / "prefix"
            run(cmake, "--install", build, "--prefix", prefix, "--component", kind)
            check_headers(prefix, source)
            check_package_files(prefix, kind)
            project = root / kind / "examples"
            shutil.copytree(source / "examples", project)
            shutil.copy(source / "tests" / "package" / "check.cpp", project)
            with open(project / "CMakeLists.txt", "a") as file:
                file.write("add_executable(check check.cpp)\ntarget_link_libraries(check PRIVATE defocus::defocus)\n")
            programs = cmake_programs(project, prefix, cmake, compiler)
            version = re.search(r'VERSION_STRING "(.*)"', (prefix / "include/defocus/version.h").read_text())[1]
            if kind == "shared":
                check_shared_library(prefix, version)
            outputs.append(render_all(programs, root / kind / "cmake-images", scene, environment))
            by_hand = pkg_config_programs(project, prefix, compiler, kind)
            outputs.append(render_all(by_hand, root / kind / "pkg-config-images", scene, environment))

        def same(size, name):
            images = [output / name for output in outputs if (output / name).exists()]
            check(len(images) > 1, f"there is no {name}")
            run(programs / "check", *size, *images)

        same((1024, 768, 4), "render.exr")
        same((480, 270, 4), "progressive.png")
        same((480, 270, 1), "progressive.depth.exr")
        same((480, 320, 4), "floor.png")
        for frame in range(12):
            same((320, 180, 4), f"frames/{frame:04}.png")
        moving = {png_data(outputs[0] / f"frames/{frame:04}.png") for frame in range(12)}
        check(len(moving) == 12, "frames of the animation are alike")


main()
