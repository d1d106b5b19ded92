"""Makes orrery.glb: a brass model of the planets on a wooden table, with strings of lamps behind it.

In the animation "Run" of five seconds, six painted planets and their wheels turn about the sun.
"""

import math

from gltf_document import FLOAT, Document, Surface, as_float32, png, quaternion

SECONDS = 5.0
KEYS = 8  # key frames per second
TURN = 2 * math.pi

# Columns: name, radius (m), distance from the sun (m), height (m), angle about the sun at the start (degrees), rotation
# about the sun during the animation (degrees), number of turns about the planet's own axis.
PLANETS = [
    ("Mercury", 0.006, 0.042, 0.100, 200, 330, 2),
    ("Venus", 0.010, 0.067, 0.094, 330, 190, 1),
    ("Earth", 0.011, 0.098, 0.087, 188, 112, 5),
    ("Mars", 0.008, 0.128, 0.080, 30, 66, 4),
    ("Jupiter", 0.024, 0.172, 0.072, 226, 34, 4),
    ("Saturn", 0.019, 0.226, 0.064, 46, 24, 3),
]


# ---- textures -------------------------------------------------------------------------------------------------------


def chance(*numbers):
    """Returns a pseudo-random number from 0 to 1 that depends only on the given integers."""
    value = 0x9e3779b9
    for number in numbers:
        value = ((value ^ (number & 0xffffffff)) * 0x85ebca6b) & 0xffffffff
        value ^= value >> 13
    return ((value * 0xc2b2ae35) & 0xffffffff) / 0xffffffff


def noise(x, y, columns, seed):
    """Returns value noise from 0 to 1, interpolated between integer grid points; it repeats in x after `columns`."""
    i, j = math.floor(x), math.floor(y)
    u, v = (t * t * (3 - 2 * t) for t in (x - i, y - j))
    a, b, c, d = (chance((i + k) % columns, j + m, seed) for m in (0, 1) for k in (0, 1))
    return a + (b - a) * u + (c - a + (a - b - c + d) * u) * v


def clouds(x, y, columns, seed, octaves=4):
    """Returns fractal noise from 0 to 1: a sum of octaves of noise()."""
    total = sum(noise(x * 2 ** k, y * 2 ** k, columns * 2 ** k, seed + k) / 2 ** k for k in range(octaves))
    return total / (2 - 2 / 2 ** octaves)


def gradient(stops, at):
    """Returns the sRGB bytes of a gradient at `at`, from 0 to 1. stops: list of (position, colour)."""
    for (a, first), (b, second) in zip(stops, stops[1:]):
        if at <= b:
            share = max(0.0, (at - a) / (b - a))
            return tuple(round(p + (q - p) * share) for p, q in zip(first, second))
    return stops[-1][1]


def painting(width, height, value, stops):
    """Returns a PNG that shows value(column, row), from 0 to 1, in the colours of a gradient of 256 steps."""
    rows = b"".join(b"\0" + bytes(min(255, max(0, round(255 * value(x, y)))) for x in range(width))
                    for y in range(height))
    return png(width, height, rows, b"".join(bytes(gradient(stops, i / 255)) for i in range(256)))


def continents(x, y):
    land = clouds(x / 28, y / 28, 9, 3, 5)
    pole = abs(y - 63.5) / 63.5
    if pole + 0.12 * (clouds(x / 14, y / 14, 18, 9) - 0.5) > 0.88:
        return 1.0
    if clouds(x / 20, y / 9, 13, 21, 4) > 0.62:
        return 0.99
    return 0.1 + 0.35 * land if land < 0.52 else 0.55 + 0.9 * (land - 0.52)


def bands(x, y):
    sway = 5 * (clouds(x / 21, y / 8, 12, 5) - 0.5)
    at = (y + sway) / 128
    spot = ((x - 60) / 15) ** 2 + ((y - 82) / 7) ** 2
    stripes = 0.5 + 0.5 * math.sin(44 * at + 2.2 * math.sin(9 * at))
    return 0.9 if spot < 1 else 0.08 + 0.55 * stripes + 0.2 * clouds(x / 42, y / 3, 6, 13)


