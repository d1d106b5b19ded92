#pragma once
// Float images: rendered, read from files, written to files, compared.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "defocus/error.h"
#include "defocus/export.h"

namespace defocus {

// Row 0 is the TOP row, channels are interleaved, colours are linear Rec.709, alpha is premultiplied coverage.
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
    // The first channel of the pixel in column x from the left and row y from the top.
    [[nodiscard]] float* at(int x, int y) { return pixels.data() + offset(x, y); }
    [[nodiscard]] const float* at(int x, int y) const { return pixels.data() + offset(x, y); }

private:
    [[nodiscard]] std::size_t offset(int x, int y) const {
        return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
               static_cast<std::size_t>(channels);
    }
};

// Pixels that somebody keeps, read where they lie: an Image's, or others of the same layout.
struct ImageView {
    int width = 0;
    int height = 0;
    int channels = 0;
    std::span<const float> pixels;

    ImageView() = default;
    ImageView(int viewWidth, int viewHeight, int viewChannels, std::span<const float> values)
        : width(viewWidth), height(viewHeight), channels(viewChannels), pixels(values) {}
    // NOLINTNEXTLINE(google-explicit-constructor): an Image goes wherever pixels are only read
    ImageView(const Image& image)
        : ImageView(image.width, image.height, image.channels, std::span<const float>(image.pixels)) {}

    [[nodiscard]] bool empty() const { return pixels.empty(); }
    // As Image::at.
    [[nodiscard]] const float* at(int x, int y) const {
        return pixels.data() +
               (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
                   static_cast<std::size_t>(channels);
    }
};

// A pixel of an image: column from the left, row from the top.
struct Pixel {
    int column = 0;
    int row = 0;
    bool operator==(const Pixel&) const = default;
};

// The curve from linear values to display values, before the sRGB encoding.
enum class ToneMap {
    none,     // clip to [0, 1]
    aces,     // ACES filmic, fit by Stephen Hill (RRT and ODT)
    agx,      // AgX, Troy Sobotka, base look (polynomial fit by Benjamin Wrensch)
    neutral,  // Khronos PBR Neutral: colours stay as they are up to 0.8, and highlights roll off to white
};

struct WriteOptions {
    ToneMap toneMap = ToneMap::none;  // PNG and JPEG only
    double exposure = 0;              // EV; PNG and JPEG only
};

// Reads PNG, JPEG, OpenEXR, Radiance HDR or TIFF, told apart by content, as linear float with 1, 3 or 4 channels
// (integer formats are decoded from sRGB, straight alpha is premultiplied, grey with alpha becomes RGBA). Of an EXR
// with more channels R, G, B and A are taken. Throws Error naming the file and the fault.
DEFOCUS_API Image readImage(const std::filesystem::path& path);

// Writes by extension: .exr (32-bit float, ZIP, linear), .png (tone-mapped, sRGB-encoded, 8 bit; with 4 channels its
// alpha is straight) and .jpg or .jpeg (the same over black). The file appears whole or not at all. Throws Error naming
// the file and the fault.
DEFOCUS_API void writeImage(const std::filesystem::path& path, const ImageView& image,
                            const WriteOptions& options = {});

// What tells two images apart, on display-encoded values in [0, 1] at EV 0 (sRGB, clipped). A pixel that is NaN or
// infinite in exactly one image counts as the largest difference there.
struct Difference {
    double mae = 0;                // mean absolute error over pixels and colour channels
    double rmse = 0;               // root mean squared error over pixels and colour channels
    double psnr = 0;               // dB; infinity for equal images
    double ssim = 1;               // mean structural similarity (Wang et al. 2004), on luma
    double flip = 0;               // mean FLIP (Andersson et al. 2020) at 67 pixels a degree
    double maxError = 0;           // largest absolute difference of a channel
    Pixel maxErrorPixel;           // the first one in reading order
    std::uint64_t pixelCount = 0;  // pixels that counted
    std::uint64_t nonFinite = 0;   // of these, with NaN or infinity in either image
};

// Compares two linear images of one size. RGBA is composited over black; grey counts as RGB. Throws Error for sizes
// that differ and for views of too few or too many pixels.
DEFOCUS_API Difference compareImages(const ImageView& reference, const ImageView& test);

}  // namespace defocus
