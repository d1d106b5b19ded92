#pragma once
// Defines a shot: scene, camera and lens of a sequence of frames, as in a shot file (docs/shot.schema.json). Values
// missing in the file are taken from the scene's camera or the program's defaults. Frame 0 is at time 0.

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
    int last = 0;  // last frame, inclusive
};

inline constexpr int maxFrame = 9'999'999;

// A point in world space, or the name of a node, which stands for the centre of that node. The node may move.
using Place = std::variant<glm::dvec3, std::string>;

// Keyframes of a lens parameter, in the unit given in lens/lens_fields.h. A single key means a constant value.
struct LensTrack {
    std::vector<Key<double>> keys;
    Easing easing = Easing::smooth;
};

// Target on which the lens is focused. It is evaluated for each frame, so that the focus follows moving objects.
// FocusPixel is a pixel of an image of the shot's size.
using FocusTarget = std::variant<FocusDistance, FocusNode, FocusPixel, FocusAuto>;

struct FocusTrack {
    std::vector<Key<FocusTarget>> keys;
    Easing easing = Easing::smooth;  // curve between the keys; 1/distance is interpolated, as on a focus ring
};

struct CameraKeys {
    std::vector<Key<Place>> positions;
    std::vector<Key<Place>> targets;  // points that the camera looks at, keyed at the same frames as `positions`
    std::vector<Key<double>> rolls;   // degrees, counter-clockwise seen from behind; same frames as `positions`
    Easing easing = Easing::smooth;
};

// Rotates the camera around a centre, about the vertical axis, at constant speed. At the first frame of the movement,
// the camera is at its original position.
struct Turntable {
    double turns = 1;                  // number of rotations; > 0: counter-clockwise seen from above
    std::optional<Place> centre;       // centre of the rotation; nullopt: the centre of the scene
    std::optional<FrameRange> frames;  // frames during which the camera rotates; nullopt: all frames of the shot
};

// Moves the camera along its view axis. At the first frame of the movement, the camera is at its original position.
struct Dolly {
    double distance = 0;  // distance in m; > 0: forward
    Easing easing = Easing::smooth;
    std::optional<FrameRange> frames;  // frames during which the camera moves; nullopt: all frames of the shot
};

// Movement of the camera during the shot; std::monostate: none. Shot::request selects the camera.
using ShotMovement = std::variant<std::monostate, CameraKeys, Turntable, Dolly>;

// Returns the defaults for values that neither the shot nor an option sets. The number of lens samples is fixed,
// because noise that changes with the number of samples would be visible. LodMode::continuous causes the least popping
// when objects change their levels of detail (docs/results.md#popping).
inline Request shotDefaults() {
    Request request;
    request.samples = RenderSettings{}.sampleCount;
    request.lod = LodMode::continuous;
    return request;
}

struct Shot {
    std::filesystem::path file;  // shot file, for messages; its folder is the base of relative paths
    // Values that are constant during the shot. Request::time is the time of frame 0.
    Request request;
    // Names of the settings (frame/settings/settings.h) that the shot file contains.
    std::set<std::string, std::less<>> given;
    // For each node, camera or clip that the shot file names: the JSON pointer to the first occurrence of the name.
    std::map<std::string, std::string, std::less<>> placesOfNames;

    double frameRate = 24;  // frames per second
    FrameRange range{0, 0};
    double animationSpeed = 1;           // multiplies the animation's speed; 0: no motion
    std::optional<double> shutterAngle;  // degrees; replaces the exposure time in seconds; 360: always open
    ShotMovement movement;
    std::optional<FocusTrack> focus;
    std::map<std::string, LensTrack, std::less<>> lens;        // constant values or keyframes, by name of lens field
    std::map<std::string, LensTrack, std::less<>> methodKeys;  // keyframes, by name of the method's setting
    bool animateSeed = false;                                  // new sample positions, thus new noise, in each frame

    std::vector<std::string> outputs = {"frames/####.exr"};
    std::filesystem::path video;  // path of the video; empty: no video
};

}  // namespace defocus::engine
