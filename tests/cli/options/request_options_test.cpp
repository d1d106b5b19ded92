// Tests the options that set the camera and the lens, with `defocus plan --json`.

#include "cli/options/request_options.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "cli/two_quads.h"
#include "lod/pyramid/level_selection.h"

namespace defocus::engine {
namespace {

using nlohmann::json;

class SceneOptionsTest : public ProgramTest {
protected:
    void SetUp() override {
        ProgramTest::SetUp();
        writeTwoQuads(folder() / "two quads ❤.gltf");
    }

    json plan(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), {"plan", "two quads ❤.gltf", "--json"});
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return outcome.exitCode == 0 ? json::parse(outcome.out) : json();
    }

    double lens(const char* key, const std::vector<std::string>& arguments) const {
        return plan(arguments)["lens"][key].get<double>();
    }
};

TEST_F(SceneOptionsTest, camerasFieldOfViewGivesTheFocalLength) {
    // The horizontal field of view is θx, with tan(θx/2) = 0.27 times the aspect ratio. The focal length is 36 mm /
    // (2·tan(θx/2)).
    EXPECT_NEAR(lens("focalLength", {"--size", "1024x768"}), 50, 1e-6);
    EXPECT_NEAR(lens("focalLength", {"--size", "300x300"}), 36 / (2 * 0.27), 1e-6);
    EXPECT_NEAR(lens("focalLength", {"--horizontal-aperture", "24"}), 24 / (2 * 0.36), 1e-6);
    EXPECT_EQ(lens("focalLength", {"--focal-length", "85"}), 85);
}

TEST_F(SceneOptionsTest, lensValuesFallBackToTheDefaults) {
    EXPECT_EQ(lens("fStop", {}), 2.8);
    EXPECT_EQ(lens("horizontalAperture", {}), 36);
    EXPECT_EQ(lens("fStop", {"--fstop", "1.4"}), 1.4);
    // At f/2, a lens of 50 mm has an aperture of 25 mm diameter.
    EXPECT_NEAR(lens("apertureDiameter", {"--fstop", "2"}), 0.025, 1e-9);
    EXPECT_NEAR(lens("apertureDiameter", {"--fstop", "2", "--blur-scale", "3"}), 0.075, 1e-9);
    EXPECT_EQ(lens("apertureDiameter", {"--no-dof"}), 0);
}

TEST_F(SceneOptionsTest, valuesMayHaveTheNotationOfPhotographers) {
    EXPECT_EQ(lens("fStop", {"--fstop", "f/1.4"}), 1.4);
    EXPECT_EQ(lens("focalLength", {"--focal-length", "85mm"}), 85);
    EXPECT_EQ(lens("focalLength", {"--focal-length", "3.5cm"}), 35);
    EXPECT_EQ(lens("focusDistance", {"--focus-distance", "50cm"}), 0.5);
    EXPECT_EQ(lens("focusDistance", {"--focus-distance", "2m"}), 2);
    EXPECT_NEAR(lens("focusDistance", {"--camera-position", "0,0,100cm", "--focus-node", "Near"}), 3, 1e-6);
}

TEST_F(SceneOptionsTest, booleanSettingsTakeAValueOrANegation) {
    EXPECT_EQ(lens("apertureDiameter", {"--dof", "false"}), 0);
    EXPECT_EQ(lens("apertureDiameter", {"--dof=false"}), 0);
    EXPECT_GT(lens("apertureDiameter", {"--dof", "true"}), 0);
    for (const Setting& setting : settings()) {
        if (setting.kind != SettingKind::boolean) continue;
        const bool negated = setting.option.starts_with("--no-");
        const std::string off = negated ? "--" + setting.option.substr(5) : "--no-" + setting.option.substr(2);
        for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
                 {setting.option, "false"}, {setting.option + "=false"}, {off}, {setting.option, "true"}}) {
            Request request;
            CLI::App command;
            addSettings(command, request, {setting.name});
            std::vector<std::string> rewritten = withoutBooleanValues(words);
            std::ranges::reverse(rewritten);
            command.parse(rewritten);
            EXPECT_EQ(setting.text(request), words.back() == "true" ? "true" : "false") << words.front();
        }
    }
}

TEST_F(SceneOptionsTest, focusDefaultsToWhatTheMiddleShows) {
    EXPECT_NEAR(lens("focusDistance", {}), 2, 1e-6);  // depth of the nearer quad, not the mean of both quads' depths
}

TEST_F(SceneOptionsTest, focusOnANode) {
    EXPECT_NEAR(lens("focusDistance", {"--focus-node", "Near"}), 2, 1e-6);
    EXPECT_NEAR(lens("focusDistance", {"--focus-node", "Far"}), 8, 1e-6);
}

