# Types of the package `defocus`. scripts/python_stubs.py writes the classes of keywords from the settings table.

import os
from dataclasses import dataclass
from typing import Any, Callable, ContextManager, Dict, Iterable, Iterator, List, Literal, Mapping, NamedTuple, Optional, Sequence, Tuple, Union

import numpy
import numpy.typing
from typing_extensions import TypedDict, Unpack

Array = numpy.typing.NDArray[numpy.float32]
Path = Union[str, os.PathLike[str]]
Progress = Callable[[str, int, int], object]
Point = Tuple[float, float, float]
Pixel = Tuple[int, int]

__version__: str
__all__: List[str]

# ---- keywords, from the settings table ----

class Keywords(TypedDict, total=False):
    strict: Optional[bool]
    variant: Optional[str]
    fish_count: Optional[int]
    triangles_per_fish: Optional[int]
    units: Optional[Union[float, Literal["auto", "m", "cm", "mm"]]]
    time: Optional[float]  # s
    clip: Optional[str]
    loop: Optional[bool]
    shutter: Optional[Union[float, str]]  # s
    shutter_position: Optional[Literal["start", "centre", "end"]]
    motion_segments: Optional[Union[int, str]]
    environment: Optional[Path]
    environment_rotation: Optional[float]  # degrees
    background: Optional[Union[str, Point]]
    ground: Optional[bool]
    hide: Optional[Union[List[str], str]]
    shadows: Optional[Literal["auto", "on", "off"]]
    multiple_scattering: Optional[bool]
    light_angle: Optional[float]  # degrees
    light_radius: Optional[float]  # m
    camera: Optional[str]
    camera_from: Optional[Path]
    camera_position: Optional[Union[Point, str]]  # m
    camera_target: Optional[Union[Point, str]]  # m
    camera_up: Optional[Union[Point, str]]
    size: Optional[Union[Tuple[int, int], str]]  # px
    preset: Optional[Literal["jeong2011", "tzeng2012", "scheuermann2004", "garcia2018", "lee2010", "munkberg2012"]]
    samples: Optional[Union[int, Literal["auto"]]]
    positions: Optional[Union[int, Literal["auto"]]]
    quality: Optional[Literal["draft", "good", "fine"]]
    target_error: Optional[float]
    time_limit: Optional[Union[float, str]]  # s
    sequence: Optional[Literal["sobol", "halton", "scrambled-halton", "r2"]]
    seed: Optional[int]
    lod: Optional[Literal["auto", "fractional", "continuous", "nearest", "off"]]
    blur_threshold: Optional[float]
    size_threshold: Optional[float]  # px
    light_threshold: Optional[float]  # px
    cache_folder: Optional[Path]
    no_cache: Optional[bool]
    focal_length: Optional[float]  # mm
    f_stop: Optional[float]
    focus_distance: Optional[float]  # m
    focus_node: Optional[str]
    focus_pixel: Optional[Union[Pixel, str]]
    focus_points: Optional[Union[Sequence[Pixel], str]]
    focus_auto: Optional[bool]
    horizontal_aperture: Optional[float]  # mm
    dof_enabled: Optional[bool]
    blur_scale: Optional[float]
    focus_breathing: Optional[bool]
    exposure_time: Optional[Union[float, str]]  # s
    iso: Optional[float]
    blade_count: Optional[int]
    blade_rotation: Optional[float]  # degrees
    blade_curvature: Optional[float]
    anamorphic_ratio: Optional[float]
    obstruction: Optional[float]
    spherical_aberration: Optional[float]
    cat_eye: Optional[float]
    axial_chromatic_aberration: Optional[float]  # dioptres
    astigmatism: Optional[float]  # mm
    coma: Optional[float]  # mm
    foreground_limit: Optional[float]  # px
    background_limit: Optional[float]  # px
    focus_range_front: Optional[float]  # m
    focus_range_behind: Optional[float]  # m
    focus_range_refocuses: Optional[bool]
    focus_tilt: Optional[float]  # degrees
    focus_swing: Optional[float]  # degrees
    field_curvature: Optional[float]
    radial_blur_gain: Optional[float]
    aperture_image: Optional[Path]
    node_blur: Optional[Union[Mapping[str, float], str]]
    method: Optional[str]
    layer_format: Optional[Literal["automatic", "rgba16f", "rgba32f"]]
    exr_layers: Optional[str]
    exr_names: Optional[Literal["nuke", "blender"]]
    tone_map: Optional[Literal["none", "aces", "agx", "neutral"]]
    exposure: Optional[Union[float, Literal["auto"]]]  # EV
    lod_metric: Optional[Literal["automatic", "size", "error", "measured", "proportional", "score"]]
    level_vertices: Optional[Literal["fitted", "surviving", "quarters"]]
    lod_coc: Optional[Literal["smallest", "centre"]]
    coc_tolerance: Optional[float]  # px
    keep_all: Optional[bool]
    memory: Optional[str]
    wave: Optional[int]
    threads: Optional[int]
    coc: Optional[Literal["published", "thin-lens"]]
    taps: Optional[int]
    max_coc: Optional[Literal["published", "unlimited"]]
    bits: Optional[Literal["16", "8"]]
    multisampling: Optional[Literal["1", "4"]]
    near_blur_depth: Optional[float]
    focal_plane_depth: Optional[float]
    far_blur_depth: Optional[float]
    blurriness_cutoff: Optional[float]
    transparency_buckets: Optional[int]
    pinholes: Optional[int]
    near_components: Optional[int]
    far_components: Optional[int]
    resolution: Optional[Literal["full", "half", "quarter"]]
    kernel: Optional[Literal["fitted", "rescaled", "published"]]
    kernel_taps: Optional[Literal["exact", "eight"]]
    storage: Optional[Literal["float", "half", "r10g10b10a2"]]
    near_field: Optional[Literal["premultiplied", "coverage"]]
    blend_bias: Optional[float]
    bias_by: Optional[Literal["constant", "luminance"]]
    convolution: Optional[Literal["separable", "direct"]]
    layers: Optional[int]
    shading: Optional[Literal["surfaces", "vertices"]]
    coc_interpolation: Optional[Literal["divided", "linear"]]
    resolve: Optional[Literal["exact", "published"]]
    segments: Optional[int]
    shading_step: Optional[int]
    interval_bits: Optional[Literal["64", "16"]]
    line_weights: Optional[Literal["area", "length"]]
    lines_per_position: Optional[int]
    bin_size: Optional[int]
    wheel: Optional[Literal["turned", "shared"]]

