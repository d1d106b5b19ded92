#pragma once
// What render, plan and their kin have in common: a scene, a camera with its lens, levels of detail, surroundings.

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>

#include "plan/shutter.h"
#include "plan/view.h"
#include "render/methods.h"

namespace defocus {

enum class Background { environment, none, uniform };

// As the command line gives it. Each number was checked by itself; what depends on the scene is checked by placeFrame.
// Lens values: option, else the camera's own value (its extras), else the default.
struct SceneOptions {
    // Scene. Without a path: the built-in fish school.
    std::filesystem::path path;
    int fishCount = 20;
    int trianglesPerFish = 90'000;
    double time = 0;    // s into the animation
    std::string clip;   // the animation's name or number; empty: the first
    bool loop = false;  // the animation repeats
    ShutterSettings shutter;
    std::filesystem::path environment;
    Background background = Background::environment;
    glm::vec3 backgroundColor{0.0f};  // Background::uniform

    // Camera and image.
    std::string camera;                        // empty: the first, or one that frames the scene
    std::optional<glm::dvec3> cameraPosition;  // m, of the world; each replaces that of the camera
    std::optional<glm::dvec3> cameraTarget;
    std::optional<glm::dvec3> cameraUp;
    int width = 1024;
    int height = 768;

    // Lens: what the command line sets of it, by the names and in the units of lens/lens_fields.h.
    std::map<std::string, double, std::less<>> lens;
    std::filesystem::path apertureImage;  // empty: the camera's own, or none
    std::string focusNode;
    std::optional<glm::ivec2> focusPixel;                  // column from the left, row from the top
    std::optional<std::array<glm::ivec2, 3>> focusPoints;  // three pixels: the focus plane goes through what they show
    bool focusAuto = false;                                // the median depth of the image's middle
    std::map<std::string, double> nodeBlur;                // by node: scale of its blur, ≥ 0
    double cocTolerance = 0.5;                             // px; see RenderSettings

    // Samples and levels of detail.
    std::uint32_t samples = 64;
    Sequence sequence = RenderSettings{}.sequence;
    std::uint32_t seed = 0;
    LodMode lod = LodMode::fractional;
    LodMetric metric = LodMetric::size;
    bool lodCocAtCentre = false;
    std::optional<double> blurThreshold;  // default: defaultThresholds
    std::optional<double> sizeThreshold;
    bool keepAll = false;
    std::filesystem::path cacheFolder;  // of pyramids; empty: defaultCacheFolder
    bool noCache = false;

    // Method.
    std::string method = "accumulation";  // its name, or with settings as MethodUse::text has it
    MethodSettings methodSettings;        // of options by their names, beyond those in `method`
    LayerFormat layerFormat = LayerFormat::automatic;
    std::uint32_t wave = 0;  // 0: as memory allows
};

// The method with its settings. Throws UsageError for settings that it doesn't take.
MethodUse chosenMethod(const SceneOptions& options);

}  // namespace defocus
