"""Renders a scene of meshes/ for each known artefact of image-space methods: with several methods and a reference. The
report of `defocus bench convergence --report FOLDER` shows these strips of images.

    scripts/figures artefacts -o FOLDER [--program build/release/defocus]

Held equal in a strip: scene, camera, lens, image size.
"""

import json

from figures.command import add_program, parser_of, path
from figures.files import write_file
from figures.frames import Frames

SIZE = "600x400"
METHODS = [
    ("Reference: 1,024 lens samples, full detail", ["--method", "accumulation", "--samples", "1024", "--lod", "off"]),
    ("Accumulation, 64 lens samples", ["--method", "accumulation", "--samples", "64"]),
    ("Scheuermann 2004 as published", ["--preset", "scheuermann2004"]),
    ("Scheuermann, thin lens, 64 taps", ["--method", "scheuermann:coc=thin-lens,max-coc=unlimited,taps=64"]),
    ("Garcia 2018 as published: quarter size", ["--preset", "garcia2018"]),
    ("Garcia, full size, exact taps", ["--method", "circular"]),
]
ARTEFACTS = [
    ("leaking", "Leaking",
     "A sharp, bright post before a dark wall: what is gathered for the wall's blur must not take the post's light. The panel "
     "lies between them, blurred less than the wall."),
    ("lost-background", "Lost background",
     "Through the blurred edges of a bar close to the lens one sees the chart behind it, which no pinhole image holds."),
    ("half-discs", "Half discs",
     "Lights far behind a sharp sill. The lower row hides behind it: half of each disk reaches past the edge in a lens, none in "
     "an image that never saw the light."),
    ("ghosting", "Ghosting",
     "A patterned board close to the lens. Under its blurred edge lies its own sharp image."),
    ("panes", "Panes",
     "Coloured glass, alpha-blended. What lies behind it keeps its own blur: the wall behind the sharp pane, the chart behind the "
     "blurred one."),
    ("resolution-loss", "Resolution loss",
     "A fine chart slants through the focus. Where the blur is a few pixels wide, small images show their own pixels."),
]


def strip(program, folder, name, title, text):
    """Renders the images of one artefact and returns their entry for strips.json."""
    images, frames = [], Frames(program, folder, f"meshes/artefact-{name}.gltf", "--size", SIZE)
    for index, (label, options) in enumerate(METHODS):
        file = f"{name}-{index}"
        frames.render(f"{file}.exr", *options, "-o", folder / f"{file}.png")
        if index > 0:
            label += f" · FLIP {frames.difference(f'{name}-0.exr', f'{file}.exr')['flip']:.3f}"
        images.append({"label": label, "file": f"{file}.png"})
    for file in (folder / "stats.json", *folder.glob(f"{name}-*.exr")):
        file.unlink()
    print(f"{title}: {len(images)} images", flush=True)
    return {"title": title, "text": text, "images": images}


def main(words):
    parser = parser_of("artefacts", __doc__)
    parser.add_argument("-o", "--output", required=True, type=path, help="folder for the images and strips.json")
    add_program(parser)
    arguments = parser.parse_args(words)
    arguments.output.mkdir(parents=True, exist_ok=True)
    strips = [strip(arguments.program, arguments.output, *artefact) for artefact in ARTEFACTS]
    write_file(arguments.output / "strips.json", json.dumps(strips, indent=1) + "\n")
