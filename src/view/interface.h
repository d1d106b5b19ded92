#pragma once
// Dear ImGui over a Window: fonts, the light and the dark look, and the frames of the interface.

#include <imgui.h>

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
    // Chains the window's event callbacks. The window must outlive it.
    explicit ViewInterface(Window& window);
    ~ViewInterface();
    ViewInterface(const ViewInterface&) = delete;
    ViewInterface& operator=(const ViewInterface&) = delete;

    // `scale`: px a unit of the interface. `events`: what came since the last frame; ImGui would miss keys that were
    // pressed and released between two frames.
    void beginFrame(bool dark, double scale, const std::vector<WindowEvent>& events);
    // Draws all widgets to the window's framebuffer.
    void endFrame();

private:
    void applyLook(bool dark, double scale);

    Window* window_;
    std::vector<int> tappedKeys_;  // that ImGui was told are down, though they were up again
    double scale_ = 0;
    bool dark_ = true;
};

}  // namespace defocus
