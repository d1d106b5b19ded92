#include "app/shot_options.h"

namespace defocus {

namespace {

template <typename Value>
void take(const std::optional<Value>& given, Value& target) {
    if (given) target = *given;
}

}  // namespace

void applyShot(const Shot& shot, SceneOptions& options) {
    options.path = shot.scene;
    take(shot.fishCount, options.fishCount);
    take(shot.trianglesPerFish, options.trianglesPerFish);
    options.time = shot.animation.start;
    options.environment = shot.environment;
    if (const auto* name = std::get_if<std::string>(&shot.background))
        options.background = *name == "none" ? Background::none : Background::environment;
    if (const auto* colour = std::get_if<glm::dvec3>(&shot.background)) {
        options.background = Background::uniform;
        options.backgroundColor = *colour;
    }
    options.camera = shot.camera.name;
    take(shot.width, options.width);
    take(shot.height, options.height);
    take(shot.samples, options.samples);
    take(shot.seed, options.seed);
    take(shot.lod, options.lod);
    take(shot.lodMetric, options.metric);
    if (shot.blurThreshold) options.blurThreshold = shot.blurThreshold;
    if (shot.sizeThreshold) options.sizeThreshold = shot.sizeThreshold;
    take(shot.method, options.method);
    take(shot.layerFormat, options.layerFormat);
}

void settleShot(Shot& shot, SceneOptions& options, bool cameraGiven) {
    if (cameraGiven) shot.camera.movement = {};
    shot.animation.start = options.time;
    if (!options.clip.empty()) shot.animation.clip = options.clip;
    shot.animation.loop = shot.animation.loop || options.loop;
    const bool focusGiven =
        options.lens.contains("focusDistance") || !options.focusNode.empty() || options.focusPixel.has_value();
    if (focusGiven) {
        shot.focus.reset();
        shot.lens.erase("focusDistance");
    }
    if (!options.focusNode.empty()) shot.focus = FocusTrack{.keys = {{0, options.focusNode}}};
    std::erase_if(shot.lens, [&](const auto& entry) { return options.lens.contains(entry.first); });
    for (const auto& [name, track] : shot.lens) options.lens[name] = track.keys.front().value;
}

SequenceBase sequenceBase(const PreparedFrame& frame, const SceneOptions& options) {
    return {frame.scene.get(), frame.view, frame.settings, frame.world.lights, options.camera, options.exposure};
}

}  // namespace defocus
