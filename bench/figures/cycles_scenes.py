"""Scenes of `scripts/figures cycles`, for Blender's Python. Lengths are in m, directions in Blender's axes (z up)."""

import math

import bpy
import numpy

from figures.cycles_materials import material


# ---- textures: H×W×3 arrays in [0, 1], sRGB-encoded colours or normals ----------------------------------------------


def checker(first, second, cells=16, size=256):
    cell = numpy.arange(size) * cells // size
    return numpy.where(((cell[:, None] + cell) % 2 == 0)[..., None], first, second)


def lines(first, second, count=32, size=256):
    stripe = numpy.arange(size) * 2 * count // size % 2
    return numpy.broadcast_to(numpy.where((stripe == 0)[:, None], first, second), (size, size, 3))


def blotches(first, second, seed, size=256):
    """Returns periodic noise between two colours, with detail at all scales."""
    noise = numpy.zeros((size, size))
    x = numpy.arange(size) * (2 * math.pi / size)
    random = numpy.random.default_rng(seed)
    for _ in range(60):
        u, v = random.integers(-12, 13, 2)
        noise += numpy.cos(u * x + v * x[:, None] + random.uniform(0, 7)) / (1 + math.hypot(u, v))
    share = 1 / (1 + numpy.exp(-2 * noise / noise.std()))[..., None]
    return first + share * (numpy.asarray(second) - first)


def normals(waves, slope, seed, size=256):
    """Returns the normals of periodic waves. slope: root mean square of the slope along each axis."""
    x = numpy.arange(size) * (2 * math.pi / size)
    slopes = numpy.zeros((2, size, size))
    random = numpy.random.default_rng(seed)
    for _ in range(12):
        u, v = random.integers(-waves, waves + 1, 2)
        slopes += numpy.array([u, v])[:, None, None] * numpy.sin(u * x + v * x[:, None] + random.uniform(0, 7))
    slopes *= slope / slopes.std()
    normal = numpy.stack([*slopes, numpy.ones_like(slopes[0])], axis=-1)
    return 0.5 + 0.5 * normal / numpy.linalg.norm(normal, axis=-1, keepdims=True)


# ---- objects --------------------------------------------------------------------------------------------------------


def finished(surface, repeat=1.0, smooth=False):
    """Assigns a material to the object that was added last, and repeats its texture."""
    thing = bpy.context.object
    thing.data.materials.append(surface)
    thing.cycles.shadow_terminator_geometry_offset = 0
    for loop in thing.data.uv_layers[0].data:
        loop.uv *= repeat
    for face in thing.data.polygons:
        face.use_smooth = smooth
    return thing


def plane(surface, size, place, turned=(0, 0, 0), repeat=1.0):
    """Adds a plane. turned: rotation as Euler angles in degrees."""
    bpy.ops.mesh.primitive_plane_add(size=size, location=place, rotation=[math.radians(angle) for angle in turned])
    return finished(surface, repeat)


def sphere(surface, radius, place, repeat=1.0):
    bpy.ops.mesh.primitive_uv_sphere_add(segments=192, ring_count=96, radius=radius, location=place, rotation=(0.4, 0.3, 0.8))
    return finished(surface, repeat, smooth=True)


def box(surface, size, place, turned):
    bpy.ops.mesh.primitive_cube_add(size=size, location=place, rotation=turned)
    return finished(surface)


def wire(surface, radius, place, length, turned):
    bpy.ops.mesh.primitive_cylinder_add(vertices=48, radius=radius, depth=length, location=place, end_fill_type="NOTHING",
                                        rotation=[math.radians(angle) for angle in turned])
    return finished(surface, smooth=True)


def sun(strength, azimuth, elevation, colour=(1, 1, 1)):
    """Adds a sun. strength: irradiance in W/m². azimuth: degrees to the right of the direction to the camera."""
    bpy.ops.object.light_add(type="SUN", rotation=(math.radians(90 - elevation), 0, math.radians(azimuth)))
    light = bpy.context.object.data
    light.energy, light.color, light.angle = strength, colour, 0


