#include "view/window/event_pacing.h"

#include <algorithm>
#include <optional>
#include <set>

namespace defocus::engine {

namespace {

bool isModifier(int code) {
    return code >= key::leftShift && code <= key::lastModifier;
}

// Returns whether the effect of a key depends on previously typed text: Return, Backspace, Tab, arrows …
bool edits(int code) {
    return code >= key::escape && !isModifier(code);
}

// Summary of the events already taken for the current frame.
struct Taken {
    bool button = false;
    bool editingKey = false;
    bool text = false;
    std::optional<bool> control;  // whether Ctrl is held with the pressed keys; nullopt: no key was pressed
    std::set<int> pressed;
};

bool mustWait(const WindowEvent& event, const Taken& taken) {
    using Type = WindowEvent::Type;
    if (taken.button) return true;  // a click changes the keyboard focus only in the next frame, so later events wait
    if (event.type == Type::text) return taken.editingKey;
    if (event.type != Type::key || !event.pressed || event.repeated || isModifier(event.key)) return false;
    const bool otherControl = taken.control && *taken.control != event.control;
    const bool afterText = edits(event.key) && (taken.text || !taken.pressed.empty());
    return otherControl || afterText || taken.editingKey || taken.pressed.contains(event.key);
}

void note(const WindowEvent& event, Taken& taken) {
    using Type = WindowEvent::Type;
    taken.button = event.type == Type::button;
    taken.text = taken.text || event.type == Type::text;
    if (event.type != Type::key || !event.pressed || isModifier(event.key)) return;
    taken.control = event.control;
    taken.editingKey = edits(event.key);
    taken.pressed.insert(event.key);
}

}  // namespace

std::vector<WindowEvent> takeEvents(std::deque<WindowEvent>& queue, const EventPace& pace) {
    std::vector<WindowEvent> result;
    Taken taken;
    bool paced = pace.interfaceHasHand;
    while (!queue.empty()) {
        const WindowEvent& event = queue.front();
        const bool beside = event.position.x >= pace.pictureEnd.x || event.position.y >= pace.pictureEnd.y;
        paced = paced || (event.type == WindowEvent::Type::button && beside);
        if (paced && mustWait(event, taken)) break;
        if (paced) note(event, taken);
        result.push_back(std::move(queue.front()));
        queue.pop_front();
    }
    return result;
}

}  // namespace defocus::engine
