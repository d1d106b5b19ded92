"""Builds glTF documents and surfaces for the scripts in this folder. Needs only Python's standard library."""

import base64
import json
import math
import struct
import zlib

FLOAT, UBYTE, USHORT, UINT = 5126, 5121, 5123, 5125


class Document:
    """A glTF document under construction, with one binary buffer."""

    def __init__(self):
        self.json = {"asset": {"version": "2.0", "generator": "defocus make_meshes.py"}, "scene": 0,
                     "scenes": [{"nodes": []}], "nodes": [], "meshes": [], "materials": [], "accessors": [],
                     "bufferViews": [], "cameras": [], "images": [], "samplers": [], "textures": []}
        self.binary = bytearray()

    def accessor(self, rows, component, kind, target=None, normalized=False, bounds=False):
        code = {FLOAT: "f", UBYTE: "B", USHORT: "H", UINT: "I"}[component]
        values = [value for row in rows for value in row]
        data = struct.pack(f"<{len(values)}{code}", *values)
        view = {"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)}
        if target:  # only buffer views of vertices and indices have a target
            view["target"] = target
        self.json["bufferViews"].append(view)
        self.binary += data + b"\0" * (-len(data) % 4)
        accessor = {"bufferView": len(self.json["bufferViews"]) - 1, "componentType": component, "count": len(rows),
                    "type": kind}
        if normalized:
            accessor["normalized"] = True
        if bounds:
            accessor["min"] = [min(column) for column in zip(*rows)]
            accessor["max"] = [max(column) for column in zip(*rows)]
        self.json["accessors"].append(accessor)
        return len(self.json["accessors"]) - 1

    def material(self, name, **fields):
        self.json["materials"].append({"name": name, **fields})
        for extension in fields.get("extensions", {}):
            used = self.json.setdefault("extensionsUsed", [])
            if extension not in used:
                used.append(extension)
        return len(self.json["materials"]) - 1

    def attributes(self, surface):
        positions = [tuple(as_float32(round(value, 5)) for value in p) for p in surface.positions]
        attributes = {"POSITION": self.accessor(positions, FLOAT, "VEC3", 34962, bounds=True)}
        if surface.normals:
            attributes["NORMAL"] = self.accessor(unit_rows(surface.normals), FLOAT, "VEC3", 34962)
        if surface.colors:
            attributes["COLOR_0"] = self.accessor(surface.colors, UBYTE, "VEC4", 34962, normalized=True)
        if surface.coordinates:
            attributes["TEXCOORD_0"] = self.accessor([tuple(map(as_float32, uv)) for uv in surface.coordinates], FLOAT,
                                                     "VEC2", 34962)
        return attributes

    def indices(self, surface):
        component = USHORT if len(surface.positions) <= 1 << 16 else UINT
        return self.accessor([(index,) for index in surface.indices], component, "SCALAR", 34963)

    def mesh(self, name, surface, material):
        return self.mesh_of(name, {"attributes": self.attributes(surface), "indices": self.indices(surface),
                                   "material": material})

    def mesh_of(self, name, primitive, **fields):
        self.json["meshes"].append({"name": name, "primitives": [primitive], **fields})
        return len(self.json["meshes"]) - 1

    def checks(self, light, dark):
        """Adds a repeating 2 x 2 checker texture without filtering for magnification. light, dark: sRGB bytes."""
        rows = b"".join(b"\0" + bytes(first) + bytes(second) for first, second in ((light, dark), (dark, light)))
        self.json["samplers"].append({"magFilter": 9728, "minFilter": 9987, "wrapS": 10497, "wrapT": 10497})
        return self.texture(png(2, 2, rows), sampler=0)

    def texture(self, image, **fields):
        """Adds a texture with a PNG image and returns its index."""
        self.json["bufferViews"].append({"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(image)})
        self.binary += image + b"\0" * (-len(image) % 4)
        self.json["images"].append({"mimeType": "image/png", "bufferView": len(self.json["bufferViews"]) - 1})
        self.json["textures"].append({"source": len(self.json["images"]) - 1, **fields})
        return len(self.json["textures"]) - 1

    def slide(self, name, moves):
        """Adds an animation of 1 s that moves nodes at constant speed. moves: {node: (x, y, z)}, distances in m."""
        times = self.accessor([(0.0,), (1.0,)], FLOAT, "SCALAR", bounds=True)
        samplers, channels = [], []
        for node, move in moves.items():
            begin = self.json["nodes"][node]["translation"]
            ends = [tuple(as_float32(b + share * m) for b, m in zip(begin, move)) for share in (0, 1)]
            samplers.append({"input": times, "output": self.accessor(ends, FLOAT, "VEC3")})
            channels.append({"sampler": len(samplers) - 1, "target": {"node": node, "path": "translation"}})
        self.json.setdefault("animations", []).append({"name": name, "samplers": samplers, "channels": channels})

    def node(self, name, parent=None, **fields):
        self.json["nodes"].append({"name": name, **fields})
        number = len(self.json["nodes"]) - 1
        siblings = self.json["scenes"][0]["nodes"] if parent is None else (
            self.json["nodes"][parent].setdefault("children", []))
        siblings.append(number)
        return number

    def camera(self, yfov, aspect, lens, **placement):
        """Adds a camera. lens: extras of the camera, which are fStop, focusDistance (m) and horizontalAperture (mm)."""
        self.json["cameras"].append({"name": "Camera", "type": "perspective", "extras": lens,
                                     "perspective": {"yfov": round(yfov, 7), "aspectRatio": aspect, "znear": 0.01}})
        self.node("Camera", camera=len(self.json["cameras"]) - 1, **placement)

    def sun(self, color, lux, rotation):
        lights = self.json.setdefault("extensions", {}).setdefault("KHR_lights_punctual", {"lights": []})["lights"]
        lights.append({"name": "Sun", "type": "directional", "color": color, "intensity": lux})
        used = self.json.setdefault("extensionsUsed", [])
        if "KHR_lights_punctual" not in used:
            used.append("KHR_lights_punctual")
        self.node("Sun", rotation=rotation, extensions={"KHR_lights_punctual": {"light": len(lights) - 1}})

    def finished(self):
        return {key: value for key, value in self.json.items() if value != []}

    def gltf(self):
        document = self.finished()
        uri = "data:application/octet-stream;base64," + base64.b64encode(self.binary).decode()
        document["buffers"] = [{"byteLength": len(self.binary), "uri": uri}]
        return (json.dumps(document, indent=1) + "\n").encode()

    def glb(self):
        document = self.finished()
        document["buffers"] = [{"byteLength": len(self.binary)}]
        text = json.dumps(document, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        total = 12 + 8 + len(text) + 8 + len(self.binary)
        return (struct.pack("<4sII", b"glTF", 2, total) + struct.pack("<I4s", len(text), b"JSON") + text +
                struct.pack("<I4s", len(self.binary), b"BIN\0") + bytes(self.binary))


def png(width, height, rows, palette=b""):
    """Returns a PNG with 8 bits per channel: RGB, or palette indices.

    rows: bytes of all rows, each preceded by its filter byte. palette: RGB bytes of the colours, if any.
    The PNG is not compressed, so that its bytes don't depend on the version of zlib.
    """
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    blocks = [rows[i:i + 0xffff] for i in range(0, len(rows), 0xffff)]
    stream = b"\x78\x01" + b"".join(
        struct.pack("<BHH", i + 1 == len(blocks), len(block), len(block) ^ 0xffff) + block
        for i, block in enumerate(blocks)) + struct.pack(">I", zlib.adler32(rows))
    return (b"\x89PNG\r\n\x1a\n" +
            chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 3 if palette else 2, 0, 0, 0)) +
            (chunk(b"PLTE", palette) if palette else b"") + chunk(b"IDAT", stream) + chunk(b"IEND", b""))


class Surface:
    def __init__(self):
        self.positions, self.normals, self.colors, self.coordinates, self.indices = [], [], [], [], []

    def quad(self, corners, normal=None, color=None):
        """Adds a quad. corners: four positions, counter-clockwise seen from the front."""
        first = len(self.positions)
        self.positions += corners
        self.normals += [normal] * 4 if normal else []
        self.colors += [color] * 4 if color else []
        self.indices += [first, first + 1, first + 2, first, first + 2, first + 3]


def as_float32(value):
    return struct.unpack("<f", struct.pack("<f", value))[0]


def linear(red, green, blue):
    """Converts sRGB bytes to linear RGBA bytes, the encoding of COLOR_0."""
    def decoded(byte):
        value = byte / 255
        return value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4
    return tuple(round(255 * decoded(byte)) for byte in (red, green, blue)) + (255,)


def unit_rows(rows):
    result = []
    for row in rows:
        length = math.sqrt(sum(value * value for value in row)) or 1.0
        result.append(tuple(round(value / length, 6) for value in row))
    return result


def quaternion(axis, degrees):
    half = math.radians(degrees) / 2
    return [round(value * math.sin(half), 7) for value in axis] + [round(math.cos(half), 7)]


def smooth_normals(surface):
    normals = [[0.0, 0.0, 0.0] for _ in surface.positions]
    for i in range(0, len(surface.indices), 3):
        corners = surface.indices[i:i + 3]
        p, q, r = (surface.positions[k] for k in corners)
        u, v = [b - a for a, b in zip(p, q)], [b - a for a, b in zip(p, r)]
        normal = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        for k in corners:
            for axis in range(3):
                normals[k][axis] += normal[axis]
    return normals


def add_tube(surface, rings, color):
    """Adds a closed tube. rings: lists of points from head to tail; the first and the last ring are a single point.

    Faces point outwards if the points of each ring run counter-clockwise, seen from the head.
    """
    first = len(surface.positions)
    around = len(rings[1])
    surface.positions.append(rings[0][0])
    for ring in rings[1:-1]:
        surface.positions += ring
    surface.positions.append(rings[-1][0])
    last = len(surface.positions) - 1
    surface.colors += [color(p) for p in surface.positions[first:]]
    rows = len(rings) - 2
    for i in range(around):
        j = (i + 1) % around
        surface.indices += [first, first + 1 + i, first + 1 + j]
        for row in range(rows - 1):
            a, b = first + 1 + row * around, first + 1 + (row + 1) * around
            surface.indices += [a + i, b + i, a + j, a + j, b + i, b + j]
        end = first + 1 + (rows - 1) * around
        surface.indices += [end + i, last, end + j]
