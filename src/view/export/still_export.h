#pragma once
// Renders a still image step by step, so that the window stays responsive, and writes it as `defocus render` does.

#include <chrono>
#include <filesystem>

#include "frame/driver/scene_driver.h"

namespace defocus::engine {

class StillExport {
public:
    // Renders `view` of `frame`, whose pyramids must be built, in the current GL context. The request provides samples,
    // seed, levels, method, tone map and exposure. Throws Error if the file (.exr, .png or .jpg) can't be written or
    // the view can't be rendered.
    StillExport(const PreparedFrame& frame, const View& view, const Request& request, std::filesystem::path output,
                std::filesystem::path shaderFolder);

    // Draws one batch of samples, or writes the file once all samples are drawn. Returns false after the file is
    // written.
    bool step();
    [[nodiscard]] double share() const { return driver_.driver().share(); }  // finished fraction, 0 … 1
    [[nodiscard]] double secondsLeft() const;  // estimate; infinity until the first batch is drawn
    [[nodiscard]] const std::filesystem::path& output() const { return output_; }

private:
    std::filesystem::path output_;
    SceneDriver driver_;
    std::chrono::steady_clock::time_point begin_;
};

}  // namespace defocus::engine
