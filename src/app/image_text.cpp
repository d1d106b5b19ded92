#include "app/image_text.h"

#include <cmath>
#include <cstdint>
#include <string>

#include "app/interface_font.h"

namespace defocus {

namespace {

constexpr std::uint32_t missingSign = '?';

// Texels are as large as pixels.
ImFontConfig plainTexels() {
    ImFontConfig config;
    config.OversampleH = 1;
    config.PixelSnapH = true;
    return config;
}

// The next code point of UTF-8 text, which moves on; a byte that begins none is replaced.
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
    return whole ? point : missingSign;
}

}  // namespace

ImageFont::ImageFont(double size) : font_(addInterfaceFont(atlas_, size, plainTexels())) {
    unsigned char* pixels = nullptr;
    atlas_.GetTexDataAsAlpha8(&pixels, &atlasWidth_, &atlasHeight_);
    coverage_ = pixels;
}

double ImageFont::lineHeight() const {
    return double{font_->FontSize};
}

void ImageFont::draw(Image& image, double x, double y, std::string_view text, float value) const {
    double pen = std::round(x);
    const int top = static_cast<int>(std::round(y));
    while (!text.empty()) {
        const std::uint32_t point = takeCodePoint(text);
        const ImFontGlyph* glyph = point <= 0xffff ? font_->FindGlyphNoFallback(static_cast<ImWchar>(point)) : nullptr;
        if (glyph == nullptr) glyph = font_->FindGlyphNoFallback(static_cast<ImWchar>(missingSign));
        if (glyph == nullptr) continue;
        const int left = static_cast<int>(std::lround(pen + double{glyph->X0}));
        const int above = top + static_cast<int>(std::lround(glyph->Y0));
        const int u = static_cast<int>(std::lround(glyph->U0 * static_cast<float>(atlasWidth_)));
        const int v = static_cast<int>(std::lround(glyph->V0 * static_cast<float>(atlasHeight_)));
        const int width = static_cast<int>(std::lround(glyph->U1 * static_cast<float>(atlasWidth_))) - u;
        const int height = static_cast<int>(std::lround(glyph->V1 * static_cast<float>(atlasHeight_))) - v;
        for (int row = 0; row < height; ++row)
            for (int column = 0; column < width; ++column) {
                const int px = left + column;
                const int py = above + row;
                if (px < 0 || py < 0 || px >= image.width || py >= image.height) continue;
                const float share = static_cast<float>(coverage_[(v + row) * atlasWidth_ + u + column]) / 255;
                float* const pixel = image.at(px, py);
                for (int c = 0; c < image.channels; ++c) pixel[c] += share * (value - pixel[c]);
            }
        pen += double{glyph->AdvanceX};
    }
}

}  // namespace defocus
