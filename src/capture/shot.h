#pragma once
// A shot: scene, camera and lens of a film, frame by frame, as in a shot file (docs/shot.schema.json). Plain data.
// Values missing in the file fall back to the scene's camera or to the program's defaults. Frames are counted from 0 at
// time 0.

#include <filesystem>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "capture/keyframes.h"
#include "frame/request.h"

namespace defocus::engine {

struct FrameRange {
    int first = 0;
    int last = 0;  // inclusive
};

inline constexpr int maxFrame = 9'999'999;

// A point in the world, or the name of a node whose centre is used; the node may move.
using Place = std::variant<glm::dvec3, std::string>;

// Values of a lens field, in the unit of lens/lens_fields.h. A single key is a constant value.
struct LensTrack {
    std::vector<Key<double>> keys;
    Easing easing = Easing::smooth;
};

// Evaluated for each frame, so that the focus follows moving objects. A pixel refers to an image of the shot's size.
using FocusTarget = std::variant<FocusDistance, FocusNode, FocusPixel, FocusAuto>;

struct FocusTrack {
    std::vector<Key<FocusTarget>> keys;
    Easing easing = Easing::smooth;  // interpolates 1/distance, like turning a focus ring
};

struct CameraKeys {
    std::vector<Key<Place>> positions;
    std::vector<Key<Place>> targets;  // points that the camera looks at; same frames as `positions`
    std::vector<Key<double>> rolls;   // degrees about the view axis, counter-clockwise from behind; same frames
    Easing easing = Easing::smooth;
};

// Turns the camera around a centre, about the vertical, at constant speed. At the movement's first frame the camera is
// at its own position.
struct Turntable {
    double turns = 1;                  // > 0: counter-clockwise from above
    std::optional<Place> centre;       // none: the scene's centre
    std::optional<FrameRange> frames;  // duration of the turns; none: the shot's range
};

// Moves the camera forward along its own view axis. At the movement's first frame the camera is at its own position.
struct Dolly {
    double distance = 0;  // m; < 0: backward
    Easing easing = Easing::smooth;
    std::optional<FrameRange> frames;  // none: the shot's range
};

// Movement of the camera; Shot::request selects the camera.
using ShotMovement = std::variant<std::monostate, CameraKeys, Turntable, Dolly>;

// Returns the request for values that neither the shot nor an option sets: the default request, with a fixed number of
// lens samples. A number that changes between frames would be visible as changing noise.
inline Request shotDefaults() {
    Request request;
    request.samples = RenderSettings{}.sampleCount;
    return request;
}

struct Shot {
    std::filesystem::path file;  // for messages; paths in a shot start at its folder, outputs at the current one
    // Fixed values of the shot. Its time is the time of frame 0.
    Request request;
    // Names of the settings (frame/settings/settings.h) that the shot gives.
    std::set<std::string, std::less<>> given;
    // JSON pointers to the places in the shot that name nodes, cameras and clips, by name.
    std::map<std::string, std::string, std::less<>> placesOfNames;

    double frameRate = 24;  // 1/s
    FrameRange range{0, 0};
    double animationSpeed = 1;           // speed of the animation; 0: it stands still
    std::optional<double> shutterAngle;  // degrees, instead of the shutter's seconds; 360: open from frame to frame
    ShotMovement movement;
    std::optional<FocusTrack> focus;
    std::map<std::string, LensTrack, std::less<>> lens;        // fixed or keyed values, by lens field
    std::map<std::string, LensTrack, std::less<>> methodKeys;  // keyed values, by method setting (MethodSetting::keyed)
    bool animateSeed = false;                                  // other sample positions in each frame: moving noise

    std::vector<std::string> outputs = {"frames/####.exr"};
    std::filesystem::path video;  // empty: no video
};

}  // namespace defocus::engine
