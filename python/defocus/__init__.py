"""Renders glTF scenes with the depth of field of a real lens.

    import defocus

    image = defocus.render("scene.glb", f_stop=1.4, focus_node="Left eye")   # H×W×4 float32, linear
    defocus.write_image("out.exr", image)

Keywords are the settings of `defocus render` in snake_case: `defocus.settings()` and docs/settings.md list them with
their units, ranges and defaults. Numbers, booleans and paths have Python's types; choices are strings. A size, a pixel,
a point or a colour is a tuple, and `node_blur` is a dictionary. None leaves a setting unset.

Images are C-contiguous float32 arrays: H×W×4 (or H×W×3, or H×W for data), row 0 at the top, linear Rec.709, alpha
premultiplied. Rendered arrays are writable and own the renderer's pixels without a copy. Functions that take images
read such arrays in place.

Calls release the GIL, so that other threads run, and Ctrl-C cancels them. A function passed as `progress` is called as
progress(stage, done, total). An exception that it raises cancels the call and propagates to the caller.
"""

from __future__ import annotations

import json
import os
import sys
import typing as _typing
import warnings as _warnings
from typing import (
    TYPE_CHECKING, Any, Callable, Dict, Iterator, List, Literal, Mapping, NamedTuple, Optional, Tuple, Union)

import numpy

from . import _defocus
from ._defocus import Error, Scene, UsageError
from ._scene_data import Camera, Instance, Light, Material, Mesh, Texture, look_at
from ._scene_data import create as _create_scene
from ._settings import INFOS as _INFOS
from ._settings import refocus_request_of as _refocus_request_of
from ._settings import request_of as _request_of
from ._settings import takes_refocus_settings as _takes_refocus_settings
from ._settings import takes_settings as _takes_settings

if TYPE_CHECKING:
    from numpy.typing import ArrayLike
    from typing_extensions import Unpack

    from ._defocus import Array, Keywords, Path, Progress, RefocusKeywords
else:  # less exact types for typing.get_type_hints; importing numpy.typing would take longer than all other imports
    Array = numpy.ndarray
    ArrayLike = Any
    Keywords = RefocusKeywords = Any
    Path = Union[str, os.PathLike]
    Progress = Callable[[str, int, int], object]
    Unpack = Optional

__version__: str = _defocus.version
__all__ = [
    "Aovs", "Camera", "Difference", "Error", "FocalStack", "Instance", "Light", "LightField", "LightFieldInfo",
    "Material", "Mesh", "Renderer", "Scene", "Setting", "Statistics", "Texture", "UsageError", "compare", "look_at",
    "plan", "progressive", "pyramid", "read_image", "render", "settings", "write_image",
]

for _part in (Camera, Instance, Light, Material, Mesh, Texture, look_at):
    # Resolve the type hints (strings) before __module__ changes, because Python looks up their names in this module.
    _part.__annotations__ = _typing.get_type_hints(_part)
    _part.__module__ = __name__
Scene.create = staticmethod(_create_scene)  # type: ignore[assignment]

Error.__doc__ = """An error of a file, a name or the driver. The message says in one line what failed and what to do."""
UsageError.__doc__ = """An invalid request: an unknown keyword (also a TypeError), or a value out of range (also a
ValueError)."""


class Setting(NamedTuple):
    """Description of a keyword of render() and of all other functions that take settings."""

    keyword: str
    option: str  # command-line option
    group: str
    kind: Literal["number", "integer", "boolean", "text", "path", "choice", "other"]
    form: str  # syntax of the value on the command line: "PX", "X,Y,Z"
    unit: str  # empty: none
    range: Optional[Tuple[float, float]]  # min and max of a number; None for other kinds
    choices: Tuple[str, ...]
    default: Optional[str]  # None: unset
    methods: Tuple[str, ...]  # rendering methods with this setting; empty: all
    help: str


class Difference(NamedTuple):
    """Difference between two images, computed from display-encoded values in [0, 1] at EV 0 (sRGB, clipped)."""

    mae: float  # mean absolute error
    rmse: float  # root mean squared error
    psnr: float  # PSNR in dB; infinity for equal images
    ssim: float  # mean structural similarity (Wang et al. 2004), on luma
    flip: float  # mean FLIP (Andersson et al. 2020) at 67 pixels per degree
    max_error: float  # max absolute difference over all pixels and colour channels
    max_error_pixel: Tuple[int, int]  # (column, row) of the first pixel with max_error, in row-major order
    pixel_count: int
    non_finite: int  # number of pixels that are NaN or infinite in at least one image


