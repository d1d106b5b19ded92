"""Makes swimmers.glb: six fish of two kinds that swim for five seconds under water, among swaying kelp.

Each fish has a skin of ten joints, and each plant has a morph target. The animation "Swim" moves all of them.
"""

import bisect
import math

from gltf_document import FLOAT, UBYTE, Document, Surface, add_tube, linear, quaternion, smooth_normals

SECONDS = 5.0
KEYS = 16  # key frames per second of channels with linear interpolation
JOINTS = 10
JOINT_LENGTH = 0.024  # distance between joints, m
FIRST_JOINT = 0.045  # x of the joint at the gills, m; the snout is at x = 0.11, the tail's root at x = −0.11


# ---- shapes ---------------------------------------------------------------------------------------------------------


def curve(knots, at):
    """Interpolates (position, value) knots: cubic Hermite with slopes from neighbours (Catmull and Rom 1974)."""
    i = min(max(bisect.bisect_right([k[0] for k in knots], at) - 1, 0), len(knots) - 2)

    def slope(k):
        before, after = knots[max(k - 1, 0)], knots[min(k + 1, len(knots) - 1)]
        return (after[1] - before[1]) / (after[0] - before[0])
    (x0, y0), (x1, y1) = knots[i], knots[i + 1]
    width = x1 - x0
    t = (at - x0) / width
    return ((1 + 2 * t) * (1 - t) ** 2 * y0 + t * (1 - t) ** 2 * width * slope(i) + t * t * (3 - 2 * t) * y1 -
            t * t * (1 - t) * width * slope(i + 1))


BACK = [(0, 0), (0.04, 0.026), (0.12, 0.046), (0.25, 0.062), (0.4, 0.066), (0.55, 0.06), (0.7, 0.045), (0.85, 0.025),
        (0.95, 0.016), (1, 0.013)]
BELLY = [(0, 0), (0.04, 0.02), (0.12, 0.036), (0.25, 0.05), (0.4, 0.056), (0.55, 0.052), (0.7, 0.04), (0.85, 0.022),
         (0.95, 0.014), (1, 0.012)]
WIDTH = [(0, 0), (0.04, 0.013), (0.12, 0.021), (0.25, 0.027), (0.4, 0.028), (0.55, 0.025), (0.7, 0.018), (0.85, 0.009),
         (0.95, 0.004), (1, 0.0025)]


def flank(a, turn):
    """Returns a point of the skin. a: 0 at the snout, 1 at the tail's root. turn: radians from the back towards +z."""
    up = math.cos(turn)
    return 0.11 - 0.22 * a, (curve(BACK, a) if up > 0 else curve(BELLY, a)) * up, curve(WIDTH, a) * math.sin(turn)


def add_sheet(surface, root, tip, rays, steps, color, thickness=0.0012, lift=None):
    """Adds a two-sided fin that is closed at its edges. root, tip: border curves, functions from [0, 1] to points."""
    first = len(surface.positions)
    places = {}
    for side in (1, -1):
        for i in range(rays + 1):
            for j in range(steps + 1):
                u, v = i / rays, j / steps
                rim = i in (0, rays) or j in (0, steps)
                if rim and side < 0:
                    places[side, i, j] = places[1, i, j]
                    continue
                places[side, i, j] = len(surface.positions)
                a, b = root(u), tip(u)
                x, y, z = (p + (q - p) * v for p, q in zip(a, b))
                ripple = 0.0016 * v * math.sin(19 * u)
                swell = 0 if rim else side * thickness * (1 - 0.7 * v)
                out = lift(u, v) if lift else 0
                surface.positions.append((x, y, z + ripple + swell + out))
                surface.colors.append(color(u, v))
    for side in (1, -1):
        for i in range(rays):
            for j in range(steps):
                corners = [places[side, i, j], places[side, i + 1, j], places[side, i + 1, j + 1], places[side, i, j + 1]]
                a, b, c = (surface.positions[k] for k in corners[:3])
                faces_left = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0
                if faces_left != (side > 0):
                    corners.reverse()
                surface.indices += [corners[0], corners[1], corners[2], corners[0], corners[2], corners[3]]
    return first


def mixed(first, second, share):
    share = min(max(share, 0.0), 1.0)
    return linear(*(a + (b - a) * share for a, b in zip(first, second)))


