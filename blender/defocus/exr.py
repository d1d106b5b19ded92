"""Reads EXR files that `defocus` writes: a single part of scan lines, uncompressed or ZIP-compressed.

Blender's Python has no reader for channels of a multi-layer file. Format: OpenEXR File Layout, openexr.com.
"""

import math
import struct
import zlib

import numpy

from .failure import Failure

TYPES = {0: numpy.dtype("<u4"), 1: numpy.dtype("<f2"), 2: numpy.dtype("<f4")}
LINES = {0: 1, 2: 1, 3: 16}  # compression (none, ZIPS, ZIP) → scan lines per block


def text_at(data, place):
    """Returns the zero-terminated text at the offset `place`, and the offset after its zero byte."""
    end = data.index(b"\0", place)
    return data[place:end].decode(), end + 1


def read_header(data):
    """Returns the attributes of an EXR file's header (name → bytes), and the offset after the header."""
    if data[:4] != b"\x76\x2f\x31\x01":
        raise Failure("the image is not an EXR file")
    attributes, place = {}, 8
    while data[place]:
        name, place = text_at(data, place)
        _, place = text_at(data, place)
        size, = struct.unpack_from("<i", data, place)
        attributes[name] = data[place + 4:place + 4 + size]
        place += 4 + size
    return attributes, place + 1


def channels_of(attribute):
    """Returns (name, type) of each channel, in the order in which the file stores the channels."""
    channels, place = [], 0
    while attribute[place]:
        name, place = text_at(attribute, place)
        channels.append((name, TYPES[struct.unpack_from("<i", attribute, place)[0]]))
        place += 16
    return channels


def unpacked(block, size):
    """Decompresses a ZIP block, which stores the differences between bytes, with all even bytes before the odd ones."""
    if len(block) == size:
        return block
    steps = numpy.frombuffer(zlib.decompress(block), numpy.uint8).astype(numpy.int64)
    steps[1:] -= 128
    halves = numpy.cumsum(steps).astype(numpy.uint8)
    result = numpy.empty(size, numpy.uint8)
    result[0::2], result[1::2] = halves[:(size + 1) // 2], halves[(size + 1) // 2:]
    return result.tobytes()


def read(file):
    """Returns the channels (name → height × width floats, row 0 at the bottom) and the text attributes."""
    try:
        with open(file, "rb") as opened:
            data = opened.read()
    except OSError as error:
        raise Failure(f"defocus wrote no image that can be read: {error.strerror}") from error
    try:
        return read_data(data)
    except (IndexError, KeyError, ValueError, struct.error, zlib.error) as error:
        raise Failure("the image is damaged") from error


def read_data(data):
    attributes, place = read_header(data)
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    channels = channels_of(attributes["channels"])
    lines = LINES[attributes["compression"][0]]
    row = sum(kind.itemsize for _, kind in channels) * width
    pixels = {name: numpy.empty((height, width), numpy.float32) for name, _ in channels}
    for offset in struct.unpack_from(f"<{math.ceil(height / lines)}Q", data, place):
        y, size = struct.unpack_from("<2i", data, offset)
        count = min(lines, bottom - y + 1)
        block, at = unpacked(data[offset + 8:offset + 8 + size], row * count), 0
        for line in range(y - top, y - top + count):
            for name, kind in channels:
                pixels[name][height - 1 - line] = numpy.frombuffer(block, kind, width, at)
                at += kind.itemsize * width
    texts = {name: value.decode() for name, value in attributes.items() if name.startswith("cryptomatte/")}
    return pixels, texts
