#pragma once
// A shot: what is filmed, from where and through which lens, frame by frame, as a shot file says it
// (docs/shot.schema.json). Plain data; what a file leaves out is empty and falls back to the scene's camera or the
// program's defaults. Frames are counted from 0 at time 0.

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "capture/keyframes.h"
#include "image/tone_map.h"
#include "lens/sequences.h"
#include "lod/pyramid/level_selection.h"
#include "plan/shutter.h"
#include "render/layer_format.h"

namespace defocus {

struct FrameRange {
    int first = 0;
    int last = 0;  // included
};

inline constexpr int mostFrame = 9'999'999;

// A point of the world, or the centre of a node, which may move.
using Place = std::variant<glm::dvec3, std::string>;

// Value of a lens field (in the unit of lens/lens_fields.h); one key: constant.
struct LensTrack {
    std::vector<Key<double>> keys;
    Easing easing = Easing::smooth;
};

// px from the left and from the top, of an image of the shot's size.
struct FocusPixel {
    int column = 0;
    int row = 0;
};
struct FocusAuto {};

// At each frame anew: a distance in m, a node that is followed (the depth of its centre), what a pixel shows, or the
// median depth of what the image's middle shows.
using FocusTarget = std::variant<double, std::string, FocusPixel, FocusAuto>;

struct FocusTrack {
    std::vector<Key<FocusTarget>> keys;
    Easing easing = Easing::smooth;  // of 1/distance, as a focus ring turns
};

struct CameraKeys {
    std::vector<Key<Place>> positions;
    std::vector<Key<Place>> targets;  // as many, at the same frames; what the camera looks at
    std::vector<Key<double>> rolls;   // as many too: degrees about the view axis, counter-clockwise from behind
    Easing easing = Easing::smooth;
};

// Around a centre, about the vertical, evenly: at the movement's first frame the camera stands in its own place.
struct Turntable {
    double turns = 1;                  // > 0: counter-clockwise from above
    std::optional<Place> centre;       // none: the middle of the scene
    std::optional<FrameRange> frames;  // that the turns take; none: the shot's
};

// Forward along the camera's own axis; at the movement's first frame the camera stands in its own place.
struct Dolly {
    double distance = 0;  // m; < 0: backward
    Easing easing = Easing::smooth;
    std::optional<FrameRange> frames;  // none: the shot's
};

struct ShotCamera {
    std::string name;  // as --camera takes it
    std::variant<std::monostate, CameraKeys, Turntable, Dolly> movement;
};

struct ShotAnimation {
    std::string clip;  // by name or number; empty: the first, where the scene has one
    double start = 0;  // s into the clip at frame 0
    double speed = 1;  // of the clip's time; 0 holds it
    bool loop = false;
};

struct Shot {
    std::filesystem::path file;  // for messages; paths in a shot are relative to its folder, outputs to the current one
    std::filesystem::path scene;
    std::optional<int> fishCount;  // of the built-in school, without a scene
    std::optional<int> trianglesPerFish;
    std::filesystem::path environment;
    std::variant<std::monostate, std::string, glm::dvec3> background;  // "environment", "none" or a linear colour

    double frameRate = 24;  // 1/s
    FrameRange range{0, 0};
    ShotAnimation animation;
    std::optional<ShutterSettings> shutter;
    std::optional<double>
        shutterAngle;  // degrees, in place of the shutter's seconds; 360: the time from frame to frame
    ShotCamera camera;
    std::optional<FocusTrack> focus;
    std::map<std::string, LensTrack, std::less<>> lens;  // by field

    std::optional<int> width, height;  // px, both or none
    std::optional<std::uint32_t> samples;
    std::optional<Sequence> sequence;
    std::optional<std::uint32_t> seed;
    bool animateSeed = false;  // other sample positions in each frame: the noise moves
    std::optional<LodMode> lod;
    std::optional<LodMetric> lodMetric;
    std::optional<double> blurThreshold, sizeThreshold;
    std::optional<std::string> method;  // as --method takes it
    std::optional<LayerFormat> layerFormat;

    std::vector<std::string> outputs = {"frames/####.exr"};
    std::optional<double> exposure;  // EV, of PNG, JPEG and video; none: what the lens's exposure time makes, else 0
    ToneMap toneMap = ToneMap::none;
    std::filesystem::path video;  // none: empty
};

}  // namespace defocus
