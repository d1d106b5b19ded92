"""Renders and measures images in Blender. Images are arrays of height × width × 4; row 0 is the bottom row."""

import math
import pathlib
import sys
import tempfile

import bpy
import numpy

import scenes


def say(text):
    print(text, file=sys.stderr)


def save_png(file, *rows):
    """Writes images with values in [0, 1] side by side into a PNG file. rows: lists of images of equal size."""
    strip = numpy.concatenate([numpy.concatenate(row, axis=1) for row in rows[::-1]])
    strip = numpy.dstack([strip, numpy.ones(strip.shape[:2])]).astype(numpy.float32)
    image = bpy.data.images.new("strip", strip.shape[1], strip.shape[0])
    image.pixels.foreach_set(strip.ravel())
    image.filepath_raw, image.file_format = str(file), "PNG"
    image.save()
    bpy.data.images.remove(image)


def rendered(engine, scene):
    """Renders the scene with an engine. Returns linear, premultiplied colours."""
    scene.render.engine = engine
    scenes.show_for(engine)
    with tempfile.TemporaryDirectory(prefix="picture-") as folder:
        scene.render.filepath = str(pathlib.Path(folder) / "picture.exr")
        bpy.ops.render.render(write_still=True)
        return read(scene.render.filepath)


def read(file):
    image = bpy.data.images.load(str(file))
    try:
        image.colorspace_settings.name = "Non-Color"
        pixels = numpy.empty(image.size[0] * image.size[1] * image.channels, numpy.float32)
        image.pixels.foreach_get(pixels)
        return pixels.reshape(image.size[1], image.size[0], image.channels).astype(float)
    finally:
        bpy.data.images.remove(image)


def encoded(linear):
    clamped = numpy.clip(linear[..., :3], 0, 1)
    return numpy.where(clamped <= 0.0031308, 12.92 * clamped, 1.055 * clamped ** (1 / 2.4) - 0.055)


def psnr(first, second):
    """Returns the PSNR in dB of display-encoded values."""
    return -10 * math.log10(numpy.mean((encoded(first) - encoded(second)) ** 2))


def crossings(row, steepness=0.0, level=0.5):
    """Returns the positions in px where a mask row crosses `level` between pixels that differ by >= `steepness`."""
    steps = numpy.flatnonzero((row[:-1] < level) != (row[1:] < level))
    return [i + (level - row[i]) / (row[i + 1] - row[i]) for i in steps if abs(row[i + 1] - row[i]) >= steepness]


def silhouette_distance(first, second):
    """Returns the largest distance in px, along rows and columns, between the alpha outlines of two images."""
    largest, count = 0, 0
    for one, other in ((first[..., 3], second[..., 3]), (first[..., 3].T, second[..., 3].T)):
        for row, other_row in zip(one, other):
            others = crossings(other_row)
            for place in crossings(row, 0.6) if others else ():
                largest = max(largest, min(abs(place - near) for near in others))
                count += 1
    assert count > 50, f"only {count} steep edges"
    return largest


def disk(light):
    """Returns (centre, radius) of a disk in px. The radius r follows from the disk's variance along an axis, r²/4."""
    x, y = numpy.arange(light.shape[1]), numpy.arange(light.shape[0])
    across, up = light.sum(0) / light.sum(), light.sum(1) / light.sum()
    centre = across @ x, up @ y
    # The width of a pixel adds a variance of 1/12 px² along each axis.
    variance = across @ (x - centre[0]) ** 2 + up @ (y - centre[1]) ** 2 - 2 / 12
    return centre, math.sqrt(2 * variance)
