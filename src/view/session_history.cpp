// A view's edits: what is remembered of them, and how an earlier state comes back.

#include <algorithm>

#include "core/error.h"
#include "frame/exposure.h"
#include "scene/ground.h"
#include "view/session.h"

namespace defocus {

ViewEdit ViewSession::currentEdit() const {
    return {state_.options,       state_.camera,           state_.lens,   state_.nearPlane,
            state_.followsCamera, state_.display.exposure, state_.meters, state_.display.toneMap};
}

void ViewSession::noteEdits() {
    if (!frame_) return;
    const bool held = input_.holds() || state_.pull || state_.poppingSince || ImGui::IsAnyItemActive();
    history_.note(currentEdit(), held, now());
}

void ViewSession::stepInHistory(const ViewActions& actions) {
    if (!actions.undo && !actions.redo && !actions.resetAll) return;
    if (export_) {
        say("A still is being written; its scene stays as it is until then.");
        return;
    }
    // A pull that is under way has its end as its result.
    if (state_.pull) state_.lens.focusDistance = state_.pull->to;
    state_.pull.reset();
    if (actions.undo) restore(history_.undo(currentEdit()), "There is nothing to undo.");
    if (actions.redo) restore(history_.redo(currentEdit()), "There is nothing to redo.");
    if (actions.resetAll) restore(history_.reset(currentEdit()), "Everything is as it was opened.");
}

// Each part of the world that differs is changed by what changes it by hand, then the rest is set.
void ViewSession::restore(const std::optional<ViewEdit>& edit, const char* otherwise) {
    if (!edit) {
        say(otherwise);
        return;
    }
    const Request& wanted = edit->options;
    if (wanted.camera != state_.options.camera) chooseCamera(wanted.camera);
    if (wanted.nodeBlur != state_.options.nodeBlur || wanted.hidden != state_.options.hidden) {
        std::vector<Node>& nodes = frame_->scene->nodes;  // a ground may have come or gone
        for (std::size_t i = 0; i < std::min(nodes.size(), nodeBlurs_.size()); ++i) nodes[i].cocScale = nodeBlurs_[i];
        Request options = state_.options;
        options.nodeBlur = wanted.nodeBlur;
        setNodeBlur(options, *frame_->scene);
        options.hidden = wanted.hidden;
        hide(options);
    }
    if (wanted.ground != hasGround(*frame_->scene)) {
        Request options = state_.options;
        options.ground = wanted.ground;
        change(options);
    }
    const Request before = state_.options;
    const bool surroundings = wanted.environment != before.environment || wanted.background != before.background ||
                              wanted.environmentRotation != before.environmentRotation ||
                              wanted.backgroundColor != before.backgroundColor ||
                              wanted.lens.apertureImage != before.lens.apertureImage;
    Request options = wanted;
    options.time = before.time;
    options.clip = before.clip;
    options.ground = hasGround(*frame_->scene);
    if (surroundings)
        change(options);
    else
        state_.options = options;
    state_.environmentPath = options.environment.string();
    state_.aperturePath = options.lens.apertureImage.string();
    state_.camera = edit->camera;
    state_.lens = edit->lens;
    state_.nearPlane = edit->nearPlane;
    state_.followsCamera = edit->followsCamera;
    state_.display.exposure = edit->exposure;
    state_.meters = edit->meters;
    state_.display.toneMap = edit->toneMap;
    state_.marker.shown = false;
    state_.focusPoints.clear();
    if (!frame_->scene->clips.empty()) poseScene();
}

// Once things have come to rest: the exposure that the scene asks for there.
void ViewSession::meter() {
    if (!picture_ || !state_.meters || state_.lens.exposureTime > 0) {
        meterDue_ = true;
        return;
    }
    if (picture_->moving()) meterDue_ = true;
    if (picture_->moving() || !meterDue_ || export_) return;
    meterDue_ = false;
    state_.display.exposure = meteredExposure(frame_->world, currentView(), frame_->settings, shaderFolder_);
}

}  // namespace defocus
