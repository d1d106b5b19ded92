#pragma once
// Undo and redo of what makes the picture: camera, lens, surroundings, levels, samples, exposure. What is laid over it
// (overlays, comparisons) and the time of the animation are no edits.

#include <deque>
#include <optional>
#include <vector>

#include "frame/request.h"
#include "view/camera_controls.h"

namespace defocus {

// The part of a ViewState that edits change.
struct ViewEdit {
    Request options;
    ViewCamera camera;
    Lens lens;
    double nearPlane = 0.01;     // m
    bool followsCamera = false;  // the camera then is where the file says, and none of its places is an edit
    double exposure = 0;         // EV
    bool meters = false;         // its exposure is metered, and what the meter reads is no edit
    ToneMap toneMap = ToneMap::neutral;
};

// Does nothing that counts as an edit lie between the two?
bool sameEdit(const ViewEdit& a, const ViewEdit& b);

class EditHistory {
public:
    // Begins anew with a scene as it was opened.
    void begin(const ViewEdit& opened);

    // Tells the state of each frame. An edit is a step back once the hand has let go (`held` false again), or, of a
    // wheel and keys, once it has rested for half a second.
    void note(const ViewEdit& now, bool held, double seconds);

    // The state before the latest edit, or after the next; none where there isn't any.
    std::optional<ViewEdit> undo(const ViewEdit& now);
    std::optional<ViewEdit> redo(const ViewEdit& now);
    // The state as it was opened, to which undo() knows the way back; none where it is there already.
    std::optional<ViewEdit> reset(const ViewEdit& now);

    [[nodiscard]] std::size_t undoSteps() const { return before_.size() + (pending_ ? 1 : 0); }
    [[nodiscard]] std::size_t redoSteps() const { return after_.size(); }

private:
    void commit(const ViewEdit& now);

    ViewEdit opened_, current_, latest_;  // latest: of the frame before
    std::deque<ViewEdit> before_;
    std::vector<ViewEdit> after_;
    bool pending_ = false;  // latest_ isn't current_
    bool held_ = false;
    double changedAt_ = 0;  // s
};

}  // namespace defocus
