#pragma once
// Implements undo and redo of everything that affects the image: camera, lens, environment, levels, samples, exposure.
// Overlays, comparisons and the animation's time are not restored.

#include <deque>
#include <optional>
#include <vector>

#include "view/state/view_state.h"

namespace defocus::engine {

// Returns whether two states are equal in all properties that undo and redo restore.
bool sameEdit(const ViewEdit& a, const ViewEdit& b);

class EditHistory {
public:
    // Clears the history. `opened`: initial state of the scene, which reset() returns.
    void begin(const ViewEdit& opened);

    // Receives the state of each frame. `held`: whether a mouse button, a key or a widget is held. `seconds`: current
    // time, see ViewState::now. An edit becomes an undo step when `held` becomes false. An edit without holding, such
    // as by mouse wheel, becomes an undo step after half a second without change.
    void note(const ViewEdit& now, bool held, double seconds);

    // Return the state before the latest edit (undo) or after the next one (redo). Return nullopt if there is no such
    // step.
    std::optional<ViewEdit> undo(const ViewEdit& now);
    std::optional<ViewEdit> redo(const ViewEdit& now);
    // Returns the state in which the scene was opened, as an edit that can be undone. Returns nullopt if `now` equals
    // this state.
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
    bool pending_ = false;  // true: latest_ has changes that aren't an undo step yet
    bool held_ = false;
    double changedAt_ = 0;  // time of the latest change in s, as passed to note()
};

}  // namespace defocus::engine
