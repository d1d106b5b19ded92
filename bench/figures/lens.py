"""Renders the images in bench/results/lens with the commands on its README.md, and draws the curves of the same page.

    scripts/figures lens [--only NAME] [--program build/release/defocus]

Each section lists commands such as "- closed: `--fstop 11`", in the order of its images. The full command is the one
at the top of the page with these options added; a sentence "With `…`" replaces the scene or the number of samples.
Updates the PSNR under Figure 9. Figure 9 needs the bench of the ray tracer (defocus_truth_bench), the curves need
matplotlib.
"""

import json
import pathlib
import re
import shlex
import struct
import sys
import tempfile

from figures.command import ROOT, add_program, parser_of, run
from figures.files import write_file

sys.path.insert(0, str(ROOT / "meshes"))
import hairball  # noqa: E402
import make_meshes  # noqa: E402
import radial_blur  # noqa: E402

FOLDER = ROOT / "bench" / "results" / "lens"
# Scenes that are not in the repository, and the functions that make them.
MADE = {"meshes/hairball.py": hairball.hairball, "meshes/radial_blur.py": radial_blur.radial_blur,
        "on lamps without `_COC_SCALE`": lambda: radial_blur.radial_blur(scaled=False), "on a finer board": lambda: make_meshes.chess(200)}


def commands_of(page):
    """Returns {image: (scene, options)} for the images on the page that `defocus render` makes."""
    scene, *common, samples = shlex.split(re.search(r"^    defocus render (.*)$", page, re.M)[1])
    commands = {}
    for section in page.split("\n## ")[1:]:
        remark = "".join(re.findall(r"^With .*", section, re.M))
        named = re.findall(r"`(meshes/.*?)`", remark) + [scene]
        count = re.findall(r"`--samples (.*?)`", remark) + [samples]
        lines = re.findall(r"^- \S+: `(.*?)` ?(.*)$", section, re.M)
        for file, (options, made) in zip(re.findall(r"!\[\]\((.*?)\)", section), lines):
            commands[file] = made or named[0], [*common, count[0], *shlex.split(options.replace("(nothing more)", ""))]
    return commands


def without_texts(data):
    """Returns a PNG file without its text chunks, which contain machine and settings."""
    kept, offset = data[:8], 8
    while offset < len(data):
        end = offset + 12 + struct.unpack_from(">I", data, offset)[0]
        if data[offset + 4:offset + 8] in (b"IHDR", b"PLTE", b"IDAT", b"IEND", b"tRNS"):
            kept += data[offset:end]
        offset = end
    return kept


def keep(picture, name):
    write_file(FOLDER / name, without_texts(picture.read_bytes()))
    print(name, flush=True)


def render(program, file, scene, options, scratch):
    if scene in MADE:
        (scratch / "scene.glb").write_bytes(MADE[scene]())
        scene = scratch / "scene.glb"
    run(program, "render", scene, *options, "-o", scratch / file, "--quiet")
    keep(scratch / file, file)


def trace(bench, page, scratch):
    """Renders Figure 9 with the ray tracer's bench, and returns the page with the new PSNR."""
    words = shlex.split(re.search(r"^    defocus_truth_bench (.*)$", page, re.M)[1])
    measured = json.loads(run(bench, *(scratch if word == "FOLDER" else word for word in words)))
    for image in ("accumulation", "embree", "difference"):
        keep(scratch / f"chess-{image}.png", f"fig9-{image}.png")
    return re.sub(r"^PSNR .* dB, .* dB at equal", f"PSNR {measured['psnr']:.1f} dB, {measured['psnrAtEqualLensPoints']:.1f} dB at equal",
                  page, flags=re.M)


def main(words):
    parser = parser_of("lens", __doc__)
    parser.add_argument("--only", metavar="NAME", default="",
                        help="only pictures whose names begin so: fig3, fig9, thin-lens, …; or coc-curves")
    add_program(parser)
    arguments = parser.parse_args(words)
    page = (FOLDER / "README.md").read_text()
    traced = "fig9".startswith(arguments.only)
    bench = arguments.program.parent / "bench" / "defocus_truth_bench"
    if traced and not bench.exists():
        parser.error(f"{bench} does not exist; build it first")
    if "coc-curves".startswith(arguments.only):
        from figures.curves import draw_curves  # imported here, because only these curves need matplotlib
        draw_curves(arguments.program, FOLDER / "coc-curves.png")
    with tempfile.TemporaryDirectory() as folder:
        scratch = pathlib.Path(folder)
        for file, (scene, options) in commands_of(page).items():
            if file.startswith(arguments.only):
                render(arguments.program, file, scene, options, scratch)
        if traced:
            write_file(FOLDER / "README.md", trace(bench, page, scratch))
