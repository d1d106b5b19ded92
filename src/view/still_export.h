#pragma once
// A still of any size and number of samples, rendered step by step so that a window stays awake, with the plan, method,
// metadata and writer of `defocus render`.

#include <chrono>
#include <filesystem>
#include <optional>

#include "frame/frame_driver.h"
#include "frame/prepared_frame.h"
#include "image/image_io.h"

namespace defocus {

struct StillRequest {
    Request options;  // samples, seed, levels, method
    View view;
    std::filesystem::path output;  // .exr, .png or .jpg
    WriteOptions write;
    bool software = false;  // the driver, for the metadata
    std::filesystem::path shaderFolder;
};

class StillExport {
public:
    // Throws Error where the file can't be written or the view not be rendered. `frame` must outlive it and keep its
    // pose.
    StillExport(const PreparedFrame& frame, const StillRequest& request);

    // One wave of samples, and after the last one the file. False once it is written.
    bool step();
    [[nodiscard]] double share() const { return driver_->share(); }  // 0 … 1
    [[nodiscard]] double secondsLeft() const;                        // as so far; infinity before the first wave
    [[nodiscard]] const StillRequest& request() const { return request_; }

private:
    void write();

    const PreparedFrame* frame_;
    StillRequest request_;
    std::optional<FrameDriver> driver_;
    std::chrono::steady_clock::time_point begin_;
};

}  // namespace defocus
