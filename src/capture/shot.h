#pragma once
// A shot: what is filmed, from where and through which lens, frame by frame, as a shot file says it
// (docs/shot.schema.json). Plain data; what a file leaves out falls back to the scene's camera or the program's
// defaults. Frames are counted from 0 at time 0.

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
    int last = 0;  // included
};

inline constexpr int maxFrame = 9'999'999;

// A point of the world, or the centre of a node, which may move.
using Place = std::variant<glm::dvec3, std::string>;

// Value of a lens field (in the unit of lens/lens_fields.h); one key: constant.
struct LensTrack {
    std::vector<Key<double>> keys;
    Easing easing = Easing::smooth;
};

// Found anew for each frame, so that the focus follows what moves. A pixel is of an image of the shot's size.
using FocusTarget = std::variant<FocusDistance, FocusNode, FocusPixel, FocusAuto>;

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

// How the camera moves; which one it is stands in Shot::request.
using ShotMovement = std::variant<std::monostate, CameraKeys, Turntable, Dolly>;

// What a shot's request is where neither the shot nor an option says: a default-made request, but with the same number
// of lens samples for each frame. A number that changes from frame to frame would be seen.
inline Request shotDefaults() {
    Request request;
    request.samples = RenderSettings{}.sampleCount;
    return request;
}

struct Shot {
    std::filesystem::path file;  // for messages; paths in a shot are relative to its folder, outputs to the current one
    // Its fixed values, and the names of the settings (frame/settings.h) that it gives; time is that of frame 0.
    Request request;
    std::set<std::string, std::less<>> given;
    // Where the names of nodes, cameras and clips that it gives stand in it, as JSON pointers.
    std::map<std::string, std::string, std::less<>> placesOfNames;

    double frameRate = 24;  // 1/s
    FrameRange range{0, 0};
    double animationSpeed = 1;           // of the clip's time; 0 holds it
    std::optional<double> shutterAngle;  // degrees, in place of the shutter's seconds; 360: from frame to frame
    ShotMovement movement;
    std::optional<FocusTrack> focus;
    std::map<std::string, LensTrack, std::less<>> lens;        // by field
    std::map<std::string, LensTrack, std::less<>> methodKeys;  // of settings of its method (MethodSetting::keyed)
    bool animateSeed = false;                                  // other sample positions in each frame: the noise moves

    std::vector<std::string> outputs = {"frames/####.exr"};
    std::filesystem::path video;  // none: empty
};

}  // namespace defocus::engine
