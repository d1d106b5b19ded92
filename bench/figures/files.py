"""Reads results of the benches, and replaces files atomically."""

import csv
import fcntl
import json
import os
import re
import tempfile


def read_json(path):
    """Returns the contents of a JSON file, with renamed_rows() and renamed_words()."""
    document = json.loads(path.read_text(encoding="utf-8"))
    if isinstance(document, dict):
        renamed_rows(document.get("rows", []))
        if "commands" in document:
            document["commands"] = [renamed_words(command) for command in document["commands"]]
    return document


def renamed_rows(rows):
    """Renames "standard" to "default" in rows, as renamed_words() does in texts."""
    for row in rows:
        row.update({name: "default" for name in ("form", "setting") if row.get(name) == "standard"})
    return rows


def renamed_words(text):
    """Renames "standard" to "default", the name of a method's own settings since version 0.2, in a command or a list of rows."""
    return re.sub(r"(, |--rows \S*?)\bstandard\b", r"\1default", text)


def csv_rows(lines):
    """Returns the rows of CSV text as dictionaries {column: text}. An empty text becomes None, and columns such as
    "time.median" become nested dictionaries."""
    rows = []
    for line in csv.DictReader(lines):
        rows.append({})
        for column, text in line.items():
            *outer, name = column.split(".")
            place = rows[-1]
            for part in outer:
                place = place.setdefault(part, {})
            place[name] = text or None
    return renamed_rows(rows)


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
