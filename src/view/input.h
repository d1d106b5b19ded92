#pragma once
// What hands do over the picture: mouse and keys become changes of the view's state.

#include <set>

#include "frame/prepared_frame.h"
#include "gl/window.h"
#include "view/state.h"

namespace defocus {

struct PictureArea {  // in window units, from the top left
    glm::dvec2 origin{0.0};
    glm::dvec2 size{1.0};
    // [−1, 1], y up.
    [[nodiscard]] glm::dvec2 normalized(const glm::dvec2& position) const;
    [[nodiscard]] bool contains(const glm::dvec2& position) const;
};

struct InputContext {
    PictureArea area;
    const PreparedFrame* frame = nullptr;  // null: there is no scene yet
    bool mouseOnInterface = false;         // a widget takes the mouse
    bool typing = false;                   // a text field or a dialog takes the keys
    bool navigating = false;               // the keyboard moves between widgets
    double now = 0;                        // s
};

class ViewInput {
public:
    void handle(const WindowEvent& event, const InputContext& context, ViewState& state, ViewActions& actions);
    // Keys that act while they are held: flying.
    void fly(const InputContext& context, double seconds, ViewState& state) const;

    // A button is held down over the picture, or a key that flies.
    [[nodiscard]] bool holds() const { return drag_ != Drag::none || !held_.empty(); }

private:
    enum class Drag { none, orbit, pan, divider };

    void press(const WindowEvent& event, const InputContext& context, ViewState& state);
    void release(const WindowEvent& event, const InputContext& context, ViewState& state, ViewActions& actions);
    void drag(const WindowEvent& event, const InputContext& context, ViewState& state);
    void hold(const WindowEvent& event, const InputContext& context);

    Drag drag_ = Drag::none;
    glm::dvec2 pressedAt_{0.0};
    glm::dvec2 last_{0.0};
    bool moved_ = false;
    double lastClick_ = -1;
    glm::dvec2 lastClickAt_{0.0};  // window units
    std::set<int> held_;  // keys that went down without Control: with it they are commands, whichever is let go first
};

// tan of half the field of view, horizontally and vertically, of the picture.
glm::dvec2 tanHalfFov(const ViewState& state, const PictureArea& area);

// The surface under a point of the picture: the object, and its depth along the view axis (m).
struct PickedSurface {
    int object = -1;
    double depth = 0;
};
std::optional<PickedSurface> pickedSurface(const PreparedFrame& frame, const ViewState& state, const PictureArea& area,
                                           const glm::dvec2& position);

// The cameras of a file that can be chosen by name, in its order.
std::vector<std::string> cameraNames(const Scene& scene);

// Begins to pull the focus to `distance` m.
void pullFocus(ViewState& state, double distance, double now, double seconds = 0.4);

// The keys, for people: what to press, what it does.
struct KeyHelp {
    const char* keys;
    const char* meaning;
};
std::span<const KeyHelp> keyHelp();

}  // namespace defocus
