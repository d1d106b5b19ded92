"""Reads results of the benches, and replaces files atomically."""

import csv
import fcntl
import json
import os
import re
import tempfile


def rename_defaults(rows):
    """Renames the settings "standard" in rows of a result to "default". Version 0.1 calls a method's defaults "standard"."""
    for row in rows:
        row.update({name: "default" for name in ("form", "setting") if row.get(name) == "standard"})


def repeatable(text):
    """Returns text with commands of version 0.1 converted to commands that repeat the run: --rows with "default" for "standard"."""
    return re.sub(r"(?<=--rows[ =])\S+", lambda rows: re.sub(r"\bstandard\b", "default", rows[0]), text)


def read_json(path):
    """Returns the contents of a JSON file. Rows and commands of version 0.1 are converted."""
    document = json.loads(path.read_text(encoding="utf-8"))
    if isinstance(document, dict):
        rename_defaults(document.get("rows", []))
        if "commands" in document:
            document["commands"] = [repeatable(command) for command in document["commands"]]
    return document


def csv_rows(lines):
    """Returns the rows of CSV text as dictionaries {column: text}, with None for an empty field.

    Columns such as "time.median" become nested dictionaries. Rows of version 0.1 are converted.
    """
    rows = []
    for line in csv.DictReader(lines):
        rows.append({})
        for column, text in line.items():
            *outer, name = column.split(".")
            place = rows[-1]
            for part in outer:
                place = place.setdefault(part, {})
            place[name] = text or None
    rename_defaults(rows)
    return rows


def read_csv(path):
    with open(path, newline="", encoding="utf-8") as file:
        return csv_rows(file)


def remove_abandoned(path):
    """Removes a temporary file unless another process has locked it for writing."""
    try:
        with open(path, "rb") as file:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            path.unlink()
    except OSError:
        pass


def write_file(path, content):
    """Replaces a file atomically through a temporary file; first removes temporary files of killed processes."""
    prefix = f".{path.name}."
    for left in path.parent.glob(f"{prefix}*"):
        remove_abandoned(left)
    with tempfile.NamedTemporaryFile(dir=path.parent, prefix=prefix, delete=False) as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            pass  # the file system has no locks
        file.write(content if isinstance(content, bytes) else content.encode())
        file.flush()
        os.fsync(file.fileno())
        os.chmod(file.name, 0o644)
        os.replace(file.name, path)
