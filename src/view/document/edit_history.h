#pragma once
// Undo and redo of everything that determines the picture: camera, lens, surroundings, levels, samples, exposure.
// Overlays, comparisons and the animation's time don't count as edits.

#include <deque>
#include <optional>
#include <vector>

#include "view/state/view_state.h"

namespace defocus::engine {

// Returns whether both states differ in nothing that counts as an edit.
bool sameEdit(const ViewEdit& a, const ViewEdit& b);

class EditHistory {
public:
    // Restarts with the state in which a scene was opened.
    void begin(const ViewEdit& opened);

    // Takes the state of each frame. An edit becomes an undo step when the mouse button or key is released (`held`
    // turns false). Edits by mouse wheel and keys become one after half a second without change.
    void note(const ViewEdit& now, bool held, double seconds);

    // Returns the state before the latest edit, or after the next one; none if there is no such step.
    std::optional<ViewEdit> undo(const ViewEdit& now);
    std::optional<ViewEdit> redo(const ViewEdit& now);
    // Returns the opened state, as an edit that can be undone; none if nothing differs from it.
    std::optional<ViewEdit> reset(const ViewEdit& now);

    [[nodiscard]] std::size_t undoSteps() const { return before_.size() + (pending_ ? 1 : 0); }
    [[nodiscard]] std::size_t redoSteps() const { return after_.size(); }

private:
    using Steps = std::deque<ViewEdit>;
    void commit(const ViewEdit& now);
    std::optional<ViewEdit> step(const ViewEdit& now, Steps& from, Steps& to);

    ViewEdit opened_, current_;
    ViewEdit latest_;  // state of the previous frame
    Steps before_, after_;
    bool pending_ = false;  // latest_ differs from current_
    bool held_ = false;
    double changedAt_ = 0;  // s
};

}  // namespace defocus::engine
