"""Draws docs/first-pictures.jpg: eighteen scenes as a new user sees them.

    scripts/figures first-pictures MODELS [--program build/release/defocus]

MODELS is a folder with the glTF files in SCENES; the school of fish is built in. Each scene has three pictures: with
lengths taken as metres, without tone map and metering; with the defaults; with --ground. Held equal: scene, camera,
f-number, image size.
Needs Pillow (Debian: python3-pil) and the font of fonts-dejavu-core.
"""

import pathlib

from PIL import Image

from figures.command import run
from figures.contact_sheet import HEIGHT, WIDTH, draw_models

SCENES = ["FlightHelmet/FlightHelmet.gltf", "Fox.glb", "Suzanne.glb", "WaterBottle.glb", "bike.glb",
          "japanese-bridge-garden-meshopt.glb", "GlassVaseFlowers.glb", "MetalRoughSpheresNoTextures.glb", "CornellBox.glb",
          "AlphaBlendModeTest.glb", "NegativeScaleTest.glb", "InterpolationTest.glb", "skull.glb", "hammer.glb", "mountain.glb",
          "AnimatedMorphCube.glb", "RecursiveSkeletons.glb", None]  # None stands for the built-in school of fish
FORMS = [("plain", ["--units", "m", "--tonemap", "none", "--exposure", "0"]), ("defaults", []), ("with --ground", ["--ground"])]
COMMON = ["--fstop", "1.4", "--size", "512x384", "--quiet"]


def pictures(program, models, index, folder):
    """Returns the images of a scene, in the order of FORMS."""
    named = [models / SCENES[index]] if SCENES[index] else []
    result = []
    for _, options in FORMS:
        options = options if named or options != ["--ground"] else []  # the school of fish is drawn without a ground
        run(program, "render", *named, "-o", folder / "picture.png", *COMMON, *options)
        with Image.open(folder / "picture.png") as image:
            result.append(image.convert("RGB").resize((WIDTH, HEIGHT), Image.LANCZOS))
    return result


def main(words):
    draw_models(words, "first-pictures", __doc__, "first-pictures.jpg", [form for form, _ in FORMS],
                [pathlib.Path(scene).stem if scene else "the built-in school" for scene in SCENES], pictures, 88)
