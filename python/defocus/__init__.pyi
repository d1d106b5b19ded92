# Types of the package `defocus`. The class Keywords is written by scripts/python_stubs.py from the settings table.

import os
from typing import Any, Callable, ContextManager, Dict, Iterator, List, Literal, Mapping, NamedTuple, Optional, Tuple, Union

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
# ---- end of keywords ----

class Error(RuntimeError): ...
class UsageError(Error, TypeError, ValueError): ...

class Setting(NamedTuple):
    keyword: str
    option: str
    group: str
    kind: Literal["number", "whole", "truth", "text", "path", "choice", "other"]
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

class Scene:
    def __init__(self, path: Path, *, progress: Optional[Progress] = None) -> None: ...
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
    def clips(self) -> List[str]: ...
    @property
    def triangles(self) -> int: ...
    @property
    def ignored(self) -> List[str]: ...

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
    tone_map: Optional[Literal["none", "aces", "agx"]] = None,
    exposure: Optional[float] = None,
) -> None: ...
def settings() -> List[Setting]: ...
