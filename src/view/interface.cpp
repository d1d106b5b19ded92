#include "view/interface.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>

#include "view/font.h"

namespace defocus {

namespace {

constexpr double fontSize = 15;  // units

void loadFont(double scale) {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    atlas.Clear();
    addViewFont(atlas, fontSize * scale);
}

ImVec4 grey(float value, float alpha = 1) {
    return {value, value, value, alpha};
}

// Neutral greys: nothing beside a picture should tint it.
void setColors(ImGuiStyle& style, bool dark) {
    if (dark)
        ImGui::StyleColorsDark(&style);
    else
        ImGui::StyleColorsLight(&style);
    const ImVec4 accent = dark ? ImVec4(0.33f, 0.58f, 0.85f, 1) : ImVec4(0.16f, 0.42f, 0.72f, 1);
    const auto set = [&](ImGuiCol color, float inDark, float inLight) {
        style.Colors[color] = grey(dark ? inDark : inLight);
    };
    const auto accented = [&](ImGuiCol color, float alpha) {
        style.Colors[color] = {accent.x, accent.y, accent.z, alpha};
    };
    set(ImGuiCol_Text, 0.90f, 0.10f);
    set(ImGuiCol_TextDisabled, 0.58f, 0.42f);
    set(ImGuiCol_WindowBg, 0.135f, 0.945f);
    set(ImGuiCol_PopupBg, 0.165f, 0.97f);
    set(ImGuiCol_Border, 0.23f, 0.80f);
    set(ImGuiCol_FrameBg, 0.205f, 0.855f);
    set(ImGuiCol_FrameBgHovered, 0.25f, 0.80f);
    set(ImGuiCol_FrameBgActive, 0.29f, 0.76f);
    set(ImGuiCol_TitleBg, 0.165f, 0.90f);
    set(ImGuiCol_TitleBgActive, 0.165f, 0.90f);
    set(ImGuiCol_Header, 0.185f, 0.885f);
    set(ImGuiCol_HeaderHovered, 0.24f, 0.83f);
    set(ImGuiCol_HeaderActive, 0.28f, 0.78f);
    set(ImGuiCol_Button, 0.235f, 0.83f);
    set(ImGuiCol_ButtonHovered, 0.29f, 0.77f);
    set(ImGuiCol_Separator, 0.23f, 0.80f);
    set(ImGuiCol_ScrollbarBg, 0.135f, 0.945f);
    accented(ImGuiCol_ButtonActive, 1);
    accented(ImGuiCol_CheckMark, 1);
    accented(ImGuiCol_SliderGrab, 1);
    accented(ImGuiCol_SliderGrabActive, 1);
    accented(ImGuiCol_PlotHistogram, 1);
    accented(ImGuiCol_PlotLines, 1);
    accented(ImGuiCol_NavHighlight, 1);
    accented(ImGuiCol_TextSelectedBg, 0.4f);
}

}  // namespace

InterfaceColors interfaceColors(bool dark) {
    if (dark)
        return {IM_COL32(230, 230, 230, 255), IM_COL32(148, 148, 148, 255), IM_COL32(70, 70, 70, 255),
                IM_COL32(84, 148, 217, 255),  IM_COL32(240, 160, 60, 255),  IM_COL32(84, 148, 217, 255),
                IM_COL32(224, 84, 72, 255),   IM_COL32(44, 44, 44, 255)};
    return {IM_COL32(26, 26, 26, 255),   IM_COL32(107, 107, 107, 255), IM_COL32(196, 196, 196, 255),
            IM_COL32(41, 107, 184, 255), IM_COL32(204, 112, 12, 255),  IM_COL32(41, 107, 184, 255),
            IM_COL32(190, 44, 34, 255),  IM_COL32(226, 226, 226, 255)};
}

glm::vec3 windowColor(bool dark) {
    return glm::vec3(dark ? 0.09f : 0.78f);
}

ViewInterface::ViewInterface(Window& window) : window_(&window) {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;  // settings are ours to keep
    io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    ImGui_ImplGlfw_InitForOpenGL(window.native(), true);
    ImGui_ImplOpenGL3_Init("#version 450");
}

ViewInterface::~ViewInterface() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

void ViewInterface::applyLook(bool dark, double scale) {
    if (scale != scale_) {
        loadFont(scale);
        ImGui_ImplOpenGL3_DestroyFontsTexture();
    }
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
    style.GrabMinSize = 9;
    style.WindowBorderSize = 1;
    style.ScaleAllSizes(static_cast<float>(scale));
    ImGui::GetStyle() = style;
    scale_ = scale;
    dark_ = dark;
}

void ViewInterface::beginFrame(bool dark, double scale, const std::vector<WindowEvent>& events) {
    if (dark != dark_ || scale != scale_) applyLook(dark, scale);
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGuiIO& io = ImGui::GetIO();
    for (const int code : tappedKeys_) io.KeysDown[code] = window_->keyHeld(code);
    tappedKeys_.clear();
    for (const WindowEvent& event : events) {
        if (event.type != WindowEvent::Type::key || !event.pressed || event.key < 0) continue;
        io.KeysDown[event.key] = true;
        tappedKeys_.push_back(event.key);
    }
    ImGui::NewFrame();
}

void ViewInterface::endFrame() {
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace defocus
