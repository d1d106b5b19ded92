"""Exceptions of this add-on."""


class Failure(Exception):
    """An error. Its message is one line for Blender's report: what failed and what to do."""


class Cancelled(Exception):
    """The user cancelled the render."""
