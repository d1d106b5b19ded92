"""Draws docs/first-pictures.jpg: eighteen scenes as a new user sees them.

    scripts/figures first-pictures MODELS [--program build/release/defocus]

MODELS is a folder with the glTF files in SCENES; the school of fish is built in. Each scene has three pictures: without
guessed units, tone map and metering; with the defaults; with --ground. Held equal: scene, camera, f-number, image size.
Needs Pillow (Debian: python3-pil) and the font of fonts-dejavu-core.
"""

import pathlib
import tempfile

from PIL import Image, ImageDraw, ImageFont

from figures.command import ROOT, add_program, parser_of, path, run

SCENES = ["FlightHelmet/FlightHelmet.gltf", "Fox.glb", "Suzanne.glb", "WaterBottle.glb", "bike.glb",
          "japanese-bridge-garden-meshopt.glb", "GlassVaseFlowers.glb", "MetalRoughSpheresNoTextures.glb", "CornellBox.glb",
          "AlphaBlendModeTest.glb", "NegativeScaleTest.glb", "InterpolationTest.glb", "skull.glb", "hammer.glb", "mountain.glb",
          "AnimatedMorphCube.glb", "RecursiveSkeletons.glb", None]  # None: the built-in school of fish
FORMS = [("before", ["--units", "m", "--tonemap", "none", "--exposure", "0"]), ("today", []), ("with --ground", ["--ground"])]
COMMON = ["--fstop", "1.4", "--size", "512x384", "--quiet"]
WIDTH, HEIGHT, GAP, LINE = 208, 156, 4, 20  # px on the sheet
COLUMNS = 2  # scenes side by side
FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"


def render(program, models, scene, options, folder):
    picture = pathlib.Path(folder) / "picture.png"
    named = [models / scene] if scene else []
    swims = scene is None and options == ["--ground"]
    run(program, "render", *named, "-o", picture, *COMMON, *([] if swims else options))
    with Image.open(picture) as image:
        return image.convert("RGB").resize((WIDTH, HEIGHT), Image.LANCZOS)


def sheet(picture_of):
    """Returns the contact sheet of all scenes. picture_of(scene, options) returns one picture."""
    rows = -(-len(SCENES) // COLUMNS)
    block = (WIDTH + GAP) * len(FORMS) + 3 * GAP
    image = Image.new("RGB", (COLUMNS * block - 2 * GAP, rows * (HEIGHT + LINE + GAP) + LINE), (250, 250, 250))
    pen, font = ImageDraw.Draw(image), ImageFont.truetype(FONT, 13)
    for index, scene in enumerate(SCENES):
        row, column = divmod(index, COLUMNS)
        y = LINE + row * (HEIGHT + LINE + GAP)
        name = pathlib.Path(scene).stem if scene else "the built-in school"
        pen.text((GAP + column * block, y + HEIGHT + 2), name, fill=(20, 20, 20), font=font)
        for place, (form, options) in enumerate(FORMS):
            x = column * block + place * (WIDTH + GAP)
            if row == 0:
                pen.text((GAP + x, 2), form, fill=(90, 90, 90), font=font)
            image.paste(picture_of(scene, options), (GAP + x, y))
    return image


def main(words):
    parser = parser_of("first-pictures", __doc__)
    parser.add_argument("models", type=path)
    add_program(parser)
    arguments = parser.parse_args(words)
    with tempfile.TemporaryDirectory() as folder:
        image = sheet(lambda scene, options: render(arguments.program, arguments.models, scene, options, folder))
    image.save(ROOT / "docs" / "first-pictures.jpg", quality=88)