TEST_F(SceneOptionsTest, focusOnAPixelTakesTheDepthAndNotTheDistance) {
    // The image has 1024 × 768 px; tan(θx/2) is 0.36 and tan(θy/2) 0.27. The centre of the quad "Near" is 0.3 m above
    // the axis at a depth of 2 m, so it is at row (1 − 0.3/(2·0.27))/2 · 768 = 170.7. The centre of the quad "Far" is 3
    // m to the right at a depth of 8 m, so it is at column (1 + 3/(8·0.36))/2 · 1024 = 1045. Only the left part of
    // "Far" is in the image.
    EXPECT_NEAR(lens("focusDistance", {"--focus-pixel", "511,170"}), 2, 1e-6);
    EXPECT_NEAR(lens("focusDistance", {"--focus-pixel", "1000,384"}), 8, 1e-6);
    // The upper edge of "Near" is at y = 0.5 m (row 28.4), its left edge at x = −0.2 m (column 369.8).
    EXPECT_NEAR(lens("focusDistance", {"--focus-pixel", "511,29"}), 2, 1e-6);
    EXPECT_EQ(run({"plan", "two quads ❤.gltf", "--focus-pixel", "511,27"}).exitCode, 1);
    EXPECT_NEAR(lens("focusDistance", {"--focus-pixel", "370,170"}), 2, 1e-6);
    EXPECT_EQ(run({"plan", "two quads ❤.gltf", "--focus-pixel", "368,170"}).exitCode, 1);
}

TEST_F(SceneOptionsTest, focusOnAPixelWithFocusBreathingHitsWhatThePictureShows) {
    // Focus breathing scales tan(θx/2) by 1 − f/s, with the focal length f = 50 mm and the focus distance s = 2 m.
    // Without breathing, the left edge of the quad "Near" is 142.2 px left of the image's centre (column 512). With
    // breathing, it is at column 512 − 142.2/(1 − 0.025) = 366.1.
    EXPECT_NEAR(lens("focusDistance", {"--focus-breathing", "--focus-pixel", "370,170"}), 2, 1e-6);
}

TEST_F(SceneOptionsTest, whatIsGivenBesideAPresetWinsWhereverItStands) {
    const json preset = plan({"--preset", "jeong2011"});
    EXPECT_EQ(preset["sequence"], "halton");
    EXPECT_EQ(preset["lod"], json({{"mode", "fractional"},
                                   {"metric", "proportional"},
                                   {"coc", "centre"},
                                   {"vertices", "surviving"},
                                   {"blurThreshold", proportionalLevels},
                                   {"sizeThreshold", 0.0},
                                   {"lightThreshold", 0.0}}));  // the metric `proportional` has no light threshold
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"--preset", "jeong2011", "--sequence", "r2", "--lod-coc", "smallest"},
             {"--lod-coc", "smallest", "--sequence", "r2", "--preset", "jeong2011"}}) {
        const json changed = plan(words);
        EXPECT_EQ(changed["sequence"], "r2");
        EXPECT_EQ(changed["lod"]["coc"], "smallest");
        EXPECT_EQ(changed["lod"]["metric"], "proportional");
    }
}

TEST_F(SceneOptionsTest, thresholdsReplaceTheirDefaultsOneByOne) {
    const json defaults = plan({"--lod-metric", "size"})["lod"];
    const json changed = plan({"--blur-threshold", "0.125"})["lod"];
    EXPECT_EQ(changed["blurThreshold"], 0.125);
    EXPECT_EQ(changed["sizeThreshold"], defaults["sizeThreshold"]);
    EXPECT_EQ(plan({"--lod", "nearest", "--lod-metric", "error"})["lod"]["mode"], "nearest");
}

TEST_F(SceneOptionsTest, largestSizeAndManySamplesAreAllowed) {
    const json large = plan({"--size", "8192x8192", "--samples", "65536"});
    EXPECT_EQ(large["image"]["width"], 8192);
    EXPECT_EQ(large["samples"], 65536);
}

TEST_F(SceneOptionsTest, builtInSchoolIsScaledByItsOptions) {
    const Outcome outcome =
        run({"plan", "--fish", "2", "--fish-triangles", "500", "--lod", "off", "--json", "--samples", "8"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const json school = json::parse(outcome.out);
    EXPECT_EQ(school["objects"].size(), 2u);
    EXPECT_EQ(school["lens"]["focusDistance"], 2);
}

TEST_F(SceneOptionsTest, helpOfEachCommandHasAnExample) {
    for (const char* command : {"render", "plan", "info", "compare"}) {
        const Outcome outcome = run({command, "--help"});
        EXPECT_EQ(outcome.exitCode, 0);
        EXPECT_EQ(outcome.err, "");
        EXPECT_NE(outcome.out.find("Example"), std::string::npos) << command;
        EXPECT_NE(outcome.out.find(std::string("defocus ") + command), std::string::npos) << command;
    }
    EXPECT_EQ(run({"--version"}).out.substr(0, 8), "defocus ");
}

}  // namespace
}  // namespace defocus::engine
