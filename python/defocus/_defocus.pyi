"""Types of the native module `_defocus`, and the keywords of functions that take settings.

The keywords exist only for type checkers; scripts/python_stubs.py writes them from the settings table.
"""

import os
from typing import Any, Callable, Iterable, List, Literal, Mapping, Optional, Sequence, Tuple, Union

import numpy
from numpy.typing import NDArray
from typing_extensions import TypedDict

from ._scene_data import Camera, Instance, Light, Mesh

Array = NDArray[numpy.float32]
Path = Union[str, os.PathLike[str]]
Progress = Callable[[str, int, int], object]
Point = Tuple[float, float, float]
Pixel = Tuple[int, int]

# Members that only the package uses have the type Any.
def __getattr__(name: str) -> Any: ...

class Error(RuntimeError): ...
class UsageError(Error, TypeError, ValueError): ...

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
