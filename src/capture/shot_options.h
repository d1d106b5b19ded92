#pragma once
// Combines a shot with the options of the command line, which override the shot's values.

#include <string>
#include <vector>

#include "capture/frame_sequence.h"
#include "capture/shot.h"
#include "frame/request.h"
#include "frame/setup/prepared_frame.h"

namespace defocus::engine {

// Sets the shot's constant values in the request as if they were given as options. Lens values are left out, because
// they may have keyframes.
void applyShot(const Shot& shot, Request& request);

// Flags the options that were given on the command line; Request does not contain this information.
struct GivenOptions {
    bool camera = false;
    bool shutter = false;
    bool samples = false;
};

// Merges shot and request after the command line is parsed. Removes overridden values from the shot: the lens fields
// and the focus that `request` sets, and the movement if an option sets a camera or its position. Sets the lens values
// of `request` to those of the shot's first keyframes, so that a frame can be prepared from `request`. With a target
// error, the number of samples has no limit unless the shot or an option sets it.
void settleShot(Shot& shot, Request& request, const GivenOptions& given);

SequenceBase sequenceBase(const PreparedFrame& frame, const Request& request);

}  // namespace defocus::engine
