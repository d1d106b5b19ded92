#pragma once
// All settings of an image. A default Request gives the same image as `defocus render` without options.
//
// Settings have the same names on the command line, in shots, in Python and in docs/settings.md, which lists their
// ranges. Unless stated otherwise, angles are in degrees, lengths in metres, and colours in linear Rec.709.

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
#include "defocus/layers.h"
#include "defocus/lens.h"
#include "defocus/settings.h"

namespace defocus {

using Color = std::array<float, 3>;

struct ImageSize {
    int width = 1024;  // px
    int height = 768;
    bool operator==(const ImageSize&) const = default;
};

// Shows Request::environment, else the environment of the scene file, else a gradient sky.
struct EnvironmentBackground {
    bool operator==(const EnvironmentBackground&) const = default;
};
// Transparent background: the image's alpha is the fraction of the pixel that surfaces cover.
struct TransparentBackground {
    bool operator==(const TransparentBackground&) const = default;
};
// Background of the image. A Color is a uniform environment, which also lights the scene.
using Background = std::variant<EnvironmentBackground, TransparentBackground, Color>;

struct Request {
    // ---- scene and lights ----
    std::filesystem::path scene;    // .gltf or .glb; empty: the built-in school of fish
    bool strict = false;            // true: throw Error for missing or damaged parts of the file, such as textures
    std::string variant;            // name of a material variant of the file; empty: the default materials
    int fishCount = 20;             // number of fish in the school, 1 … 10,000
    int trianglesPerFish = 90'000;  // approximate number of triangles of each fish
    std::optional<double> units;    // metres per scene unit. Default: from the file, or guessed from the scene's size
    double time = 0;                // time of the animation in s
    std::string clip;               // name or index of the animation; empty: the first animation
    bool loop = false;              // true: the animation repeats; false: its first and last pose are held
    // Duration of the exposure in s; > 0 gives motion blur. Default: the shutter of `cameraFrom`, else 0.
    std::optional<double> shutter;
    ShutterPosition shutterPosition = ShutterPosition::centre;
    MotionSegments motionSegments = 1u;
    std::filesystem::path environment;  // "studio", "overcast", "sunset", or an equirectangular .hdr or .exr file
    double environmentRotation = 0;     // degrees about the vertical axis, counter-clockwise as seen from above
    Background background;
    bool ground = false;            // adds a neutral ground plane that receives shadows
    std::vector<std::string> hide;  // names or indices of nodes to hide, with their descendants
    Shadows shadows = Shadows::automatic;
    // true: adds light that is reflected several times between the microfacets of rough surfaces. glTF's material model
    // includes only the first reflection, so rough metals are too dark without this light.
    bool multipleScattering = false;
    std::optional<double> lightAngle;   // angular diameter of directional lights in degrees. Default: each light's own
    std::optional<double> lightRadius;  // radius of point and spot lights in m. Default: each light's own

    // ---- camera and image ----
    CameraChoice camera;
    // Camera in a separate file, such as "shot.usda:/World/cam"; replaces the scene's camera. Empty: none.
    std::string cameraFrom;
    std::optional<Vector3> cameraPosition;  // replaces the camera's position
    std::optional<Vector3> cameraTarget;    // point to look at; replaces the camera's direction
    std::optional<Vector3> cameraUp;        // replaces the camera's up vector
    ImageSize size;

    // ---- lens and focus ----
    LensSettings lens;
    Focus focus;
    std::map<std::string, double> nodeBlur;  // node name or index → blur factor ≥ 0 of the node and its descendants

    // ---- samples and levels of detail ----
    std::optional<std::uint32_t> samples;  // number of lens samples, 1 … maxSamples. Default: automatic, from `quality`
    // Number of subpixel positions at which each lens sample is drawn, 1 or 4; other values throw Error. Default: 4 for
    // a still image of method "auto" with an automatic number of samples, many triangles and little blur, else 1.
    // `layers` require 1.
    std::optional<std::uint32_t> positions;
    Quality quality = Quality::good;  // used if samples, targetError and timeLimit are unset
    // Target RMSE of the display-encoded image at EV 0, 1e-6 … 1. Samples are added, 64 at a time, until the estimated
    // error is below the target. `samples` is the max number of samples.
    std::optional<double> targetError;
    // Time limit in s. Samples are added, 64 at a time, until the time has elapsed. `samples` is the max number of
    // samples.
    std::optional<double> timeLimit;
    Sequence sequence = Sequence::sobol;
    std::uint32_t seed = 0;  // each seed gives different sample points
    // Default: fractional. A still image with an automatic number of samples and default level settings is drawn at
    // full detail if building the levels would take more time than they save.
    std::optional<LodMode> lod;
    // Target length of triangle edges relative to the blur diameter. Default: depends on the number of samples.
    std::optional<double> blurThreshold;
    // Target length of triangle edges in px where nothing is blurred. Default: depends on the number of samples.
    std::optional<double> sizeThreshold;
    // For LodMetric::measured: max product of a level's projected edge length in px and its relative shading error.
    // Default: depends on the number of samples.
    std::optional<double> lightThreshold;
    std::filesystem::path cacheFolder;  // cache of mesh pyramids; empty: $XDG_CACHE_HOME/defocus or ~/.cache/defocus
    bool noCache = false;               // true: pyramids are built without reading or writing the cache

    // ---- rendering method ----
    std::string method = "auto";
    std::map<std::string, std::string> methodSettings;  // setting name → value; missing settings: default
    LayerFormat layerFormat = LayerFormat::automatic;

    // Data layers to add to EXR files. Layers need a method that averages lens samples; with layers, method "auto" uses
    // method "accumulation".
    std::vector<Layer> layers;
    ExrNames exrNames = ExrNames::nuke;

    // ---- conversion to PNG, JPEG and video ----
    ToneMap toneMap = ToneMap::neutral;
    Exposure exposure;

    // ---- settings for developers ----
    LodMetric lodMetric = LodMetric::automatic;
    LevelVertices levelVertices = LevelVertices::fitted;
    LodCoc lodCoc = LodCoc::smallest;
    // Max error in px, > 0, of linear interpolation of the circle of confusion within a triangle.
    double cocTolerance = 0.5;
    bool keepAll = false;  // true: disables culling, and draws all lens samples even if no blur reaches half a pixel
    std::optional<std::uint64_t> memory;  // memory limit in bytes. Default: 3/4 of the free memory
    // Number of lens samples drawn at once, 1 … 64; does not change the image. Default: as many as fit into memory.
    std::optional<std::uint32_t> wave;
    // Number of threads that draw, 1 … 64; does not change the image. Default: half the number of cores if the driver
    // is llvmpipe from Mesa 25.0 or later, else 1.
    std::optional<std::uint32_t> threads;
};

}  // namespace defocus
