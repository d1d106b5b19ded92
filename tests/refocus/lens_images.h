#pragma once
// Writes files of lens images (views from points of the lens) that show the built-in school of fish.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>

#include "core/error.h"
#include "defocus/defocus.h"
#include "frame/own_context.h"
#include "refocus/light_field_output.h"
#include "refocus/refocus.h"
#include "scratch_folder.h"

namespace defocus::engine {

inline Request smallSchool() {
    Request request;
    request.fishCount = 3;
    request.trianglesPerFish = 2'000;
    request.noCache = true;
    request.size = {128, 96};
    request.lens.fStop = 0.95;
    request.focus = FocusDistance{2};
    request.method = "accumulation";
    request.samples = 64;
    return request;
}

class LightFieldTest : public OwnContextTest {
protected:
    // Renders the lens images (views from lens points) of a request into a file, and returns its path.
    std::filesystem::path lensImages(const Request& request, std::optional<FocusRange> range) const {
        const std::filesystem::path path = folder_.path() / "a.lens.exr";
        SceneDriver driver(nullptr, request, {}, {});
        LightFieldOutput output(driver, path, range);
        output.start();
        while (output.advance()) {
        }
        output.finish();
        return path;
    }

    // Returns the error message with which the request is rejected; empty if it is accepted.
    std::string refusalOf(const Request& request, FocusRange range = {1.5, 3}) const {
        try {
            lensImages(request, range);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    }

    ScratchFolder folder_;
};

// Returns an image without its margin.
inline Image within(const Image& image, int margin) {
    Image result(image.width - 2 * margin, image.height - 2 * margin, image.channels);
    const auto rowFloats = static_cast<std::size_t>(result.width) * static_cast<std::size_t>(result.channels);
    for (int y = 0; y < result.height; ++y) std::copy_n(image.at(margin, y + margin), rowFloats, result.at(0, y));
    return result;
}

}  // namespace defocus::engine
