#include "view/interface.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>

#include <algorithm>
#include <cfloat>
#include <optional>
#include <set>
#include <utility>

#include "view/font.h"

namespace defocus {

namespace {

constexpr double fontSize = 15;  // units

// The backend makes the font's texture once, with its other resources.
void loadFont(double scale) {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    const bool hadTexture = atlas.IsBuilt();
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    atlas.Clear();
    addViewFont(atlas, fontSize * scale);
    if (hadTexture) ImGui_ImplOpenGL3_CreateFontsTexture();
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
    accented(ImGuiCol_SliderGrab, 0.45f);  // the value is written over it
    accented(ImGuiCol_SliderGrabActive, 0.65f);
    accented(ImGuiCol_PlotHistogram, 1);
    accented(ImGuiCol_PlotLines, 1);
    accented(ImGuiCol_NavHighlight, 1);
    accented(ImGuiCol_TextSelectedBg, 0.4f);
    style.Colors[ImGuiCol_ModalWindowDimBg] = grey(0, 0.3f);  // a dialog doesn't wash the picture out
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
    // Its callbacks would tell it of events before the frame that takes them.
    ImGui_ImplGlfw_InitForOpenGL(window.native(), false);
    ImGui_ImplOpenGL3_Init("#version 450");
}

ViewInterface::~ViewInterface() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

void ViewInterface::applyLook(bool dark, double scale) {
    if (scale != scale_) loadFont(scale);
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
    scale_ = scale;
    dark_ = dark;
}

void ViewInterface::beginFrame(bool dark, double scale, const std::vector<WindowEvent>& events) {
    if (dark != dark_ || scale != scale_) applyLook(dark, scale);
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    feed(events);
    ImGui::NewFrame();
}

// What GLFW's state says is of now; what the frame takes may have been otherwise.
void ViewInterface::feed(const std::vector<WindowEvent>& events) {
    ImGuiIO& io = ImGui::GetIO();
    GLFWwindow* const window = window_->native();
    // Which finds the letter that the keyboard's layout has there.
    const auto tell = [&](const WindowEvent& event) {
        ImGui_ImplGlfw_KeyCallback(window, event.key, 0, event.pressed ? 1 : 0, 0);
    };
    if (const bool focused = window_->focused(); focused != std::exchange(focused_, focused) && !focused)
        std::ranges::fill(io.KeysDown, false);  // they are let go elsewhere
    for (const WindowEvent& event : std::exchange(tappedKeys_, {})) tell(event);
    std::array<bool, 3> pressed{};
    std::set<int> down;
    std::optional<WindowEvent> chord;  // the latest key that isn't a modifier
    for (const WindowEvent& event : events) {
        mouse_ = event.position;
        const auto button = static_cast<std::size_t>(event.button);
        switch (event.type) {
            case WindowEvent::Type::button:
                buttons_[button] = event.pressed;
                pressed[button] = pressed[button] || event.pressed;
                break;
            case WindowEvent::Type::scroll:
                io.MouseWheelH += static_cast<float>(event.scroll.x);
                io.MouseWheel += static_cast<float>(event.scroll.y);
                break;
            case WindowEvent::Type::text:
                io.AddInputCharacter(event.letter);
                break;
            case WindowEvent::Type::key:
                if (event.key < 0 || event.repeated) break;
                if (event.pressed) {
                    tell(event);
                    io.KeysDownDuration[event.key] = -1;  // pressed anew, even if no frame saw it up
                    down.insert(event.key);
                    if (event.key < key::leftShift) chord = event;
                } else if (down.contains(event.key)) {
                    tappedKeys_.push_back(event);  // it is down for this frame
                } else {
                    tell(event);
                }
                break;
            default:
                break;
        }
    }
    const bool away = !window_->hovered() && std::ranges::find(buttons_, true) == buttons_.end() && events.empty();
    io.MousePos =
        away ? ImVec2(-FLT_MAX, -FLT_MAX) : ImVec2(static_cast<float>(mouse_.x), static_cast<float>(mouse_.y));
    for (std::size_t i = 0; i < buttons_.size(); ++i) io.MouseDown[i] = buttons_[i] || pressed[i];
    // Of a chord that was let go within the frame, too.
    io.KeyCtrl = io.KeysDown[key::leftControl] || io.KeysDown[key::rightControl] || (chord && chord->control);
    io.KeyShift = io.KeysDown[key::leftShift] || io.KeysDown[key::rightShift] || (chord && chord->shift);
    io.KeyAlt = chord && chord->alt;
}

void ViewInterface::endFrame() {
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace defocus
