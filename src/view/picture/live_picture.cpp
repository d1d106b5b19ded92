#include "view/picture/live_picture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "frame/driver/reference_image.h"
#include "frame/report/picture_warnings.h"
#include "frame/report/plan_warnings.h"
#include "frame/settings/settings.h"
#include "frame/setup/exposure.h"
#include "plan/motion/camera_path.h"

namespace defocus::engine {

namespace {

constexpr std::uint32_t minClippingSamples = 16;  // min lens samples before the image is checked for clipping

std::optional<PictureSide> comparedSide(const ViewState& state, const PictureSide& first) {
    switch (state.comparison) {
        case Comparison::none:
            break;
        case Comparison::fullDetail:
            return PictureSide{first.method, LodMode::off, 0};
        case Comparison::nearest:
            return PictureSide{first.method, LodMode::nearest, 0};
        case Comparison::reference:
            return PictureSide{"accumulation", LodMode::off, referenceOffset};
        case Comparison::method:
            return PictureSide{state.comparedMethod, first.lod, 0};
    }
    return std::nullopt;
}

// Returns the focus distance (m) of the popping test at `seconds` after its start. The focus moves from the nearest to
// the farthest object and back; 1/distance follows a cosine over time.
double poppingFocus(const FramePlan& plan, double nearPlane, double seconds) {
    double nearest = 1e6;
    double farthest = 1e-3;
    for (const ObjectPlan& object : plan.objects) {
        nearest = std::min(nearest, std::max(object.nearestDepth, 2 * nearPlane));
        farthest = std::max(farthest, object.farthestDepth);
    }
    const double share = 0.5 - 0.5 * std::cos(2 * std::numbers::pi * seconds / poppingDuration);
    return focusBetween(nearest, std::max(nearest, farthest), share);
}

// Returns, as one string, the settings that affect the picture, except the number of samples, the level mode and the
// method.
std::string pictureSettings(Request request) {
    const Request defaults;
    request.samples = defaults.samples;
    request.lod = defaults.lod;
    request.method = defaults.method;
    request.methodSettings.clear();
    return pixelSettings(request);
}

// Returns the request for drawing the picture of this state. `plan`: plan of the previous frame, which gives the depth
// range of the popping test.
PictureRequest pictureRequest(const Document& document, const ViewState& state, const FramePlan& plan, bool software) {
    PictureRequest result;
    result.view = currentView(document, state);
    result.settings = renderSettings(state.options);
    result.settingsKey = pictureSettings(state.options);
    result.poseVersion = document.poseVersion;
    result.display = state.display;
    result.display.exposure = shownExposure(state);
    result.display.toneMap = state.options.toneMap;
    result.maxSamples = state.maxSamples;
    result.imageBytes = state.imageBytes;
    result.targetError = state.options.targetError;
    if (state.poppingSince) {
        result.view.lens.focusDistance = poppingFocus(plan, result.view.nearPlane, state.now - *state.poppingSince);
        result.sides = {{"accumulation", LodMode::fractional, 0}, {"accumulation", LodMode::nearest, 0}};
        result.fixedQuality = FrameQuality{software ? 0.5 : 1.0, 16, 1};
        return result;
    }
    const PictureSide first{chosenMethod(state.options).text(), renderSettings(state.options).lod, 0};
    result.sides = {first};
    if (const std::optional<PictureSide> second = comparedSide(state, first)) result.sides.push_back(*second);
    return result;
}

void makeImage(LivePicture& picture, const Document& document, const ViewState& state, bool software) {
    RendererOptions options;
    options.layerFormat = state.options.layerFormat;
    options.shaderFolder = document.shaderFolder;
    options.wave = state.options.wave.value_or(software ? 1 : 8);
    picture.image.reset();  // free its memory before the next allocation
    picture.image.emplace(document.frame->world, options, software);
    picture.worldVersion = document.worldVersion;
}

// Simplifies a request that can't be drawn: turns off the comparison and the popping test or, if neither is on,
// replaces the method with accumulation. Returns false if the request is already as simple as possible.
bool simplifyRequest(ViewState& state) {
    if (state.comparison != Comparison::none || state.poppingSince) {
        state.comparison = Comparison::none;
        state.poppingSince.reset();
        return true;
    }
    if (state.options.method == "accumulation") return false;
    state.options.method = "accumulation";
    state.options.methodSettings.clear();
    return true;
}

// Measures and sets the exposure once the view has come to rest.
void meter(LivePicture& picture, Document& document, ViewState& state, bool exporting) {
    const bool moving = picture.image->moving();
    const bool meters = state.meters && !(state.lens.exposureTime > 0);
    picture.meterDue = picture.meterDue || moving || !meters;
    if (moving || !meters || !picture.meterDue || exporting) return;
    picture.meterDue = false;
    PreparedFrame& frame = *document.frame;
    state.exposure = meteredExposure(frame.world, currentView(document, state), frame.settings, document.shaderFolder);
}

// Updates the warnings about the picture of a view at rest. The check for clipping reads the image back from the GPU,
// so it runs only once per exposure and tone map.
void updateWarnings(LivePicture& picture, const ViewState& state) {
    picture.warnings.clear();
    if (picture.image->moving()) {
        picture.clippingKnownFor.reset();
        return;
    }
    const WriteOptions write = writeOptions(state);
    const std::pair key(write.exposure, write.toneMap);
    if (picture.image->samples() >= minClippingSamples && picture.clippingKnownFor != key) {
        picture.clipping = clippingWarnings(picture.image->image(), write);
        picture.clippingKnownFor = key;
    }
    picture.warnings = planWarnings(picture.image->plan(), chosenMethod(state.options), state.maxSamples);
    if (picture.clippingKnownFor)
        picture.warnings.insert(picture.warnings.end(), picture.clipping.begin(), picture.clipping.end());
}

}  // namespace

std::string sideLabel(const PictureSide& side) {
    if (side.firstSample == referenceOffset) return "reference";
    if (side.method != "accumulation") return side.method;
    return side.lod == LodMode::off ? "full detail" : std::string(lodModeName(side.lod)) + " levels";
}

void growPicture(LivePicture& picture, const Document& document, const ViewState& state) {
    if (picture.image && picture.worldVersion == document.worldVersion) picture.image->grow(state.budget);
}

void updatePicture(LivePicture& picture, Document& document, ViewState& state, bool software, double restOfFrame,
                   bool exporting) {
    if (!document.frame) return;
    if (!picture.image || picture.worldVersion != document.worldVersion) makeImage(picture, document, state, software);
    const auto update = [&] {
        PictureRequest request = pictureRequest(document, state, picture.image->plan(), software);
        request.restOfFrame = restOfFrame;
        picture.image->update(request, state.budget);
    };
    try {
        update();
    } catch (const Error& error) {
        sayFault(state, error.what());
        if (!simplifyRequest(state)) throw;
        makeImage(picture, document, state, software);
        update();
    }
    meter(picture, document, state, exporting);
    updateWarnings(picture, state);
}

}  // namespace defocus::engine
