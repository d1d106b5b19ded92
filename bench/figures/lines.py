"""Compares line samples with points on meshes/teapots.py: runs, images and tables of bench/results/line-samples.md.

    scripts/figures lines [--program build/release/defocus] [--runs FOLDER]

Takes minutes on a CPU. --runs keeps the results of the bench in FOLDER, and measures only what FOLDER lacks.
scripts/figures tables then writes the tables of the page. Needs Pillow (Debian: python3-pil) and the font of
fonts-dejavu-core.
"""

import json
import math
import pathlib
import sys
import tempfile

from PIL import Image, ImageChops, ImageStat

from figures.command import ROOT, add_program, parser_of, path, run
from figures.contact_sheet import HEIGHT, WIDTH, contact_sheet
from figures.files import write_file
from figures.line_rows import DETAILS, EXACT, POINTS, PUBLISHED, VIEWS, equal_time_points, row_of, run_name, runs, text_of
from figures.results import RESULTS

sys.path.insert(0, str(ROOT / "meshes"))
import teapots  # noqa: E402

FOLDER = RESULTS / "lines"
MAGNIFIED = 4  # factor by which crops of the images are enlarged
PLACES = {"blurred edges": (38, 76), "in focus": (124, 68), "lights": (16, 0)}  # upper left corners of the crops, px


def measure(program, folder):
    """Runs the bench for each view, resuming the results in the folder, and copies the results."""
    (folder / "teapots.glb").write_bytes(teapots.teapots())
    for name, options in runs().items():
        again = ["--resume"] if (folder / name).exists() else []
        run(program, "bench", "convergence", "teapots.glb", "--size", f"{WIDTH}x{HEIGHT}", *options, *again, "-o", name, cwd=folder)
        write_file(RESULTS / f"{name}.json", (folder / name / "results.json").read_bytes())
        print(name, flush=True)


class Pictures:
    """Reads the images of the runs in a folder."""

    def __init__(self, folder):
        self.folder = folder

    def reference(self, blur):
        return self.opened(f"{VIEWS[blur]}/images/reference.png")

    def drawn(self, blur, method, samples):
        return self.opened(f"{run_name(blur, method)}/{row_of(blur, method, samples)['image']}")

    def opened(self, file):
        with Image.open(self.folder / file) as image:
            return image.convert("RGB")


def detail(image, name):
    x, y = PLACES[name]
    return image.crop((x, y, x + WIDTH // MAGNIFIED, y + HEIGHT // MAGNIFIED))


def difference(a, b):
    """Returns the RMSE between two images with values in [0, 1]."""
    return math.sqrt(sum(value * value for value in ImageStat.Stat(ImageChops.difference(a, b)).rms) / 3) / 255


def save(sheet, name):
    FOLDER.mkdir(exist_ok=True)
    sheet.save(FOLDER / name, quality=90)
    print(name, flush=True)


def draw_views(pictures, columns, texts, file):
    """Draws a row of images for each view. columns: (method, samples). texts: {blur scale: title of the row}."""
    blurs = list(texts)
    save(contact_sheet(("reference", *(text_of(*column) for column in columns)), list(texts.values()), lambda index: [
        pictures.reference(blurs[index]), *(pictures.drawn(blurs[index], *column) for column in columns)], columns=1), file)


def draw_details(pictures):
    """Draws enlarged details of the images, and writes the errors of these details."""
    texts, errors = [text_of(*column) for column in DETAILS], {}

    def row(index):
        name = list(PLACES)[index]
        reference, *parts = (detail(image, name) for image in (
            pictures.reference(1), *(pictures.drawn(1, *column) for column in DETAILS)))
        errors[name] = {text: round(difference(reference, part), 4) for text, part in zip(texts, parts)}
        return [part.resize((WIDTH, HEIGHT), Image.NEAREST) for part in (reference, *parts)]

    save(contact_sheet(("reference", *texts), list(PLACES), row, columns=1), "figure-8.jpg")
    write_file(FOLDER / "details.json", json.dumps(errors, indent=1) + "\n")


def main(words):
    parser = parser_of("lines", __doc__)
    parser.add_argument("--runs", type=path, metavar="FOLDER", help="folder for the results of the bench (default: a temporary one)")
    add_program(parser)
    arguments = parser.parse_args(words)
    with tempfile.TemporaryDirectory() as scratch:
        folder = arguments.runs or pathlib.Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        measure(arguments.program, folder)
        pictures = Pictures(folder)
        draw_views(pictures, [(EXACT, 16), (PUBLISHED, 16), (POINTS, equal_time_points())], {1: "teapots"}, "figure-1.jpg")
        draw_details(pictures)
        draw_views(pictures, [(EXACT, 16), (PUBLISHED, 16), (POINTS, 64), (POINTS, 256)],
                   {blur: f"{blur:g} times the blur" for blur in VIEWS}, "figure-9.jpg")
