#pragma once
// Applies mouse and key events over the picture to the window's state.

#include <set>

#include "frame/setup/prepared_frame.h"
#include "gl/window.h"
#include "view/state/view_state.h"

namespace defocus::engine {

struct InputContext {
    const PreparedFrame* frame = nullptr;  // null: no scene is open
    bool mouseOnInterface = false;         // true: a widget uses the mouse
    bool typing = false;                   // true: a text field or a dialog receives the keys
    bool navigating = false;               // true: keys move ImGui's focus between widgets
};

class ViewInput {
public:
    void handle(const WindowEvent& event, const InputContext& context, ViewState& state, ViewActions& actions);
    // Moves the camera by the fly keys (W A S D Q E) that are held down.
    void fly(const InputContext& context, double seconds, ViewState& state) const;

    // Returns whether a mouse button over the picture, or a key pressed without Ctrl, is held down.
    [[nodiscard]] bool holds() const { return drag_ != Drag::none || !held_.empty(); }

private:
    enum class Drag { none, orbit, pan, divider };

    void press(const WindowEvent& event, const InputContext& context, const ViewState& state);
    void release(const WindowEvent& event, const InputContext& context, ViewState& state);
    void drag(const WindowEvent& event, ViewState& state);
    void pressKey(const WindowEvent& event, const InputContext& context, ViewState& state, ViewActions& actions);

    Drag drag_ = Drag::none;
    glm::dvec2 pressedAt_{0.0};
    glm::dvec2 last_{0.0};
    bool moved_ = false;
    double lastClick_ = -1;
    glm::dvec2 lastClickAt_{0.0};
    // Keys that were pressed without Ctrl. A key pressed with Ctrl is a command, even if Ctrl is released first.
    std::set<int> held_;
};

}  // namespace defocus::engine
