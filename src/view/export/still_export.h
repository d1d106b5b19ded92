#pragma once
// Renders a still image step by step, so that the window stays responsive, and writes it as `defocus render` does.

#include <chrono>
#include <filesystem>
#include <optional>

#include "frame/driver/frame_driver.h"
#include "frame/setup/prepared_frame.h"
#include "image/image_io.h"

namespace defocus::engine {

struct StillRequest {
    Request options;  // provides samples, seed, levels and method
    View view;
    std::filesystem::path output;  // path with extension .exr, .png or .jpg
    WriteOptions write;
    bool software = false;  // true: OpenGL runs on the CPU
    std::filesystem::path shaderFolder;
};

class StillExport {
public:
    // Throws Error if the file can't be written or the view can't be rendered. `frame` must outlive the export, and its
    // pose must not change.
    StillExport(const PreparedFrame& frame, const StillRequest& request);

    // Draws one batch of samples, or writes the file once all samples are drawn. Returns false after the file is
    // written.
    bool step();
    [[nodiscard]] double share() const { return driver_->share(); }  // finished fraction, 0 … 1
    [[nodiscard]] double secondsLeft() const;  // estimate; infinity until the first batch is drawn
    [[nodiscard]] const StillRequest& request() const { return request_; }

private:
    void finish();

    const PreparedFrame* frame_;
    StillRequest request_;
    std::optional<FrameDriver> driver_;
    std::chrono::steady_clock::time_point begin_;
};

}  // namespace defocus::engine
