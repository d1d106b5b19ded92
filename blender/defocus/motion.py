"""Exports motion blur: an animation in the glTF file moves objects and camera while the shutter is open."""

import base64
import math
import struct

from mathutils import Quaternion

SEGMENTS = 4  # number of straight segments that approximate the path of a moving object
# The exporter rotates cameras and lights, because they look along a different axis in glTF's coordinate system.
TURNED = Quaternion((math.sqrt(0.5), -math.sqrt(0.5), 0, 0))
FLOAT = 5126  # glTF's component type for floats


def exposure_of(scene):
    """Returns the exposure time in s and the frame numbers at which to sample it; (0, []) without motion blur."""
    render = scene.render
    if not render.use_motion_blur or render.motion_blur_shutter <= 0:
        return 0, []
    begin = {"start": 0, "end": -1}.get(scene.defocus.shutter_position, -0.5)
    first = scene.frame_current + scene.frame_subframe + begin * render.motion_blur_shutter
    frames = [first + render.motion_blur_shutter * i / SEGMENTS for i in range(SEGMENTS + 1)]
    return render.motion_blur_shutter * render.fps_base / render.fps, frames


def instance_key(instance):
    """Returns a key that is the same in all frames for the same instance of an object."""
    parent = instance.parent.name if instance.parent else ""
    return instance.object.name, parent, tuple(instance.persistent_id)


def poses_at(depsgraph):
    """Returns the matrices of all instances and of the camera (key None) at the depsgraph's time."""
    poses = {instance_key(instance): instance.matrix_world.copy() for instance in depsgraph.object_instances}
    camera = depsgraph.scene_eval.camera
    if camera is not None:
        poses[None] = camera.evaluated_get(depsgraph).matrix_world.copy()
    return poses


def poses_during(engine, depsgraph, frames):
    """Returns the poses at each of the frames. Sets the depsgraph back to its original frame."""
    if not frames:
        return []
    scene = depsgraph.scene
    shown, fraction = scene.frame_current, scene.frame_subframe
    poses = []
    try:
        for frame in frames:
            engine.frame_set(math.floor(frame), frame - math.floor(frame))
            poses.append(poses_at(depsgraph))
    finally:
        engine.frame_set(shown, fraction)
    return poses


def transforms(matrices, turned):
    """Returns the translations, rotations and scales of matrices in glTF's axes."""
    translations, rotations, scales = [], [], []
    last = None
    for matrix in matrices:
        place, rotation, scale = matrix.decompose()
        if turned:
            rotation = rotation @ TURNED
        if last is not None:
            rotation.make_compatible(last)
        last = rotation
        translations.append((place.x, place.z, -place.y))
        rotations.append((rotation.x, rotation.z, -rotation.y, rotation.w))
        scales.append((scale.x, scale.z, scale.y))
    return {"translation": translations, "rotation": rotations, "scale": scales}


def add_accessor(content, rows, minimum=None, maximum=None):
    """Adds a buffer with rows of floats to glTF content; returns the index of its accessor."""
    values = [value for row in rows for value in row]
    data = struct.pack(f"<{len(values)}f", *values)
    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    content.setdefault("buffers", []).append({"byteLength": len(data), "uri": uri})
    content.setdefault("bufferViews", []).append({"buffer": len(content["buffers"]) - 1, "byteLength": len(data)})
    accessor = {"bufferView": len(content["bufferViews"]) - 1, "componentType": FLOAT, "count": len(rows),
                "type": {1: "SCALAR", 3: "VEC3", 4: "VEC4"}[len(rows[0])]}
    if minimum is not None:
        accessor |= {"min": [minimum], "max": [maximum]}
    content.setdefault("accessors", []).append(accessor)
    return len(content["accessors"]) - 1


def add_motion(content, nodes, seconds, poses):
    """Adds an animation of `seconds` to glTF content, and returns whether any node moves.

    nodes: list of (node index, key of its instance, whether the exporter rotates its axes).
    """
    samplers, channels = [], []
    times = None
    for node, key, turned in nodes:
        matrices = [pose.get(key) for pose in poses]
        if None in matrices or all(matrix == matrices[0] for matrix in matrices):
            continue
        if times is None:
            times = add_accessor(content, [(seconds * i / SEGMENTS,) for i in range(SEGMENTS + 1)], 0, seconds)
        for path, rows in transforms(matrices, turned).items():
            samplers.append({"input": times, "output": add_accessor(content, rows)})
            channels.append({"sampler": len(samplers) - 1, "target": {"node": node, "path": path}})
    if channels:
        content.setdefault("animations", []).append({"name": "shutter", "samplers": samplers, "channels": channels})
    return bool(channels)
