"""Tests that images are read, written and compared without unnecessary copies."""

import math

import numpy
import pytest

import defocus


@pytest.fixture
def gradient():
    return numpy.linspace(0, 1, 24 * 32 * 3, dtype=numpy.float32).reshape(24, 32, 3)


def test_equal_images_have_no_difference(gradient):
    difference = defocus.compare(gradient, gradient.copy())
    assert difference.mae == difference.rmse == difference.flip == difference.max_error == 0
    assert difference.psnr == math.inf and difference.ssim == 1
    assert difference.pixel_count == 24 * 32 and difference.non_finite == 0


# Between a black and a white image, every error metric is 1, and the PSNR with peak 1 is 0 dB.
def test_black_and_white_differ_by_one():
    black = numpy.zeros((16, 20, 4), numpy.float32)
    white = numpy.ones((16, 20), numpy.float32)
    difference = defocus.compare(black, white)
    assert difference.mae == difference.rmse == difference.max_error == 1
    assert difference.psnr == 0
    assert difference.max_error_pixel == (0, 0)
    black[3, 7, 1] = numpy.nan
    assert defocus.compare(black, white).non_finite == 1


def test_the_largest_difference_is_where_it_is(gradient):
    other = gradient.copy()
    other[5, 9, 2] = 0
    assert defocus.compare(gradient, other).max_error_pixel == (9, 5)


def test_float32_arrays_are_read_where_they_lie(gradient):
    assert defocus._pixels(gradient) is gradient
    read_only = gradient.view()
    read_only.flags.writeable = False
    assert defocus._pixels(read_only) is read_only
    for part in (gradient[2:, ::2], gradient[..., :3]):
        assert numpy.shares_memory(defocus._pixels(part), gradient)
    # The C++ functions reject doubles, reversed rows and Fortran order, so no array is converted implicitly.
    for other in (gradient.astype(numpy.float64), gradient[::-1], numpy.asfortranarray(gradient)):
        with pytest.raises(TypeError):
            defocus._defocus.compare(other, other)
        assert defocus._pixels(other).flags.c_contiguous
        assert defocus.compare(other, other.copy()).mae == 0
    assert defocus.compare(gradient.astype(numpy.float64), gradient).mae == 0
    for part in (gradient[:, ::2], gradient[2:9, 3:], gradient[..., :3], gradient[..., 0]):
        assert defocus.compare(part, numpy.ascontiguousarray(part)).mae == 0


def test_what_is_no_image_is_refused(gradient):
    with pytest.raises(defocus.UsageError, match="linear float values, not uint8"):
        defocus.compare((255 * gradient).astype(numpy.uint8), gradient)
    with pytest.raises(defocus.UsageError, match="not 24×32×2"):
        defocus.compare(gradient[..., :2], gradient)
    with pytest.raises(defocus.UsageError, match="not 5"):
        defocus.compare(numpy.zeros(5), gradient)
    with pytest.raises(defocus.Error, match="images of different sizes cannot be compared: 32x24 and 32x23"):
        defocus.compare(gradient, gradient[:-1])


def test_files_keep_floats_and_shape(gradient, tmp_path):
    for shape in ((24, 32, 3), (24, 32, 4), (24, 32)):
        image = numpy.resize(gradient, shape) * 7 - 1
        defocus.write_image(tmp_path / "a.exr", image)
        read = defocus.read_image(str(tmp_path / "a.exr"))
        assert read.shape == shape and read.dtype == numpy.float32
        assert numpy.array_equal(read, image)
        assert type(read.base).__name__ == "PyCapsule" and read.flags.writeable
        assert defocus.compare(tmp_path / "a.exr", image).mae == 0


def test_one_channel_is_a_plane(gradient, tmp_path):
    defocus.write_image(tmp_path / "a.exr", gradient[..., :1])
    assert numpy.array_equal(defocus.read_image(tmp_path / "a.exr"), gradient[..., 0])


def test_eight_bits_are_encoded_and_exposed(tmp_path):
    grey = numpy.full((4, 4, 3), 0.25, numpy.float32)
    defocus.write_image(tmp_path / "a.png", grey, tone_map="none", exposure=1)
    read = defocus.read_image(tmp_path / "a.png")
    assert numpy.allclose(read, 0.5, atol=0.005)
    with pytest.raises(defocus.UsageError, match="tone_map: 'acse' is not one of none, aces, agx, neutral; did you mean 'aces'"):
        defocus.write_image(tmp_path / "b.png", grey, tone_map="acse")
    assert not (tmp_path / "b.png").exists()


def test_faults_of_files_are_one_line(gradient, tmp_path):
    with pytest.raises(defocus.Error, match="missing.exr"):
        defocus.read_image(tmp_path / "missing.exr")
    with pytest.raises(defocus.Error, match='unknown image type ".bmp"'):
        defocus.write_image(tmp_path / "a.bmp", gradient)
    with pytest.raises(defocus.Error, match="folder"):
        defocus.write_image(tmp_path / "no such folder" / "a.exr", gradient)
