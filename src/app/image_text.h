#pragma once
// Words in images: labels of contact sheets.

#include <imgui.h>

#include <string_view>

#include "image/image.h"

namespace defocus {

// A typeface at one size, drawn into images on the CPU. No context of Dear ImGui or OpenGL is needed.
class ImageFont {
public:
    explicit ImageFont(double size);  // px

    [[nodiscard]] double lineHeight() const;
    // One line of UTF-8 from its top left corner, `value` in all channels of the image, over what is there; what lies
    // outside the image is left out. Signs that the font lacks become question marks.
    void draw(Image& image, double x, double y, std::string_view text, float value) const;

private:
    ImFontAtlas atlas_;
    ImFont* font_ = nullptr;
    const unsigned char* coverage_ = nullptr;  // of the atlas, a byte a pixel
    int atlasWidth_ = 0;
    int atlasHeight_ = 0;
};

}  // namespace defocus
