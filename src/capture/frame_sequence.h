#pragma once
// What to render for each frame of a shot. A pure function of the shot and the frame's number: nothing is carried over
// from frame to frame, so that frames can be rendered in any order and on any machine.

#include <set>
#include <string>
#include <vector>

#include "capture/shot.h"
#include "frame/driver/frame_moment.h"
#include "plan/motion/shutter.h"

namespace defocus::engine {

// What a shot starts from: the scene with the camera and the settings that the shot's fixed values give.
struct SequenceBase {
    std::shared_ptr<const Scene> scene;
    View view;
    RenderSettings settings;
    std::vector<PlacedLight> lights;  // where the scene has none of its own
    CameraChoice camera;
    bool cameraStands = false;                     // at view's place, wherever the scene's own goes
    std::set<std::string, std::less<>> fixedLens;  // fields that don't follow the camera's own values
    glm::dvec3 centre{0.0};                        // the middle of the scene at its start, around which turntables turn
    std::vector<std::string> hidden;               // nodes that aren't drawn
    ShutterSettings shutter;  // of each frame; the shot's camera moves while the shutter is open, too
};

// Throws Error naming the shot's file and the frame for what can't be filmed: nodes and clips that don't exist, a focus
// behind the camera or on nothing, an impossible lens.
FrameMoment frameAt(const Shot& shot, const SequenceBase& base, int frame);

// Frames of `range` that shard `shard` of `shards` renders: every shards-th, so that each has its part of whatever
// takes long.
std::vector<int> shardFrames(const FrameRange& range, int shard, int shards);

}  // namespace defocus::engine
