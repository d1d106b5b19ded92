"""Draws contact sheets: for each scene its name and several pictures side by side. Needs Pillow and fonts-dejavu-core."""

from PIL import Image, ImageDraw, ImageFont

WIDTH, HEIGHT, GAP, LINE = 208, 156, 4, 20  # px: image width, image height, gap, line height
FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"
PAPER = (250, 250, 250)


def contact_sheet(titles, names, pictures_of, columns=2):
    """Returns the contact sheet. titles: one per picture of a scene; pictures_of(index): pictures of the scene
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
