#include "capture/shot_options.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "core/error.h"
#include "frame/settings/settings.h"
#include "frame/setup/moment.h"
#include "lens/lens_fields.h"

namespace defocus::engine {

namespace {

bool cameraPlaced(const Request& request) {
    return request.cameraPosition || request.cameraTarget || request.cameraUp;
}

// Removes a focus on a node, a pixel or the image's centre from the request and returns it, because a shot evaluates
// such a focus in each frame; nullopt for any other focus.
std::optional<FocusTarget> takeFocusTarget(Request& request) {
    const Focus focus = request.focus;
    std::optional<FocusTarget> target;
    if (const auto* const node = std::get_if<FocusNode>(&focus)) target = *node;
    if (const auto* const pixel = std::get_if<FocusPixel>(&focus)) target = *pixel;
    if (std::holds_alternative<FocusAuto>(focus)) target = FocusAuto{};
    if (target) request.focus = CameraFocus{};
    return target;
}

// Returns the lens fields that the request's focus points determine.
std::vector<const char*> fieldsOfFocusPoints(const Request& request) {
    const auto* const points = std::get_if<FocusPoints>(&request.focus);
    if (points == nullptr) return {};
    std::vector<const char*> fields = {"focusDistance", "focusTilt", "focusSwing"};
    if (points->pixels.size() > 3) fields.push_back("fieldCurvature");
    return fields;
}

// Scales the pixel positions at which the shot focuses from the shot's image size to the request's image size.
void scaleFocusPixels(Shot& shot, const Request& request) {
    if (!shot.focus || !shot.given.contains("size")) return;
    for (auto& key : shot.focus->keys)
        if (auto* const at = std::get_if<FocusPixel>(&key.value)) {
            const ImageSize& own = shot.request.size;
            at->pixel = {static_cast<int>((at->pixel.column + 0.5) * request.size.width / own.width),
                         static_cast<int>((at->pixel.row + 0.5) * request.size.height / own.height)};
        }
}

// Returns whether the shot contains lengths in metres. If so, one unit of its scene is a metre.
bool saysLength(const Shot& shot) {
    if (std::holds_alternative<CameraKeys>(shot.movement) || std::holds_alternative<Dolly>(shot.movement)) return true;
    return shot.focus && std::ranges::any_of(shot.focus->keys, [](const auto& key) {
               return std::holds_alternative<FocusDistance>(key.value);
           });
}

// Throws Error if the shot has keyframes for a setting that the method doesn't have.
void checkMethodKeys(const Shot& shot) {
    const Method& method = *chosenMethod(shot.request).method;
    for (const auto& [name, track] : shot.methodKeys)
        if (std::ranges::none_of(method.settings,
                                 [&](const MethodSetting& setting) { return setting.keyed && setting.name == name; }))
            fail("{}: /methodKeys/{}: method {} has no setting of this name that supports keyframes",
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
    if (shot.shutterAngle && !given.shutter) request.shutter = *shot.shutterAngle / 360 / shot.frameRate;
    if (request.targetError && !given.samples && !shot.given.contains("samples")) request.samples.reset();
    scaleFocusPixels(shot, request);
    if (!std::holds_alternative<CameraFocus>(request.focus)) {
        shot.focus.reset();
        shot.lens.erase("focusDistance");
    }
    for (const char* const name : fieldsOfFocusPoints(request)) shot.lens.erase(name);
    if (std::optional<FocusTarget> target = takeFocusTarget(request)) shot.focus = FocusTrack{.keys = {{0, *target}}};
    if (!request.units && saysLength(shot)) request.units = 1;
    if (request.lens.exposureTime && shot.given.contains("exposure")) request.exposure = DefaultExposure{};
    const LensValues lens = givenLensValues(request);
    std::erase_if(shot.lens, [&](const auto& entry) { return lens.contains(entry.first); });
    for (const auto& [name, track] : shot.lens) giveLensValue(request, *lensFieldNamed(name), track.keys.front().value);
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
    base.hidden = request.hide;
    base.shutter = shutterOf(request, *frame.scene);
    for (const auto& [name, value] : givenLensValues(request)) base.fixedLens.insert(name);
    for (const char* const name : fieldsOfFocusPoints(request)) base.fixedLens.insert(name);
    base.centre = frame.world.pose.bounds.centre();
    return base;
}

}  // namespace defocus::engine
