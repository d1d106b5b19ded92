#pragma once
// Renders a scene to a file of lens images (one image per lens sample), one image at a time:
//
//   LightFieldOutput output(driver, path, range);
//   output.start();
//   while (output.advance()) {}
//   output.finish();

#include <filesystem>
#include <optional>

#include "frame/driver/scene_driver.h"
#include "refocus/light_field.h"

namespace defocus::engine {

class LightFieldOutput {
public:
    // Number of lens samples if the request gives none.
    static constexpr std::uint32_t defaultSamples = 64;

    // `driver` must outlive the output. `range`: focus distances that images computed from the file may have, in
    // addition to the request's focus distance; nullopt: from the nearest to the farthest visible surface. Throws
    // UsageError unless 0 < nearest ≤ farthest.
    LightFieldOutput(SceneDriver& driver, std::filesystem::path path, std::optional<FocusRange> range);

    // Throws UsageError unless the file's name ends with .exr.
    static void checkPath(const std::filesystem::path& path);
    // Returns the request with the method and the number of samples that lens images need. Throws UsageError if the
    // request sets another method, an unsuitable number of samples, a target error or a time limit.
    static Request suited(Request request);

    // Begins the frame of the driver's first request, which suited() must have returned. Throws Error in the same cases
    // as lightFieldInfo() and SceneDriver::start().
    void start(const Progress& progress = {});
    // Draws and writes the next image. Returns false once all images are written.
    bool advance();
    // Completes the file.
    void finish();

    [[nodiscard]] const LightFieldInfo& info() const { return info_; }  // valid after start()

private:
    SceneDriver& driver_;
    std::filesystem::path path_;
    std::optional<FocusRange> range_;
    LightFieldInfo info_;
    std::optional<ImagePartWriter> writer_;
};

}  // namespace defocus::engine
