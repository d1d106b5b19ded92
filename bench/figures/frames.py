"""Renders images of one scene for a measurement, and compares them."""

import json

from figures.command import run


class Frames:
    """Renders images to a folder. subject: the scene and the options that all images have."""

    def __init__(self, program, folder, *subject):
        self.program, self.folder, self.subject = program, folder, subject

    def render(self, file, *options):
        """Renders an image and returns its statistics."""
        stats = self.folder / "stats.json"
        run(self.program, "render", *self.subject, "--quiet", *options, "--stats", stats, "-o", self.folder / file)
        return json.loads(stats.read_text())

    def difference(self, reference, file):
        """Compares a file with the reference. Returns the metrics of `defocus compare`, such as "rmse" and "flip"."""
        return json.loads(run(self.program, "compare", self.folder / reference, self.folder / file, "--json"))