def add_eye(surface, side):
    center, radius = (0.083, 0.012, side * 0.0165), 0.0075

    def color(p):
        away = side * (p[2] - center[2]) / radius
        return linear(16, 18, 24) if away > 0.62 else linear(226, 196, 120)
    rings = [[(center[0], center[1] + radius, center[2])]]
    for i in range(1, 10):
        polar = math.pi * i / 10
        rings.append([(center[0] + radius * math.sin(polar) * math.sin(2 * math.pi * k / 16),
                       center[1] + radius * math.cos(polar),
                       center[2] + radius * math.sin(polar) * math.cos(2 * math.pi * k / 16)) for k in range(16)])
    rings.append([(center[0], center[1] - radius, center[2])])
    add_tube(surface, rings, color)


def fish(skin, fin):
    """Returns a fish. skin(a, height): colour of the body, with `a` from snout (0) to tail (1) and height from −1 to 1.
    fin(v): colour of the fins, from root (0) to edge (1).
    """
    surface = Surface()
    around, along = 40, 84
    rings = [[flank(0, 0)]]
    for i in range(1, along):
        a = 0.5 - 0.5 * math.cos(math.pi * i / along)  # spaces rings more densely at both ends
        rings.append([flank(a, 2 * math.pi * k / around) for k in range(around)])
    rings.append([(-0.111, 0, 0)])

    def body(p):
        a = (0.11 - p[0]) / 0.22
        return skin(a, p[1] / max(curve(BACK if p[1] > 0 else BELLY, a), 1e-4))
    add_tube(surface, rings, body)

    def tail_tip(u):
        turn = 2 * u - 1
        length = 0.072 * (1 - 0.36 * (1 - abs(turn) ** 1.6))
        return -0.1 - length * math.cos(0.72 * turn), 0.012 * turn + length * math.sin(0.72 * turn), 0
    add_sheet(surface, lambda u: (-0.102, 0.011 * (2 * u - 1), 0), tail_tip, 30, 14, lambda u, v: fin(v))
    for knots, sign, begin, end, height in ((BACK, 1, 0.26, 0.88, 0.034), (BELLY, -1, 0.58, 0.88, 0.028)):
        def root(u):
            a = begin + (end - begin) * u
            return 0.11 - 0.22 * a, sign * 0.93 * curve(knots, a), 0

        def tip(u):
            tall = height * math.sin(math.pi * (0.06 + 0.88 * u)) ** 0.55 * (1 - 0.35 * u)
            x, y, z = root(u)
            return x - 0.55 * tall, y + sign * tall, z
        add_sheet(surface, root, tip, 34 if sign > 0 else 18, 8, lambda u, v: fin(v))
    for side in (1, -1):
        add_sheet(surface, lambda u: (0.034, -0.004 - 0.014 * u, side * 0.0245),
                  lambda u: (-0.006 - 0.012 * u, 0.008 - 0.044 * u, side * 0.034), 14, 8, lambda u, v: fin(v),
                  lift=lambda u, v: side * 0.012 * v * (1 - u))
        add_eye(surface, side)
    surface.normals = smooth_normals(surface)
    return surface


def coral(a, height):
    """Returns the colour of a fish that is orange with three pale bands with dark edges; parameters as in fish()."""
    orange, pale, dark = (238, 92, 16), (246, 240, 228), (30, 20, 18)
    near = min(abs(a - place - 0.02 * height * height) / half for place, half in ((0.27, 0.05), (0.6, 0.055), (0.93, 0.05)))
    if near < 0.8:
        return linear(*pale)
    return mixed(dark, orange, (near - 1) / 0.25) if near > 1 else mixed(pale, dark, (near - 0.8) / 0.2)


def azure(a, height):
    """Returns the colour of a fish that is deep blue with a dark stripe and a yellow tail; parameters as in fish()."""
    blue, deep, yellow = (24, 92, 214), (10, 18, 60), (250, 206, 40)
    stripe = 1 - abs(height - 0.45 + 0.9 * abs(a - 0.42)) / 0.22
    return mixed(blue, yellow, (a - 0.84) / 0.06) if a > 0.84 else mixed(blue, deep, stripe)


# ---- movement -------------------------------------------------------------------------------------------------------


