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
    options.clip = shot.animation.clip;
    options.loop = shot.animation.loop;
    take(shot.shutter, options.exposure);
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
    take(shot.sequence, options.sequence);
    take(shot.seed, options.seed);
    take(shot.lod, options.lod);
    take(shot.lodMetric, options.metric);
    if (shot.blurThreshold) options.blurThreshold = shot.blurThreshold;
    if (shot.sizeThreshold) options.sizeThreshold = shot.sizeThreshold;
    take(shot.method, options.method);
    take(shot.layerFormat, options.layerFormat);
}

void settleShot(Shot& shot, SceneOptions& options, const GivenOptions& given) {
    if (given.camera) shot.camera.movement = {};
    shot.animation.start = options.time;
    shot.animation.clip = options.clip;
    shot.animation.loop = options.loop;
    if (shot.shutterAngle && !given.shutter) options.exposure.seconds = *shot.shutterAngle / 360 / shot.frameRate;
    const bool focusGiven = options.lens.contains("focusDistance") || !options.focusNode.empty() ||
                            options.focusPixel || options.focusPoints || options.focusAuto;
    if (focusGiven) {
        shot.focus.reset();
        shot.lens.erase("focusDistance");
    }
    if (options.focusPoints) {
        shot.lens.erase("focusTilt");
        shot.lens.erase("focusSwing");
    }
    if (!options.focusNode.empty()) shot.focus = FocusTrack{.keys = {{0, options.focusNode}}};
    std::erase_if(shot.lens, [&](const auto& entry) { return options.lens.contains(entry.first); });
    for (const auto& [name, track] : shot.lens) options.lens[name] = track.keys.front().value;
}

SequenceBase sequenceBase(const PreparedFrame& frame, const SceneOptions& options) {
    SequenceBase base;
    base.scene = frame.scene.get();
    base.view = frame.view;
    base.settings = frame.settings;
    base.lights = frame.world.lights;
    base.camera = options.camera;
    base.exposure = options.exposure;
    for (const auto& [name, value] : options.lens) base.fixedLens.insert(name);
    if (options.focusPixel || options.focusPoints || options.focusAuto) base.fixedLens.insert("focusDistance");
    if (options.focusPoints) base.fixedLens.insert({"focusTilt", "focusSwing"});
    base.centre = frame.world.pose.bounds.centre();
    return base;
}

}  // namespace defocus
