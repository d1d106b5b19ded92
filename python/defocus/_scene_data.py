"""Defines the parts of a scene (meshes, cameras, lights …) that Scene.create takes, and converts them to C++."""

from __future__ import annotations

import dataclasses
import math
import numbers
import re
from typing import (
    TYPE_CHECKING, Any, Callable, Dict, Iterable, Literal, Mapping, Optional, Sequence, Tuple, TypeVar, Union)

import numpy

from . import _defocus
from ._settings import request_of as _request_of

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray
else:  # less exact types for typing.get_type_hints; importing numpy.typing would take longer than all other imports
    ArrayLike = Any
    NDArray = Iterable

Part = TypeVar("Part")
Color = Sequence[float]


@dataclasses.dataclass(eq=False)
class Texture:
    """An image of linear floats in [0, 1]: H×W, H×W×3 or H×W×4, with the top row first. It is stored with 8 bits per
    channel."""

    image: ArrayLike
    # "color": linear Rec.709 with premultiplied alpha; "data": linear values, such as normals
    content: Literal["color", "data"] = "color"
    straight_alpha: bool = False  # True: the alpha of the colours is straight, not premultiplied
    wrap_u: Literal["repeat", "clamp_to_edge", "mirrored_repeat"] = "repeat"
    wrap_v: Literal["repeat", "clamp_to_edge", "mirrored_repeat"] = "repeat"
    magnification: Literal["nearest", "linear"] = "linear"
    minification: Literal["nearest", "linear"] = "linear"
    mipmaps: bool = True
    name: str = ""


@dataclasses.dataclass(eq=False)
class Material:
    """A metallic-roughness material of glTF. Texture values multiply the factors of the same name. Base colour and
    emission need textures with the content "color"; all others need "data"."""

    base_color: Color = (1, 1, 1, 1)  # RGB or RGBA in [0, 1], linear
    base_color_texture: Optional[Texture] = None
    metallic: float = 1
    roughness: float = 1
    metallic_roughness_texture: Optional[Texture] = None  # roughness in G, metalness in B
    normal_texture: Optional[Texture] = None  # (n + 1)/2 for the normal n in tangent space, +y up
    normal_scale: float = 1
    occlusion_texture: Optional[Texture] = None  # texture with occlusion in R
    occlusion_strength: float = 1
    emission: Color = (0, 0, 0)  # emitted radiance, ≥ 0
    emission_texture: Optional[Texture] = None
    alpha_mode: Literal["opaque", "mask", "blend"] = "opaque"
    alpha_cutoff: float = 0.5
    double_sided: bool = False
    unlit: bool = False  # True: the base colour is shown without lighting
    ior: float = 1.5
    transmission: float = 0
    transmission_texture: Optional[Texture] = None  # texture with transmission in R
    thickness: float = 0  # in mesh units; 0: thin wall without refraction
    attenuation_distance: float = math.inf
    attenuation_color: Color = (1, 1, 1)
    name: str = ""


@dataclasses.dataclass(eq=False)
class Mesh:
    """Triangles with one material. Arrays of vertex attributes have one row per vertex."""

    positions: ArrayLike  # N×3
    # M×3 integers; front faces are counter-clockwise. Default: 0, 1, 2, then 3, 4, 5 …
    indices: Optional[ArrayLike] = None
    normals: Optional[ArrayLike] = None  # N×3, any length > 0. Default: flat shading
    uvs: Optional[ArrayLike] = None  # N×2; (0, 0) is the texture's top left corner, (1, 1) its bottom right
    colors: Optional[ArrayLike] = None  # N×3 or N×4 floats in [0, 1], linear, straight alpha
    material: Optional[Material] = None  # None: glTF's default material
    name: str = ""


@dataclasses.dataclass(eq=False)
class Instance:
    """An object of the scene: a mesh with a transform."""

    mesh: Mesh
    transform: Optional[ArrayLike] = None  # 4×4, with the translation in the last column. Default: the identity
    name: str = ""  # name of the node. Default: the mesh's name


