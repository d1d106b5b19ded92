"""Reads results of the benches, and replaces files atomically."""

import csv
import fcntl
import json
import os
import tempfile


def read_json(path):
    return json.loads(path.read_text(encoding="utf-8"))


def read_csv(path):
    """Returns the rows of a CSV file, each as a dictionary {column: text}."""
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


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
