// Text is drawn with stb_truetype: OpenImageIO's render_text, up to version 2.4, drops all but the last byte of
// non-ASCII characters.
#include "image/text.h"

#include <stb_truetype.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/file.h"

namespace defocus::engine {

namespace {

namespace fs = std::filesystem;

const std::array typefaceFiles = {
    "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
    "/usr/share/fonts/TTF/DejaVuSans.ttf",
    "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
    "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
    "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
    "/Library/Fonts/Arial Unicode.ttf",
};

struct Typeface {
    std::vector<std::byte> file;
    stbtt_fontinfo outlines{};
};

std::unique_ptr<Typeface> loadedTypeface() {
    const std::optional<fs::path> path = sansSerifFile();
    if (!path) return nullptr;
    auto typeface = std::make_unique<Typeface>();
    typeface->file = readFile(*path);
    const auto* const bytes = reinterpret_cast<const unsigned char*>(typeface->file.data());
    return stbtt_InitFont(&typeface->outlines, bytes, 0) != 0 ? std::move(typeface) : nullptr;
}

// Removes the first code point from UTF-8 `text` and returns it; invalid bytes give '?'.
std::uint32_t takeCodePoint(std::string_view& text) {
    const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
    const std::uint32_t first = byte(0);
    const std::size_t length = first < 0x80         ? 1
                               : (first >> 5) == 6  ? 2
                               : (first >> 4) == 14 ? 3
                               : (first >> 3) == 30 ? 4
                                                    : 0;
    bool whole = length > 0 && length <= text.size();
    for (std::size_t i = 1; whole && i < length; ++i) whole = (byte(i) >> 6) == 2;
    std::uint32_t point = length == 1 ? first : first & (0x7fu >> length);
    for (std::size_t i = 1; whole && i < length; ++i) point = point << 6 | (byte(i) & 0x3f);
    text.remove_prefix(whole ? length : 1);
    return whole ? point : std::uint32_t{'?'};
}

// Blends `value` over a rectangle of the image. `coverage` is the opacity of each pixel, 0 to 255, row by row.
void blend(Image& image, int left, int top, int width, int height, const unsigned char* coverage, float value) {
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column) {
            const int x = left + column;
            const int y = top + row;
            if (x < 0 || y < 0 || x >= image.width || y >= image.height) continue;
            const float share = static_cast<float>(coverage[row * width + column]) / 255;
            float* const pixel = image.at(x, y);
            for (int c = 0; c < image.channels; ++c) pixel[c] += share * (value - pixel[c]);
        }
}

}  // namespace

std::optional<fs::path> sansSerifFile() {
    std::error_code ignored;
    for (const char* file : typefaceFiles)
        if (fs::is_regular_file(file, ignored)) return file;
    return std::nullopt;
}

bool writeText(Image& image, int x, int y, std::string_view text, double size, float value) {
    static const std::unique_ptr<Typeface> typeface = loadedTypeface();
    if (!typeface) return false;
    const stbtt_fontinfo& outlines = typeface->outlines;
    const float scale = stbtt_ScaleForMappingEmToPixels(&outlines, static_cast<float>(size));
    double pen = x;
    while (!text.empty()) {
        const int glyph = stbtt_FindGlyphIndex(&outlines, static_cast<int>(takeCodePoint(text)));
        const auto place = static_cast<int>(std::floor(pen));
        int width = 0, height = 0, left = 0, top = 0;
        unsigned char* const coverage = stbtt_GetGlyphBitmapSubpixel(
            &outlines, scale, scale, static_cast<float>(pen - place), 0, glyph, &width, &height, &left, &top);
        if (coverage != nullptr) blend(image, place + left, y + top, width, height, coverage, value);
        stbtt_FreeBitmap(coverage, nullptr);
        int advance = 0, bearing = 0;
        stbtt_GetGlyphHMetrics(&outlines, glyph, &advance, &bearing);
        pen += double{scale} * advance;
    }
    return true;
}

}  // namespace defocus::engine
