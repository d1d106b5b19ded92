#pragma once
// Limits the number of events per frame. ImGui reads keys and buttons once per frame; if a slow frame took all waiting
// events, ImGui would lose some, such as text after Ctrl+A or after a click into a field. Events outside the interface,
// such as mouse moves that orbit the camera, need no limit.

#include <deque>
#include <vector>

#include "gl/window.h"

namespace defocus::engine {

struct EventPace {
    bool interfaceHasHand = false;  // true: a widget uses the mouse or takes text, or a dialog is open
    glm::dvec2 pictureEnd{0.0};     // lower right corner of the picture, window units; the panels lie beyond it
};

// Removes the events of one frame from the front of the queue, at least one if there are any. The other events wait for
// the next frame.
std::vector<WindowEvent> takeEvents(std::deque<WindowEvent>& queue, const EventPace& pace);

}  // namespace defocus::engine