def cratered(seed):
    """Returns a function value(column, row) for painting() that draws a planet with craters."""
    craters = [(256 * chance(k, seed), 128 * chance(k, seed, 1), 2 + 7 * chance(k, seed, 2) ** 3) for k in range(46)]

    def value(x, y):
        level = clouds(x / 16, y / 16, 16, seed, 5)
        width = math.sin(math.pi * (y + 0.5) / 128)
        for column, row, radius in craters:
            if abs(y - row) < radius:
                distance = math.hypot(((x - column + 128) % 256 - 128) * width, y - row)
                level += 0.25 * (distance / radius) ** 4 - 0.14 if distance < radius else 0
        return level
    return value


def swirls(x, y):
    return clouds(x / 42, y / 9 + 3 * clouds(x / 42, y / 30, 6, 41), 6, 17, 4)


def quiet_bands(x, y):
    at = y / 128
    return 0.4 + 0.3 * math.sin(26 * at) + 0.25 * clouds(x / 85, y / 4, 3, 23)


PAINT = {
    "Mercury": (cratered(7), [(0, (62, 58, 54)), (1, (206, 198, 186))]),
    "Venus": (swirls, [(0, (168, 112, 58)), (0.5, (226, 184, 118)), (1, (250, 232, 190))]),
    "Earth": (continents, [(0, (8, 26, 66)), (0.3, (22, 78, 136)), (0.5, (46, 128, 150)), (0.54, (88, 124, 60)),
                           (0.7, (140, 124, 74)), (0.9, (176, 158, 116)), (0.98, (240, 244, 248)),
                           (1, (252, 252, 252))]),
    "Mars": (cratered(29), [(0, (84, 34, 18)), (0.55, (188, 92, 48)), (1, (232, 170, 120))]),
    "Jupiter": (bands, [(0, (134, 88, 58)), (0.3, (196, 148, 104)), (0.6, (232, 212, 180)), (0.85, (244, 236, 220)),
                        (0.9, (196, 84, 48)), (1, (206, 96, 56))]),
    "Saturn": (quiet_bands, [(0, (158, 122, 76)), (0.5, (214, 184, 130)), (1, (240, 224, 182))]),
}


def engraving(x, y):
    """Returns the value of the dial's texture at (x, y): rings and degree marks, from 0 (brass) to 1 (black)."""
    across, along = (x - 255.5) / 256, (y - 255.5) / 256
    radius, angle = math.hypot(across, along), math.degrees(math.atan2(along, across)) % 360
    line = 0.0
    for ring, width in ((0.985, 0.005), (0.9, 0.004), (0.84, 0.003), (0.56, 0.004), (0.52, 0.003)):
        line = max(line, 1.2 - abs(radius - ring) / width)
    for step, inner, outer, width in ((5, 0.9, 0.94, 0.003), (30, 0.84, 0.985, 0.006), (10, 0.9, 0.96, 0.004),
                                      (60, 0.56, 0.84, 0.004)):
        off = math.radians(abs((angle + step / 2) % step - step / 2)) * radius
        if inner < radius < outer:
            line = max(line, 1.2 - off / width)
    star = 0.38 + 0.1 * math.cos(math.radians(angle) * 6)
    line = max(line, 1.2 - abs(radius - star) / 0.005)
    return min(1.0, max(0.0, line))


def grain(x, y):
    ring = x / 256 * 5 + 0.9 * clouds(x / 64, y / 256, 4, 51)
    fibre = clouds(x / 2, y / 48, 128, 57, 3)
    return 0.5 + 0.3 * math.sin(TURN * ring) * (0.6 + 0.4 * fibre) + 0.4 * (fibre - 0.5)


# ---- shapes ---------------------------------------------------------------------------------------------------------