class Aovs(NamedTuple):
    """Per-pixel data of the nearest surface at the pixel's centre in a pinhole view: H×W each."""

    depth: Array  # depth in m along the view axis; infinity for pixels without a surface
    coc: Array  # diameter of the circle of confusion in px; > 0 behind the focus plane, < 0 in front of it
    level: Array  # fractional level of detail of the object; −1 for pixels without a surface


class Statistics(NamedTuple):
    """Time, memory and triangle counts of a frame; times are wall-clock times."""

    samples: int
    positions: int  # number of subpixel positions per lens sample: 1 or 4
    load_milliseconds: float
    pyramid_milliseconds: float
    setup_milliseconds: float
    render_milliseconds: float
    triangles_drawn: int
    triangles_at_full_detail: int
    gpu_bytes: int
    device: str
    stopped: Literal["samples", "target error", "time limit", "nothing blurred"]  # why no more samples were drawn
    estimated_error: Optional[float]  # RMSE of the display-encoded image at EV 0; only with target_error or time_limit


class LightFieldInfo(NamedTuple):
    """Properties of the lens images in a file."""

    width: int  # px
    height: int  # px
    focus_distance: float  # focus distance of the rendered images, m
    f_stop: float  # f-number of the rendered aperture; refocusing cannot use a smaller one
    focal_length: float  # mm
    horizontal_aperture: float  # sensor width, mm
    focus_range: Tuple[float, float]  # focus distances in m that can be chosen
    full_disk: bool  # True: f-number and aperture shape can be chosen; False: both are fixed
    # For focus at s, the image of lens point (u, v) moves by pixels_per_dioptre · (1/s − 1/focus_distance) · (u, v) px.
    pixels_per_dioptre: float
    lens_points: List[List[float]]  # [u, v] of each image in the unit disk; u points right, v up


class FocalStack(NamedTuple):
    """Images that are focused at different distances, which divide the rendered range evenly in 1/distance, from the
    nearest to the farthest."""

    focus_distances: List[float]  # m
    pictures: List[Array]  # H×W×4 each


def settings() -> List[Setting]:
    """Returns descriptions of all keywords, in the order of `defocus render --help`."""
    rows = []
    for info in _INFOS.values():
        ranged = info.kind.name in ("number", "integer")
        rows.append(Setting(info.keyword, info.option, info.group, info.kind.name, info.metavar, info.unit,
                            (info.min, info.max) if ranged else None, tuple(info.choices), info.default_value,
                            tuple(info.methods), info.help))
    return rows


class Renderer:
    """Renders frames of one scene. Loads and simplifies its meshes once.

        with defocus.Renderer("scene.glb", samples=128) as renderer:
            for f_stop in (1.4, 2.8, 5.6):
                image = renderer.render(f_stop=f_stop)

    Settings given to `render` and `start` replace those of the constructor for that frame; None unsets a setting.
    Threads may share a renderer; its calls run one after another. `close()`, or the end of the `with` block, frees the
    renderer's memory.
    """

    @_takes_settings
    def __init__(self, scene: Union[Path, Scene, None] = None, *, progress: Optional[Progress] = None,
                 **settings: Unpack[Keywords]):
        self._scene = scene
        self._settings = settings
        self._warned: set = set()
        opened = scene if isinstance(scene, Scene) else None
        self._native = _defocus.Renderer(opened, self._request({}), _listener(progress))

    def _request(self, changes: Mapping[str, Any]) -> Any:
        return _request_of(self._scene, {**self._settings, **changes})

    def _warn(self) -> None:
        lines = [line for line in dict.fromkeys(self._native.warnings()) if line not in self._warned]
        self._warned.update(lines)
        _warn(lines)

    @_takes_settings
    def render(self, *, progress: Optional[Progress] = None, **settings: Unpack[Keywords]) -> Array:
        """Renders a frame and returns its image: H×W×4."""
        image = self._native.render(self._request(settings), _listener(progress))
        self._warn()
        return image

    @_takes_settings
    def progressive(self, **settings: Unpack[Keywords]) -> Iterator[Tuple[Array, int]]:
        """Renders a frame in steps. After each step, yields the image so far and its number of samples."""
        self.start(**settings)
        more = True
        while more:
            more = self.advance()
            yield self.image(), self.samples

    @_takes_settings
    def start(self, **settings: Unpack[Keywords]) -> None:
        """Starts a frame; each call of advance() then draws some of its samples."""
        self._native.start(self._request(settings))
        self._warn()

    def advance(self) -> bool:
        """Draws further samples. Returns False once the frame is complete."""
        return self._native.advance()

    def image(self) -> Array:
        """Returns the mean of the samples drawn so far: H×W×4."""
        return self._native.image()

    @property
    def samples(self) -> int:
        """Number of samples drawn so far."""
        return self._native.samples()

    @property
    def sample_total(self) -> int:
        """Number of samples in the complete frame."""
        return self._native.sample_total()

    @property
    def statistics(self) -> Statistics:
        """Statistics of the frame so far."""
        native = self._native.statistics()
        return Statistics(*(getattr(native, name) for name in Statistics._fields))

    @property
    def warnings(self) -> List[str]:
        """Warnings about the scene file and the request; each is also issued once as a Python warning."""
        return self._native.warnings()

    @property
    def scene(self) -> Scene:
        return self._native.scene()

    def aovs(self) -> Aovs:
        """Returns depth, circle of confusion and level of detail of the latest frame."""
        return Aovs(*self._native.aovs())

    def plan(self) -> Dict[str, Any]:
        """Returns the plan of the latest frame as a dictionary with the keys of `defocus plan --json`."""
        return json.loads(self._native.plan_json())

    def write(self, path: Path, image: ArrayLike) -> None:
        """Writes an image with the metadata of the latest frame. PNG and JPEG files use the settings' exposure and tone
        map."""
        self._native.write(path, _pixels(image))
        self._warn()

    def close(self) -> None:
        self._native.close()

    def __enter__(self) -> "Renderer":
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()