class RefocusKeywords(TypedDict, total=False):
    f_stop: Optional[float]
    focus_distance: Optional[float]  # m
    focus_pixel: Optional[Union[Pixel, str]]
    blade_count: Optional[int]
    blade_rotation: Optional[float]  # degrees
    blade_curvature: Optional[float]
    anamorphic_ratio: Optional[float]
    obstruction: Optional[float]
    spherical_aberration: Optional[float]
    aperture_image: Optional[Path]

# ---- end of keywords ----

class Error(RuntimeError): ...
class UsageError(Error, TypeError, ValueError): ...

class Setting(NamedTuple):
    keyword: str
    option: str
    group: str
    kind: Literal["number", "integer", "boolean", "text", "path", "choice", "other"]
    form: str
    unit: str
    range: Optional[Tuple[float, float]]
    choices: Tuple[str, ...]
    default: Optional[str]
    methods: Tuple[str, ...]
    help: str

class Difference(NamedTuple):
    mae: float
    rmse: float
    psnr: float
    ssim: float
    flip: float
    max_error: float
    max_error_pixel: Pixel
    pixel_count: int
    non_finite: int

class Aovs(NamedTuple):
    depth: Array
    coc: Array
    level: Array

class Statistics(NamedTuple):
    samples: int
    load_milliseconds: float
    pyramid_milliseconds: float
    setup_milliseconds: float
    render_milliseconds: float
    triangles_drawn: int
    triangles_at_full_detail: int
    gpu_bytes: int
    device: str
    stopped: Literal["samples", "target error", "time limit", "nothing blurred"]
    estimated_error: Optional[float]

