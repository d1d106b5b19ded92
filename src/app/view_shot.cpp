#include "app/view_shot.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "lens/lens_fields.h"

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

ordered_json cameraJson(const SceneOptions& options, const std::vector<ShotKey>& keys) {
    ordered_json camera = ordered_json::object();
    if (!options.camera.empty()) camera["name"] = options.camera;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const glm::dmat4& matrix = keys[i].view.worldFromCamera;
        const glm::dvec3 position(matrix[3]);
        const glm::dvec3 target = position - keys[i].pivotDistance * glm::dvec3(matrix[2]);
        camera["keys"].push_back(
            {{"frame", frameOf(i)}, {"position", pointJson(position)}, {"target", pointJson(target)}});
    }
    return camera;
}

ordered_json lensJson(const std::vector<ShotKey>& keys) {
    ordered_json lens = ordered_json::object();
    for (const LensField& field : lensFields()) {
        const std::string_view name = field.name;
        if (name == "focusDistance") continue;  // keyframed as the shot's focus
        const auto valueAt = [&](std::size_t key) { return lensFieldValue(keys[key].view.lens, field); };
        bool varies = false;
        for (std::size_t i = 1; i < keys.size(); ++i) varies = varies || valueAt(i) != valueAt(0);
        if (!varies) {
            if (valueAt(0) != lensFieldValue(Lens{}, field) || name == "focalLength")
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

}  // namespace

std::string shotJson(const SceneOptions& options, const std::vector<ShotKey>& keys, const WriteOptions& write) {
    ordered_json shot;
    if (!options.path.empty())
        shot["scene"] = std::filesystem::absolute(options.path).string();
    else
        shot["fish"] = {{"count", options.fishCount}, {"triangles", options.trianglesPerFish}};
    if (!options.environment.empty()) shot["environment"] = std::filesystem::absolute(options.environment).string();
    if (options.background == Background::none) shot["background"] = "none";
    if (options.background == Background::uniform) shot["background"] = pointJson(glm::dvec3(options.backgroundColor));
    shot["frameRate"] = 24;
    shot["range"] = {0, frameOf(keys.size() - 1)};
    if (options.time != 0) shot["animation"] = {{"start", options.time}};
    shot["camera"] = cameraJson(options, keys);
    shot["focus"] = focusJson(keys);
    shot["lens"] = lensJson(keys);
    shot["size"] = {keys.back().view.width, keys.back().view.height};
    shot["samples"] = options.samples;
    if (options.seed != 0) shot["seed"] = options.seed;
    shot["lod"] = lodModeName(options.lod);
    const std::string method = chosenMethod(options).text();
    if (method != "accumulation") shot["method"] = method;
    const bool ofLens = std::ranges::any_of(keys, [](const ShotKey& key) { return key.view.lens.exposureTime > 0; });
    if (write.exposure != 0 && !ofLens) shot["exposure"] = write.exposure;
    shot["toneMap"] = write.toneMap == ToneMap::none ? "none" : write.toneMap == ToneMap::aces ? "aces" : "agx";
    return shot.dump(2) + "\n";
}

}  // namespace defocus
