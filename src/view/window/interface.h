#pragma once
// Runs ImGui in a Window: passes events to ImGui and draws its widgets.

#include <array>
#include <vector>

#include "gl/window.h"

namespace defocus::engine {

class ViewInterface {
public:
    // `window` must outlive the interface.
    explicit ViewInterface(Window& window);
    ~ViewInterface();
    ViewInterface(const ViewInterface&) = delete;
    ViewInterface& operator=(const ViewInterface&) = delete;

    // Begins a frame. `scale`: px per interface unit. `events`: events of this frame (event_pacing.h).
    void beginFrame(bool dark, double scale, const std::vector<WindowEvent>& events);
    // Draws the widgets of the frame to the window's framebuffer.
    void endFrame();

private:
    void feed(const std::vector<WindowEvent>& events);

    Window* window_;

    std::vector<WindowEvent> tappedKeys_;  // keys pressed and released in one frame; ImGui gets the release in the next
    std::array<bool, 3> buttons_{};        // whether each mouse button is down after the latest event
    glm::dvec2 mouse_{0.0};                // mouse position, window units
    bool focused_ = false;
    double scale_ = 0;
    bool dark_ = true;
};

}  // namespace defocus::engine
