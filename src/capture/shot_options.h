#pragma once
// A shot together with the command line: what an option says wins over what the shot says.

#include <string>
#include <vector>

#include "capture/frame_sequence.h"
#include "capture/shot.h"
#include "frame/request.h"
#include "frame/setup/prepared_frame.h"

namespace defocus::engine {

// The shot's fixed values as if they had been given as options, except its lens, whose fields may have keys.
void applyShot(const Shot& shot, Request& request);

// What the command line said of these, which show no trace in Request.
struct GivenOptions {
    bool camera = false;
    bool shutter = false;
};

// After the command line has been read. Takes from the shot what `request` replaces: lens fields and focus that have a
// value, and with a camera given, or its place, its movement. Puts the first values of the shot's lens into `request`,
// so that the scene can be placed.
void settleShot(Shot& shot, Request& request, const GivenOptions& given);

SequenceBase sequenceBase(const PreparedFrame& frame, const Request& request);

}  // namespace defocus::engine
