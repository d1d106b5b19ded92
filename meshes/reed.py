"""Makes reed.glb: a reed of 1,200 triangles with a skin of four joints and a morph target.

The clip "Bend" of one second animates both: the reed bends and swells.
"""

import math

from gltf_document import FLOAT, UBYTE, Document, Surface, add_tube, as_float32, smooth_normals

HEIGHT = 1.2  # m
JOINTS = 4
JOINT_LENGTH = 0.3  # distance between joints in m; the first joint is at the root
AROUND, RINGS = 20, 30
KEYS = 8  # number of key frames of the clip


def outline(share):
    """Returns the radius (m) at a fraction of the height: a thin stalk and a thick ear, closed at both ends."""
    ear = math.exp(-((share - 0.78) / 0.09) ** 2)
    return (0.018 + 0.05 * ear) * min(1.0, 12 * (1 - share), 40 * share + 0.2)


def shape():
    surface = Surface()
    rings = [[(0.0, 0.0, 0.0)]]
    for ring in range(1, RINGS + 1):
        share = ring / (RINGS + 1)
        radius = outline(share)
        rings.append([(radius * math.sin(2 * math.pi * i / AROUND), share * HEIGHT,
                       radius * math.cos(2 * math.pi * i / AROUND)) for i in range(AROUND)])
    rings.append([(0.0, HEIGHT, 0.0)])
    add_tube(surface, rings, lambda p: (int(60 + 120 * p[1] / HEIGHT), 130, int(70 + 400 * abs(p[0])), 255))
    surface.normals = smooth_normals(surface)
    return surface


def joint_weights(position):
    """Returns the joints and weights of a vertex: the two nearest joints, with weights that add up to 255."""
    place = min(position[1] / JOINT_LENGTH, JOINTS - 1.0)
    joint = min(int(place), JOINTS - 2)
    second = round(255 * (place - joint))
    return (joint, joint + 1, 0, 0), (255 - second, second, 0, 0)


def turn(axis, angle):
    half = 0.5 * angle
    return tuple(as_float32(round(a * math.sin(half), 6)) for a in axis) + (as_float32(round(math.cos(half), 6)),)


def reed():
    document = Document()
    material = document.material("Reed", pbrMetallicRoughness={"metallicFactor": 0, "roughnessFactor": 0.7})
    surface = shape()
    attributes = document.attributes(surface)
    weights = [joint_weights(p) for p in surface.positions]
    attributes["JOINTS_0"] = document.accessor([w[0] for w in weights], UBYTE, "VEC4", 34962)
    attributes["WEIGHTS_0"] = document.accessor([w[1] for w in weights], UBYTE, "VEC4", 34962, normalized=True)
    swell = [(as_float32(round(0.8 * x, 5)), 0.0, as_float32(round(0.8 * z, 5))) for x, _, z in surface.positions]
    mesh = document.mesh_of("Reed", {"attributes": attributes, "indices": document.indices(surface),
                                     "material": material,
                                     "targets": [{"POSITION": document.accessor(swell, FLOAT, "VEC3", bounds=True)}]},
                            weights=[0])
    joints, parent = [], None
    for i in range(JOINTS):
        parent = document.node(f"Joint {i}", parent=parent, translation=[0, 0 if i == 0 else JOINT_LENGTH, 0])
        joints.append(parent)
    unbind = [(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, as_float32(round(-JOINT_LENGTH * i, 6)), 0, 1)
              for i in range(JOINTS)]
    document.json["skins"] = [{"name": "Reed", "joints": joints,
                               "inverseBindMatrices": document.accessor(unbind, FLOAT, "MAT4")}]
    node = document.node("Reed", mesh=mesh, skin=0)

    moments = [i / KEYS for i in range(KEYS + 1)]
    times = document.accessor([(time,) for time in moments], FLOAT, "SCALAR", bounds=True)
    samplers, channels = [], []

    def channel(target, path, rows, kind):
        samplers.append({"input": times, "output": document.accessor(rows, FLOAT, kind)})
        channels.append({"sampler": len(samplers) - 1, "target": {"node": target, "path": path}})
    for i, joint in enumerate(joints):
        axis = (0.6, 0.0, 0.8) if i % 2 else (0.0, 0.6, 0.8)
        channel(joint, "rotation",
                [turn(axis, 0.25 * math.sin(2 * math.pi * time + 0.7 * i) + 0.1 * i) for time in moments], "VEC4")
    channel(node, "weights", [(as_float32(round(0.5 - 0.5 * math.cos(2 * math.pi * time), 6)),) for time in moments],
            "SCALAR")
    document.json["animations"] = [{"name": "Bend", "samplers": samplers, "channels": channels}]
    return document.glb()
