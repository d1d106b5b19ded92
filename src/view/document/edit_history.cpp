#include "view/document/edit_history.h"

#include <algorithm>
#include <utility>

#include "frame/settings/settings.h"
#include "lens/lens_fields.h"

namespace defocus::engine {

namespace {

constexpr std::size_t maxSteps = 200;
constexpr double restTime = 0.5;  // seconds without change after which an edit is complete

bool sameOptions(const Request& a, const Request& b) {
    return std::ranges::all_of(settings(), [&](const Setting& setting) {
        if (setting.name == "time" || setting.name == "clip" || setting.name == "size") return true;
        return setting.repeated ? setting.texts(a) == setting.texts(b) : setting.text(a) == setting.text(b);
    });
}

bool sameLens(const Lens& a, const Lens& b) {
    return a.apertureImage == b.apertureImage && std::ranges::all_of(lensFields(), [&](const LensField& field) {
               return lensFieldValue(a, field) == lensFieldValue(b, field);
           });
}

bool sameCamera(const ViewEdit& a, const ViewEdit& b) {
    if (a.followsCamera != b.followsCamera) return false;
    if (a.followsCamera) return true;
    return a.camera.worldFromCamera == b.camera.worldFromCamera && a.nearPlane == b.nearPlane;
}

}  // namespace

bool sameEdit(const ViewEdit& a, const ViewEdit& b) {
    const bool exposed = a.meters == b.meters && (a.meters || a.exposure == b.exposure);
    return exposed && sameCamera(a, b) && sameLens(a.lens, b.lens) && sameOptions(a.options, b.options);
}

void EditHistory::begin(const ViewEdit& opened) {
    opened_ = current_ = latest_ = opened;
    before_.clear();
    after_.clear();
    pending_ = held_ = false;
}

void EditHistory::note(const ViewEdit& now, bool held, double seconds) {
    const bool changed = !sameEdit(now, latest_);
    const bool grasped = held && !held_;
    const bool letGo = !held && held_;
    held_ = held;
    if (grasped && pending_) commit(latest_);  // an edit by mouse wheel ends when a drag begins
    if (changed) changedAt_ = seconds;
    latest_ = now;
    if (changed) pending_ = !sameEdit(now, current_);
    if (pending_ && !held && (letGo || seconds - changedAt_ >= restTime)) commit(now);
}

void EditHistory::commit(const ViewEdit& now) {
    before_.push_back(std::exchange(current_, now));
    if (before_.size() > maxSteps) before_.pop_front();
    after_.clear();
    latest_ = now;
    pending_ = false;
}

std::optional<ViewEdit> EditHistory::step(const ViewEdit& now, Steps& from, Steps& to) {
    if (!sameEdit(now, current_)) commit(now);
    if (from.empty()) return std::nullopt;
    to.push_back(std::exchange(current_, from.back()));
    from.pop_back();
    latest_ = current_;
    pending_ = false;
    return current_;
}

std::optional<ViewEdit> EditHistory::undo(const ViewEdit& now) {
    return step(now, before_, after_);
}

std::optional<ViewEdit> EditHistory::redo(const ViewEdit& now) {
    return step(now, after_, before_);
}

std::optional<ViewEdit> EditHistory::reset(const ViewEdit& now) {
    if (!sameEdit(now, current_)) commit(now);
    if (sameEdit(current_, opened_)) return std::nullopt;
    commit(opened_);
    return current_;
}

}  // namespace defocus::engine