def point(power, place, colour=(1, 1, 1)):
    """Adds a point light. power: radiant flux in W."""
    bpy.ops.object.light_add(type="POINT", location=place)
    light = bpy.context.object.data
    light.energy, light.color, light.shadow_soft_size = power, colour, 0


def camera(height, focus, fstop, pitch):
    """Adds a camera above the origin that looks along +y and `pitch` degrees down: 50 mm on a sensor of 36 mm."""
    bpy.ops.object.camera_add(location=(0, 0, height), rotation=(math.radians(90 - pitch), 0, 0))
    bpy.context.scene.camera = bpy.context.object
    lens = bpy.context.object.data
    lens.lens, lens.sensor_width, lens.sensor_fit, lens.clip_start = 50, 36, "HORIZONTAL", 0.05
    lens.dof.use_dof, lens.dof.focus_distance, lens.dof.aperture_fstop, lens.dof.aperture_blades = True, focus, fstop, 0


# ---- scenes ---------------------------------------------------------------------------------------------------------

BLUE, SAND, RED, WHITE, DARK = ((0.2, 0.35, 0.65), (0.85, 0.75, 0.55), (0.75, 0.25, 0.2), (0.9, 0.9, 0.88), (0.12, 0.12, 0.14))
GOLD, STEEL, COPPER = (0.95, 0.8, 0.45), (0.75, 0.76, 0.78), (0.95, 0.7, 0.6)


def grazing_planes():
    """A checkered floor and a wall of fine lines, both seen at about 80° from their normals."""
    camera(0.18, 1.0, 1.2, 10)
    plane(material("tiles", checker(WHITE, BLUE), roughness=1), 6, (0, 3.3, 0), (0, 0, 20), repeat=6)
    plane(material("lines", lines(SAND, DARK), roughness=1), 3, (-0.3, 1.7, 0.3), (90, 0, 98), repeat=3)
    sun(2.5, 30, 50, (1, 0.9, 0.8))
    sun(0.8, -60, 30, (0.7, 0.8, 1))


