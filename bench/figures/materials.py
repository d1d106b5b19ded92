"""Draws docs/materials.jpg: Khronos' feature models, beside the images by their authors.

    scripts/figures materials MODELS [--program build/release/defocus]

MODELS is a folder with the models in SCENES (NAME.glb) and an image of each model by its authors (NAME.jpg or
NAME.png). All models are drawn with the defaults and without blur. Needs Pillow (Debian: python3-pil) and the font of
fonts-dejavu-core.
"""

from PIL import Image, ImageOps

from figures.command import run
from figures.contact_sheet import HEIGHT, PAPER, WIDTH, draw_models

SCENES = ["AnisotropyRotationTest", "AnisotropyStrengthTest", "IridescenceSuzanne", "SpecularTest", "ClearCoatTest", "ClearcoatWicker",
          "AttenuationTest", "TransmissionTest", "GlassHurricaneCandleHolder", "GlamVelvetSofa", "EmissiveStrengthTest",
          "NormalTangentTest"]
OPTIONS = ["--no-dof", "--samples", "64", "--size", "512x384", "--environment", "studio", "--quiet"]


def pictures(program, models, index, folder):
    """Returns the image that the program renders, and the image by the model's authors."""
    scene = models / f"{SCENES[index]}.glb"
    run(program, "render", scene, "-o", folder / "picture.png", *OPTIONS)
    theirs = next(file for file in (scene.with_suffix(".jpg"), scene.with_suffix(".png")) if file.exists())
    result = []
    for file in (folder / "picture.png", theirs):
        with Image.open(file) as image:
            result.append(ImageOps.pad(image.convert("RGB"), (WIDTH, HEIGHT), Image.LANCZOS, PAPER))
    return result


def main(words):
    draw_models(words, "materials", __doc__, "materials.jpg", ("defocus", "authors"), SCENES, pictures, 85)
