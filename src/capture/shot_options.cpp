#include "capture/shot_options.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "core/error.h"
#include "frame/settings.h"
#include "lens/lens_fields.h"

namespace defocus {

namespace {

bool cameraPlaced(const Request& request) {
    return request.cameraPosition || request.cameraTarget || request.cameraUp;
}

// Where the request ask for a focus that each frame finds anew, it becomes the shot's: frames may show what the first
// pose doesn't.
std::optional<FocusTarget> takeFocusTarget(Request& request) {
    std::optional<FocusTarget> target;
    if (!request.focusNode.empty()) target = std::exchange(request.focusNode, {});
    if (request.focusPixel) target = FocusPixel{request.focusPixel->column, request.focusPixel->row};
    if (request.focusAuto) target = FocusAuto{};
    request.focusPixel.reset();
    request.focusAuto = false;
    return target;
}

// What focus points set of the lens.
std::vector<const char*> fieldsOfFocusPoints(const Request& request) {
    std::vector<const char*> fields;
    if (!request.focusPoints.empty()) fields = {"focusDistance", "focusTilt", "focusSwing"};
    if (request.focusPoints.size() > 3) fields.push_back("fieldCurvature");
    return fields;
}

// A shot names pixels of its own size; the same place of an image of another.
void scaleFocusPixels(Shot& shot, const Request& request) {
    if (!shot.focus || !shot.given.contains("size")) return;
    for (auto& key : shot.focus->keys)
        if (auto* pixel = std::get_if<FocusPixel>(&key.value)) {
            pixel->column = static_cast<int>((pixel->column + 0.5) * request.width / shot.request.width);
            pixel->row = static_cast<int>((pixel->row + 0.5) * request.height / shot.request.height);
        }
}

// A shot with lengths in metres is of a scene that its author knows to be in metres.
bool saysLength(const Shot& shot) {
    if (std::holds_alternative<CameraKeys>(shot.movement) || std::holds_alternative<Dolly>(shot.movement)) return true;
    return shot.focus && std::ranges::any_of(shot.focus->keys,
                                             [](const auto& key) { return std::holds_alternative<double>(key.value); });
}

// Throws Error for keys of a setting that the method doesn't have.
void checkMethodKeys(const Shot& shot) {
    const Method& method = *chosenMethod(shot.request).method;
    for (const auto& [name, track] : shot.methodKeys)
        if (std::ranges::none_of(method.settings,
                                 [&](const MethodSetting& setting) { return setting.keyed && setting.name == name; }))
            fail("{}: /methodKeys/{}: the method {} has no such setting that may change from frame to frame",
                 shot.file.string(), name, method.name);
}

}  // namespace

void applyShot(const Shot& shot, Request& request) {
    for (const std::string& name : shot.given) {
        const Setting& setting = *settingNamed(name);
        if (const std::optional<std::string> text = setting.text(shot.request)) setting.set(request, *text);
    }
}

void settleShot(Shot& shot, Request& request, const GivenOptions& given) {
    if (given.camera || cameraPlaced(request)) shot.movement = {};
    if (shot.shutterAngle && !given.shutter) request.shutter.seconds = *shot.shutterAngle / 360 / shot.frameRate;
    scaleFocusPixels(shot, request);
    const bool focusGiven = request.lens.focusDistance || !request.focusNode.empty() || request.focusPixel ||
                            !request.focusPoints.empty() || request.focusAuto;
    if (focusGiven) {
        shot.focus.reset();
        shot.lens.erase("focusDistance");
    }
    for (const char* const name : fieldsOfFocusPoints(request)) shot.lens.erase(name);
    if (std::optional<FocusTarget> target = takeFocusTarget(request)) shot.focus = FocusTrack{.keys = {{0, *target}}};
    if (!request.metresPerUnit && saysLength(shot)) request.metresPerUnit = 1;
    if (request.lens.exposureTime && shot.given.contains("exposure")) request.exposure.reset();
    const LensValues lens = givenLensValues(request.lens);
    std::erase_if(shot.lens, [&](const auto& entry) { return lens.contains(entry.first); });
    for (const auto& [name, track] : shot.lens)
        giveLensValue(request.lens, *lensFieldNamed(name), track.keys.front().value);
    shot.request = request;
    checkMethodKeys(shot);
}

SequenceBase sequenceBase(const PreparedFrame& frame, const Request& request) {
    SequenceBase base;
    base.scene = frame.scene;
    base.view = frame.view;
    base.settings = frame.settings;
    base.lights = frame.world.lights;
    base.camera = request.camera;
    base.cameraStands = cameraPlaced(request);
    base.hidden = request.hidden;
    base.shutter = request.shutter;
    for (const auto& [name, value] : givenLensValues(request.lens)) base.fixedLens.insert(name);
    for (const char* const name : fieldsOfFocusPoints(request)) base.fixedLens.insert(name);
    base.centre = frame.world.pose.bounds.centre();
    return base;
}

}  // namespace defocus
