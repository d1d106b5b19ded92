#pragma once
// Computes the scene, camera and lens of each frame of a shot. The result depends only on the shot and the frame's
// number, so that frames can be rendered in any order and on any machine.

#include <set>
#include <string>
#include <vector>

#include "capture/shot.h"
#include "frame/setup/frame_moment.h"
#include "plan/motion/shutter.h"

namespace defocus::engine {

// Initial state of a shot: the scene with the camera and the settings of the shot's fixed values.
struct SequenceBase {
    std::shared_ptr<const Scene> scene;
    View view;
    RenderSettings settings;
    std::vector<PlacedLight> lights;  // sizes of the scene's lights; default lights if it has none
    CameraChoice camera;
    bool cameraStands = false;                     // the camera stays at its place in `view`; else it follows its node
    std::set<std::string, std::less<>> fixedLens;  // lens fields that don't follow the camera's own values
    glm::dvec3 centre{0.0};                        // centre of the scene at its start; turntables turn around it
    std::vector<std::string> hidden;               // nodes that aren't drawn
    ShutterSettings shutter;                       // exposure of each frame; the camera may move during it
};

// Returns a frame's state. Throws Error for nodes and clips that don't exist, for a focus behind the camera or on
// nothing, and for an impossible lens. The message names the shot's file and the frame.
FrameMoment frameAt(const Shot& shot, const SequenceBase& base, int frame);

// Returns the frames of `range` that shard `shard` of `shards` renders: every shards-th frame, so that slow passages
// are shared evenly.
std::vector<int> shardFrames(const FrameRange& range, int shard, int shards);

}  // namespace defocus::engine
