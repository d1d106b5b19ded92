#!/usr/bin/env python3
"""Writes the keywords of defocus/_defocus.pyi from the settings table of the built module.

    PYTHONPATH=build/release/python /usr/bin/python3 scripts/python_stubs.py          # writes the stub
    PYTHONPATH=build/release/python /usr/bin/python3 scripts/python_stubs.py --check  # exit code 1: stub is outdated
"""

import sys
from pathlib import Path

import defocus
from defocus._settings import REFOCUS

STUB = Path(__file__).resolve().parents[1] / "python" / "defocus" / "_defocus.pyi"
BEGIN = "# ---- keywords, from the settings table ----\n"
TYPES = {"number": "float", "integer": "int", "boolean": "bool", "text": "str", "path": "Path"}
# Python types of settings of kind "other", keyed by the syntax of their command-line values.
FORMS = {
    "N|exact": "Union[int, str]",
    "environment|none|R,G,B": "Union[str, Point]",
    "X,Y,Z": "Union[Point, str]",
    "WxH": "Union[Tuple[int, int], str]",
    "X,Y": "Union[Pixel, str]",
    "X,Y,X,Y,X,Y": "Union[Sequence[Pixel], str]",
    "NAME=SCALE": "Union[Mapping[str, float], str]",
    "NAME": "str",
    "NODE": "Union[List[str], str]",
    "SIZE": "str",
    "LAYER,…": "str",
}


def type_of(setting):
    if setting.kind == "choice":
        return "Literal[" + ", ".join(f'"{choice}"' for choice in setting.choices) + "]"
    if setting.kind in ("number", "integer") and setting.choices:
        return f"Union[{TYPES[setting.kind]}, Literal[" + ", ".join(f'"{word}"' for word in setting.choices) + "]]"
    if setting.kind == "number" and setting.unit == "s" and setting.range[0] >= 0:
        return "Union[float, str]"  # also a fraction such as "1/48"
    return FORMS[setting.form] if setting.kind == "other" else TYPES[setting.kind]


def keywords():
    every = [setting for setting in defocus.settings() if setting.keyword != "scene"]
    text = ""
    for name, settings in (("Keywords", every), ("RefocusKeywords", [s for s in every if s.keyword in REFOCUS])):
        text += f"\nclass {name}(TypedDict, total=False):\n"
        for setting in settings:
            unit = f"  # {setting.unit}" if setting.unit else ""
            text += f"    {setting.keyword}: Optional[{type_of(setting)}]{unit}\n"
    return text


def main():
    old = STUB.read_text()
    new = old[:old.index(BEGIN) + len(BEGIN)] + keywords()
    if "--check" not in sys.argv[1:]:
        STUB.write_text(new)
    elif new != old:
        sys.exit(f"{STUB.name}: its keywords are not those of the settings table; run scripts/python_stubs.py")


if __name__ == "__main__":
    main()
