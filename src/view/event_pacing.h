#pragma once
// How many of the events that wait a frame may take. Dear ImGui looks at keys and buttons once a frame: on a slow
// driver, what a quick hand did within one frame (Ctrl A and the text that follows, a click and the word that is typed
// where it went) would come to it all at once, and some of it would be lost. The picture's own commands need no such
// care.

#include <deque>
#include <vector>

#include "gl/window.h"

namespace defocus {

struct EventPace {
    bool interfaceHasHand = false;  // a widget has the mouse or takes text, or a dialog is open
    glm::dvec2 pictureEnd{0.0};     // window units: what lies beyond is interface, whoever had the mouse before
};

// Takes the events from the front of the queue that may go into one frame; at least one where there is any. The rest
// waits for the next frame.
std::vector<WindowEvent> takeEvents(std::deque<WindowEvent>& queue, const EventPace& pace);

}  // namespace defocus