def lathe(surface, profile, around, sharp=35):
    """Adds a surface of revolution about the y axis. Edges sharper than `sharp` degrees are not smoothed.

    profile: list of (radius, height), from top to bottom.
    """
    directions = []
    for (r0, y0), (r1, y1) in zip(profile, profile[1:]):
        length = math.hypot(r1 - r0, y1 - y0)
        directions.append(((y0 - y1) / length, (r1 - r0) / length))  # outward normal
    for k, ((r0, y0), (r1, y1)) in enumerate(zip(profile, profile[1:])):
        normals = []
        for neighbour in (k - 1, k + 1):
            own = directions[k]
            if 0 <= neighbour < len(directions):
                other = directions[neighbour]
                if own[0] * other[0] + own[1] * other[1] > math.cos(math.radians(sharp)):
                    own = (own[0] + other[0], own[1] + other[1])
            normals.append(own)
        first = len(surface.positions)
        for (radius, height), (out, up) in zip(((r0, y0), (r1, y1)), normals):
            for i in range(around + 1):
                angle = TURN * i / around
                surface.positions.append((radius * math.cos(angle), height, -radius * math.sin(angle)))
                surface.normals.append((out * math.cos(angle), up, -out * math.sin(angle)))
        for i in range(around):
            a, b = first + i, first + around + 1 + i
            surface.indices += ([a, b, b + 1] if r1 > 0 else [a, b, a + 1]) if r0 <= 0 or r1 <= 0 else \
                [a, b, b + 1, a, b + 1, a + 1]


def ball(around, rows):
    """Returns a unit sphere with texture coordinates: u grows eastwards, v from the north pole."""
    surface = Surface()
    for j in range(rows + 1):
        polar = math.pi * j / rows
        for i in range(around + 1):
            angle = TURN * i / around
            normal = (math.sin(polar) * math.cos(angle), math.cos(polar), -math.sin(polar) * math.sin(angle))
            surface.positions.append(normal)
            surface.normals.append(normal)
            surface.coordinates.append((i / around, j / rows))
    for j in range(rows):
        for i in range(around):
            a, b = j * (around + 1) + i, (j + 1) * (around + 1) + i
            surface.indices += ([a, b, b + 1] if j + 1 < rows else []) + ([a, b + 1, a + 1] if j else [])
    return surface


def rod(radius, length):
    """Returns a rod from the origin along +x, with a bevelled end."""
    upright = Surface()
    lathe(upright, [(0, length), (0.7 * radius, length), (radius, length - 0.4 * radius), (radius, 0)], 14)
    surface = Surface()
    surface.positions = [(y, -x, z) for x, y, z in upright.positions]
    surface.normals = [(y, -x, z) for x, y, z in upright.normals]
    surface.indices = upright.indices
    return surface


def add_plate(surface, outline, hole, low, high):
    """Adds a plate with a hole, between two heights. Outline and hole have equal numbers of (x, z) points,
    counter-clockwise as seen from above.
    """
    for (x0, z0), (x1, z1) in zip(outline, outline[1:] + outline[:1]):
        length = math.hypot(x1 - x0, z1 - z0)
        surface.quad([(x0, low, z0), (x1, low, z1), (x1, high, z1), (x0, high, z0)],
                     normal=((z0 - z1) / -length, 0, (x1 - x0) / -length))
    count = len(outline)
    inward = [(-x / math.hypot(x, z), 0, -z / math.hypot(x, z)) for x, z in hole]
    for first_ring, first_height, second_ring, second_height, normals in (
            (outline, high, hole, high, [(0, 1, 0)] * count), (hole, low, outline, low, [(0, -1, 0)] * count),
            (hole, high, hole, low, inward)):
        first = len(surface.positions)
        surface.positions += [(x, first_height, z) for x, z in first_ring]
        surface.positions += [(x, second_height, z) for x, z in second_ring]
        surface.normals += 2 * normals
        for i in range(count):
            j = (i + 1) % count
            surface.indices += [first + i, first + j, first + count + j, first + i, first + count + j, first + count + i]


def circle(radius, count):
    return [(radius * math.cos(TURN * i / count), -radius * math.sin(TURN * i / count)) for i in range(count)]


