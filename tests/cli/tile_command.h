#pragma once
// Fixture that runs `defocus render` on a small scene, for a full frame or one tile at a time.

#include <filesystem>
#include <string>
#include <vector>

#include "cli/shots.h"
#include "image/image_io.h"

namespace defocus::engine {

class TileCommand : public Capture {
protected:
    static std::vector<std::string> line(const std::vector<std::string>& more, const char* size = "64x48",
                                         const char* samples = "70") {
        std::vector<std::string> words = {"render", "quads.gltf", "--quiet", "--size",           size, "--fstop",
                                          "1",      "--samples",  samples,   "--focus-distance", "3"};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }
    Outcome tile(const std::string& share, const std::string& output, std::vector<std::string> more = {}) const {
        more.insert(more.end(), {"--tile", share, "-o", output});
        return run(line(more));
    }
    [[nodiscard]] std::vector<float> pixelsOf(const std::string& name) const {
        return readImage(folder() / name).pixels;
    }
    void expectRefused(const Outcome& outcome, int exitCode, const std::string& why) const {
        expectOneLine(outcome, exitCode);
        EXPECT_NE(outcome.err.find(why), std::string::npos) << outcome.err;
    }
};

}  // namespace defocus::engine
