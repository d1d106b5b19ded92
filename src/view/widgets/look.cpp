#include "view/widgets/look.h"

#include <array>
#include <filesystem>
#include <optional>
#include <system_error>

namespace defocus::engine {

namespace {

constexpr double fontSize = 15;            // font size in interface units
constexpr double bitmapShare = 13.0 / 15;  // scales fontSize so that ImGui's bitmap font looks as large as other fonts

// Ranges of glyphs: Latin, Greek (λ), punctuation, arrows, simple shapes and the check mark.
constexpr ImWchar glyphs[] = {0x20,   0xff,   0x192,  0x192,  0x370,  0x3ff,  0x2010, 0x2044, 0x2190,
                              0x21ff, 0x2212, 0x2265, 0x25a0, 0x25ff, 0x2713, 0x2713, 0};

// Sets neutral greys, which don't influence how the picture's colours look, and one accent colour.
void setColors(ImGuiStyle& style, bool dark) {
    (dark ? ImGui::StyleColorsDark : ImGui::StyleColorsLight)(&style);
    const auto grey = [&](ImGuiCol color, float inDark, float inLight) {
        const float value = dark ? inDark : inLight;
        style.Colors[color] = {value, value, value, 1};
    };
    const auto accent = [&](ImGuiCol color, float alpha) {
        style.Colors[color] = dark ? ImVec4(0.33f, 0.58f, 0.85f, alpha) : ImVec4(0.16f, 0.42f, 0.72f, alpha);
    };
    grey(ImGuiCol_Text, 0.90f, 0.10f);
    grey(ImGuiCol_TextDisabled, 0.58f, 0.42f);
    grey(ImGuiCol_WindowBg, 0.135f, 0.945f);
    grey(ImGuiCol_PopupBg, 0.165f, 0.97f);
    grey(ImGuiCol_Border, 0.23f, 0.80f);
    grey(ImGuiCol_FrameBg, 0.205f, 0.855f);
    grey(ImGuiCol_FrameBgHovered, 0.25f, 0.80f);
    grey(ImGuiCol_FrameBgActive, 0.29f, 0.76f);
    grey(ImGuiCol_TitleBg, 0.165f, 0.90f);
    grey(ImGuiCol_TitleBgActive, 0.165f, 0.90f);
    grey(ImGuiCol_Header, 0.185f, 0.885f);
    grey(ImGuiCol_HeaderHovered, 0.24f, 0.83f);
    grey(ImGuiCol_HeaderActive, 0.28f, 0.78f);
    grey(ImGuiCol_Button, 0.235f, 0.83f);
    grey(ImGuiCol_ButtonHovered, 0.29f, 0.77f);
    grey(ImGuiCol_Separator, 0.23f, 0.80f);
    grey(ImGuiCol_ScrollbarBg, 0.135f, 0.945f);
    accent(ImGuiCol_ButtonActive, 1);
    accent(ImGuiCol_CheckMark, 1);
    accent(ImGuiCol_SliderGrab, 0.45f);  // translucent, because the value is drawn over the grab
    accent(ImGuiCol_SliderGrabActive, 0.65f);
    accent(ImGuiCol_PlotHistogram, 1);
    accent(ImGuiCol_NavHighlight, 1);
    accent(ImGuiCol_TextSelectedBg, 0.4f);
    style.Colors[ImGuiCol_PlotHistogramHovered] =
        dark ? ImVec4(0.94f, 0.63f, 0.24f, 1) : ImVec4(0.80f, 0.44f, 0.05f, 1);
    style.Colors[ImGuiCol_ModalWindowDimBg] = {0, 0, 0, 0.3f};  // leave the picture visible behind a dialog
}

// Returns the path of a sans-serif TrueType font with Latin and Greek letters, if one is installed in a common
// location.
std::optional<std::filesystem::path> sansSerifFile() {
    constexpr std::array files = {
        "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
        "/usr/share/fonts/TTF/DejaVuSans.ttf",
        "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
        "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
        "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
        "/Library/Fonts/Arial Unicode.ttf",
    };
    std::error_code ignored;
    for (const char* file : files)
        if (std::filesystem::is_regular_file(file, ignored)) return file;
    return std::nullopt;
}

}  // namespace

glm::vec3 windowColor(bool dark) {
    return glm::vec3(dark ? 0.09f : 0.78f);
}

void setStyle(bool dark, double scale) {
    ImGuiStyle style;
    setColors(style, dark);
    style.WindowPadding = {12, 10};
    style.FramePadding = {7, 4};
    style.ItemSpacing = {7, 6};
    style.ItemInnerSpacing = {6, 5};
    style.IndentSpacing = 14;
    style.ScrollbarSize = 11;
    style.WindowRounding = 4;
    style.FrameRounding = 3;
    style.GrabRounding = 3;
    style.PopupRounding = 3;
    style.ScrollbarRounding = 4;
    style.GrabMinSize = 6;
    style.WindowBorderSize = 1;
    style.ScaleAllSizes(static_cast<float>(scale));
    ImGui::GetStyle() = style;
}

void addFont(ImFontAtlas& atlas, double scale) {
    const std::optional<std::filesystem::path> file = sansSerifFile();
    const auto size = static_cast<float>(fontSize * scale);
    if (file && atlas.AddFontFromFileTTF(file->c_str(), size, nullptr, glyphs) != nullptr) return;
    ImFontConfig config;
    config.SizePixels = static_cast<float>(fontSize * scale * bitmapShare);
    atlas.AddFontDefault(&config);
}

}  // namespace defocus::engine