@dataclasses.dataclass(eq=False)
class Camera:
    """A camera that looks along the −z axis of its transform; see look_at."""

    transform: Optional[ArrayLike] = None  # 4×4. Default: the identity
    yfov: float = 0.6911112  # full vertical angle in radians; unused if lens has a focal length
    znear: float = 0.01  # scene units; nearer surfaces are invisible
    focus_distance: Optional[float] = None  # scene units along the view axis. Default: automatic, like focus_auto
    lens: Mapping[str, Any] = dataclasses.field(default_factory=dict)  # settings of the lens, such as {"f_stop": 1.4}
    name: str = ""


@dataclasses.dataclass(eq=False)
class Light:
    """A light of KHR_lights_punctual that shines along the −z axis of its transform; see look_at."""

    type: Literal["directional", "point", "spot"] = "directional"
    transform: Optional[ArrayLike] = None  # 4×4. Default: the identity
    color: Color = (1, 1, 1)
    intensity: float = 1  # illuminance in lux (directional) or intensity in candela (point, spot)
    range: float = 0  # range in scene units; 0: unlimited
    inner_cone_angle: float = 0  # angle of a spot light from the axis, radians
    outer_cone_angle: float = math.pi / 4
    angular_diameter: float = 0.00925  # angular diameter of a directional light in radians; softens shadows
    radius: float = 0.03  # radius of a point or spot light in m; softens shadows
    name: str = ""


def look_at(position: Sequence[float], target: Sequence[float],
            up: Sequence[float] = (0, 1, 0)) -> NDArray[numpy.float64]:
    """Returns the 4×4 transform of a camera or light at `position` that looks at `target`."""
    points = [_numbers("look_at", name, value, 3) for name, value in
              (("position", position), ("target", target), ("up", up))]
    return numpy.array(_native(_defocus.look_at, *points)).reshape(4, 4).T.copy()


def create(instances: Iterable[Union[Instance, Mesh]], *, cameras: Iterable[Camera] = (), lights: Iterable[Light] = (),
           name: str = "", metres_per_unit: float = 1) -> _defocus.Scene:
    """Creates a scene and copies its arrays. A Mesh among the instances is placed at the origin. Without cameras, the
    renderer adds a camera that frames the scene; without lights, it adds studio lights."""
    instances = [Instance(item) if isinstance(item, Mesh) else _checked(item, Instance) for item in _items(instances)]
    meshes = _distinct((_checked(instance.mesh, Mesh) for instance in instances), Mesh)
    materials = _distinct((mesh.material for mesh in meshes), Material)
    textures = _distinct((getattr(material, key) for material in materials for key in _texture_fields), Texture)
    return _native(
        _defocus.create_scene, [_mesh(mesh, index, materials) for index, mesh in enumerate(meshes)],
        [_plain(_defocus.MaterialData(), material, index, textures) for index, material in enumerate(materials)],
        [_texture(texture, index) for index, texture in enumerate(textures)],
        [_plain(_defocus.InstanceData(), instance, index, meshes) for index, instance in enumerate(instances)],
        [_camera(_checked(camera, Camera), index) for index, camera in enumerate(_items(cameras))],
        [_plain(_defocus.LightData(), _checked(light, Light), index) for index, light in enumerate(_items(lights))],
        str(name), _number("Scene.create", "metres_per_unit", metres_per_unit))


# ---- conversion of the parts of a scene ------------------------------------------------------------------------------

_texture_fields = [field.name for field in dataclasses.fields(Material) if field.name.endswith("_texture")]
_choices = {"content": _defocus.TextureContent, "wrap_u": _defocus.TextureWrap, "wrap_v": _defocus.TextureWrap,
            "magnification": _defocus.TextureFilter, "minification": _defocus.TextureFilter,
            "alpha_mode": _defocus.AlphaMode, "type": _defocus.LightType}


def _items(parts: Any) -> list:
    """Returns the instances, cameras or lights as a list; a single one becomes a list with one entry."""
    single = (Instance, Mesh, Camera, Light)
    try:
        return [parts] if isinstance(parts, single) else list(parts)
    except TypeError:
        raise _defocus.UsageError(f"Scene.create: {parts!r} is not a list of parts") from None


def _checked(part: Any, kind: type) -> Any:
    if not isinstance(part, kind):
        raise _defocus.UsageError(f"Scene.create: {part!r} is not a defocus.{kind.__name__}")
    return part


