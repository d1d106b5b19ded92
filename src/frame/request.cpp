#include "frame/request.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.h"
#include "frame/settings.h"
#include "lens/lens_fields.h"
#include "render/frame_run.h"

namespace defocus {

MethodUse chosenMethod(const Request& request) try {
    MethodUse use = parseMethodUse(request.method);
    for (const auto& [name, value] : request.methodSettings) use.settings[name] = value;
    use.settings = completeSettings(use.method->name, use.method->settings, use.settings);
    return use;
} catch (const Error& error) {
    throw UsageError(error.what());
}

bool isAutomatic(const Request& request) {
    const bool exact = request.shutter.seconds > 0 && request.shutter.exactMotion;
    return request.settings.sampleCount == automaticSamples && !request.stop.given() && !exact &&
           chosenMethod(request).method->sumsBlocks;
}

void checkStop(const Request& request) {
    checkStop(request.stop, *chosenMethod(request).method, request.shutter);
}

namespace {

void checkValue(const Setting& setting, const Request& request, Request& scratch) {
    if (setting.lensField) {  // their text holds no infinity
        const LensField& field = *lensFieldNamed(setting.name);
        giveLensValue(scratch.lens, field, givenLensValue(request.lens, field));
    } else if (setting.repeated) {
        for (const std::string& text : setting.texts(request)) setting.set(scratch, text);
    } else if (const std::optional<std::string> text = setting.text(request)) {
        setting.set(scratch, *text);
    } else if (setting.kind == SettingKind::choice && setting.text(Request{})) {
        fail("give one of {}", fmt::join(setting.choices, ", "));
    }
}

}  // namespace

void checkRequest(const Request& request) {
    Request scratch;
    for (const Setting& setting : settings()) try {
            checkValue(setting, request, scratch);
        } catch (const Error& error) {
            throw UsageError(fmt::format("{}: {}", setting.name, error.what()));
        }
    if (request.stop.sampleLimit < 1 || request.stop.sampleLimit > mostSamples)
        throw UsageError(
            fmt::format("sampleLimit: {} is not a whole number from 1 to {}", request.stop.sampleLimit, mostSamples));
    checkStop(request);
    const int focuses = (request.lens.focusDistance ? 1 : 0) + (request.focusNode.empty() ? 0 : 1) +
                        (request.focusPixel ? 1 : 0) + (request.focusPoints.empty() ? 0 : 1) +
                        (request.focusAuto ? 1 : 0);
    if (focuses > 1)
        throw UsageError("give at most one of focusDistance, focusNode, focusPixel, focusPoints and focusAuto");
}

}  // namespace defocus
