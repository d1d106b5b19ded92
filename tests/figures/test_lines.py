"""Tests the teapots in meshes/, and the images and tables of `scripts/figures lines`."""

import math
import re
import sys
from pathlib import Path

import pytest

from figures import line_rows

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "meshes"))
import teapots  # noqa: E402


def volume(surface):
    """Returns six times the signed volume of a closed surface, which is positive if the triangles face outwards."""
    total = 0
    for i in range(0, len(surface.indices), 3):
        (a, b, c), (d, e, f), (g, h, k) = (surface.positions[corner] for corner in surface.indices[i:i + 3])
        total += a * (e * k - f * h) - b * (d * k - f * g) + c * (d * h - e * g)
    return total


def test_a_bezier_curve_is_its_bernstein_polynomial():
    points = [(0, 1), (2, 5), (3, -1), (4, 2)]
    for t in (0, 0.3, 0.5, 1):
        weights = [math.comb(3, i) * (1 - t) ** (3 - i) * t ** i for i in range(4)]
        assert teapots.bezier(points, t) == pytest.approx(tuple(sum(w * p[axis] for w, p in zip(weights, points)) for axis in (0, 1)))


@pytest.mark.parametrize("rows", [teapots.HANDLE, teapots.SPOUT])
def test_bent_tubes_face_outwards(rows):
    """Normals point away from the centre of their ring, except at the lip that bends into the spout."""
    tube = teapots.Surface()
    teapots.add_bent_tube(tube, rows, 6)
    normals = teapots.smooth_normals(tube)
    rings = [range(first, first + 12) for first in range(0, len(tube.positions), 12)]
    outwards = 0
    for ring in rings:
        middle = [sum(tube.positions[i][axis] for i in ring) / 12 for axis in range(3)]
        outwards += sum(sum(n * (p - m) for n, p, m in zip(normals[i], tube.positions[i], middle)) > 0 for i in ring)
    assert outwards > 0.7 * len(tube.positions)


def test_the_body_is_as_large_as_its_profile_says():
    """A finely divided body has the volume of its profile: pi times the integral of r² over the height."""
    body = teapots.Surface()
    for curves in teapots.PROFILES:
        teapots.add_turned(body, curves, 40)
    profile = [point for curves in teapots.PROFILES for point in teapots.along(curves, 400 if len(curves[0]) == 4 else 1)]
    integral = sum((a[0] ** 2 + a[0] * b[0] + b[0] ** 2) / 3 * (a[1] - b[1]) for a, b in zip(profile, profile[1:]))
    assert volume(body) / 6 == pytest.approx(math.pi * integral * teapots.SCALE ** 3, rel=2e-3)


def test_details_keep_their_size_and_differences_are_rmse():
    image = pytest.importorskip("PIL.Image")
    from figures import lines
    for name in lines.PLACES:
        assert lines.detail(image.new("RGB", (lines.WIDTH, lines.HEIGHT)), name).size == (52, 39)
    white, grey = image.new("RGB", (4, 4), (255, 255, 255)), image.new("RGB", (4, 4), (255, 255, 204))
    assert lines.difference(white, white) == 0
    assert lines.difference(white, grey) == pytest.approx(0.2 / math.sqrt(3))
    grey.paste((255, 255, 255), (0, 0, 4, 2))
    assert lines.difference(white, grey) == pytest.approx(0.2 / math.sqrt(6))


@pytest.mark.parametrize("times, count", [((60, 240, 960), 16), ((30, 120, 480), 64), ((1, 8, 90), 256)])
def test_the_number_of_points_with_the_time_of_16_lines(monkeypatch, times, count):
    def row(method, samples, time):
        return {"method": method, "form": "default", "samples": samples, "milliseconds": {"median": time}}

    rows = [row("line", 16, 100), *(row("stochastic", *pair) for pair in zip((16, 64, 256), times))]
    monkeypatch.setattr(line_rows, "run_of", lambda name: {"rows": rows})
    assert line_rows.equal_time_points() == count


def test_the_page_shows_every_picture_and_every_committed_run():
    page = (line_rows.RESULTS / "line-samples.md").read_text()
    assert re.findall(r"!\[\]\((.*?)\)", page) == [f"lines/figure-{number}.jpg" for number in (1, 8, 9)]
    assert all((line_rows.RESULTS / picture).exists() for picture in re.findall(r"!\[\]\((.*?)\)", page))
    for name in line_rows.runs():
        assert line_rows.run_of(name)["commands"][0].startswith("defocus bench convergence teapots.glb ")
