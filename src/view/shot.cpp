#include "view/shot.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>
#include <string_view>

#include "lens/lens_fields.h"
#include "plan/camera_path.h"

namespace defocus {

namespace {

using nlohmann::ordered_json;

ordered_json pointJson(const glm::dvec3& point) {
    return {point.x, point.y, point.z};
}

// As the kind of the field asks for: truth value, whole number or number.
ordered_json valueJson(const LensField& field, double value) {
    if (std::holds_alternative<bool Lens::*>(field.member)) return value != 0;
    if (std::holds_alternative<int Lens::*>(field.member)) return static_cast<int>(value);
    return std::min(value, field.most);
}

int frameOf(std::size_t key) {
    return static_cast<int>(key) * framesBetweenKeys;
}

// Degrees about the view axis, of a camera that looks at `target`; of all turns the one next to `before`, so that no
// camera spins between two keys.
double rollOf(const glm::dmat4& worldFromCamera, const glm::dvec3& target, double before) {
    const glm::dmat4 upright = lookingAt(glm::dvec3(worldFromCamera[3]), target);
    const double roll =
        glm::degrees(std::atan2(glm::dot(worldFromCamera[0], upright[1]), glm::dot(worldFromCamera[0], upright[0])));
    const double nearest = roll + 360 * std::round((before - roll) / 360);
    return std::abs(nearest) < 1e-9 ? 0 : nearest;
}

ordered_json cameraJson(const SceneOptions& options, const std::vector<ShotKey>& keys) {
    ordered_json camera = ordered_json::object();
    if (!options.camera.empty()) camera["name"] = options.camera;
    double roll = 0;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const glm::dmat4& matrix = keys[i].view.worldFromCamera;
        const glm::dvec3 position(matrix[3]);
        const glm::dvec3 target = position - keys[i].pivotDistance * glm::dvec3(matrix[2]);
        camera["keys"].push_back(
            {{"frame", frameOf(i)}, {"position", pointJson(position)}, {"target", pointJson(target)}});
        roll = rollOf(matrix, target, roll);
        if (roll != 0) camera["keys"].back()["roll"] = roll;
    }
    return camera;
}

// Brightness: by the lens, or by an exposure value, which exclude each other.
bool shotExposedByLens(const std::vector<ShotKey>& keys) {
    return std::ranges::any_of(keys, [](const ShotKey& key) { return key.view.lens.exposureTime > 0; });
}

ordered_json lensJson(const std::vector<ShotKey>& keys, const Lens& cameraLens) {
    ordered_json lens = ordered_json::object();
    for (const LensField& field : lensFields()) {
        const std::string_view name = field.name;
        if (name == "focusDistance") continue;  // keyframed as the shot's focus
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

ordered_json animationJson(const SceneOptions& options, double start, double speed) {
    ordered_json animation = ordered_json::object();
    if (!options.clip.empty()) animation["clip"] = options.clip;
    if (start != 0) animation["start"] = start;
    if (speed != 1) animation["speed"] = speed;
    if (options.loop) animation["loop"] = true;
    return animation;
}

ordered_json shutterJson(const ShutterSettings& shutter) {
    static constexpr const char* positions[] = {"start", "centre", "end"};
    return {{"seconds", shutter.seconds},
            {"position", positions[static_cast<std::size_t>(shutter.position)]},
            {"segments", shutter.motionSegments},
            {"exact", shutter.exactMotion}};
}

void addSceneJson(ordered_json& shot, const SceneOptions& options) {
    if (!options.path.empty())
        shot["scene"] = std::filesystem::absolute(options.path).string();
    else
        shot["fish"] = {{"count", options.fishCount}, {"triangles", options.trianglesPerFish}};
    if (!options.environment.empty()) shot["environment"] = std::filesystem::absolute(options.environment).string();
    if (options.background == Background::none) shot["background"] = "none";
    if (options.background == Background::uniform) shot["background"] = pointJson(glm::dvec3(options.backgroundColor));
}

void addQualityJson(ordered_json& shot, const SceneOptions& options) {
    shot["samples"] = options.samples;
    shot["sequence"] = std::string(sequenceName(options.sequence));
    if (options.seed != 0) shot["seed"] = options.seed;
    shot["lod"] = lodModeName(options.lod);
    shot["lodMetric"] = options.metric == LodMetric::size ? "size" : "error";
    if (options.blurThreshold) shot["blurThreshold"] = *options.blurThreshold;
    if (options.sizeThreshold) shot["sizeThreshold"] = *options.sizeThreshold;
    if (options.layerFormat != LayerFormat::automatic) shot["layerFormat"] = layerFormatName(options.layerFormat);
    const std::string method = chosenMethod(options).text();
    if (method != "accumulation") shot["method"] = method;
}

}  // namespace

std::string shotJson(const ShotRecording& recording) {
    const SceneOptions& options = recording.options;
    const std::vector<ShotKey>& keys = recording.keys;
    ordered_json shot;
    addSceneJson(shot, options);
    shot["frameRate"] = 24;
    shot["range"] = {0, frameOf(keys.size() - 1)};
    const ordered_json animation = animationJson(options, keys.front().time, recording.animationSpeed);
    if (!animation.empty()) shot["animation"] = animation;
    if (options.shutter != ShutterSettings{}) shot["shutter"] = shutterJson(options.shutter);
    shot["camera"] = cameraJson(options, keys);
    shot["focus"] = focusJson(keys);
    shot["lens"] = lensJson(keys, recording.cameraLens);
    shot["size"] = {keys.back().view.width, keys.back().view.height};
    addQualityJson(shot, options);
    const double exposure = recording.write.exposure;
    if (!shotExposedByLens(keys) && (exposure != 0 || recording.cameraLens.exposureTime > 0))
        shot["exposure"] = exposure;
    static constexpr const char* toneMaps[] = {"none", "aces", "agx"};
    shot["toneMap"] = toneMaps[static_cast<std::size_t>(recording.write.toneMap)];
    return shot.dump(2) + "\n";
}

}  // namespace defocus
