#pragma once
// Everything that a picture depends on. A default Request renders what `defocus render` renders without options.
//
// Members have the names that the settings have everywhere: on the command line, in shots, in Python and in
// docs/settings.md, which gives their ranges. Angles are degrees and lengths metres unless a comment says otherwise;
// colours are linear Rec.709.

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

// The environment map, the file's own environment, or a gradient sky.
struct EnvironmentBackground {
    bool operator==(const EnvironmentBackground&) const = default;
};
// Nothing: alpha is the coverage of the geometry.
struct TransparentBackground {
    bool operator==(const TransparentBackground&) const = default;
};
// The background of the image; a Color is uniform and lights the scene.
using Background = std::variant<EnvironmentBackground, TransparentBackground, Color>;

struct Request {
    // Scene.
    std::filesystem::path scene;    // .gltf or .glb; empty: the built-in school of fish
    int fishCount = 20;             // of the school, 1 … 10,000
    int trianglesPerFish = 90'000;  // of the school, approximate
    std::optional<double> units;    // metres per unit of the scene; none: the file's, else a guess from its size
    double time = 0;                // s into the animation
    std::string clip;               // name or number of the animation; empty: the first
    bool loop = false;              // repeat the animation instead of holding its ends
    double shutter = 0;             // s that the shutter stays open, for motion blur
    ShutterPosition shutterPosition = ShutterPosition::centre;
    MotionSegments motionSegments = 1u;
    std::filesystem::path environment;  // "studio", "overcast", "sunset", or an equirectangular .hdr or .exr
    double environmentRotation = 0;     // counter-clockwise, seen from above
    Background background;
    bool ground = false;            // a neutral ground beneath the scene, which catches shadows
    std::vector<std::string> hide;  // nodes, by name or number, that aren't drawn, with their children
    Shadows shadows = Shadows::automatic;
    std::optional<double> lightAngle;   // angular diameter of directional lights; none: each light's own
    std::optional<double> lightRadius;  // of point and spot lights; none: each light's own

    // Camera and image.
    CameraChoice camera;
    std::optional<Vector3> cameraPosition;  // each replaces the camera's own
    std::optional<Vector3> cameraTarget;    // a point that the camera looks at
    std::optional<Vector3> cameraUp;        // a direction
    ImageSize size;

    // Lens.
    LensSettings lens;
    Focus focus;
    std::map<std::string, double> nodeBlur;  // by node: scale ≥ 0 of the blur of the node and its children

    // Samples and levels of detail.
    std::optional<std::uint32_t> samples;  // 1 … maxSamples; none: as many as the picture needs
    std::optional<double> targetError;  // 1e-6 … 1: add blocks of 64 samples, at most `samples`, until the RMSE of the
                                        // display-encoded image at EV 0 is estimated to be below it
    std::optional<double> timeLimit;  // s: add blocks of 64 samples, at most `samples`, for this long
    Sequence sequence = Sequence::sobol;
    std::uint32_t seed = 0;  // selects another set of sample points
    LodMode lod = LodMode::fractional;
    std::optional<double> blurThreshold;   // px of the target edge for each px of blur; none: by the number of samples
    std::optional<double> sizeThreshold;   // px, minimum target edge; none: by the number of samples
    std::optional<double> lightThreshold;  // px, see LodMetric::measured; none: by the number of samples
    std::filesystem::path cacheFolder;     // of pyramids; empty: $XDG_CACHE_HOME/defocus or ~/.cache/defocus
    bool noCache = false;                  // build pyramids without reading or writing the cache

    // Method.
    std::string method = "accumulation";
    std::map<std::string, std::string> methodSettings;  // by name; the others have their defaults
    LayerFormat layerFormat = LayerFormat::automatic;

    // Display: PNG, JPEG and video.
    ToneMap toneMap = ToneMap::neutral;
    Exposure exposure;

    // For developers.
    LodMetric lodMetric = LodMetric::automatic;
    LevelVertices levelVertices = LevelVertices::fitted;
    LodCoc lodCoc = LodCoc::smallest;
    double cocTolerance = 0.5;            // px by which C may differ from its interpolation inside a triangle, > 0
    bool keepAll = false;                 // draw also what cannot be seen: the image must be the same
    std::optional<std::uint64_t> memory;  // bytes that the process may take; none: three quarters of what is free
    std::optional<std::uint32_t> wave;  // lens samples drawn at once, 1 … 64 (the same image); none: as memory allows
};

}  // namespace defocus
