#pragma once
// Writes what a render says about itself: metadata in its images, numbers in --stats, a line for people.

#include <optional>
#include <string>

#include "frame/setup/prepared_frame.h"
#include "image/image_io.h"
#include "plan/frame_plan.h"
#include "render/renderer.h"

namespace defocus::engine {

struct RenderReport {
    const Request& options;
    std::string method;  // MethodUse::text
    const PreparedFrame& frame;
    const FramePlan& plan;
    RenderStats stats;
    bool softwareDriver = false;
    double totalMilliseconds = 0;         // of the whole command so far
    std::optional<double> exposure = {};  // EV of its 8-bit images; none: the lens's
    std::string command = {};             // the command line, as a shell would take it
    std::uint64_t memoryLimit = 0;        // bytes that the process might take
    int tiles = 1;                        // that were drawn one after the other; 1: the image in one piece
};

// EXR's standard names where there are any: aperture (f-number), focus (m), nominalFocalLength (mm), worldToCamera,
// worldToNDC, cameraLabel, software; the rest under "defocus:".
Metadata renderMetadata(const RenderReport& report);

// JSON; milliseconds and bytes as the keys say, the largest blur as a diameter in px (null where it has no bound), the
// date in UTC. peakBytes is the whole process's memory at its peak.
std::string statsJson(const RenderReport& report);

// "error about 0.0047", "error not estimated"
std::string errorText(const RenderStats& stats);

// "1024x768, 64 samples in 1.52 s: 2.1 M triangles (full detail: 115.2 M), llvmpipe …"
std::string summary(const RenderReport& report);

}  // namespace defocus::engine
