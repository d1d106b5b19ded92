"""Draws contact sheets: for each scene its name and several images side by side. Needs Pillow and fonts-dejavu-core."""

import pathlib
import tempfile

from PIL import Image, ImageDraw, ImageFont

from figures.command import ROOT, add_program, parser_of, path

WIDTH, HEIGHT, GAP, LINE = 208, 156, 4, 20  # px: image width, image height, gap, line height
FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"
PAPER = (250, 250, 250)


def contact_sheet(titles, names, pictures_of, columns=2):
    """Returns the contact sheet. titles: one per image of a scene; pictures_of(index): images of the scene
    names[index]; columns: number of scenes side by side."""
    rows = -(-len(names) // columns)
    block = (WIDTH + GAP) * len(titles) + 3 * GAP
    image = Image.new("RGB", (columns * block - 2 * GAP, rows * (HEIGHT + LINE + GAP) + LINE), PAPER)
    pen, font = ImageDraw.Draw(image), ImageFont.truetype(FONT, 13)
    for index, name in enumerate(names):
        row, column = divmod(index, columns)
        y = LINE + row * (HEIGHT + LINE + GAP)
        pen.text((GAP + column * block, y + HEIGHT + 2), name, fill=(20, 20, 20), font=font)
        for place, (title, picture) in enumerate(zip(titles, pictures_of(index))):
            x = GAP + column * block + place * (WIDTH + GAP)
            if row == 0:
                pen.text((x, 2), title, fill=(90, 90, 90), font=font)
            image.paste(picture, (x, y))
    return image


def draw_models(words, name, text, file, titles, names, pictures_of, quality):
    """Runs `scripts/figures NAME MODELS`, which draws a contact sheet of models to a file in docs.

    text: the parser's description. pictures_of(program, models, index, folder): returns the images of names[index], and
    may write to the folder.
    """
    parser = parser_of(name, text)
    parser.add_argument("models", type=path)
    add_program(parser)
    arguments = parser.parse_args(words)
    with tempfile.TemporaryDirectory() as folder:
        image = contact_sheet(titles, names, lambda index: pictures_of(arguments.program, arguments.models, index, pathlib.Path(folder)))
    image.save(ROOT / "docs" / file, quality=quality)