def textured_spheres():
    camera(0.25, 1.0, 1.0, 12)
    floor = material("floor", lines(SAND, RED, 8), roughness=1)
    plane(floor, 4, (0, 2, -0.1), repeat=4)
    for i in range(9):
        surface = material(f"ball {i}", checker(WHITE, (BLUE, RED, DARK)[i % 3], 24) if i % 2 else blotches(DARK, SAND, i), roughness=1)
        sphere(surface, 0.07, (0.2 * (i % 3 - 1) * (1 + 0.5 * (i // 3)), 0.75 + 0.35 * (i // 3), -0.03), repeat=2)
    sun(2, 40, 45, (1, 0.9, 0.8))
    sun(0.8, -70, 25, (0.7, 0.8, 1))
    point(1.5, (-0.3, 0.8, 0.3))


def metal_spheres():
    """Metal spheres, from smooth to rough: perceptual roughness 0.25 to 0.8."""
    camera(0.2, 1.0, 1.0, 10)
    for i in range(8):
        surface = material(f"metal {i}", (GOLD, STEEL, COPPER)[i % 3], metallic=1, roughness=0.25 + 0.55 * i / 7)
        sphere(surface, 0.1, (0.24 * (i % 4 - 1.5) * (1 + 0.6 * (i // 4)), 0.9 + 0.6 * (i // 4), 0.06 * (i // 4)))
    sun(2, 40, 45)
    sun(1, -50, 20, (0.7, 0.8, 1))
    point(3, (0, 0.5, 0.5), (1, 0.8, 0.6))


def metal_plate():
    camera(0.6, 0.95, 1.0, 40)
    brushed = material("brushed", blotches(STEEL, GOLD, 3), normal=normals(8, 0.12, 4), metallic=1, roughness=0.45)
    plane(brushed, 2.4, (0, 0.95, 0), repeat=3)
    sun(2, 160, 35)
    sun(1.2, 60, 50, (0.7, 0.8, 1))
    point(4, (0.1, 1.3, 0.5), (1, 0.8, 0.6))


def leather():
    """A dielectric surface with a normal map, like leather."""
    camera(0.45, 0.95, 1.0, 28)
    plane(material("leather", blotches(RED, DARK, 5), normal=normals(16, 0.2, 6), roughness=0.5), 1.6, (0, 0.95, 0), repeat=3)
    sun(2.5, 150, 40)
    sun(1, -40, 50, (0.7, 0.8, 1))


def boxes():
    """160 small boxes at many depths: every third is metal with a normal map, the others are textured dielectrics."""
    camera(0, 1.1, 0.95, 0)
    surfaces = [material("metal box", blotches(COPPER, STEEL, 7), normal=normals(4, 0.15, 8), metallic=1, roughness=0.5),
                material("checkered box", checker(WHITE, BLUE, 24), roughness=0.6),
                material("lined box", lines(SAND, RED, 16), roughness=0.4)]
    random = numpy.random.default_rng(9)
    for i in range(160):
        depth = random.uniform(0.6, 3)
        side, up = random.uniform(-0.4, 0.4, 2) * depth
        box(surfaces[i % 3], random.uniform(0.04, 0.1), (side, depth, 0.75 * up), random.uniform(0, 6, 3))
    sun(2.5, 30, 40, (1, 0.95, 0.9))
    sun(1, -50, 20, (0.7, 0.8, 1))


def wires():
    """Metal wires, 0.3 to 2 px thick, in front of a textured wall."""
    camera(0, 1.0, 1.0, 0)
    plane(material("wall", checker(SAND, DARK, 8), roughness=1), 3, (0, 1.9, 0), (90, 0, 15), repeat=2)
    metals = [material(f"wire {i}", colour, metallic=1, roughness=0.5) for i, colour in enumerate((GOLD, STEEL, COPPER))]
    random = numpy.random.default_rng(10)
    for i in range(30):
        depth = random.uniform(0.6, 1.5)
        wire(metals[i % 3], random.uniform(0.0006, 0.004), (random.uniform(-0.35, 0.35) * depth, depth, 0), 2,
             (random.uniform(-25, 25), random.uniform(-50, 50), 0))
    sun(2.5, 40, 40, (1, 0.95, 0.9))
    sun(1, -60, 20, (0.7, 0.8, 1))


def still_life():
    camera(0.25, 1.0, 1.0, 12)
    plane(material("table", blotches(SAND, DARK, 11), normal=normals(8, 0.1, 12), roughness=0.6), 4, (0, 2, -0.1), repeat=8)
    plane(material("cloth", lines(RED, WHITE, 12), roughness=1), 4, (0, 2.4, 0), (90, 0, -10), repeat=4)
    sphere(material("gold ball", GOLD, normal=normals(6, 0.12, 13), metallic=1, roughness=0.4), 0.1, (-0.17, 0.95, 0), repeat=2)
    sphere(material("glazed ball", checker(BLUE, WHITE, 8), roughness=0.4), 0.09, (0.1, 1.25, -0.01), repeat=2)
    box(material("brass box", COPPER, normal=normals(6, 0.12, 14), metallic=1, roughness=0.5), 0.14, (0.17, 0.8, -0.03), (0, 0, 0.5))
    box(material("book", blotches(BLUE, SAND, 15), roughness=0.5), 0.2, (-0.3, 1.5, 0), (0, 0, -0.3))
    wire(material("rod", STEEL, metallic=1, roughness=0.4), 0.004, (0.02, 0.7, 0), 0.6, (0, 35, 20))
    sun(2.2, 40, 45, (1, 0.95, 0.9))
    point(1.5, (-0.4, 0.7, 0.4), (0.7, 0.8, 1))


SCENES = {scene.__name__.replace("_", " "): scene
          for scene in (grazing_planes, textured_spheres, metal_spheres, metal_plate, leather, boxes, wires, still_life)}
