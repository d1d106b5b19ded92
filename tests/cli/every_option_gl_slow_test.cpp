// Every setting that a command offers acts: with it, the command says or draws something else. A setting that has no
// case below fails the test, and so does one that changes nothing.

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/program.h"
#include "frame/settings.h"
#include "image/image_io.h"
#include "scene/gltf/builder.h"

namespace defocus {
namespace {

using nlohmann::json;
using Words = std::vector<std::string>;

// What is given, and what must be given with it so that it can act.
struct Case {
    Words words;
    Words with;
    bool still = false;  // the school of fish; else a square that moves
};

// A square that goes away from the camera to its right within 2 s, before a board; a second clip holds it, a second
// camera stands closer.
std::string movingSquare() {
    GltfBuilder builder;
    const int positions = builder.positions({-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0});
    const int indices = builder.indices({0, 1, 2, 0, 2, 3});
    builder.mesh({{{"attributes", {{"POSITION", positions}}}, {"indices", indices}}}, {{"name", "Square"}});
    builder.json["cameras"] = {
        {{"name", "Far"}, {"type", "perspective"}, {"perspective", {{"yfov", 0.9}, {"znear", 0.1}}}},
        {{"name", "Near"}, {"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}}};
    builder.add("nodes", {{"camera", 0}});
    builder.add("nodes", {{"camera", 1}, {"translation", {0.2, 0, -0.5}}});
    builder.add("nodes", {{"mesh", 0}, {"name", "Board"}, {"translation", {-1.5, 0.5, -9}}, {"scale", {2, 2, 1}}});
    const int times = builder.floats({0, 2}, "SCALAR", 1);
    const int away = builder.floats({0, 0, -3, 1.5, 0, -6}, "VEC3", 3);
    const int still = builder.floats({0, 0, -3, 0, 0, -3}, "VEC3", 3);
    const auto clip = [&](const char* name, int output) {
        return json{{"name", name},
                    {"samplers", {{{"input", times}, {"output", output}}}},
                    {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}};
    };
    builder.json["animations"] = {clip("Away", away), clip("Still", still)};
    return builder.glb();
}

// Settings of the lens take any value in their range; blur makes most of them seen.
const std::map<std::string, Case>& cases() {
    static const Words blurred = {"--fstop", "0.5"};
    static const Words moving = {"--shutter", "1", "--time", "0.5"};
    static const std::map<std::string, Case> table = {
        {"scene", {{"square.glb"}, {}, true}},
        {"fishCount", {{"--fish", "3"}, {}, true}},
        {"trianglesPerFish", {{"--fish-triangles", "1500"}, {}, true}},
        {"time", {{"--time", "1"}, {}}},
        {"clip", {{"--clip", "Still"}, {"--time", "1"}}},
        {"loop", {{"--loop"}, {"--time", "2.5"}}},
        {"shutter", {{"--shutter", "0.5"}, {"--time", "1"}}},
        {"shutterPosition", {{"--shutter-position", "start"}, moving}},
        {"motionSegments", {{"--motion-segments", "exact"}, moving}},
        {"environment", {{"--environment", "sky.hdr"}, {}}},
        {"background", {{"--background", "none"}, {}}},
        {"camera", {{"--camera", "Near"}, {}}},
        {"cameraPosition", {{"--camera-position", "0.5,0,0"}, {}}},
        {"cameraTarget", {{"--camera-target", "0.5,0,-3"}, {}}},
        {"cameraUp", {{"--camera-up", "1,1,0"}, {}}},
        {"size", {{"--size", "40x36"}, {}}},
        {"focalLength", {{"--focal-length", "70"}, {}}},
        {"fStop", {{"--fstop", "0.7"}, {}}},
        {"focusDistance", {{"--focus-distance", "4"}, blurred}},
        {"focusNode", {{"--focus-node", "Board"}, blurred}},
        {"focusPixel", {{"--focus-pixel", "24,18"}, {"--fstop", "0.5", "--time", "1", "--camera", "Near"}}},
        {"focusPoints", {{"--focus-points", "10,16,24,18,26,8"}, blurred}},
        {"focusAuto", {{"--focus-auto"}, blurred}},
        {"horizontalAperture", {{"--horizontal-aperture", "50"}, blurred}},
        {"dofEnabled", {{"--no-dof"}, blurred}},
        {"blurScale", {{"--blur-scale", "3"}, blurred}},
        {"focusBreathing", {{"--focus-breathing"}, {"--focus-distance", "0.2"}}},
        {"exposureTime", {{"--exposure-time", "1/20"}, {}}},
        {"iso", {{"--iso", "800"}, {"--exposure-time", "1/20"}}},
        {"bladeCount", {{"--blades", "3"}, blurred}},
        {"bladeRotation", {{"--blade-rotation", "30"}, {"--fstop", "0.5", "--blades", "3"}}},
        {"bladeCurvature", {{"--blade-curvature", "0.5"}, {"--fstop", "0.5", "--blades", "3"}}},
        {"anamorphicRatio", {{"--anamorphic-ratio", "2"}, blurred}},
        {"obstruction", {{"--obstruction", "0.5"}, blurred}},
        {"sphericalAberration", {{"--spherical-aberration", "0.8"}, blurred}},
        {"catEye", {{"--cat-eye", "0.8"}, blurred}},
        {"axialChromaticAberration", {{"--axial-chromatic-aberration", "0.3"}, blurred}},
        {"foregroundLimit", {{"--foreground-limit", "0"}, {"--fstop", "0.5", "--focus-distance", "8"}}},
        {"backgroundLimit", {{"--background-limit", "0"}, {"--fstop", "0.5", "--focus-distance", "1"}}},
        {"focusRangeFront", {{"--focus-range-front", "5"}, {"--fstop", "0.5", "--focus-distance", "8"}}},
        {"focusRangeBehind", {{"--focus-range-behind", "5"}, {"--fstop", "0.5", "--focus-distance", "1"}}},
        {"focusTilt", {{"--focus-tilt", "40"}, blurred}},
        {"focusSwing", {{"--focus-swing", "40"}, blurred}},
        {"fieldCurvature", {{"--field-curvature", "2"}, blurred}},
        {"radialBlurGain", {{"--radial-blur-gain", "3"}, blurred}},
        {"nodeBlur", {{"--node-blur", "Board=0"}, {"--fstop", "0.5", "--focus-distance", "1"}}},
        {"apertureImage", {{"--aperture-image", "half.png"}, blurred}},
        {"samples", {{"--samples", "9"}, {}}},
        {"sequence", {{"--sequence", "r2"}, blurred}},
        {"seed", {{"--seed", "5"}, blurred}},
        {"lod", {{"--lod", "off"}, {"--fstop", "0.3"}, true}},
        {"blurThreshold", {{"--blur-threshold", "3"}, {"--fstop", "0.3", "--size-threshold", "0"}, true}},
        {"sizeThreshold", {{"--size-threshold", "9"}, {"--blur-threshold", "0"}, true}},
        {"cacheFolder", {{"--cache-dir", "kept"}, {}, true}},
        {"noCache", {{"--no-cache"}, {}, true}},
        {"method", {{"--method", "circular"}, blurred}},
        {"layerFormat", {{"--layer-format", "rgba8"}, {}}},
        {"lodMetric", {{"--lod-metric", "error"}, {"--fstop", "0.3"}, true}},
        {"lodCoc",
         {{"--lod-coc", "centre"},
          {"--fstop", "0.3", "--size-threshold", "0", "--blur-threshold", "30", "--focus-distance", "1.95"},
          true}},
        {"cocTolerance", {{"--coc-tolerance", "0.01"}, {"--fstop", "0.5", "--field-curvature", "2"}}},
        {"keepAll", {{"--keep-all"}, {}, true}},
        {"wave", {{"--wave", "1"}, {}, true}},
        {"toneMap", {{"--tonemap", "agx"}, {}}},
        {"exposure", {{"--exposure", "1"}, {}}},
    };
    return table;
}

class EveryOption : public ProgramTest {
public:
    // The settings among a command's options.
    static std::vector<std::string> settingsOffered(const Words& command) {
        CLI::App program;
        GlobalOptions global;
        addCommands(program, global);
        CLI::App* found = &program;
        for (const std::string& word : command) found = found->get_subcommand(word);
        std::vector<std::string> names;
        for (const Setting& setting : settings())
            if (found->get_option_no_throw(setting.option) != nullptr) names.push_back(setting.name);
        return names;
    }

protected:
    void SetUp() override {
        ProgramTest::SetUp();
        GltfBuilder::save(folder() / "square.glb", movingSquare());
        Image sky(8, 4, 3);
        for (std::size_t i = 0; i < sky.pixels.size(); ++i) sky.pixels[i] = static_cast<float>(i % 7) * 0.3f;
        writeImage(folder() / "sky.exr", sky);
        std::filesystem::rename(folder() / "sky.exr", folder() / "sky.hdr");  // told apart by content
        Image half(8, 8, 1);
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 4; ++x) *half.at(x, y) = 1;
        writeImage(folder() / "half.png", half);
    }

    // The command line with and without the setting, on the case's scene.
    static Words lineOf(const Words& command, const std::string& name, bool given, const Words& rest) {
        const Case& tried = cases().at(name);
        Words line = command;
        const Words scene = tried.still ? Words{"--fish", "1", "--fish-triangles", "900"} : Words{"square.glb"};
        const bool replacesScene = name == "scene" || name == "fishCount" || name == "trianglesPerFish";
        const auto add = [&](const Words& words) { line.insert(line.end(), words.begin(), words.end()); };
        if (name == "fishCount") add({"--fish-triangles", "900"});
        if (name == "trianglesPerFish") add({"--fish", "1"});
        if (!replacesScene) add(scene);
        if (name == "scene" && !given) add(scene);
        if (name == "fishCount" && !given) add({"--fish", "1"});
        if (name == "trianglesPerFish" && !given) add({"--fish-triangles", "900"});
        if (name != "size") add({"--size", "48x36"});
        if (name == "size" && !given) add({"--size", "48x36"});
        add(tried.with);
        if (given) add(tried.words);
        add(rest);
        return line;
    }

    // With and without the setting, `rest` being what the command is given anyway: what `print` sees must differ.
    void expectActs(const Words& command, const std::string& name, const Words& rest,
                    const std::function<std::string()>& print) {
        std::string seen[2];
        for (const bool given : {false, true}) {
            std::filesystem::remove_all(cacheFolder());
            std::filesystem::remove_all(folder() / "kept");
            Words tail = rest;
            const auto samples = std::find(tail.begin(), tail.end(), "--samples");
            if (name == "samples" && given && samples != tail.end()) tail.erase(samples, samples + 2);
            last_ = run(lineOf(command, name, given, tail));
            EXPECT_EQ(last_.exitCode, 0) << last_.err;
            seen[given ? 1 : 0] = print();
        }
        EXPECT_TRUE(seen[0] != seen[1]) << name << " changes nothing";
    }

    [[nodiscard]] std::string cacheState() const {
        return std::string(std::filesystem::exists(cacheFolder()) ? "cache " : "") +
               (std::filesystem::exists(folder() / "kept") ? "kept " : "");
    }

    Outcome last_;
};

std::vector<std::string> offered(const char* command) {
    return EveryOption::settingsOffered({command});
}

TEST_F(EveryOption, hasItsCase) {
    for (const char* command : {"plan", "render", "view", "capture"})
        for (const std::string& name : offered(command)) EXPECT_TRUE(cases().contains(name)) << command << " " << name;
}

class EveryOptionOfPlan : public EveryOption, public testing::WithParamInterface<std::string> {};

TEST_P(EveryOptionOfPlan, acts) {
    // An environment is read and its faults are told (BadInput), but light is no matter of a plan.
    if (GetParam() == "environment") return;
    expectActs({"plan"}, GetParam(), {"--json"}, [&] { return last_.out + cacheState(); });
}

INSTANTIATE_TEST_SUITE_P(Settings, EveryOptionOfPlan, testing::ValuesIn(offered("plan")),
                         [](const auto& each) { return each.param; });

class EveryOptionOfRender : public EveryOption, public testing::WithParamInterface<std::string> {};

TEST_P(EveryOptionOfRender, acts) {
    const Words rest = {"--samples", "4", "-o", "a.exr", "-o", "a.png", "--stats", "stats.json"};
    expectActs({"render"}, GetParam(), rest, [&] {
        const Image image = readImage(folder() / "a.exr");
        const json stats = json::parse(textOf(folder() / "stats.json"));
        std::string text = cacheState() + std::to_string(image.width) + textOf(folder() / "a.png");
        text.append(reinterpret_cast<const char*>(image.pixels.data()), image.pixels.size() * sizeof(float));
        for (const char* key : {"wave", "layerFormat", "trianglesFacingAway", "trianglesOutside", "samples"})
            text += stats.at(key).dump() + " ";
        return text;
    });
}

INSTANTIATE_TEST_SUITE_P(Settings, EveryOptionOfRender, testing::ValuesIn(offered("render")),
                         [](const auto& each) { return each.param; });

// What the speed-up bench takes of the levels of detail shows in the triangles that it counts.
TEST_F(EveryOption, ofLevelsActsInTheSpeedup) {
    const auto triangles = [&](const Words& option) {
        Words line = {"bench", "speedup", "--counts", "4", "--runs", "1", "--reference-samples", "0", "-o", "result"};
        const Words scene = {"--fish",  "1",   "--fish-triangles", "3000", "--size", "64x48",
                             "--fstop", "0.3", "--focus-distance", "1.2"};
        line.insert(line.end(), scene.begin(), scene.end());
        line.insert(line.end(), option.begin(), option.end());
        last_ = run(line);
        EXPECT_EQ(last_.exitCode, 0) << last_.err;
        const json result = json::parse(textOf(folder() / "result" / "speedup.json"));
        std::string text;
        for (const json& row : result.at("rows")) text += row.at("triangles").dump() + " ";
        return text;
    };
    const std::string bySize = triangles({"--blur-threshold", "0"});
    EXPECT_NE(bySize, triangles({"--blur-threshold", "3"}));
    EXPECT_NE(bySize, triangles({"--blur-threshold", "0", "--size-threshold", "1"}));
    EXPECT_NE(bySize, triangles({"--blur-threshold", "0", "--lod-metric", "error"}));
}

}  // namespace
}  // namespace defocus
