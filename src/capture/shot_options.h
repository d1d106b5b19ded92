#pragma once
// Combines a shot with the command line. Options override the shot's values.

#include <string>
#include <vector>

#include "capture/frame_sequence.h"
#include "capture/shot.h"
#include "frame/request.h"
#include "frame/setup/prepared_frame.h"

namespace defocus::engine {

// Sets the shot's fixed values in the request as if they were given as options. Lens values are left out, because they
// may have keys.
void applyShot(const Shot& shot, Request& request);

// Options that were given but leave no trace in Request.
struct GivenOptions {
    bool camera = false;
    bool shutter = false;
};

// Settles shot and request after parsing the command line. Removes from the shot what `request` overrides: lens fields
// and focus with a value, and the movement if a camera or its position is given. Puts the first values of the shot's
// lens into `request`, so that the scene can be placed.
void settleShot(Shot& shot, Request& request, const GivenOptions& given);

SequenceBase sequenceBase(const PreparedFrame& frame, const Request& request);

}  // namespace defocus::engine