def joint_weights(position):
    """Returns the joints and weights of a vertex: the two nearest joints, with weights that add up to 255."""
    place = min(max((FIRST_JOINT - position[0]) / JOINT_LENGTH, 0.0), JOINTS - 1.0)
    joint = min(int(place), JOINTS - 2)
    second = round(255 * (place - joint))
    return (joint, joint + 1, 0, 0), (255 - second, second, 0, 0)


def heading(velocity):
    """Returns the rotation (x, y, z, w) from +x to the velocity's direction, without roll: about y, then z."""
    yaw = math.atan2(-velocity[2], velocity[0])
    pitch = math.atan2(velocity[1], math.hypot(velocity[0], velocity[2]))
    (cy, sy), (cp, sp) = ((math.cos(0.5 * angle), math.sin(0.5 * angle)) for angle in (yaw, pitch))
    return sy * sp, sy * cp, cy * sp, cy * cp


def derivative(function, time, step=1e-3):
    return [(b - a) / (2 * step) for a, b in zip(function(time - step), function(time + step))]


def rounded(values):
    return tuple(round(value, 6) for value in values)


class Clip:
    """A glTF animation. Channels with the same number of keys per second share their key times."""

    def __init__(self, document, name):
        self.document, self.samplers, self.channels, self.inputs = document, [], [], {}
        document.json["animations"] = [{"name": name, "samplers": self.samplers, "channels": self.channels}]

    def channel(self, node, path, function, kind, a_second, cubic=False):
        count = round(SECONDS * a_second) + 1
        times = [i / a_second for i in range(count)]
        if a_second not in self.inputs:
            self.inputs[a_second] = self.document.accessor([(round(t, 6),) for t in times], FLOAT, "SCALAR", bounds=True)
        rows = []
        for time in times:
            value = [rounded(function(time))]
            if cubic:  # each cubic key has an in-tangent, a value and an out-tangent
                tangent = rounded(derivative(function, time))
                value = [tangent] + value + [tangent]
            rows += value
        self.samplers.append({"input": self.inputs[a_second], "output": self.document.accessor(rows, FLOAT, kind),
                              "interpolation": "CUBICSPLINE" if cubic else "LINEAR"})
        self.channels.append({"sampler": len(self.samplers) - 1, "target": {"node": node, "path": path}})


def swim(clip, path, joints, beat, phase, start, velocity, sway):
    """Adds the channels of a fish that swims along a wavy path from `start` (m) with `velocity` (m/s).

    A wave runs along the body from head to tail `beat` times per second. sway: amplitude of the path in m.
    """
    def place(time):
        turn = 2 * math.pi * (0.22 * time + phase)
        return (start[0] + velocity[0] * time, start[1] + velocity[1] * time + 0.5 * sway * math.sin(turn),
                start[2] + velocity[2] * time + sway * math.sin(turn + 1.3))
    clip.channel(path, "translation", place, "VEC3", 4, cubic=True)
    clip.channel(path, "rotation", lambda time: heading(derivative(place, time)), "VEC4", 4, cubic=True)
    for i, joint in enumerate(joints):
        def bend(time, i=i):
            most = 0.045 if i == 0 else 0.02 + 0.016 * i
            angle = most * math.sin(2 * math.pi * (beat * time + phase) - 0.62 * i + (math.pi if i == 0 else 0))
            return 0, math.sin(0.5 * angle), 0, math.cos(0.5 * angle)
        clip.channel(joint, "rotation", bend, "VEC4", KEYS)


