"""Draws the figures of docs/concepts.md as SVG files under docs/concepts.

    scripts/figures concepts [--program build/release/defocus]

The levels are exported by `defocus pyramid`. The other figures are computed from the formulas on that page.
"""

import math
import pathlib
import struct
import tempfile

from figures.command import ROOT, add_program, parser_of, run
from figures.files import write_file
from figures.glb import read_glb

FOLDER = ROOT / "docs" / "concepts"
INK, GREY, BLUE, ORANGE, GREEN = "#333333", "#9a9a9a", "#0063a8", "#c24e00", "#00805c"  # palette after Okabe and Ito
CELL_COLOURS = ("#0063a8", "#f0a070", "#35b089", "#c070a0")
FOCUS = 2.0  # focus distance, m


class Drawing:
    """Draws shapes and texts into an SVG figure; its width and height are in pixels."""

    def __init__(self, width, height, title):
        self.head = (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" '
                     f'role="img" font-family="sans-serif" font-size="13">\n<title>{title}</title>\n'
                     f'<rect width="{width}" height="{height}" fill="white"/>\n')
        self.parts = []

    def paths(self, paths, colour=INK, width=1.2, dash="", end=""):
        """Draws lines through points. end: "Z" closes each line."""
        steps = "".join(f"M{'L'.join(f'{x:.1f} {y:.1f}' for x, y in points)}{end}" for points in paths)
        dashes = f' stroke-dasharray="{dash}"' if dash else ""
        self.parts.append(f'<path d="{steps}" stroke="{colour}" stroke-width="{width}" fill="none"{dashes}/>')

    def line(self, start, end, *style):
        self.paths([(start, end)], *style)

    def dot(self, centre, radius=4.0, colour=INK, outline="none", opacity=1):
        self.parts.append(f'<circle cx="{centre[0]:.1f}" cy="{centre[1]:.1f}" r="{radius:.1f}" fill="{colour}" '
                          f'stroke="{outline}" fill-opacity="{opacity}"/>')

    def box(self, corner, size, colour):
        self.parts.append(f'<rect x="{corner[0]}" y="{corner[1]}" width="{size[0]}" height="{size[1]}" fill="{colour}"/>')

    def text(self, place, words, anchor="start", colour=INK):
        self.parts.append(f'<text x="{place[0]:.1f}" y="{place[1]:.1f}" text-anchor="{anchor}" fill="{colour}">{words}</text>')

    def save(self, name):
        write_file(FOLDER / name, self.head + "\n".join(self.parts) + "\n</svg>\n")
        print(FOLDER / name)


def radical_inverse(base, index):
    value, scale = 0.0, 1 / base
    while index:
        value += scale * (index % base)
        index //= base
        scale /= base
    return value


def disk_points(count):
    """Returns `count` points of the Halton sequence, from index 1 on, mapped to the unit disk."""
    points = []
    for index in range(1, count + 1):
        radius, angle = math.sqrt(radical_inverse(2, index)), 2 * math.pi * radical_inverse(3, index)
        points.append((radius * math.cos(angle), radius * math.sin(angle)))
    return points


def draw_lens_sample():
    """Draws a side view: three lens samples see a far and a near point at different positions on the focus plane."""
    drawing = Drawing(720, 300, "Rays from three lens samples to two points cross the focus plane at different positions")
    lens, plane, axis, half = 70, 380, 150, 75
    far, near = (660, axis - 40), (250, axis + 25)
    drawing.line((30, axis), (700, axis), GREY, 0.8, "4 4")
    drawing.line((lens, axis - half), (lens, axis + half), INK, 5)
    drawing.line((plane, 30), (plane, 270), GREEN, 2)
    for share, colour in ((1, BLUE), (0, INK), (-1, ORANGE)):
        start = (lens, axis - share * half)
        drawing.dot(start, 5, colour)
        for point in (far, near):
            end = max(point[0], plane)
            slope = (point[1] - start[1]) / (point[0] - start[0])
            drawing.line(start, (end, start[1] + slope * (end - lens)), colour, 1)
            drawing.dot((plane, start[1] + slope * (plane - lens)), 3.5, colour)
    drawing.dot(far, 6)
    drawing.dot(near, 6)
    drawing.text((lens, 285), "lens", "middle")
    drawing.text((plane, 290), "focus plane", "middle", GREEN)
    drawing.text((far[0], far[1] - 14), "far point", "middle")
    drawing.text((near[0], near[1] + 24), "near point", "middle")
    drawing.save("lens-sample.svg")


