#pragma once
// Limits the events of a frame. ImGui reads keys and buttons once per frame. If a slow frame took all waiting events,
// some would be lost, such as text after Ctrl A or after a click into a field. The picture's own commands need no
// limit.

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
