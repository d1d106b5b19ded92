#include "app/interface_font.h"

#include <filesystem>

namespace defocus {

namespace {

const char* const fontFiles[] = {
    "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
    "/usr/share/fonts/TTF/DejaVuSans.ttf",
    "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
    "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
    "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
    "/Library/Fonts/Arial Unicode.ttf",
};

// Latin, Greek (λ), punctuation, arrows, simple shapes and the check mark.
constexpr ImWchar glyphs[] = {0x20,   0xff,   0x192,  0x192,  0x370,  0x3ff,  0x2010, 0x2044, 0x2190,
                              0x21ff, 0x2212, 0x2265, 0x25a0, 0x25ff, 0x2713, 0x2713, 0};

constexpr double bitmapShare = 13.0 / 15;  // the bitmap font is as large as another at this share of its size

}  // namespace

ImFont* addInterfaceFont(ImFontAtlas& atlas, double size, ImFontConfig config) {
    for (const char* file : fontFiles) {
        std::error_code ignored;
        if (!std::filesystem::exists(file, ignored)) continue;
        if (ImFont* font = atlas.AddFontFromFileTTF(file, static_cast<float>(size), &config, glyphs)) return font;
    }
    config.SizePixels = static_cast<float>(size * bitmapShare);
    return atlas.AddFontDefault(&config);
}

}  // namespace defocus
