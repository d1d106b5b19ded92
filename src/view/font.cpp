#include "view/font.h"

#include <filesystem>
#include <optional>

#include "image/text.h"

namespace defocus {

namespace {

// Latin, Greek (λ), punctuation, arrows, simple shapes and the check mark.
constexpr ImWchar glyphs[] = {0x20,   0xff,   0x192,  0x192,  0x370,  0x3ff,  0x2010, 0x2044, 0x2190,
                              0x21ff, 0x2212, 0x2265, 0x25a0, 0x25ff, 0x2713, 0x2713, 0};

constexpr double bitmapShare = 13.0 / 15;  // the bitmap font is as large as another at this share of its size

}  // namespace

void addViewFont(ImFontAtlas& atlas, double size) {
    const std::optional<std::filesystem::path> file = sansSerifFile();
    if (file && atlas.AddFontFromFileTTF(file->c_str(), static_cast<float>(size), nullptr, glyphs) != nullptr) return;
    ImFontConfig config;
    config.SizePixels = static_cast<float>(size * bitmapShare);
    atlas.AddFontDefault(&config);
}

}  // namespace defocus