class Scene:
    def __init__(self, path: Path, *, variant: str = "", progress: Optional[Progress] = None) -> None: ...
    @staticmethod
    def school_of_fish(
        fish_count: int = 20, triangles_per_fish: int = 90_000, *, progress: Optional[Progress] = None
    ) -> Scene: ...
    @property
    def name(self) -> str: ...
    @property
    def cameras(self) -> List[str]: ...
    @property
    def nodes(self) -> List[str]: ...
    @property
    def variants(self) -> List[str]: ...
    @property
    def clips(self) -> List[str]: ...
    @property
    def triangles(self) -> int: ...
    @property
    def ignored(self) -> List[str]: ...

    @staticmethod
    def create(
        instances: Iterable[Union[Instance, Mesh]],
        *,
        cameras: Iterable[Camera] = (),
        lights: Iterable[Light] = (),
        name: str = "",
        metres_per_unit: float = 1,
    ) -> Scene: ...

@dataclass(eq=False)
class Texture:
    image: numpy.typing.ArrayLike
    content: Literal["color", "data"] = "color"
    straight_alpha: bool = False
    wrap_u: Literal["repeat", "clamp_to_edge", "mirrored_repeat"] = "repeat"
    wrap_v: Literal["repeat", "clamp_to_edge", "mirrored_repeat"] = "repeat"
    magnification: Literal["nearest", "linear"] = "linear"
    minification: Literal["nearest", "linear"] = "linear"
    mipmaps: bool = True
    name: str = ""

@dataclass(eq=False)
class Material:
    base_color: Sequence[float] = (1, 1, 1, 1)
    base_color_texture: Optional[Texture] = None
    metallic: float = 1
    roughness: float = 1
    metallic_roughness_texture: Optional[Texture] = None
    normal_texture: Optional[Texture] = None
    normal_scale: float = 1
    occlusion_texture: Optional[Texture] = None
    occlusion_strength: float = 1
    emission: Sequence[float] = (0, 0, 0)
    emission_texture: Optional[Texture] = None
    alpha_mode: Literal["opaque", "mask", "blend"] = "opaque"
    alpha_cutoff: float = 0.5
    double_sided: bool = False
    unlit: bool = False
    ior: float = 1.5
    transmission: float = 0
    transmission_texture: Optional[Texture] = None
    thickness: float = 0
    attenuation_distance: float = ...
    attenuation_color: Sequence[float] = (1, 1, 1)
    name: str = ""

@dataclass(eq=False)
class Mesh:
    positions: numpy.typing.ArrayLike
    indices: Optional[numpy.typing.ArrayLike] = None
    normals: Optional[numpy.typing.ArrayLike] = None
    uvs: Optional[numpy.typing.ArrayLike] = None
    colors: Optional[numpy.typing.ArrayLike] = None
    material: Optional[Material] = None
    name: str = ""

@dataclass(eq=False)
class Instance:
    mesh: Mesh
    transform: Optional[numpy.typing.ArrayLike] = None
    name: str = ""

@dataclass(eq=False)
class Camera:
    transform: Optional[numpy.typing.ArrayLike] = None
    yfov: float = 0.6911112
    znear: float = 0.01
    focus_distance: Optional[float] = None
    lens: Mapping[str, Any] = ...
    name: str = ""

@dataclass(eq=False)
class Light:
    type: Literal["directional", "point", "spot"] = "directional"
    transform: Optional[numpy.typing.ArrayLike] = None
    color: Sequence[float] = (1, 1, 1)
    intensity: float = 1
    range: float = 0
    inner_cone_angle: float = 0
    outer_cone_angle: float = ...
    angular_diameter: float = 0.00925
    radius: float = 0.03
    name: str = ""

