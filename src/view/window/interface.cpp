#include "view/window/interface.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <cfloat>
#include <optional>
#include <set>
#include <utility>

#include "view/widgets/look.h"

namespace defocus::engine {

namespace {

void loadFont(double scale) {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    const bool hadTexture = atlas.IsBuilt();  // false: ImGui's backend creates the font texture in its first frame
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    atlas.Clear();
    addFont(atlas, scale);
    if (hadTexture) ImGui_ImplOpenGL3_CreateFontsTexture();
}

}  // namespace

ViewInterface::ViewInterface(Window& window) : window_(&window) {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    // Install no GLFW callbacks. They would pass events to ImGui at once, but the window may handle queued events only
    // in a later frame.
    ImGui_ImplGlfw_InitForOpenGL(window.native(), false);
    ImGui_ImplOpenGL3_Init("#version 450");
}

ViewInterface::~ViewInterface() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

void ViewInterface::beginFrame(bool dark, double scale, const std::vector<WindowEvent>& events) {
    if (scale != scale_) loadFont(scale);
    if (dark != dark_ || scale != scale_) setStyle(dark, scale);
    dark_ = dark;
    scale_ = scale;
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    feed(events);
    ImGui::NewFrame();
}

// Sets ImGui's input from the frame's events, because GLFW's own state may be ahead of these events.
void ViewInterface::feed(const std::vector<WindowEvent>& events) {
    ImGuiIO& io = ImGui::GetIO();
    GLFWwindow* const window = window_->native();
    // Passes a key event to ImGui's GLFW backend, which maps the key according to the keyboard layout.
    const auto tell = [&](const WindowEvent& event) {
        ImGui_ImplGlfw_KeyCallback(window, event.key, 0, event.pressed ? 1 : 0, 0);
    };
    if (const bool focused = window_->focused(); focused != std::exchange(focused_, focused) && !focused)
        std::ranges::fill(io.KeysDown, false);  // focus was lost: another window receives the key releases
    for (const WindowEvent& event : std::exchange(tappedKeys_, {})) tell(event);
    std::array<bool, 3> pressed{};
    std::set<int> down;
    std::optional<WindowEvent> chord;  // latest pressed key that isn't a modifier
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
                    io.KeysDownDuration[event.key] = -1;  // makes ImGui see a new press, even if no release preceded it
                    down.insert(event.key);
                    if (event.key < key::leftShift) chord = event;
                } else if (down.contains(event.key)) {
                    tappedKeys_.push_back(event);  // release the key in the next frame, so that ImGui sees the press
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
    // The modifiers of a key count even if they were released within the frame.
    io.KeyCtrl = io.KeysDown[key::leftControl] || io.KeysDown[key::rightControl] || (chord && chord->control);
    io.KeyShift = io.KeysDown[key::leftShift] || io.KeysDown[key::rightShift] || (chord && chord->shift);
    io.KeyAlt = chord && chord->alt;
}

void ViewInterface::endFrame() {
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace defocus::engine
