"""Reads and writes binary glTF files (.glb)."""

import json
import struct


def read_glb(data):
    """Returns the document of a .glb file, and the bytes of the chunks after it."""
    end = 20 + struct.unpack_from("<I", data, 12)[0]
    return json.loads(data[20:end]), data[end:]


def glb(document, chunks):
    """Returns the bytes of a .glb file. chunks: bytes of the chunks after the document."""
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    return struct.pack("<4sIII4s", b"glTF", 2, 20 + len(text) + len(chunks), len(text), b"JSON") + text + chunks