def wheel(teeth, radius, thickness):
    """Returns a gear wheel with a rim, five spokes and a hub."""
    surface = Surface()
    depth = 3.8 * radius / teeth
    outline = []
    for i in range(teeth):
        for place, reach in ((0.1, 0), (0.32, 1), (0.68, 1), (0.9, 0)):
            angle = TURN * (i + place) / teeth
            r = radius - depth * (1 - reach)
            outline.append((r * math.cos(angle), -r * math.sin(angle)))
    add_plate(surface, outline, circle(0.8 * radius, len(outline)), 0, thickness)
    add_plate(surface, circle(0.26 * radius, 40), circle(0.1 * radius, 40), -0.2 * thickness, 1.2 * thickness)
    for k in range(5):
        angle = TURN * k / 5
        along, across = (math.cos(angle), -math.sin(angle)), (math.sin(angle), math.cos(angle))

        def at(distance, side, height, u=along, v=across):
            return (distance * u[0] + side * v[0], height, distance * u[1] + side * v[1])
        half, inner, outer, low, high = 0.055 * radius, 0.22 * radius, 0.84 * radius, 0.15 * thickness, 0.85 * thickness
        for near, far, normal in (((half, high), (-half, high), (0, 1, 0)), ((-half, low), (half, low), (0, -1, 0)),
                                  ((half, low), (half, high), (across[0], 0, across[1])),
                                  ((-half, high), (-half, low), (-across[0], 0, -across[1]))):
            surface.quad([at(inner, *near), at(outer, *near), at(outer, *far), at(inner, *far)], normal=normal)
    return surface


# ---- the scene ------------------------------------------------------------------------------------------------------


