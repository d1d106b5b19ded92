#pragma once
// Computes the scene, camera and lens of each frame of a shot. The result depends only on the shot and the frame
// number, so that frames can be rendered in any order and on any machine.

#include <set>
#include <string>
#include <vector>

#include "capture/shot.h"
#include "frame/setup/frame_moment.h"
#include "plan/motion/shutter.h"

namespace defocus::engine {

// Initial state of a shot: the scene, with the camera and the settings that are constant in the shot.
struct SequenceBase {
    std::shared_ptr<const Scene> scene;
    View view;
    RenderSettings settings;
    // Lights with the request's light sizes; default lights if the scene has no lights.
    std::vector<PlacedLight> lights;
    CameraChoice camera;
    bool cameraStands = false;                     // true: the camera stays as in `view`; false: it follows its node
    std::set<std::string, std::less<>> fixedLens;  // lens fields that the shot sets instead of the camera
    glm::dvec3 centre{0.0};                        // scene's centre at the start; default centre of turntables
    std::vector<std::string> hidden;               // nodes that aren't drawn
    ShutterSettings shutter;                       // exposure of each frame, during which the camera may move
};

// Returns the state of a frame. Throws Error for nodes and clips that don't exist, for a focus that is behind the
// camera or hits no surface, and for an invalid lens. The message contains the shot's file and the frame number.
FrameMoment frameAt(const Shot& shot, const SequenceBase& base, int frame);

// Returns the frames of `range` that shard `shard` of `shards` renders: every `shards`-th frame, so that slow sequences
// are spread evenly over the shards.
std::vector<int> shardFrames(const FrameRange& range, int shard, int shards);

}  // namespace defocus::engine
