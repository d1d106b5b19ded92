#include "view/export/shot.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>
#include <string_view>

#include "capture/setting_json.h"
#include "frame/settings/settings.h"
#include "lens/lens_fields.h"
#include "plan/motion/camera_path.h"
#include "scene/built_in_environment.h"

namespace defocus::engine {

namespace {

using nlohmann::ordered_json;

// Returns a lens value as a JSON boolean, integer or number, according to the field's type.
ordered_json valueJson(const LensField& field, double value) {
    if (std::holds_alternative<bool Lens::*>(field.member)) return value != 0;
    if (std::holds_alternative<int Lens::*>(field.member)) return static_cast<int>(value);
    return std::min(value, field.max);
}

int frameOf(std::size_t key) {
    return static_cast<int>(key) * framesBetweenKeys;
}

// Returns the roll angle in degrees, about the view axis, of a camera that looks at `target`. Of the equivalent angles,
// returns the one closest to `before`, so that the camera doesn't spin between two keyframes.
double rollOf(const glm::dmat4& worldFromCamera, const glm::dvec3& target, double before) {
    const glm::dmat4 upright = lookingAt(glm::dvec3(worldFromCamera[3]), target);
    const double roll =
        glm::degrees(std::atan2(glm::dot(worldFromCamera[0], upright[1]), glm::dot(worldFromCamera[0], upright[0])));
    const double nearest = roll + 360 * std::round((before - roll) / 360);
    return std::abs(nearest) < 1e-9 ? 0 : nearest;
}

ordered_json cameraJson(const Request& options, const std::vector<ShotKey>& keys) {
    ordered_json camera = ordered_json::object();
    if (const auto name = settingNamed("camera")->text(options)) camera["name"] = *name;
    double roll = 0;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const glm::dmat4& matrix = keys[i].view.worldFromCamera;
        const glm::dvec3 position(matrix[3]);
        const glm::dvec3 target = position - keys[i].pivotDistance * glm::dvec3(matrix[2]);
        camera["keys"].push_back({{"frame", frameOf(i)}, {"position", asArray(position)}, {"target", asArray(target)}});
        roll = rollOf(matrix, target, roll);
        if (roll != 0) camera["keys"].back()["roll"] = roll;
    }
    return camera;
}

// Returns whether the lens determines the exposure. In that case, a shot must not contain an exposure value.
bool shotExposedByLens(const std::vector<ShotKey>& keys) {
    return std::ranges::any_of(keys, [](const ShotKey& key) { return key.view.lens.exposureTime > 0; });
}

ordered_json lensJson(const std::vector<ShotKey>& keys, const Lens& cameraLens) {
    ordered_json lens = ordered_json::object();
    for (const LensField& field : lensFields()) {
        const std::string_view name = field.name;
        if (name == "focusDistance") continue;  // stored as the shot's focus keyframes, not as a lens value
        if ((name == "exposureTime" || name == "iso") && !shotExposedByLens(keys)) continue;
        const auto valueAt = [&](std::size_t key) { return lensFieldValue(keys[key].view.lens, field); };
        bool varies = false;
        for (std::size_t i = 1; i < keys.size(); ++i) varies = varies || valueAt(i) != valueAt(0);
        if (!varies) {
            if (valueAt(0) != lensFieldValue(cameraLens, field) || name == "focalLength")
                lens[field.name] = valueJson(field, valueAt(0));
            continue;
        }
        for (std::size_t i = 0; i < keys.size(); ++i)
            lens[field.name]["keys"].push_back({{"frame", frameOf(i)}, {"value", valueJson(field, valueAt(i))}});
    }
    return lens;
}

ordered_json focusJson(const std::vector<ShotKey>& keys) {
    ordered_json focus;
    for (std::size_t i = 0; i < keys.size(); ++i)
        focus["keys"].push_back({{"frame", frameOf(i)}, {"distance", std::min(keys[i].view.lens.focusDistance, 1e12)}});
    return focus;
}

// Adds the settings that stay constant during a shot. Writes samples and levels even if they have their defaults, so
// that the shot doesn't change when a default does.
void addSettings(ordered_json& shot, const Request& request) {
    for (const Setting& setting : settings()) {
        if (setting.shotPlace.empty() || setting.keyed) continue;
        const bool always = setting.group == SettingGroup::samples || setting.name == "size";
        const std::optional<std::string> text = always ? setting.text(request) : changedText(setting, request);
        if (text) shot[ordered_json::json_pointer(setting.shotPlace)] = settingJson(setting, *text);
    }
    if (!shot.contains("shutter")) return;
    shot["shutter"]["seconds"] = request.shutter.value_or(0);  // the schema requires this value
    if (shutterSettings(request).exactMotion()) {
        shot["shutter"].erase("segments");
        shot["shutter"]["exact"] = true;
    }
}

}  // namespace

std::string shotJson(const ShotRecording& recording) {
    const std::vector<ShotKey>& keys = recording.keys;
    Request request = recording.options;
    if (!request.scene.empty()) request.scene = std::filesystem::absolute(request.scene);
    if (!request.environment.empty() && !isBuiltInEnvironment(request.environment.string()))
        request.environment = std::filesystem::absolute(request.environment);
    request.time = keys.front().time;
    request.size = {keys.back().view.width, keys.back().view.height};
    if (recording.metresPerUnit != 1) request.units = recording.metresPerUnit;
    request.toneMap = recording.write.toneMap;
    request.exposure = DefaultExposure{};
    const double exposure = recording.write.exposure;
    if (!shotExposedByLens(keys) && (exposure != 0 || recording.cameraLens.exposureTime > 0 || !request.scene.empty()))
        request.exposure = ExposureValue{exposure};

    ordered_json shot;
    shot["frameRate"] = 24;
    shot["range"] = {0, frameOf(keys.size() - 1)};
    shot["camera"] = cameraJson(recording.options, keys);
    shot["focus"] = focusJson(keys);
    shot["lens"] = lensJson(keys, recording.cameraLens);
    addSettings(shot, request);
    if (recording.animationSpeed != 1) shot["animation"]["speed"] = recording.animationSpeed;
    return shot.dump(2) + "\n";
}

}  // namespace defocus::engine
