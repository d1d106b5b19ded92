"""Converts Python keywords and values to the settings of a request."""

from __future__ import annotations

import difflib
import inspect
import numbers
import os
from typing import Any, Callable, Iterable, Mapping, TypeVar

import numpy

from . import _defocus

Function = TypeVar("Function", bound=Callable[..., Any])

# Settings by keyword, in the order of `defocus render --help`.
INFOS = {info.keyword: info for info in _defocus.setting_infos()}

# Keywords of the settings that can still be chosen after the lens images are rendered.
REFOCUS = [info.keyword for info in INFOS.values() if info.name in _defocus.refocus_settings()]

# Keywords that apply only to the built-in school of fish.
SCHOOL = ("fish_count", "triangles_per_fish")


def text(value: Any, separator: str = ",") -> str:
    """Returns a value in the command line's syntax, with `separator` between the elements of a sequence."""
    if isinstance(value, str):
        return value
    if isinstance(value, os.PathLike):
        return os.fsdecode(value)
    if isinstance(value, (bool, numpy.bool_)):
        return "true" if value else "false"
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        return repr(float(value))
    if isinstance(value, (tuple, list, numpy.ndarray)):
        return separator.join(text(part, separator) for part in value)
    return str(value)


def texts(info: _defocus.SettingInfo, value: Any) -> Iterable[str]:
    if info.repeated and isinstance(value, Mapping):
        return [f"{name}={text(part)}" for name, part in value.items()]
    if info.repeated and isinstance(value, (tuple, list)):
        return [text(part) for part in value]
    return [text(value, info.array_separator)]


def unknown(keyword: str, known: Iterable[str]) -> _defocus.UsageError:
    nearest = difflib.get_close_matches(keyword, known, n=1)
    hint = f"did you mean '{nearest[0]}'?" if nearest else "defocus.settings() lists them"
    return _defocus.UsageError(f"there is no setting '{keyword}'; {hint}")


def set_value(request: _defocus.Request, keyword: str, value: Any) -> None:
    info = INFOS.get(keyword)
    if info is None:
        raise unknown(keyword, [*INFOS, "progress"])
    try:
        for part in texts(info, value):
            request.set(info.name, part)
    except _defocus.UsageError as error:
        # Replace the setting's name in the message by the Python keyword.
        raise _defocus.UsageError(str(error).replace(f"{info.name}: ", f"{keyword}: ", 1)) from None


def check_exclusions(given: Mapping[str, Any]) -> None:
    """Raises UsageError if two of the given settings exclude each other."""
    by_name = {info.name: keyword for keyword, info in INFOS.items()}
    for keyword in given:
        for name in INFOS[keyword].excludes if keyword in INFOS else ():
            if by_name[name] in given:
                raise _defocus.UsageError(f"{keyword} cannot be combined with {by_name[name]}")


def request_of(scene: Any, settings: Mapping[str, Any]) -> _defocus.Request:
    """Returns the request for a scene (a path, a Scene or None) and keywords. Ignores keywords with the value None."""
    request = _defocus.Request()
    given = {keyword: value for keyword, value in settings.items() if value is not None}
    if scene is not None:
        for keyword in SCHOOL:
            if keyword in given:
                raise _defocus.UsageError(f"{keyword} applies only to the built-in school of fish; leave out the scene")
    if isinstance(scene, (str, os.PathLike)):
        set_value(request, "scene", scene)
    elif scene is not None and not isinstance(scene, _defocus.Scene):
        raise _defocus.UsageError(f"scene: {scene!r} is neither a path nor a Scene")
    check_exclusions(given)
    # Set values in the order of INFOS, so that explicit settings override those of a preset or a method.
    order = {keyword: place for place, keyword in enumerate(INFOS)}
    for keyword, value in sorted(given.items(), key=lambda item: order.get(item[0], 0)):
        set_value(request, keyword, value)
    return request


def refocus_request_of(settings: Mapping[str, Any]) -> _defocus.Request:
    """Returns the request for the keywords of LightField.refocus(). Raises UsageError for keywords that would need
    a new rendering."""
    for keyword, value in settings.items():
        if value is not None and keyword in INFOS and keyword not in REFOCUS:
            raise _defocus.UsageError(f"{keyword} cannot be changed after rendering; use one of {', '.join(REFOCUS)}")
    return request_of(None, settings)


def takes_settings(function: Function, names: Iterable[str] = tuple(INFOS)) -> Function:
    """Decorator for functions with **settings: adds keywords to the signature that help() and completion show."""
    signature = inspect.signature(function)
    own = [p for p in signature.parameters.values() if p.kind is not inspect.Parameter.VAR_KEYWORD]
    taken = {parameter.name for parameter in own}
    keywords = [inspect.Parameter(keyword, inspect.Parameter.KEYWORD_ONLY, default=None)
                for keyword in names if keyword != "scene" and keyword not in taken]
    function.__signature__ = signature.replace(parameters=own + keywords)  # type: ignore[attr-defined]
    return function


def takes_refocus_settings(function: Function) -> Function:
    """Decorator for functions whose **settings are limited to the keywords in REFOCUS."""
    return takes_settings(function, REFOCUS)
