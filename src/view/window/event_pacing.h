#pragma once
// Limits the events of a frame. ImGui sees keys and buttons once per frame: if a slow frame took everything that
// happened meanwhile (Ctrl A and the text after it, a click and the word typed there), some of it would be lost. The
// picture's own commands need no limit.

#include <deque>
#include <vector>

#include "gl/window.h"

namespace defocus::engine {

struct EventPace {
    bool interfaceHasHand = false;  // a widget has the mouse or takes text, or a dialog is open
    glm::dvec2 pictureEnd{0.0};     // window units; the interface lies beyond
};

// Takes the events of one frame from the front of the queue, at least one if there are any. The others wait for the
// next frame.
std::vector<WindowEvent> takeEvents(std::deque<WindowEvent>& queue, const EventPace& pace);

}  // namespace defocus::engine