def add_school(document, clip):
    material = document.material("Scales", pbrMetallicRoughness={"metallicFactor": 0, "roughnessFactor": 0.38})
    kinds = [("Coral", fish(coral, lambda v: mixed((240, 104, 22), (40, 24, 20), (v - 0.8) / 0.2))),
             ("Azure", fish(azure, lambda v: mixed((250, 206, 40), (22, 60, 170), (v - 0.55) / 0.45)))]

    # Both kinds of fish have the same shape and different colours.
    surface = kinds[0][1]
    shape = document.attributes(surface)
    weights = [joint_weights(p) for p in surface.positions]
    shape["JOINTS_0"] = document.accessor([w[0] for w in weights], UBYTE, "VEC4", 34962)
    shape["WEIGHTS_0"] = document.accessor([w[1] for w in weights], UBYTE, "VEC4", 34962, normalized=True)
    indices = document.indices(surface)
    meshes = []
    for name, kind in kinds:
        colors = document.accessor(kind.colors, UBYTE, "VEC4", 34962, normalized=True)
        meshes.append(document.mesh_of(name, {"attributes": {**shape, "COLOR_0": colors}, "indices": indices,
                                              "material": material}))
    unbind = document.accessor([(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, round(JOINT_LENGTH * i - FIRST_JOINT, 6), 0, 0, 1)
                                for i in range(JOINTS)], FLOAT, "MAT4")

    # Each fish: kind, size, beats per second, phase, start (m), velocity (m/s), sway (m).
    school = [(0, 1.0, 1.5, 0.1, (-0.31, -0.03, -0.95), (0.115, 0.008, -0.02), 0.02),
              (1, 1.15, 1.3, 0.45, (0.62, 0.13, -1.75), (-0.16, 0.004, 0.05), 0.03),
              (0, 0.85, 1.9, 0.7, (-0.95, 0.24, -2.4), (0.2, -0.012, 0.02), 0.03),
              (1, 1.0, 1.6, 0.2, (0.95, -0.3, -2.2), (-0.17, 0.02, -0.06), 0.03),
              (0, 0.9, 1.7, 0.9, (1.5, 0.42, -3.6), (-0.24, -0.01, 0.05), 0.04),
              (1, 1.05, 1.4, 0.6, (-1.5, -0.05, -3.3), (0.2, 0.01, 0.06), 0.04)]
    for number, (kind, size, beat, phase, start, velocity, sway) in enumerate(school, 1):
        path = document.node(f"Path {number}", scale=[size] * 3)
        joints, parent = [], path
        for i in range(JOINTS):
            parent = document.node(f"Joint {number}.{i}", parent=parent,
                                   translation=[FIRST_JOINT if i == 0 else -JOINT_LENGTH, 0, 0])
            joints.append(parent)
        skins = document.json.setdefault("skins", [])
        skins.append({"name": f"Skin {number}", "joints": joints, "skeleton": path, "inverseBindMatrices": unbind})
        document.node(f"Fish {number}", mesh=meshes[kind], skin=len(skins) - 1)
        swim(clip, path, joints, beat, phase, start, velocity, sway)


# ---- surroundings ---------------------------------------------------------------------------------------------------


def kelp(number):
    """Returns the blades of a plant, and the largest displacement of each vertex by the water current in m."""
    surface, sway = Surface(), []
    for blade in range(6):
        chance = math.sin(12.9898 * (blade + 7 * number)) * 43758.5453 % 1
        turn, tall = 2 * math.pi * (blade + chance) / 6, 0.55 + 0.55 * chance
        foot = (0.07 * math.cos(turn), 0.07 * math.sin(turn))
        across = (math.cos(turn + 1.2), math.sin(turn + 1.2))
        first = len(surface.positions)
        for i in range(25):
            v = i / 24
            half = 0.024 * math.sin(math.pi * (0.12 + 0.88 * v)) ** 0.7 * (1 + 0.16 * math.sin(17 * v + 5 * chance)) + 0.001
            lean = 0.12 * v * v
            for side in (-1, 1):
                surface.positions.append((foot[0] + lean * math.cos(turn) + side * half * across[0], tall * v,
                                          foot[1] + lean * math.sin(turn) + side * half * across[1]))
                surface.colors.append(mixed((34, 74, 38), (150, 160, 50), v))
                sway.append((0.16 * v * v, -0.05 * v * v * v, 0.03 * v * v * math.sin(3 * turn)))
        for i in range(24):
            a = first + 2 * i
            surface.indices += [a, a + 1, a + 3, a, a + 3, a + 2]
    surface.normals = smooth_normals(surface)
    return surface, sway