class Orrery:
    def __init__(self):
        self.document = Document()
        self.samplers, self.channels = [], []
        self.times = None  # accessor of the key frames' times
        self.shared = None  # vertices and indices of the sphere that all globes share
        self.brass = self.plain("Brass", (0.88, 0.62, 0.28), 0.24, 1)
        self.steel = self.plain("Steel", (0.72, 0.72, 0.74), 0.3, 1)

    def painted(self, name, roughness, metallic, image):
        return self.document.material(name, pbrMetallicRoughness={
            "baseColorTexture": {"index": self.document.texture(image)}, "metallicFactor": metallic,
            "roughnessFactor": roughness})

    def plain(self, name, color, roughness, metallic):
        return self.document.material(name, pbrMetallicRoughness={
            "baseColorFactor": [*color, 1], "metallicFactor": metallic, "roughnessFactor": roughness})

    def glowing(self, name, color, strength):
        return self.document.material(name, emissiveFactor=color, pbrMetallicRoughness={
            "baseColorFactor": [0, 0, 0, 1], "metallicFactor": 0},
            extensions={"KHR_materials_emissive_strength": {"emissiveStrength": strength}})

    def turns(self, node, begin, degrees):
        """Adds a rotation of a node about the y axis at constant speed during the animation."""
        count = round(SECONDS * KEYS)
        if self.times is None:
            self.times = self.document.accessor([(as_float32(SECONDS * i / count),) for i in range(count + 1)], FLOAT,
                                                "SCALAR", bounds=True)
        rows = []
        for i in range(count + 1):
            half = math.radians(begin + degrees * i / count) / 2
            rows.append((0.0, as_float32(round(math.sin(half), 7)), 0.0, as_float32(round(math.cos(half), 7))))
        self.samplers.append({"input": self.times, "output": self.document.accessor(rows, FLOAT, "VEC4")})
        self.channels.append({"sampler": len(self.samplers) - 1, "target": {"node": node, "path": "rotation"}})

    def part(self, name, surface, material, parent=None, **place):
        return self.document.node(name, parent=parent, mesh=self.document.mesh(name, surface, material), **place)

    def globe(self, name, radius, material, parent=None, **place):
        """Adds a globe. All globes share the vertices of one sphere."""
        if self.shared is None:
            surface = ball(64, 32)
            self.shared = {"attributes": self.document.attributes(surface), "indices": self.document.indices(surface)}
        mesh = self.document.mesh_of(name, {**self.shared, "material": material})
        return self.document.node(name, parent=parent, mesh=mesh, scale=[radius] * 3, **place)

    def add_base(self):
        table = Surface()
        table.quad([(-3, 0, 0.9), (3, 0, 0.9), (3, 0, -3.5), (-3, 0, -3.5)], normal=(0, 1, 0))
        table.coordinates = [(-6, 2), (6, 2), (6, -7), (-6, -7)]
        self.part("Table", table, self.painted("Wood", 0.42, 0, painting(256, 256, grain, [
            (0, (44, 20, 10)), (0.5, (92, 48, 26)), (1, (140, 84, 48))])))

        foot = Surface()
        lathe(foot, [(0.104, 0.018), (0.112, 0.017), (0.118, 0.013), (0.118, 0.009), (0.128, 0.006), (0.13, 0.0)], 96)
        self.part("Foot", foot, self.plain("Walnut", (0.09, 0.035, 0.016), 0.25, 0))
        dial = Surface()
        side = 0.105
        for ring in ((0.0, 1), (side, 96)):
            for i in range(97):
                angle = TURN * i / 96
                x, z = ring[0] * math.cos(angle), -ring[0] * math.sin(angle)
                dial.positions.append((x, 0.0184, z))
                dial.normals.append((0, 1, 0))
                dial.coordinates.append((0.5 + 0.5 * x / side, 0.5 + 0.5 * z / side))
        for i in range(96):
            dial.indices += [i, 97 + i, 98 + i]
        self.part("Dial", dial, self.painted("Dial", 0.3, 1, painting(512, 512, engraving, [
            (0, (236, 198, 128)), (1, (36, 22, 10))])))
        rim = Surface()
        lathe(rim, [(0.104, 0.019), (0.1045, 0.0205), (0.1075, 0.0205), (0.108, 0.017)], 96, sharp=60)
        self.part("Rim", rim, self.brass)

        column = Surface()
        lathe(column, [(0, 0.142), (0.003, 0.1415), (0.0035, 0.139), (0.0035, 0.115), (0.006, 0.113), (0.007, 0.110),
                       (0.006, 0.107), (0.0045, 0.105), (0.0045, 0.06), (0.009, 0.056), (0.0105, 0.05), (0.009, 0.044),
                       (0.0075, 0.041), (0.0075, 0.033), (0.012, 0.029), (0.020, 0.025), (0.026, 0.022), (0.027, 0.0185)],
              48, sharp=50)
        self.part("Column", column, self.brass)

    def add_sun(self):
        self.globe("Sun", 0.016, self.glowing("Sun", [1.0, 0.72, 0.34], 9), translation=[0, 0.158, 0])
        lights = self.document.json.setdefault("extensions", {}).setdefault("KHR_lights_punctual", {"lights": []})
        lights["lights"].append({"name": "Sun", "type": "point", "color": [1.0, 0.78, 0.5], "intensity": 0.16})
        self.document.json["extensionsUsed"].append("KHR_lights_punctual")
        self.document.node("Sunlight", translation=[0, 0.158, 0], extensions={"KHR_lights_punctual": {"light": 0}})

    def add_planets(self):
        for index, (name, radius, distance, height, begin, degrees, spins) in enumerate(PLANETS):
            pivot = self.document.node(f"{name}'s arm")
            self.turns(pivot, begin, degrees)
            self.part(f"{name}'s rod", rod(0.0016, distance), self.brass, pivot, translation=[0, height - 0.02, 0])
            collar = Surface()
            lathe(collar, [(0.0045, 0.004), (0.0068, 0.0036), (0.0074, 0.002), (0.0074, -0.002), (0.0068, -0.0036),
                           (0.0045, -0.004)], 32, sharp=20)
            self.part(f"{name}'s collar", collar, self.brass, pivot, translation=[0, height - 0.02, 0])
            teeth = 34 + 10 * index
            self.part(f"{name}'s wheel", wheel(teeth, 0.021 + 0.0052 * index, 0.0026), (self.brass, self.steel)[index % 2],
                      pivot, translation=[0, height - 0.0285, 0])
            pin = Surface()
            pole = 0.02 - 0.9 * radius
            lathe(pin, [(0.0, pole + 0.003), (0.0011, pole + 0.003), (0.0011, 0.001), (0.0028, 0.0006), (0.003, -0.0022),
                        (0.0022, -0.003), (0, -0.0031)], 16)
            self.part(f"{name}'s pin", pin, self.steel, pivot, translation=[distance, height - 0.02, 0])
            value, stops = PAINT[name]
            paint = self.painted(name, 0.36, 0, painting(256, 128, value, stops))
            tilt = self.document.node(f"{name}'s tilt", parent=pivot, translation=[distance, height, 0],
                                      rotation=quaternion((0.8944272, 0, 0.4472136), 0 if index < 2 else 21))
            planet = self.globe(name, radius, paint, tilt)
            self.turns(planet, 0, 360 * spins)
            if name == "Saturn":
                self.add_rings(tilt)
            if name == "Earth":
                self.add_moon(pivot, distance, height)

    def add_rings(self, parent):
        rings = Surface()
        for inner, outer in ((0.0235, 0.0262), (0.0268, 0.0335), (0.0345, 0.0395)):
            lathe(rings, [(inner, 0.0002), (outer, 0.0002), (outer, -0.0002), (inner, -0.0002), (inner, 0.0002)], 96)
        self.part("Rings", rings, self.plain("Rings", (0.72, 0.58, 0.36), 0.35, 0.6), parent)

    def add_moon(self, parent, distance, height):
        orbit = self.document.node("Moon's arm", parent=parent, translation=[distance, height - 0.006, 0])
        self.turns(orbit, 90, 560)
        self.part("Moon's rod", rod(0.0007, 0.022), self.steel, orbit)
        self.globe("Moon", 0.0034, self.plain("Moon", (0.62, 0.6, 0.57), 0.5, 0), orbit, translation=[0.022, 0.004, 0])

    def add_lamps(self):
        """Adds strings of small lamps that hang behind the table."""
        colors = [[1.0, 0.56, 0.2], [1.0, 0.66, 0.3], [1.0, 0.44, 0.16], [1.0, 0.74, 0.46], [0.36, 0.58, 1.0],
                  [1.0, 0.3, 0.26]]
        bulb = ball(12, 6)
        meshes = [self.document.mesh("Lamp", bulb, self.glowing(f"Lamp {k + 1}", color, 42))
                  for k, color in enumerate(colors)]
        for row, (depth, left, right, high, sag, count) in enumerate(((1.1, -0.7, 0.66, 0.27, 0.11, 13),
                                                                      (1.7, -0.95, 0.9, 0.33, 0.15, 17),
                                                                      (2.5, -1.2, 1.35, 0.4, 0.2, 21))):
            for i in range(count):
                share = (i + 0.6 * chance(i, row) - 0.3) / (count - 1)
                drop = sag * (1 - (2 * share - 1) ** 2)
                kind = int(chance(row, i, 5) * len(colors))
                self.document.node(f"Lamp {row + 1}.{i + 1}", mesh=meshes[kind], scale=[0.0055] * 3, translation=[
                    round(left + (right - left) * share, 4), round(high - drop + 0.05 * chance(i, row, 3), 4),
                    round(-depth + 0.2 * chance(i, row, 9), 4)])

    def finish(self):
        self.document.json["animations"] = [{"name": "Run", "samplers": self.samplers, "channels": self.channels}]
        self.document.camera(2 * math.atan(0.19), 16 / 9, {"fStop": 1.8, "focusDistance": 0.5, "horizontalAperture": 36.0},
                             translation=[0.0, 0.145, 0.58], rotation=quaternion((-1, 0, 0), 5))
        return self.document.glb()


def orrery():
    scene = Orrery()
    scene.add_base()
    scene.add_sun()
    scene.add_planets()
    scene.add_lamps()
    return scene.finish()
