// The picture of a view: what the state asks for.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "frame/picture_warnings.h"
#include "frame/plan_warnings.h"
#include "frame/reference_image.h"
#include "view/session.h"

namespace defocus {

namespace {

constexpr std::uint32_t clippingSamples = 16;  // that show whether a picture is clipped

}

PictureRequest ViewSession::request() const {
    PictureRequest result;
    result.view = currentView();
    result.settings = state_.options.settings;
    result.poseVersion = poseVersion_;
    result.first = {chosenMethod(state_.options), state_.options.settings.lod, 0};
    result.display = state_.display;
    result.display.exposure = shownExposure(state_);
    result.mostSamples = state_.mostSamples;
    result.targetError = state_.options.stop.targetError;
    result.restOfFrame = interfaceMilliseconds_;
    const MethodUse accumulation = parseMethodUse("accumulation");
    switch (state_.comparison) {
        case Comparison::none:
            break;
        case Comparison::fullDetail:
            result.second = {result.first.method, LodMode::off, 0};
            break;
        case Comparison::nearest:
            result.second = {result.first.method, LodMode::nearest, 0};
            break;
        case Comparison::reference:
            result.second = {accumulation, LodMode::off, referenceOffset};
            break;
        case Comparison::method:
            result.second = {parseMethodUse(state_.comparedMethod), state_.options.settings.lod, 0};
            break;
    }
    if (state_.poppingSince) {
        // From the nearest to the farthest object and back, evenly in 1/distance.
        double nearest = 1e6;
        double farthest = 1e-3;
        for (const ObjectPlan& object : picture_->plan().objects) {
            nearest = std::min(nearest, std::max(object.nearestDepth, 2 * result.view.nearPlane));
            farthest = std::max(farthest, object.farthestDepth);
        }
        const double share =
            0.5 - 0.5 * std::cos(2 * std::numbers::pi * (now() - *state_.poppingSince) / poppingDuration);
        result.view.lens.focusDistance = 1 / ((1 - share) / nearest + share / std::max(nearest, farthest));
        result.first = {accumulation, LodMode::fractional, 0};
        result.second = {accumulation, LodMode::nearest, 0};
        result.fixedQuality = FrameQuality{window_.software() ? 0.5 : 1.0, 16, 1};
    }
    return result;
}

void ViewSession::makePicture() {
    RendererOptions options;
    options.layerFormat = state_.options.layerFormat;
    options.shaderFolder = shaderFolder_;
    options.wave = state_.options.wave > 0 ? state_.options.wave : (window_.software() ? 1 : 8);
    picture_.emplace(frame_->world, options, window_.software());
}

void ViewSession::updatePicture() {
    if (!picture_) return;
    try {
        picture_->update(request(), state_.budget);
    } catch (const Error& error) {
        // A request that can't be drawn: back to what can.
        say(error.what(), true);
        if (state_.comparison != Comparison::none || state_.poppingSince) {
            state_.comparison = Comparison::none;
            state_.poppingSince.reset();
        } else if (state_.options.method != "accumulation") {
            state_.options.method = "accumulation";
            state_.options.methodSettings.clear();
        } else {
            throw;
        }
        makePicture();
        picture_->update(request(), state_.budget);
    }
}

// What a person should know of a picture that rests. The plan knows most of it; what is clipped is looked for once.
void ViewSession::updateWarnings() {
    warnings_.clear();
    if (!picture_ || picture_->moving()) {
        clippingKnownAt_.reset();
        return;
    }
    const WriteOptions write = writeOptions();
    const std::pair key(write.exposure, write.toneMap);
    if (picture_->samples() >= clippingSamples && clippingKnownAt_ != key) {
        clipping_ = clippingWarnings(picture_->image(), write);
        clippingKnownAt_ = key;
    }
    warnings_ = planWarnings(picture_->plan(), chosenMethod(state_.options), state_.mostSamples);
    if (clippingKnownAt_) warnings_.insert(warnings_.end(), clipping_.begin(), clipping_.end());
}

std::string ViewSession::sideLabel(const PictureSide& side) const {
    if (side.firstSample == referenceOffset) return "reference";
    const std::string method = side.method.text();
    if (method != "accumulation") return method;
    return side.lod == LodMode::off ? "full detail" : std::string(lodModeName(side.lod)) + " levels";
}

}  // namespace defocus