class LightField:
    """A file of lens images: views of the scene from points on the lens, one for each lens sample. Computes images with
    another focus, f-number and aperture shape ("pictures") from the lens images, without rendering.

        field = defocus.LightField.render("scene.lens.exr", "scene.glb", f_stop=1.4, samples=128)
        near = field.refocus(focus_distance=1.2)
        eye = field.refocus(focus_pixel=(512, 384), f_stop=2.8, blade_count=6)

    `LightField(path)` opens a file. The lens images stay in memory if they fit into half of the free memory;
    `close()`, or the end of a `with` block, frees them. Threads may share a light field; its calls run one after
    another.
    """

    def __init__(self, path: Path):
        self._native = _defocus.LightField(path)

    @classmethod
    @_takes_settings
    def render(cls, path: Path, scene: Union[Path, Scene, None] = None, *,
               focus_range: Optional[Tuple[float, float]] = None, progress: Optional[Progress] = None,
               **settings: Unpack[Keywords]) -> "LightField":
        """Renders the lens images of a scene to the file `path` (.exr), and opens it. `focus_range`: distances (near,
        far) in m to choose from later; default: from the nearest to the farthest visible surface."""
        opened = scene if isinstance(scene, Scene) else None
        field = cls.__new__(cls)
        field._native = _defocus.LightField.render(opened, _request_of(scene, settings), path, focus_range,
                                                   _listener(progress))
        _warn(field._native.warnings())
        return field

    @property
    def info(self) -> LightFieldInfo:
        native = self._native.info()
        return LightFieldInfo(*(getattr(native, name) for name in LightFieldInfo._fields))

    @_takes_refocus_settings
    def refocus(self, *, fill_gaps: bool = True, progress: Optional[Progress] = None,
                **settings: Unpack[RefocusKeywords]) -> Array:
        """Returns an image: H×W×4, linear. Keywords that are not given keep their values from rendering. `fill_gaps`
        blurs each lens image, so that blur does not show as separate copies of a surface."""
        return self._native.refocus(_refocus_request_of(settings), fill_gaps, _listener(progress))

    @_takes_refocus_settings
    def stack(self, count: int, *, fill_gaps: bool = True, progress: Optional[Progress] = None,
              **settings: Unpack[RefocusKeywords]) -> FocalStack:
        """Returns `count` images that are focused at different distances (a focal stack)."""
        return FocalStack(*self._native.stack(count, _refocus_request_of(settings), fill_gaps, _listener(progress)))

    def all_in_focus(self, *, progress: Optional[Progress] = None) -> Array:
        """Returns the view from the lens's centre, in which all surfaces are in focus: H×W×4."""
        return self._native.all_in_focus(_listener(progress))

    def depth(self) -> Array:
        """Returns the depths in m of the surfaces visible from the lens's centre: H×W; infinity for pixels without a
        surface."""
        return self._native.depth()

    @_takes_refocus_settings
    def coc(self, **settings: Unpack[RefocusKeywords]) -> Array:
        """Returns the signed diameters in px of the circles of confusion of the surfaces visible from the lens's
        centre: H×W; > 0 behind the focus plane."""
        return self._native.coc(_refocus_request_of(settings))

    def close(self) -> None:
        self._native.close()

    def __enter__(self) -> "LightField":
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()


@_takes_settings
def render(scene: Union[Path, Scene, None] = None, *, progress: Optional[Progress] = None,
           **settings: Unpack[Keywords]) -> Array:
    """Renders a scene (path of a glTF file, or a Scene) with depth of field and returns the image: H×W×4 float32,
    linear. Default scene: the built-in school of fish."""
    with Renderer(scene, progress=progress, **settings) as renderer:
        return renderer.render(progress=progress)


