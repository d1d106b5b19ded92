#pragma once
// Runs ImGui in a Window: feeds it events and draws its frames.

#include <array>
#include <vector>

#include "gl/window.h"

namespace defocus::engine {

class ViewInterface {
public:
    // The window must outlive it.
    explicit ViewInterface(Window& window);
    ~ViewInterface();
    ViewInterface(const ViewInterface&) = delete;
    ViewInterface& operator=(const ViewInterface&) = delete;

    // Begins a frame. `scale`: px per unit of the interface. `events`: the events of this frame (event_pacing.h).
    void beginFrame(bool dark, double scale, const std::vector<WindowEvent>& events);
    // Draws the widgets to the window's framebuffer.
    void endFrame();

private:
    void feed(const std::vector<WindowEvent>& events);

    Window* window_;

    std::vector<WindowEvent> tappedKeys_;  // pressed and released in one frame; ImGui gets the release in the next
    std::array<bool, 3> buttons_{};        // held buttons, according to the events so far
    glm::dvec2 mouse_{0.0};                // window units
    bool focused_ = false;
    double scale_ = 0;
    bool dark_ = true;
};

}  // namespace defocus::engine
