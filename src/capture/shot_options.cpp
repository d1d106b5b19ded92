#include "capture/shot_options.h"

#include <optional>
#include <utility>

namespace defocus {

namespace {

template <typename Value>
void take(const std::optional<Value>& given, Value& target) {
    if (given) target = *given;
}

bool cameraPlaced(const SceneOptions& options) {
    return options.cameraPosition || options.cameraTarget || options.cameraUp;
}

// Where the options ask for a focus that each frame finds anew, it becomes the shot's: frames may show what the first
// pose doesn't.
std::optional<FocusTarget> takeFocusTarget(SceneOptions& options) {
    std::optional<FocusTarget> target;
    if (!options.focusNode.empty()) target = std::exchange(options.focusNode, {});
    if (options.focusPixel) target = FocusPixel{options.focusPixel->x, options.focusPixel->y};
    if (options.focusAuto) target = FocusAuto{};
    options.focusPixel.reset();
    options.focusAuto = false;
    return target;
}

// A shot names pixels of its own size; the same place of an image of another.
void scaleFocusPixels(Shot& shot, const SceneOptions& options) {
    if (!shot.focus || !shot.width) return;
    for (auto& key : shot.focus->keys)
        if (auto* pixel = std::get_if<FocusPixel>(&key.value)) {
            pixel->column = static_cast<int>((pixel->column + 0.5) * options.width / *shot.width);
            pixel->row = static_cast<int>((pixel->row + 0.5) * options.height / *shot.height);
        }
}

}  // namespace

void applyShot(const Shot& shot, SceneOptions& options) {
    options.path = shot.scene;
    take(shot.fishCount, options.fishCount);
    take(shot.trianglesPerFish, options.trianglesPerFish);
    options.time = shot.animation.start;
    options.clip = shot.animation.clip;
    options.loop = shot.animation.loop;
    take(shot.shutter, options.shutter);
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
    if (given.camera || cameraPlaced(options)) shot.camera.movement = {};
    shot.animation.start = options.time;
    shot.animation.clip = options.clip;
    shot.animation.loop = options.loop;
    if (shot.shutterAngle && !given.shutter) options.shutter.seconds = *shot.shutterAngle / 360 / shot.frameRate;
    scaleFocusPixels(shot, options);
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
    if (std::optional<FocusTarget> target = takeFocusTarget(options)) shot.focus = FocusTrack{.keys = {{0, *target}}};
    if (options.lens.contains("exposureTime")) shot.exposure.reset();
    std::erase_if(shot.lens, [&](const auto& entry) { return options.lens.contains(entry.first); });
    for (const auto& [name, track] : shot.lens) options.lens[name] = track.keys.front().value;
}

SequenceBase sequenceBase(const PreparedFrame& frame, const SceneOptions& options) {
    SequenceBase base;
    base.scene = frame.scene;
    base.view = frame.view;
    base.settings = frame.settings;
    base.lights = frame.world.lights;
    base.camera = options.camera;
    base.cameraStands = cameraPlaced(options);
    base.shutter = options.shutter;
    for (const auto& [name, value] : options.lens) base.fixedLens.insert(name);
    if (options.focusPoints) base.fixedLens.insert({"focusDistance", "focusTilt", "focusSwing"});
    base.centre = frame.world.pose.bounds.centre();
    return base;
}

}  // namespace defocus