def _distinct(parts: Iterable[Optional[Part]], kind: type) -> Dict[Part, int]:
    """Returns a dictionary from each distinct mesh, material or texture to its index, in order of first use. Skips
    None."""
    return {part: index for index, part in
            enumerate(dict.fromkeys(_checked(part, kind) for part in parts if part is not None))}


def _label(part: Any, index: int) -> str:
    kind = type(part).__name__.lower()
    return f"{kind} '{part.name}' ({index})" if part.name else f"{kind} {index}"


def _plain(native: Any, part: Any, index: int, indices: Optional[Mapping[Any, int]] = None,
           skip: Sequence[str] = ()) -> Any:
    """Copies the fields of `part` to `native`, the C++ struct with the same members, and returns `native`. `indices`
    maps referenced textures or meshes to their indices."""
    label = _label(part, index)
    for field in dataclasses.fields(part):
        key, value = field.name, getattr(part, field.name)
        if key in skip:
            continue
        if key in _choices:
            value = _choice(label, key, value)
        elif key == "transform":
            value = _transform(label, value)
        elif key.endswith("_texture") or key == "mesh":
            value = -1 if value is None or indices is None else indices[value]
        elif key in ("color", "emission", "attenuation_color"):
            value = _numbers(label, key, value, 3)
        elif key == "base_color":
            value = (*_numbers(label, key, value, 3, 4), 1.0)[:4]
        elif isinstance(field.default, bool):
            value = bool(value)
        elif isinstance(field.default, numbers.Real):
            value = _number(label, key, value)
        elif key == "name":
            value = str(value)
        setattr(native, key, value)
    return native


def _mesh(mesh: Mesh, index: int, materials: Mapping[Material, int]) -> Any:
    label = _label(mesh, index)
    native = _defocus.MeshData()
    native.name = str(mesh.name)
    native.material = -1 if mesh.material is None else materials[mesh.material]
    native.positions = _rows(label, "positions", mesh.positions, 3)
    if mesh.normals is not None:
        native.normals = _rows(label, "normals", mesh.normals, 3)
    if mesh.uvs is not None:
        native.uvs = _rows(label, "uvs", mesh.uvs, 2)
    if mesh.colors is not None:
        native.colors = _colors(label, mesh.colors)
    if mesh.indices is not None:
        native.indices = _indices(label, mesh.indices)
    return native


def _texture(texture: Texture, index: int) -> Any:
    native = _plain(_defocus.TextureData(), texture, index, skip=["image"])
    image = numpy.asarray(texture.image)
    label = _label(texture, index)
    if image.dtype.kind != "f":
        raise _defocus.UsageError(f"{label}: an image holds linear floats, not {image.dtype}; divide by the range and "
                                  "decode first")
    if image.ndim not in (2, 3):
        raise _defocus.UsageError(f"{label}: an image is H×W or H×W×channels, not {_shape(image)}")
    native.image = _float32(image)
    return native


def _camera(camera: Camera, index: int) -> Any:
    native = _plain(_defocus.CameraData(), camera, index, skip=["focus_distance", "lens"])
    label = _label(camera, index)
    if camera.focus_distance is not None:
        native.focus_distance = _number(label, "focus_distance", camera.focus_distance)
    if not isinstance(camera.lens, Mapping):
        raise _defocus.UsageError(f"{label}: lens is not a dictionary of settings")
    given = {keyword: value for keyword, value in camera.lens.items() if value is not None}
    try:
        for keyword, value in given.items():
            if not native.set_lens(_request_of(None, {keyword: value})):
                raise _defocus.UsageError(f"'{keyword}' is no setting of the lens")
        native.set_lens(_request_of(None, given))
    except _defocus.UsageError as error:
        raise _defocus.UsageError(f"{label}: {error}") from None
    return native


_fields = {field.name for kind in (Texture, Material, Mesh, Instance, Camera, Light)
           for field in dataclasses.fields(kind)}
_snake_case = {re.sub("_(.)", lambda match: match[1].upper(), name): name
               for name in (*_fields, "metres_per_unit", "look_at") if "_" in name}