def look_at(
    position: Sequence[float], target: Sequence[float], up: Sequence[float] = (0, 1, 0)
) -> numpy.typing.NDArray[numpy.float64]: ...

class Renderer(ContextManager["Renderer"]):
    def __init__(
        self, scene: Union[Path, Scene, None] = None, *, progress: Optional[Progress] = None, **settings: Unpack[Keywords]
    ) -> None: ...
    def render(self, *, progress: Optional[Progress] = None, **settings: Unpack[Keywords]) -> Array: ...
    def progressive(self, **settings: Unpack[Keywords]) -> Iterator[Tuple[Array, int]]: ...
    def start(self, **settings: Unpack[Keywords]) -> None: ...
    def advance(self) -> bool: ...
    def image(self) -> Array: ...
    @property
    def samples(self) -> int: ...
    @property
    def sample_total(self) -> int: ...
    @property
    def statistics(self) -> Statistics: ...
    @property
    def warnings(self) -> List[str]: ...
    @property
    def scene(self) -> Scene: ...
    def aovs(self) -> Aovs: ...
    def plan(self) -> Dict[str, Any]: ...
    def write(self, path: Path, image: numpy.typing.ArrayLike) -> None: ...
    def close(self) -> None: ...
    def __exit__(self, *exception: object) -> None: ...

class LightFieldInfo(NamedTuple):
    width: int
    height: int
    focus_distance: float
    f_stop: float
    focal_length: float
    horizontal_aperture: float
    focus_range: Tuple[float, float]
    full_disk: bool
    pixels_per_dioptre: float
    lens_points: List[List[float]]

class FocalStack(NamedTuple):
    focus_distances: List[float]
    pictures: List[Array]

class LightField(ContextManager["LightField"]):
    def __init__(self, path: Path) -> None: ...
    @classmethod
    def render(
        cls,
        path: Path,
        scene: Union[Path, Scene, None] = None,
        *,
        focus_range: Optional[Tuple[float, float]] = None,
        progress: Optional[Progress] = None,
        **settings: Unpack[Keywords],
    ) -> "LightField": ...
    @property
    def info(self) -> LightFieldInfo: ...
    def refocus(
        self, *, fill_gaps: bool = True, progress: Optional[Progress] = None, **settings: Unpack[RefocusKeywords]
    ) -> Array: ...
    def stack(
        self, count: int, *, fill_gaps: bool = True, progress: Optional[Progress] = None, **settings: Unpack[RefocusKeywords]
    ) -> FocalStack: ...
    def all_in_focus(self, *, progress: Optional[Progress] = None) -> Array: ...
    def depth(self) -> Array: ...
    def coc(self, **settings: Unpack[RefocusKeywords]) -> Array: ...
    def close(self) -> None: ...
    def __exit__(self, *exception: object) -> None: ...

def render(
    scene: Union[Path, Scene, None] = None, *, progress: Optional[Progress] = None, **settings: Unpack[Keywords]
) -> Array: ...
def progressive(
    scene: Union[Path, Scene, None] = None, *, progress: Optional[Progress] = None, **settings: Unpack[Keywords]
) -> Iterator[Tuple[Array, int]]: ...
def plan(
    scene: Optional[Path] = None, *, progress: Optional[Progress] = None, **settings: Unpack[Keywords]
) -> Dict[str, Any]: ...
def pyramid(
    scene: Optional[Path] = None, *, progress: Optional[Progress] = None, **settings: Unpack[Keywords]
) -> Any: ...
def compare(
    reference: Union[Path, numpy.typing.ArrayLike], test: Union[Path, numpy.typing.ArrayLike]
) -> Difference: ...
def read_image(path: Path) -> Array: ...
def write_image(
    path: Path,
    image: numpy.typing.ArrayLike,
    *,
    tone_map: Optional[Literal["none", "aces", "agx", "neutral"]] = None,
    exposure: Optional[float] = None,
) -> None: ...
def settings() -> List[Setting]: ...
