#pragma once
// Dear ImGui over a Window: fonts, the light and the dark look, and the frames of the interface.

#include <imgui.h>

#include <array>

#include "gl/window.h"

namespace defocus {

// What widgets draw with beyond ImGui's own colours.
struct InterfaceColors {
    ImU32 text, faint, line, accent, warm, cool, fault, fill;
};

InterfaceColors interfaceColors(bool dark);
// Behind picture and panel, display values.
glm::vec3 windowColor(bool dark);

class ViewInterface {
public:
    // The window must outlive it.
    explicit ViewInterface(Window& window);
    ~ViewInterface();
    ViewInterface(const ViewInterface&) = delete;
    ViewInterface& operator=(const ViewInterface&) = delete;

    // `scale`: px a unit of the interface. `events`: what the frame takes of what people did (view/event_pacing.h).
    void beginFrame(bool dark, double scale, const std::vector<WindowEvent>& events);
    // Draws all widgets to the window's framebuffer.
    void endFrame();

private:
    void applyLook(bool dark, double scale);
    void feed(const std::vector<WindowEvent>& events);

    Window* window_;
    std::vector<WindowEvent> tappedKeys_;  // let go in the frame that pressed them: it saw them held
    std::array<bool, 3> buttons_{};        // held, as of the events so far
    glm::dvec2 mouse_{0.0};                // window units, likewise
    bool focused_ = false;
    double scale_ = 0;
    bool dark_ = true;
};

}  // namespace defocus