def draw_circle_of_confusion():
    """Draws the blur diameter over depth for a 50 mm f/2 lens, 36 mm sensor, 1024 px; below, the blur disks."""
    drawing = Drawing(720, 330, "Diameter of the circle of confusion over depth")
    left, right, top, bottom, first, last, most = 60, 690, 20, 220, 0.8, 8.0, 30.0
    # A · W / (2 tan(θx/2)) with aperture A = 0.050/2 m, image width W = 1024 px, field of view θx, tan(θx/2) = 18/50.
    scale = 0.050 / 2 * 1024 / 0.72

    def diameter(depth):
        return scale * abs(1 / FOCUS - 1 / depth)

    def place(depth, value):
        return left + (right - left) * (depth - first) / (last - first), bottom - (bottom - top) * value / most
    for value in range(0, 31, 10):
        drawing.line(place(first, value), place(last, value), "#dddddd", 1)
        drawing.text((left - 8, place(first, value)[1] + 4), str(value), "end")
    drawing.text((left + 8, top + 2), "CoC, px")
    drawing.line(place(FOCUS, 0), place(FOCUS, most), GREEN, 1.5, "4 4")
    drawing.text((place(FOCUS, 0)[0] + 8, top + 14), "focus distance, 2 m", "start", GREEN)
    for colour, begin, end in ((ORANGE, first, FOCUS), (BLUE, FOCUS, last)):
        depths = [begin + (end - begin) * step / 80 for step in range(81)]
        drawing.paths([[place(depth, diameter(depth)) for depth in depths]], colour, 2.2)
    drawing.line(place(first, scale / FOCUS), place(last, scale / FOCUS), GREY, 1, "2 4")
    drawing.text((right, place(last, scale / FOCUS)[1] - 6), "at infinity", "end", GREY)
    for depth in (1, 2, 3, 4, 5, 6, 7, 8):
        x = place(depth, 0)[0]
        drawing.dot((x, 265), max(diameter(depth), 1), ORANGE if depth < FOCUS else BLUE, opacity=0.5)
        drawing.text((x, 240), f"{depth} m", "middle")
    drawing.text(((left + right) / 2, 318), "image of a point at each depth, drawn at twice its size", "middle", GREY)
    drawing.save("circle-of-confusion.svg")


def triangles_of(data):
    """Returns the triangles of a GLB file with a single buffer, each as its three vertex positions."""
    document, chunks = read_glb(data)

    def values(index, code, size, count):
        accessor = document["accessors"][index]
        view = document["bufferViews"][accessor["bufferView"]]
        start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        stride = view.get("byteStride", size * count)
        return [struct.unpack_from(f"<{count}{code}", chunks, 8 + start + stride * i) for i in range(accessor["count"])]
    triangles = []
    for mesh in document["meshes"]:
        for primitive in mesh["primitives"]:
            positions = values(primitive["attributes"]["POSITION"], "f", 4, 3)
            code, size = {5121: ("B", 1), 5123: ("H", 2), 5125: ("I", 4)}[document["accessors"][primitive["indices"]]["componentType"]]
            indices = [positions[index] for index, in values(primitive["indices"], code, size, 1)]
            triangles += [indices[i:i + 3] for i in range(0, len(indices), 3)]
    return triangles


