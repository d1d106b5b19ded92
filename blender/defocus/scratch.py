"""Makes temporary folders for exports and images."""

import tempfile

from .failure import Failure


def new_folder(purpose, make=tempfile.mkdtemp):
    """Returns a new temporary folder made by a function of tempfile. Raises Failure if it cannot be made."""
    try:
        return make(prefix=f"defocus-{purpose}-")
    except OSError as error:
        raise Failure(f"No temporary folder can be made: {error}; set TMPDIR to a writable folder") from error
