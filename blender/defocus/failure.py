"""Defines the exceptions of this add-on."""


class Failure(Exception):
    """An error whose message is one line for Blender's report: what failed and what to do."""


class Cancelled(Exception):
    """Raised when the user cancels the render."""