def _native(function: Callable[..., Any], *arguments: Any) -> Any:
    """Calls a C++ function and returns its result. Replaces camelCase members in its error messages by snake_case."""
    try:
        return function(*arguments)
    except _defocus.UsageError as error:
        pattern = rf"\b({'|'.join(_snake_case)})\b"
        raise _defocus.UsageError(re.sub(pattern, lambda match: _snake_case[match[1]], str(error))) from None


# ---- checks and conversion of values ---------------------------------------------------------------------------------


def _shape(array: numpy.ndarray) -> str:
    if array.ndim == 1:
        return f"{array.size} values"
    return "×".join(map(str, array.shape)) or "a single value"


def _float32(array: numpy.ndarray) -> numpy.ndarray:
    with numpy.errstate(over="ignore"):  # values that overflow to infinity are reported by the C++ code
        return numpy.ascontiguousarray(array, dtype=numpy.float32)


def _rows(label: str, name: str, value: Any, *columns: int) -> numpy.ndarray:
    """Returns `value` as a 2D float32 array; its number of columns must be one of `columns`."""
    array = numpy.asarray(value)
    if array.ndim != 2 or array.shape[1] not in columns:
        wanted = " or ".join(f"N×{count}" for count in columns)
        raise _defocus.UsageError(f"{label}: {name} is {_shape(array)}, not {wanted}")
    if array.dtype.kind not in "fiu":
        raise _defocus.UsageError(f"{label}: {name} holds {array.dtype}, not numbers")
    if len(array) == 0:
        raise _defocus.UsageError(f"{label}: {name} is empty")
    return _float32(array)


def _colors(label: str, value: Any) -> numpy.ndarray:
    colors = _rows(label, "colors", value, 3, 4)
    if numpy.asarray(value).dtype.kind != "f":
        raise _defocus.UsageError(f"{label}: colors are linear floats; divide integers by the range and decode first")
    return colors if colors.shape[1] == 4 else numpy.hstack([colors, numpy.ones((len(colors), 1), numpy.float32)])


def _indices(label: str, value: Any) -> numpy.ndarray:
    array = numpy.asarray(value)
    if array.size == 0:
        raise _defocus.UsageError(f"{label}: indices is empty, so the mesh has no triangles")
    if array.dtype.kind not in "iu":
        raise _defocus.UsageError(f"{label}: indices are integers, not {array.dtype}")
    if array.ndim != 1 and (array.ndim != 2 or array.shape[1] != 3):
        raise _defocus.UsageError(f"{label}: indices is {_shape(array)}, not M×3")
    limit = numpy.iinfo(numpy.uint32).max
    if array.min() < 0 or array.max() > limit:
        raise _defocus.UsageError(f"{label}: index {array.min() if array.min() < 0 else array.max()} is not from 0 to "
                                  f"{limit}")
    return numpy.ascontiguousarray(array, dtype=numpy.uint32).reshape(-1)


def _transform(label: str, value: Any) -> list:
    """Returns the matrix as 16 numbers in column-major order."""
    array = numpy.eye(4) if value is None else numpy.asarray(value)
    if array.shape != (4, 4) or array.dtype.kind not in "fiu":
        raise _defocus.UsageError(f"{label}: transform is {_shape(array)} of {array.dtype}, not 4×4 numbers")
    if not (array[3] == (0, 0, 0, 1)).all():
        raise _defocus.UsageError(f"{label}: the last row of transform is {array[3].tolist()}, not 0, 0, 0, 1; the "
                                  "translation stands in the last column")
    return array.T.ravel().tolist()


def _choice(label: str, name: str, value: Any) -> Any:
    members = _choices[name].__members__
    if value not in members:
        raise _defocus.UsageError(f"{label}: {name} is {value!r}; it must be one of {', '.join(members)}")
    return members[value]


def _number(label: str, name: str, value: Any) -> float:
    if isinstance(value, (numbers.Real, numpy.bool_)):
        return float(value)
    raise _defocus.UsageError(f"{label}: {name} is {value!r}, not a number")


def _numbers(label: str, name: str, value: Any, *counts: int) -> Tuple[float, ...]:
    try:
        values = tuple(value)
    except TypeError:
        values = ()
    if len(values) not in counts:
        raise _defocus.UsageError(f"{label}: {name} is {value!r}, not {' or '.join(map(str, counts))} numbers")
    return tuple(_number(label, name, part) for part in values)
