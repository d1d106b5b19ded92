"""Draws docs/materials.jpg: Khronos' feature models, beside the pictures by their authors.

    scripts/figures materials MODELS [--program build/release/defocus]

MODELS is a folder with the models in SCENES (NAME.glb) and the picture of each (NAME.jpg or NAME.png). All models are drawn with the
defaults and without blur. Needs Pillow (Debian: python3-pil) and the font of fonts-dejavu-core.
"""

import pathlib
import tempfile

from PIL import Image, ImageOps

from figures.command import ROOT, add_program, parser_of, path, run
from figures.contact_sheet import HEIGHT, PAPER, WIDTH, contact_sheet

SCENES = ["AnisotropyRotationTest", "AnisotropyStrengthTest", "IridescenceSuzanne", "SpecularTest", "ClearCoatTest", "ClearcoatWicker",
          "AttenuationTest", "TransmissionTest", "GlassHurricaneCandleHolder", "GlamVelvetSofa", "EmissiveStrengthTest",
          "NormalTangentTest"]
OPTIONS = ["--no-dof", "--samples", "64", "--size", "512x384", "--environment", "studio", "--quiet"]


def fitted(image):
    """Returns the image, scaled to the size of a picture on the contact sheet."""
    return ImageOps.pad(image.convert("RGB"), (WIDTH, HEIGHT), Image.LANCZOS, PAPER)


def pictures(program, models, scene, folder):
    """Returns the picture that the program renders, and the picture by the model's authors."""
    drawn = pathlib.Path(folder) / "picture.png"
    run(program, "render", models / f"{scene}.glb", "-o", drawn, *OPTIONS)
    theirs = next(models / f"{scene}{end}" for end in (".jpg", ".png") if (models / f"{scene}{end}").exists())
    result = []
    for file in (drawn, theirs):
        with Image.open(file) as image:
            result.append(fitted(image))
    return result


def main(words):
    parser = parser_of("materials", __doc__)
    parser.add_argument("models", type=path)
    add_program(parser)
    arguments = parser.parse_args(words)
    with tempfile.TemporaryDirectory() as folder:
        image = contact_sheet(("defocus", "authors"), SCENES,
                              lambda index: pictures(arguments.program, arguments.models, SCENES[index], folder))
    image.save(ROOT / "docs" / "materials.jpg", quality=85)
