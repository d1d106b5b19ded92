#pragma once
// Defines images of floats, and functions that read, write and compare them.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "defocus/error.h"
#include "defocus/export.h"

namespace defocus {

// Image of linear Rec.709 colour. Row 0 is the top row, and channels are interleaved. Alpha is coverage, and colours
// are premultiplied by alpha.
struct Image {
    int width = 0;
    int height = 0;
    int channels = 0;           // 1 (data), 3 (RGB) or 4 (RGBA, premultiplied)
    std::vector<float> pixels;  // width · height · channels

    Image() = default;
    Image(int imageWidth, int imageHeight, int imageChannels)
        : width(imageWidth),
          height(imageHeight),
          channels(imageChannels),
          pixels(static_cast<std::size_t>(imageWidth) * static_cast<std::size_t>(imageHeight) *
                 static_cast<std::size_t>(imageChannels)) {}

    [[nodiscard]] bool empty() const { return pixels.empty(); }
    // Return a pointer to the first channel of the pixel in column x (from the left) and row y (from the top).
    [[nodiscard]] float* at(int x, int y) { return pixels.data() + offset(x, y); }
    [[nodiscard]] const float* at(int x, int y) const { return pixels.data() + offset(x, y); }

private:
    [[nodiscard]] std::size_t offset(int x, int y) const {
        return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
               static_cast<std::size_t>(channels);
    }
};

// Distances in memory between neighbouring pixels of an ImageView, in floats.
struct ImageStrides {
    std::size_t pixel = 0;  // distance to the next pixel of the row
    std::size_t row = 0;    // distance to the pixel in the same column of the next row
    bool operator==(const ImageStrides&) const = default;
};

// Read-only view of pixels in memory that the view does not own and must not outlive. The channels of a pixel are
// contiguous; the positions of pixels follow from `strides`.
struct ImageView {
    int width = 0;
    int height = 0;
    int channels = 0;
    std::span<const float> pixels;  // starts at the top left pixel
    ImageStrides strides;

    ImageView() = default;
    // Creates a view of pixels in the layout of Image::pixels, without gaps.
    ImageView(int viewWidth, int viewHeight, int viewChannels, std::span<const float> values)
        : ImageView(viewWidth, viewHeight, viewChannels, values, packedStrides(viewWidth, viewChannels)) {}
    // Creates a view of pixels with arbitrary strides, such as a part of a larger image.
    ImageView(int viewWidth, int viewHeight, int viewChannels, std::span<const float> values, ImageStrides between)
        : width(viewWidth), height(viewHeight), channels(viewChannels), pixels(values), strides(between) {}
    // NOLINTNEXTLINE(google-explicit-constructor): implicit, so that functions that only read pixels accept an Image
    ImageView(const Image& image)
        : ImageView(image.width, image.height, image.channels, std::span<const float>(image.pixels)) {}

    [[nodiscard]] bool empty() const { return pixels.empty(); }
    // Returns whether there are no gaps between pixels or rows.
    [[nodiscard]] bool isPacked() const { return strides == packedStrides(width, channels); }
    // Returns a pointer to the first channel of the pixel in column x and row y.
    [[nodiscard]] const float* at(int x, int y) const {
        return pixels.data() + static_cast<std::size_t>(y) * strides.row + static_cast<std::size_t>(x) * strides.pixel;
    }

private:
    static ImageStrides packedStrides(int width, int channels) {
        return {static_cast<std::size_t>(channels),
                static_cast<std::size_t>(width) * static_cast<std::size_t>(channels)};
    }
};

// Position of a pixel in an image: column from the left and row from the top, both starting at 0.
struct Pixel {
    int column = 0;
    int row = 0;
    bool operator==(const Pixel&) const = default;
};

// Tone curve that maps linear values to [0, 1] before the sRGB encoding.
enum class ToneMap {
    none,     // no curve; values are clipped to [0, 1]
    aces,     // ACES filmic curve, Stephen Hill's fit of RRT and ODT
    agx,      // AgX by Troy Sobotka, base look, Benjamin Wrensch's polynomial fit
    neutral,  // Khronos PBR Neutral: keeps colours up to 0.8, compresses highlights to white
};

struct WriteOptions {
    ToneMap toneMap = ToneMap::none;  // used only for PNG and JPEG
    double exposure = 0;              // exposure in EV; used only for PNG and JPEG
};

// Reads a PNG, JPEG, OpenEXR, Radiance HDR or TIFF file as linear float with 1, 3 or 4 channels. The content, not the
// extension, determines the format. Integer formats are decoded from sRGB, straight alpha is premultiplied, and grey
// with alpha becomes RGBA. From an EXR file with more channels, only R, G, B and A are read. Throws Error, with the
// path in its message, if the file cannot be read.
DEFOCUS_API Image readImage(const std::filesystem::path& path);

// Writes an image in the format of the file's extension:
//   .exr: linear 32-bit float with ZIP compression;
//   .png: tone-mapped, sRGB-encoded, 8 bits, with straight alpha if the image has 4 channels;
//   .jpg, .jpeg: like .png, but composited over black.
// The write is atomic: a failure leaves no partial file. Throws Error, with the path and the reason in its message, if
// writing fails.
DEFOCUS_API void writeImage(const std::filesystem::path& path, const ImageView& image,
                            const WriteOptions& options = {});

// Error metrics of two images, computed from display-encoded values in [0, 1] (EV 0, sRGB, clipped). A pixel that is
// NaN or infinite in only one of the images counts as the maximum difference.
struct Difference {
    double mae = 0;                // mean absolute error over pixels and colour channels
    double rmse = 0;               // root mean squared error over pixels and colour channels
    double psnr = 0;               // PSNR in dB; infinity for equal images
    double ssim = 1;               // mean structural similarity (Wang et al. 2004), on luma
    double flip = 0;               // mean FLIP (Andersson et al. 2020) at 67 pixels per degree
    double maxError = 0;           // max absolute difference of a colour channel
    Pixel maxErrorPixel;           // first pixel with maxError, in row-major order
    std::uint64_t pixelCount = 0;  // number of compared pixels
    std::uint64_t nonFinite = 0;   // number of compared pixels that are NaN or infinite in at least one image
};

// Returns the difference of two linear images of the same size. RGBA is composited over black; grey is expanded to RGB.
// Throws Error if the sizes differ or if a view extends beyond ImageView::pixels.
DEFOCUS_API Difference compareImages(const ImageView& reference, const ImageView& test);

}  // namespace defocus
