// Tests the options for an animation's clip, time and shutter, with `defocus plan --json`.

#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "scene/gltf/builder.h"

namespace defocus::engine {
namespace {

using nlohmann::json;

// Returns a glTF file with a square that recedes from 2 m to 6 m in 4 s. In a second clip, the square stays at 3 m.
std::string movingSquare() {
    GltfBuilder builder;
    const int positions = builder.positions({-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0});
    const int indices = builder.indices({0, 1, 2, 0, 2, 3});
    builder.mesh({{{"attributes", {{"POSITION", positions}}}, {"indices", indices}}}, {{"name", "Square"}});
    builder.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.9}, {"znear", 0.1}}}}};
    builder.add("nodes", {{"camera", 0}});
    const int times = builder.floats({0, 4}, "SCALAR", 1);
    const int away = builder.floats({0, 0, -2, 0, 0, -6}, "VEC3", 3);
    const int still = builder.floats({0, 0, -3, 0, 0, -3}, "VEC3", 3);
    const auto clip = [&](const char* name, int output) {
        return json{{"name", name},
                    {"samplers", {{{"input", times}, {"output", output}}}},
                    {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}};
    };
    builder.json["animations"] = {clip("Away", away), clip("Still", still)};
    return builder.glb();
}

class ExposureOptions : public ProgramTest {
protected:
    void SetUp() override {
        ProgramTest::SetUp();
        GltfBuilder::save(folder() / "square.glb", movingSquare());
    }

    json plan(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), {"plan", "square.glb", "--json", "--samples", "32", "--no-cache"});
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return outcome.exitCode == 0 ? json::parse(outcome.out) : json();
    }

    void expectDepths(double nearest, double farthest, const std::vector<std::string>& arguments) const {
        const json depths = plan(arguments)["objects"][0]["depth"];
        EXPECT_NEAR(depths[0].get<double>(), nearest, 1e-5);
        EXPECT_NEAR(depths[1].get<double>(), farthest, 1e-5);
    }
};

TEST_F(ExposureOptions, clipTimeAndLoopChooseTheMoment) {
    expectDepths(3, 3, {"--time", "1"});
    expectDepths(6, 6, {"--time", "9"});
    expectDepths(3, 3, {"--time", "9", "--loop"});
    expectDepths(5, 5, {"--time", "-1", "--loop"});
    expectDepths(3, 3, {"--time", "2", "--clip", "Still"});
    expectDepths(4, 4, {"--time", "2", "--clip", "0"});
}

TEST_F(ExposureOptions, theShutterIsOpenAroundItsTime) {
    expectDepths(3.5, 4.5, {"--time", "2", "--shutter", "1"});
    expectDepths(4, 5, {"--time", "2", "--shutter", "1", "--shutter-position", "start"});
    expectDepths(3, 4, {"--time", "2", "--shutter", "2/2", "--shutter-position", "end"});
}

TEST_F(ExposureOptions, segmentsAndExactMotionSayHowManyMoments) {
    const auto moments = [&](const std::vector<std::string>& arguments) {
        return plan(arguments)["shutter"]["moments"].get<int>();
    };
    EXPECT_EQ(moments({"--time", "2"}), 0);
    EXPECT_EQ(moments({"--time", "2", "--shutter", "0"}), 0);
    EXPECT_EQ(moments({"--time", "2", "--shutter", "1/2"}), 2);
    EXPECT_EQ(moments({"--time", "2", "--shutter", "1/2", "--motion-segments", "8"}), 9);
    EXPECT_EQ(moments({"--time", "2", "--shutter", "1/2", "--motion-segments", "exact"}), 32);
    EXPECT_EQ(moments({"--time", "2", "--shutter", "1/2", "--clip", "Still"}), 0);
    EXPECT_EQ(plan({"--time", "2", "--shutter", "1/2"})["shutter"]["movingObjects"], 1);
}

TEST_F(ExposureOptions, wrongValuesGiveOneLine) {
    for (const std::vector<std::string>& wrong : std::vector<std::vector<std::string>>{{"--shutter", "1/0"},
                                                                                       {"--shutter", "-1"},
                                                                                       {"--shutter", "1/"},
                                                                                       {"--shutter", "soon"},
                                                                                       {"--motion-segments", "0"},
                                                                                       {"--motion-segments", "65"},
                                                                                       {"--motion-segments", "fast"},
                                                                                       {"--shutter-position", "left"}})
        EXPECT_EQ(run({"plan", "square.glb", wrong[0], wrong[1]}).exitCode, 2) << wrong[0] << " " << wrong[1];
    const Outcome outcome = run({"plan", "square.glb", "--clip", "Gallop"});
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_NE(outcome.err.find("there is no animation 'Gallop'; the scene has: 0 Away, 1 Still"), std::string::npos)
        << outcome.err;
}

}  // namespace
}  // namespace defocus::engine
