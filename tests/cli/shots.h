#pragma once
// Writes a shot file with a few small frames of the two squares in two_quads.h: the focus moves from the near square to
// the far one while the camera orbits the near square.

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/gl_program.h"
#include "cli/two_quads.h"

namespace defocus::engine {

class Capture : public GlProgramTest {
protected:
    void SetUp() override {
        GlProgramTest::SetUp();
        writeTwoQuads(folder() / "quads.gltf");
        writeShot(shot());
    }

    static nlohmann::json shot() {
        return {{"scene", "quads.gltf"},
                {"range", {0, 7}},
                {"size", {64, 48}},
                {"samples", 8},
                {"camera", {{"turntable", {{"turns", 0.1}, {"centre", "Near"}}}}},
                {"lens", {{"fStop", {{"keys", {{{"frame", 0}, {"value", 1.4}}, {{"frame", 7}, {"value", 2.8}}}}}}}},
                {"focus", {{"keys", {{{"frame", 0}, {"node", "Near"}}, {{"frame", 7}, {"distance", 8}}}}}}};
    }

    void writeShot(const nlohmann::json& document) const { std::ofstream(folder() / "shot.json") << document.dump(2); }

    Outcome capture(std::vector<std::string> arguments, std::size_t maxFileBytes = 0) const {
        arguments.insert(arguments.begin(), {"capture", "shot.json", "--quiet"});
        return run(arguments, maxFileBytes);
    }

    [[nodiscard]] std::string bytesOf(const std::filesystem::path& name) const { return textOf(folder() / name); }
};

}  // namespace defocus::engine
