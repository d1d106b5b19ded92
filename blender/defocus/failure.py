"""The exceptions of this add-on."""


class Failure(Exception):
    """One line for Blender's report: what failed and what to do."""


class Cancelled(Exception):
    """The user cancelled the render."""