def add_kelp(document, clip):
    material = document.material("Kelp", doubleSided=True,
                                 pbrMetallicRoughness={"metallicFactor": 0, "roughnessFactor": 0.6})
    plants = [(-0.62, -1.5), (0.9, -1.7), (-1.25, -2.6), (0.35, -2.9), (1.7, -3.1), (-0.5, -3.9), (1.0, -4.3), (-2.0, -4.2)]
    for number, (x, z) in enumerate(plants, 1):
        surface, sway = kelp(number)
        rows = [rounded(row) for row in sway]
        target = {"POSITION": document.accessor(rows, FLOAT, "VEC3", bounds=True)}
        mesh = document.mesh_of(f"Kelp {number}", {"attributes": document.attributes(surface),
                                                   "indices": document.indices(surface), "material": material,
                                                   "targets": [target]}, weights=[0])
        node = document.node(f"Kelp {number}", mesh=mesh, translation=[x, -0.66, z])
        clip.channel(node, "weights", lambda t, n=number: (math.sin(2 * math.pi * (0.2 * t + 0.13 * n)),), "SCALAR", KEYS)


def add_water(document):
    """Adds sand, a bright backdrop that darkens downwards, and specks of glowing plankton."""
    sand = Surface()
    columns, rows = 40, 36
    for j in range(rows + 1):
        for i in range(columns + 1):
            x, z = -4.5 + 9 * i / columns, -0.3 - 7.7 * j / rows
            wave = 0.02 * math.sin(7 * x + 2 * math.sin(3 * z)) * math.cos(5 * z) + 0.05 * math.sin(1.1 * x - z)
            sand.positions.append((x, -0.7 + wave, z))
            sand.colors.append(mixed((128, 142, 128), (196, 196, 160), 0.5 + 9 * wave))
    for j in range(rows):
        for i in range(columns):
            a = j * (columns + 1) + i
            b = a + columns + 1
            sand.indices += [a, a + 1, b + 1, a, b + 1, b]
    sand.normals = smooth_normals(sand)
    material = document.material("Sand", pbrMetallicRoughness={"metallicFactor": 0, "roughnessFactor": 0.9})
    document.node("Sand", mesh=document.mesh("Sand", sand, material))

    backdrop = Surface()
    for j in range(17):
        for i in range(25):
            u, v = i / 24, j / 16
            backdrop.positions.append((-7 + 14 * u, -1.2 + 6 * v, -8))
            beams = 0.1 * math.sin(9 * u + 2.5 * v) * v
            backdrop.colors.append(mixed((6, 58, 84), (150, 222, 226), v * v * 1.2 + beams + 0.08))
    for j in range(16):
        for i in range(24):
            a = 25 * j + i
            backdrop.indices += [a, a + 1, a + 26, a, a + 26, a + 25]
    water = document.material("Water", extensions={"KHR_materials_unlit": {}})
    document.node("Backdrop", mesh=document.mesh("Backdrop", backdrop, water))

    specks = Surface()
    for i in range(40):
        chances = [math.sin(78.233 * i + 31.7 * k + 1) * 43758.5453 % 1 for k in range(4)]
        z = -0.8 - 4.2 * chances[2] ** 1.5
        center = (-z * 0.45 * (2 * chances[0] - 1), -z * 0.3 * (2 * chances[1] - 1) + 0.1, z)
        radius = -z * (0.003 + 0.002 * chances[3])
        rings = [[(center[0], center[1] + radius, z)]]
        for polar in (math.pi / 4, math.pi / 2, 3 * math.pi / 4):
            rings.append([(center[0] + radius * math.sin(polar) * math.sin(math.pi * k / 4),
                           center[1] + radius * math.cos(polar),
                           z + radius * math.sin(polar) * math.cos(math.pi * k / 4)) for k in range(8)])
        rings.append([(center[0], center[1] - radius, z)])
        add_tube(specks, rings, lambda p: linear(255, 255, 255))
    specks.normals = smooth_normals(specks)
    glow = document.material("Plankton", emissiveFactor=[0.8, 1.0, 0.9],
                             extensions={"KHR_materials_emissive_strength": {"emissiveStrength": 1.3}})
    document.node("Plankton", mesh=document.mesh("Plankton", specks, glow))


def swimmers():
    document = Document()
    clip = Clip(document, "Swim")
    add_school(document, clip)
    add_kelp(document, clip)
    add_water(document)
    document.sun([0.92, 1.0, 0.96], 3.2, quaternion((-0.9363292, 0.3511234, 0), 62))
    document.camera(2 * math.atan(0.2025), 16 / 9, {"fStop": 1.4, "focusDistance": 0.95, "horizontalAperture": 36.0})
    return document.glb()
