"""Converts Blender's camera to command-line options of `defocus`.

Blender can shift the camera, and can render only a part of the frame. `defocus` can do neither, so it draws a larger
image centred on the optical axis, the canvas. The image that Blender shows is a part of the canvas.
"""

import dataclasses
import math

from .failure import Failure


@dataclasses.dataclass
class View:
    """Sizes in px of the canvas (the image that `defocus` draws) and of the part that Blender shows; y points up."""

    width: int  # size of the canvas, the image that `defocus` draws
    height: int
    x: int  # lower left corner of the part that Blender shows, relative to the canvas's lower left corner
    y: int
    picture_width: int
    picture_height: int
    sensor_width: float  # width that the canvas (the image that `defocus` draws) has on the sensor, mm


def frame_size(render):
    """Returns the size in pixels of the whole frame, as if there were no render border."""
    share = render.resolution_percentage / 100
    return int(render.resolution_x * share), int(render.resolution_y * share)


def border(render):
    """Returns the left, right, lower and upper edges of the rendered part of the frame, in pixels."""
    width, height = frame_size(render)
    if not render.use_border:
        return 0, width, 0, height
    return (int(render.border_min_x * width), int(render.border_max_x * width),
            int(render.border_min_y * height), int(render.border_max_y * height))


def picture_size(render):
    """Returns the size of the rendered part of the frame in pixels."""
    left, right, bottom, top = border(render)
    return right - left, top - bottom


def fit_is_horizontal(camera, width, height):
    if camera.sensor_fit == "AUTO":
        return width >= height
    return camera.sensor_fit == "HORIZONTAL"


def margin(shift):
    """Returns how many pixels a camera shift adds to the canvas, and how many of these lie left of or below the frame.

    The shift, in pixels, may be negative; it is rounded to the nearest half pixel.
    """
    halves = round(2 * shift)
    return abs(halves), max(halves, 0)


def view_of(camera, render):
    """Returns the View of a camera's data. Raises Failure if the camera is not a perspective camera."""
    if camera.type != "PERSP":
        kind = {"ORTHO": "orthographic", "PANO": "panoramic"}.get(camera.type, camera.type.lower())
        raise Failure(f"The camera '{camera.name}' is {kind}; Defocus needs a perspective camera")
    width, height = frame_size(render)
    horizontal = fit_is_horizontal(camera, width, height)
    # Blender uses sensor_height only with a vertical fit; an automatic fit puts sensor_width along the longer side.
    sensor = camera.sensor_height if camera.sensor_fit == "VERTICAL" else camera.sensor_width
    sensor_width = sensor if horizontal else sensor * width / height

    longer = width if horizontal else height
    add_x, x = margin(camera.shift_x * longer)
    add_y, y = margin(camera.shift_y * longer)
    left, _, bottom, _ = border(render)
    return View(width + add_x, height + add_y, x + left, y + bottom, *picture_size(render), sensor_width * (width + add_x) / width)


def focus_distance(camera_object):
    """Returns the distance from the camera to the focus plane along the view axis, in m."""
    dof = camera_object.data.dof
    if dof.focus_object is None:
        return dof.focus_distance
    target = dof.focus_object.matrix_world
    bone = dof.focus_subtarget and dof.focus_object.type == "ARMATURE" and dof.focus_object.pose.bones.get(dof.focus_subtarget)
    if bone:
        target = target @ bone.matrix
    axis = -camera_object.matrix_world.col[2].xyz.normalized()
    return abs(axis.dot(target.translation - camera_object.matrix_world.translation))


def camera_words(camera_object, view):
    """Returns the command-line options of `defocus` for an evaluated camera."""
    camera, dof = camera_object.data, camera_object.data.dof
    words = ["--size", f"{view.width}x{view.height}", "--units", "m",
             "--focal-length", f"{camera.lens:.7g}mm", "--horizontal-aperture", f"{view.sensor_width:.7g}mm"]
    if not dof.use_dof:
        return words + ["--no-dof"]
    words += ["--fstop", f"{dof.aperture_fstop:.7g}", "--focus-distance", f"{max(focus_distance(camera_object), 1e-5):.7g}m",
              "--anamorphic-ratio", f"{dof.aperture_ratio:.7g}"]
    if dof.aperture_blades >= 3:
        # At rotation 0, the rightmost point of the aperture is the middle of an edge in Blender, but a corner in
        # `defocus`.
        rotation = math.degrees(dof.aperture_rotation) + 180 / dof.aperture_blades
        words += ["--blades", str(dof.aperture_blades), "--blade-rotation", f"{rotation:.7g}"]
    return words
