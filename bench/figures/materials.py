"""Draws docs/materials.jpg: Khronos' feature models, beside the pictures of their authors.

    scripts/figures materials MODELS [--program build/release/defocus]

MODELS is a folder with the models in SCENES (NAME.glb) and the picture of each (NAME.jpg or NAME.png). All models are drawn with the
defaults and without blur. Needs Pillow (Debian: python3-pil) and the font of fonts-dejavu-core.
"""

import pathlib
import tempfile

from PIL import Image, ImageDraw, ImageFont, ImageOps

from figures.command import ROOT, add_program, parser_of, path, run

SCENES = ["AnisotropyRotationTest", "AnisotropyStrengthTest", "IridescenceSuzanne", "SpecularTest", "ClearCoatTest", "ClearcoatWicker",
          "AttenuationTest", "TransmissionTest", "GlassHurricaneCandleHolder", "GlamVelvetSofa", "EmissiveStrengthTest",
          "NormalTangentTest"]
OPTIONS = ["--no-dof", "--samples", "64", "--size", "512x384", "--environment", "studio", "--quiet"]
WIDTH, HEIGHT, GAP, LINE = 208, 156, 4, 20  # px on the sheet
COLUMNS = 2  # models side by side
FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"
PAPER = (250, 250, 250)


def fitted(image):
    """Returns the image scaled to fit into a picture of the sheet."""
    return ImageOps.pad(image.convert("RGB"), (WIDTH, HEIGHT), Image.LANCZOS, PAPER)


def pictures(program, models, scene, folder):
    """Returns the picture of the program and that of the model's authors."""
    drawn = pathlib.Path(folder) / "picture.png"
    run(program, "render", models / f"{scene}.glb", "-o", drawn, *OPTIONS)
    theirs = next(models / f"{scene}{end}" for end in (".jpg", ".png") if (models / f"{scene}{end}").exists())
    result = []
    for file in (drawn, theirs):
        with Image.open(file) as image:
            result.append(fitted(image))
    return result


def sheet(pictures_of):
    """Returns the contact sheet of all models. pictures_of(scene) returns the two pictures of a model."""
    rows = -(-len(SCENES) // COLUMNS)
    block = (WIDTH + GAP) * 2 + 3 * GAP
    image = Image.new("RGB", (COLUMNS * block - 2 * GAP, rows * (HEIGHT + LINE + GAP) + LINE), PAPER)
    pen, font = ImageDraw.Draw(image), ImageFont.truetype(FONT, 13)
    for index, scene in enumerate(SCENES):
        row, column = divmod(index, COLUMNS)
        y = LINE + row * (HEIGHT + LINE + GAP)
        pen.text((GAP + column * block, y + HEIGHT + 2), scene, fill=(20, 20, 20), font=font)
        for place, (title, picture) in enumerate(zip(("defocus", "authors"), pictures_of(scene))):
            x = GAP + column * block + place * (WIDTH + GAP)
            if row == 0:
                pen.text((x, 2), title, fill=(90, 90, 90), font=font)
            image.paste(picture, (x, y))
    return image


def main(words):
    parser = parser_of("materials", __doc__)
    parser.add_argument("models", type=path)
    add_program(parser)
    arguments = parser.parse_args(words)
    with tempfile.TemporaryDirectory() as folder:
        image = sheet(lambda scene: pictures(arguments.program, arguments.models, scene, folder))
    image.save(ROOT / "docs" / "materials.jpg", quality=85)
