#pragma once
// All settings of a picture. A default Request renders the same image as `defocus render` without options.
//
// Members have the same names on the command line, in shots, in Python and in docs/settings.md, which lists their
// ranges. Unless a comment says otherwise, angles are in degrees, lengths in metres, and colours in linear Rec.709.

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "defocus/camera.h"
#include "defocus/exposure.h"
#include "defocus/focus.h"
#include "defocus/image.h"
#include "defocus/lens.h"
#include "defocus/settings.h"

namespace defocus {

using Color = std::array<float, 3>;

struct ImageSize {
    int width = 1024;  // px
    int height = 768;
    bool operator==(const ImageSize&) const = default;
};

// Shows the environment map, or else the file's own environment, or else a gradient sky.
struct EnvironmentBackground {
    bool operator==(const EnvironmentBackground&) const = default;
};
// Shows no background: alpha is the coverage of the geometry.
struct TransparentBackground {
    bool operator==(const TransparentBackground&) const = default;
};
// Background of the image. A Color is uniform and lights the scene.
using Background = std::variant<EnvironmentBackground, TransparentBackground, Color>;

struct Request {
    // Scene.
    std::filesystem::path scene;    // .gltf or .glb; empty: the built-in school of fish
    int fishCount = 20;             // number of fish in the school, 1 … 10,000
    int trianglesPerFish = 90'000;  // approximate number of triangles per fish
    std::optional<double> units;    // metres per scene unit. Default: the file's, or a guess from its size
    double time = 0;                // s, time in the animation
    std::string clip;               // animation, by name or number; empty: the first
    bool loop = false;              // true: repeat the animation; false: hold its first and last pose
    double shutter = 0;             // s, duration of the exposure, for motion blur
    ShutterPosition shutterPosition = ShutterPosition::centre;
    MotionSegments motionSegments = 1u;
    std::filesystem::path environment;  // "studio", "overcast", "sunset", or an equirectangular .hdr or .exr file
    double environmentRotation = 0;     // counter-clockwise, seen from above
    Background background;
    bool ground = false;            // adds a neutral ground plane that receives shadows
    std::vector<std::string> hide;  // nodes to hide, by name or number, with their children
    Shadows shadows = Shadows::automatic;
    std::optional<double> lightAngle;   // angular diameter of directional lights. Default: each light's own
    std::optional<double> lightRadius;  // radius of point and spot lights. Default: each light's own

    // Camera and image.
    CameraChoice camera;
    std::optional<Vector3> cameraPosition;  // replaces the camera's own position
    std::optional<Vector3> cameraTarget;    // replaces the camera's direction by a point to look at
    std::optional<Vector3> cameraUp;        // replaces the camera's up direction
    ImageSize size;

    // Lens.
    LensSettings lens;
    Focus focus;
    std::map<std::string, double> nodeBlur;  // node name → factor ≥ 0 on the blur of the node and its children

    // Samples and levels of detail.
    std::optional<std::uint32_t> samples;  // 1 … maxSamples. Default: chosen for each picture
    // Error target, 1e-6 … 1. Blocks of 64 samples are added until the estimated RMSE of the display-encoded image at
    // EV 0 falls below it. `samples` is the upper limit.
    std::optional<double> targetError;
    // Time limit in s: blocks of 64 samples are added for this long. `samples` is the upper limit.
    std::optional<double> timeLimit;
    Sequence sequence = Sequence::sobol;
    std::uint32_t seed = 0;  // selects a different set of sample points
    LodMode lod = LodMode::fractional;
    // Target edge length per px of blur, in px. Default: depends on the number of samples.
    std::optional<double> blurThreshold;
    std::optional<double> sizeThreshold;   // px, minimum target edge length. Default: depends on the number of samples
    std::optional<double> lightThreshold;  // px, see LodMetric::measured. Default: depends on the number of samples
    std::filesystem::path cacheFolder;     // pyramid cache; empty: $XDG_CACHE_HOME/defocus or ~/.cache/defocus
    bool noCache = false;                  // true: build pyramids without reading or writing the cache

    // Method.
    std::string method = "accumulation";
    std::map<std::string, std::string> methodSettings;  // name → value; missing settings have their defaults
    LayerFormat layerFormat = LayerFormat::automatic;

    // Display: PNG, JPEG and video.
    ToneMap toneMap = ToneMap::neutral;
    Exposure exposure;

    // For developers.
    LodMetric lodMetric = LodMetric::automatic;
    LevelVertices levelVertices = LevelVertices::fitted;
    LodCoc lodCoc = LodCoc::smallest;
    // Largest error of the linearly interpolated circle of confusion inside a triangle, in px, > 0.
    double cocTolerance = 0.5;
    bool keepAll = false;                 // true: also draw invisible parts; the image must not change
    std::optional<std::uint64_t> memory;  // memory limit in bytes. Default: three quarters of the free memory
    // Number of lens samples drawn at once, 1 … 64. It does not change the image. Default: as memory allows.
    std::optional<std::uint32_t> wave;
};

}  // namespace defocus