def draw_pyramid(program):
    """Draws every second level of a fish's pyramid as a wireframe, seen from the side."""
    with tempfile.TemporaryDirectory() as folder:
        run(program, "pyramid", "--fish", 1, "--fish-triangles", 1600, "--no-measure", "--export", folder)
        files = sorted(pathlib.Path(folder).glob("*-level-*.glb"))
        levels = [(level, triangles_of(file.read_bytes())) for level, file in enumerate(files)]
    drawing = Drawing(720, 240, "Levels 0, 2 and 4 of a fish")
    corners = [corner for triangle in levels[0][1] for corner in triangle]
    low, high = ([pick(corner[axis] for corner in corners) for axis in range(3)] for pick in (min, max))
    wide, tall = sorted(range(3), key=lambda axis: high[axis] - low[axis])[:0:-1]
    if wide == 1:
        wide, tall = tall, wide
    scale = min(210 / (high[wide] - low[wide]), 180 / (high[tall] - low[tall]))
    for column, (level, triangles) in enumerate(levels[:5:2]):
        middle = 120 + 240 * column
        drawing.paths([[(middle + scale * (corner[wide] - (low[wide] + high[wide]) / 2),
                         105 - scale * (corner[tall] - (low[tall] + high[tall]) / 2)) for corner in triangle]
                       for triangle in triangles], BLUE, 0.4, end="Z")
        drawing.text((middle, 228), f"level {level}: {len(triangles):,} triangles", "middle")
    drawing.save("pyramid.svg")


def draw_sample_split():
    """Shows which of 16 lens samples draw which level, for nine fractional levels λ from 1 to 2."""
    drawing = Drawing(720, 290, "Levels that 16 samples draw while λ goes from 1 to 2")
    count, side = 16, 22
    drawing.text((60, 22), "lens sample 0 … 15")
    drawing.text((50, 22), "λ", "end")
    for row in range(9):
        fraction = row / 8
        coarse = round(fraction * count)
        drawing.text((50, 50 + 25 * row), f"{1 + fraction:g}", "end")
        for sample in range(count):
            drawing.box((60 + (side + 2) * sample, 34 + 25 * row), (side, 21), ORANGE if sample < coarse else BLUE)
    centre, radius = (580, 130), 96
    drawing.dot(centre, radius, "#f4f4f4", GREY)
    for sample, (x, y) in enumerate(disk_points(count)):
        drawing.dot((centre[0] + radius * x, centre[1] - radius * y), 5, ORANGE if sample < 4 else BLUE)
    drawing.text((580, 22), "the lens at λ = 1.25", "middle")
    drawing.box((490, 248), (14, 14), BLUE)
    drawing.text((510, 260), "level 1")
    drawing.box((590, 248), (14, 14), ORANGE)
    drawing.text((610, 260), "level 2 (coarser)")
    drawing.save("sample-split.svg")


def halved(points, count):
    """Divides points into equal groups by repeated halving across the longer side. count: number of groups, 2^n."""
    if count == 1:
        return [points]
    spans = [max(point[axis] for point in points) - min(point[axis] for point in points) for axis in (0, 1)]
    points = sorted(points, key=lambda point: point[spans.index(max(spans))])
    middle = len(points) // 2
    return halved(points[:middle], count // 2) + halved(points[middle:], count // 2)


def draw_lens_cells():
    """Draws 16 lens samples as points (left), and 16 lens cells of 32 points each, marked with the points' means (right)."""
    drawing = Drawing(720, 300, "Sixteen lens samples as points, and as cells with their means")
    radius = 125
    left, right = (180, 140), (540, 140)
    for centre in (left, right):
        drawing.dot(centre, radius, "#f4f4f4", GREY)
    for x, y in disk_points(16):
        drawing.dot((left[0] + radius * x, left[1] - radius * y), 4)
    for index, cell in enumerate(halved(disk_points(512), 16)):
        colour = CELL_COLOURS[(index + index // 4) % 4]
        for x, y in cell:
            drawing.dot((right[0] + radius * x, right[1] - radius * y), 3, colour)
        x, y = (sum(point[axis] for point in cell) / len(cell) for axis in (0, 1))
        drawing.dot((right[0] + radius * x, right[1] - radius * y), 5, "black", "white")
    drawing.text((left[0], 290), "16 samples as points", "middle")
    drawing.text((right[0], 290), "16 samples as cells", "middle")
    drawing.save("lens-cells.svg")


def main(words):
    parser = parser_of("concepts", __doc__)
    add_program(parser)
    arguments = parser.parse_args(words)
    FOLDER.mkdir(exist_ok=True)
    draw_lens_sample()
    draw_circle_of_confusion()
    draw_pyramid(arguments.program)
    draw_sample_split()
    draw_lens_cells()
