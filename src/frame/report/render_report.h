#pragma once
// Describes a render: metadata for its image files, JSON for --stats, and a line of text.

#include <cstdint>
#include <optional>
#include <string>

#include "frame/setup/prepared_frame.h"
#include "image/image_io.h"
#include "plan/frame_plan.h"
#include "render/renderer.h"

namespace defocus::engine {

struct RenderReport {
    const Request& options;
    std::string method;  // method and its settings, from MethodUse::text
    const PreparedFrame& frame;
    const FramePlan& plan;
    RenderStats stats;
    bool softwareDriver = false;
    double totalMilliseconds = 0;         // time since the command began
    std::optional<double> exposure = {};  // exposure of 8-bit images, EV; nullopt: from the lens
    std::string command = {};             // the command line in shell syntax
    std::uint64_t memoryLimit = 0;        // memory limit of the process, bytes
    int tiles = 1;                        // number of tiles drawn; 1: untiled
};

// Returns image metadata. Uses the standard EXR names where they exist: aperture (f-number), focus (m),
// nominalFocalLength (mm), worldToCamera, worldToNDC, cameraLabel, software, expTime, isoSpeed. All other names begin
// with "defocus:".
Metadata renderMetadata(const RenderReport& report);

// Returns a JSON object. Key names contain the unit, milliseconds or bytes; memoryLimit is also in bytes. largestBlur
// is a diameter in pixels, null if unbounded. date is in UTC. peakBytes is the peak memory of the process.
std::string statsJson(const RenderReport& report);

// Returns a text such as "RMSE about 0.0047", or "RMSE not estimated".
std::string errorText(const RenderStats& stats);

// Returns a number of drawn images in words: "64 samples", or "4 pinhole images" for a method without lens samples.
std::string imageCount(const RenderReport& report, std::uint32_t count);

// Returns a summary such as "1024x768, 64 samples in 1.52 s: 2.1 M triangles (full detail: 115.2 M), llvmpipe …". For a
// method without lens samples, it gives the number of pinhole images instead.
std::string summary(const RenderReport& report);

}  // namespace defocus::engine
