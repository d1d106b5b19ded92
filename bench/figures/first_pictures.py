"""Draws docs/first-pictures.jpg: eighteen scenes as a new user sees them.

    scripts/figures first-pictures MODELS [--program build/release/defocus]

MODELS is a folder with the glTF files in SCENES; the school of fish is built in. Each scene has three pictures: with
lengths taken as metres, without tone map and metering; with the defaults; with --ground. Held equal: scene, camera,
f-number, image size.
Needs Pillow (Debian: python3-pil) and the font of fonts-dejavu-core.
"""

import pathlib
import tempfile

from PIL import Image

from figures.command import ROOT, add_program, parser_of, path, run
from figures.contact_sheet import HEIGHT, WIDTH, contact_sheet

SCENES = ["FlightHelmet/FlightHelmet.gltf", "Fox.glb", "Suzanne.glb", "WaterBottle.glb", "bike.glb",
          "japanese-bridge-garden-meshopt.glb", "GlassVaseFlowers.glb", "MetalRoughSpheresNoTextures.glb", "CornellBox.glb",
          "AlphaBlendModeTest.glb", "NegativeScaleTest.glb", "InterpolationTest.glb", "skull.glb", "hammer.glb", "mountain.glb",
          "AnimatedMorphCube.glb", "RecursiveSkeletons.glb", None]  # None stands for the built-in school of fish
FORMS = [("before", ["--units", "m", "--tonemap", "none", "--exposure", "0"]), ("today", []), ("with --ground", ["--ground"])]
COMMON = ["--fstop", "1.4", "--size", "512x384", "--quiet"]


def render(program, models, scene, options, folder):
    picture = pathlib.Path(folder) / "picture.png"
    named = [models / scene] if scene else []
    swims = scene is None and options == ["--ground"]
    run(program, "render", *named, "-o", picture, *COMMON, *([] if swims else options))
    with Image.open(picture) as image:
        return image.convert("RGB").resize((WIDTH, HEIGHT), Image.LANCZOS)


def main(words):
    parser = parser_of("first-pictures", __doc__)
    parser.add_argument("models", type=path)
    add_program(parser)
    arguments = parser.parse_args(words)
    with tempfile.TemporaryDirectory() as folder:
        image = contact_sheet(
            [form for form, _ in FORMS], [pathlib.Path(scene).stem if scene else "the built-in school" for scene in SCENES],
            lambda index: [render(arguments.program, arguments.models, SCENES[index], options, folder) for _, options in FORMS])
    image.save(ROOT / "docs" / "first-pictures.jpg", quality=88)