@_takes_settings
def progressive(scene: Union[Path, Scene, None] = None, *, progress: Optional[Progress] = None,
                **settings: Unpack[Keywords]) -> Iterator[Tuple[Array, int]]:
    """Renders an image in steps. After each step, yields the image so far and its number of lens samples:

        for image, samples in defocus.progressive("scene.glb", samples=1024):
            ...

    Each image is a new array. The renderer is freed with the generator, or by the generator's `close()`. The call
    raises an error for invalid keywords; the first step raises an error for a faulty scene.
    """
    _request_of(scene, settings)

    def images() -> Iterator[Tuple[Array, int]]:
        with Renderer(scene, progress=progress, **settings) as renderer:
            yield from renderer.progressive()

    return images()


def _refuse_open_scene(function: str, scene: Any) -> None:
    if isinstance(scene, Scene):
        raise UsageError(f"{function}() takes the path of a scene; for an open scene, use Renderer(scene).plan()")


@_takes_settings
def plan(scene: Optional[Path] = None, *, progress: Optional[Progress] = None,
         **settings: Unpack[Keywords]) -> Dict[str, Any]:
    """Returns the plan of a frame as a dictionary with the keys of `defocus plan --json`: blur, levels and samples of
    each object, and omitted parts with the reason. Needs no GPU and renders nothing."""
    _refuse_open_scene("plan", scene)
    return json.loads(_defocus.plan_json(_request_of(scene, settings), _listener(progress)))


@_takes_settings
def pyramid(scene: Optional[Path] = None, *, progress: Optional[Progress] = None, **settings: Unpack[Keywords]) -> Any:
    """Returns the levels of detail of each mesh of a scene, each with its number of triangles, and its mean edge length
    and error in mesh units."""
    _refuse_open_scene("pyramid", scene)
    return json.loads(_defocus.pyramid_json(_request_of(scene, settings), _listener(progress)))


def compare(reference: Union[Path, ArrayLike], test: Union[Path, ArrayLike]) -> Difference:
    """Returns the difference between two linear images of the same size, each an array or a path."""
    native = _defocus.compare(_pixels(reference), _pixels(test))
    return Difference(*(getattr(native, name) for name in Difference._fields))


def read_image(path: Path) -> Array:
    """Reads a PNG, JPEG, OpenEXR, Radiance HDR or TIFF file as linear float32: H×W×4, H×W×3 or H×W. Integer formats are
    decoded from sRGB, and straight alpha is premultiplied."""
    return _defocus.read_image(path)


def write_image(path: Path, image: ArrayLike, *, tone_map: Optional[Literal["none", "aces", "agx", "neutral"]] = None,
                exposure: Optional[float] = None) -> None:
    """Writes an .exr (32-bit float, linear), .png or .jpg file (8 bit, sRGB). `tone_map` (default: "neutral") and
    `exposure` (EV) apply to 8-bit files. The file is replaced atomically."""
    request = _request_of(None, {"tone_map": tone_map, "exposure": exposure})
    _defocus.write_image(path, _pixels(image), request)


def _listener(progress: Optional[Progress]) -> Optional[Progress]:
    if progress is not None and not callable(progress):
        raise UsageError(f"progress: {progress!r} is not a callable that takes stage, done and total")
    return progress


def _pixels(image: Union[Path, ArrayLike]) -> Array:
    """Returns an image (array or path) as float32 pixels that C++ can read in place. Copies arrays of other layouts."""
    if isinstance(image, (str, os.PathLike)):
        return read_image(image)
    array = numpy.asarray(image)
    if array.dtype.kind != "f":
        raise UsageError(f"an image must have linear float values, not {array.dtype}; divide by the maximum and decode")
    if array.ndim not in (2, 3) or (array.ndim == 3 and array.shape[2] not in (1, 3, 4)):
        shape = "×".join(map(str, array.shape))
        raise UsageError(f"an image must have the shape H×W or H×W×C with 1, 3 or 4 channels, not {shape}")
    in_place = array.dtype == numpy.float32 and all(0 < step and step % 4 == 0 for step in array.strides)
    if in_place and (array.ndim == 2 or array.shape[2] == 1 or array.strides[2] == 4):
        return array
    return numpy.ascontiguousarray(array, dtype=numpy.float32)


def _warn(lines: List[str]) -> None:
    """Issues `lines` as Python warnings, attributed to the first caller outside this package."""
    level = 1
    while sys._getframe(level).f_globals.get("__name__", "").split(".")[0] == __name__:
        level += 1
    for line in lines:
        _warnings.warn(line, stacklevel=level + 1)


def __dir__() -> List[str]:
    return sorted([*__all__, "__version__"])
