#pragma once
// What is asked for: a scene, a camera with its lens, a moment, samples, levels of detail, a method. A default-made
// request renders what `defocus render` renders without options. Angles are degrees, lengths metres unless they say
// otherwise; colours are linear Rec.709. docs/settings.md lists each setting's range.

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "defocus/image.h"
#include "defocus/lens.h"
#include "defocus/settings.h"

namespace defocus {

using Vector3 = std::array<double, 3>;

// What lies around the scene.
enum class Background {
    environment,  // the environment map, the file's own, or a gradient sky
    none,         // a transparent image: alpha is the coverage of the geometry
    uniform,      // Request::backgroundColor
};

struct Request {
    // Scene. Without a path: the built-in school of fish.
    std::filesystem::path scene;          // .gltf or .glb
    std::optional<double> metresPerUnit;  // of the scene's lengths, 1e-9 … 1e9; none: what the file says, else a guess
    int fishCount = 20;                   // of the school, 1 … 10,000
    int trianglesPerFish = 90'000;        // about
    double time = 0;                      // s into the animation
    std::string clip;                     // the animation's name or number; empty: the first
    bool loop = false;                    // the animation repeats instead of holding its ends
    ShutterSettings shutter;              // motion blur
    std::filesystem::path environment;    // "studio", "overcast", "sunset", or an equirectangular .hdr or .exr; empty:
                                          // see Background
    double environmentRotation = 0;       // degrees counter-clockwise, seen from above
    Background background = Background::environment;
    std::array<float, 3> backgroundColor{};
    bool ground = false;                // a neutral ground beneath what the scene holds
    std::optional<double> lightAngle;   // degrees that every directional light measures across; none: its own
    std::optional<double> lightRadius;  // m, of every point and spot light; none: its own

    // Camera and image.
    std::string camera;                     // a name; empty: the file's first; "auto": one that frames the scene
    std::optional<Vector3> cameraPosition;  // each replaces that of the camera
    std::optional<Vector3> cameraTarget;    // a point that it looks at
    std::optional<Vector3> cameraUp;        // a direction
    int width = 1024;                       // px
    int height = 768;

    // Lens, and where it is focused: at most one of lens.focusDistance and these four. Without any, the camera's own
    // distance, else the median depth of what the middle of the image shows.
    LensSettings lens;
    std::string focusNode;            // the centre of this node
    std::optional<Pixel> focusPixel;  // what is seen there
    std::vector<Pixel>
        focusPoints;         // 3 … 16: the focus plane goes through what three show, a curved surface along more
    bool focusAuto = false;  // the median depth of what the image's middle shows
    std::map<std::string, double> nodeBlur;  // by node: scale of the blur of all below it, ≥ 0; 0 keeps it sharp
    std::vector<std::string> hidden;         // nodes, by name or number, that aren't drawn, with all below them

    // Samples and levels of detail.
    RenderSettings settings = {.sampleCount = automaticSamples};
    StopSettings stop;                  // instead of a number of samples
    std::filesystem::path cacheFolder;  // of pyramids; empty: $XDG_CACHE_HOME/defocus or ~/.cache/defocus
    bool noCache = false;               // simplify anew and store nothing

    // Method.
    std::string method = "accumulation";  // its name, or with settings: "circular:far-components=5,resolution=half"
    std::map<std::string, std::string> methodSettings;  // by their names, beyond those in `method`
    LayerFormat layerFormat = LayerFormat::automatic;
    std::uint32_t wave = 0;               // lens samples drawn at once, 1 … 64 (the same image); 0: as memory allows
    std::optional<std::uint64_t> memory;  // bytes that the process may take; none: three quarters of what is free

    // Display: how PNG and JPEG are made of the linear image.
    ToneMap toneMap = ToneMap::neutral;
    // EV; none: what the lens's exposure time makes; else metered where the scene has lights of its own, and else 0.
    std::optional<double> exposure;
    bool exposureAuto = false;  // metered; `exposure` then means nothing
};

}  // namespace defocus
