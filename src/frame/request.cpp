#include "frame/request.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.h"
#include "frame/settings/settings.h"
#include "lens/lens_fields.h"
#include "render/frame_run.h"

namespace defocus::engine {

MethodUse namedMethod(const Request& request) try {
    const Method& method = methodNamed(request.method);
    return {&method, completeSettings(method.name, method.settings, request.methodSettings)};
} catch (const Error& error) {
    throw UsageError(error.what());
}

MethodUse chosenMethod(const Request& request) {
    const bool limited = request.method == automaticMethod && request.memory;
    return limited ? parseMethodUse("accumulation") : namedMethod(request);
}

RenderSettings renderSettings(const Request& request) {
    RenderSettings settings;
    settings.sampleCount = request.samples.value_or(settings.sampleCount);
    settings.positions = chosenMethod(request).method->drawsPositions ? request.positions.value_or(1) : 1;
    settings.sequence = request.sequence;
    settings.seed = request.seed;
    settings.lod = request.lod.value_or(settings.lod);
    settings.metric = request.lodMetric;
    settings.lodCoc = request.lodCoc;
    settings.levelVertices = request.levelVertices;
    settings.thresholds = givenThresholds(request);
    settings.shadows = request.shadows;
    settings.multipleScattering = request.multipleScattering;
    settings.cocTolerance = request.cocTolerance;
    settings.keepAll = request.keepAll;
    settings.layers = request.layers;
    return settings;
}

GivenThresholds givenThresholds(const Request& request) {
    return {request.blurThreshold, request.sizeThreshold, request.lightThreshold};
}

ShutterSettings shutterSettings(const Request& request) {
    return {request.shutter.value_or(0), request.shutterPosition, request.motionSegments, {}};
}

StopSettings stopSettings(const Request& request) {
    StopSettings stop{request.targetError, request.timeLimit, request.samples.value_or(maxSamples)};
    const bool opens = request.shutter.value_or(0) > 0 || (!request.shutter && !request.cameraFrom.empty());
    const bool exact = opens && shutterSettings(request).exactMotion();
    if (!request.samples && !stop.given() && !exact && chosenMethod(request).method->sumsBlocks)
        stop.automatic = request.quality;
    stop.choosesPositions = stop.automatic && !request.positions && request.layers.empty() &&
                            chosenMethod(request).method->name == automaticMethod;
    return stop;
}

LensValues givenLensValues(const Request& request) {
    LensValues values = givenLensValues(request.lens);
    if (const auto* const focus = std::get_if<FocusDistance>(&request.focus)) values["focusDistance"] = focus->metres;
    return values;
}

void giveLensValue(Request& request, const LensField& field, double value) {
    giveLensValue(request.lens, field, value);
    if (field.name == std::string_view("focusDistance")) request.focus = FocusDistance{value};
}

void checkStop(const Request& request) {
    checkStop(stopSettings(request), *chosenMethod(request).method, shutterSettings(request));
}

namespace {

void checkValue(const Setting& setting, const Request& request, Request& scratch) {
    // Check lens values as numbers, because their text form clamps infinity to a valid value. The focus distance
    // belongs to Request::focus and is checked as text.
    if (setting.lensField && setting.name != "focusDistance") {
        const LensField& field = *lensFieldNamed(setting.name);
        giveLensValue(scratch.lens, field, givenLensValue(request.lens, field));
    } else if (setting.repeated) {
        for (const std::string& text : setting.texts(request)) setting.set(scratch, text);
    } else if (const std::optional<std::string> text = setting.text(request)) {
        setting.set(scratch, *text);
    } else if (setting.kind == SettingKind::choice && setting.text(Request{})) {
        fail("choose one of {}", fmt::join(setting.choices, ", "));
    }
}

}  // namespace

void checkRequest(const Request& request) {
    Request scratch;
    for (const Setting& setting : settings()) try {
            checkValue(setting, request, scratch);
        } catch (const Error& error) {
            throw UsageError(namedError(setting.name, error.what()));
        }
    checkStop(request);
}

}  // namespace defocus::engine
