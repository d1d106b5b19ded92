// Tests the window of `defocus view` with mouse and keyboard input.

#include <algorithm>
#include <cmath>

#include "image/image_io.h"
#include "view/view_fixtures.h"
#ifdef DEFOCUS_XCB
#include "view/drop_source.h"
#endif

namespace defocus::engine {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

using View = SessionWindow;

TEST_F(View, clickFocusesOnWhatIsUnderTheCursor) {
    openSmall({"--focus-distance", "4"});
    click(234, 98);
    EXPECT_TRUE(focusesAt(8)) << state();
    EXPECT_EQ(state().at("selected"), "Far");
    click(130, 44);
    EXPECT_TRUE(focusesAt(2)) << state();
    EXPECT_EQ(state().at("selected"), "Near");
    click(20, 182);  // empty background
    ASSERT_TRUE(comesToRest()) << state();
    EXPECT_NEAR(reached().at("focusDistance").get<double>(), 2, 1e-6);
    EXPECT_EQ(reached().at("selected"), "Near");
}

TEST_F(View, stillViewGathersSamplesAndAChangeBeginsAnew) {
    openSmall({"--focus-distance", "4", "--fstop", "1.4"});
    ASSERT_TRUE(reaches([](const json& s) { return s.at("samples") > 130; })) << state();
    EXPECT_EQ(state().at("moving"), false);
    const double changes = number("changes");
    const double begun = number("begun");
    key("bracketright");  // next f-stop
    ASSERT_TRUE(reaches([&](const json& s) { return s.at("begun") > begun && s.at("samples") > 130; })) << state();
    EXPECT_GT(number("changes"), changes);
    EXPECT_DOUBLE_EQ(number("fStop"), 1.6);
}

TEST_F(View, workIsCountedInAllSamplesOfTheViewAndAnewAfterAChange) {
    openSmall({"--fstop", "1.4", "--focus-distance", "4"});
    EXPECT_EQ(state().at("workSamples"), 0);  // the number of triangles per pixel is counted only on request
    key("n");
    ASSERT_TRUE(reaches([](const json& s) { return s.at("overlay") == 3 && s.at("workSamples") == 64; })) << state();
    const double changes = number("changes");
    key("bracketright");
    ASSERT_TRUE(reaches([&](const json& s) {
        return s.at("changes") > changes && s.at("moving") == false && s.at("workSamples") == 64;
    })) << state();
    key("n");
    EXPECT_TRUE(reaches([](const json& s) { return s.at("overlay") == 0; })) << state();
}

TEST_F(View, badFileReportsAndTheOldSceneStays) {
    openSmall({"--no-dof"});
    std::ofstream(folder() / "bad.glb") << "no glTF";
    openByHand("bad.glb");
    ASSERT_TRUE(reaches([](const json& s) { return s.at("fault") != ""; })) << state();
    EXPECT_NE(state().at("fault").get<std::string>().find("bad.glb"), std::string::npos);
    EXPECT_EQ(state().at("scene"), "quads.gltf");
    EXPECT_TRUE(running());
}

TEST_F(View, openedFileReplacesTheScene) {
    openSmall({"--no-dof"});
    writeTwoQuads(folder() / "other.gltf");
    openByHand("other.gltf");
    EXPECT_TRUE(showsScene("other.gltf")) << state();
}

#ifdef DEFOCUS_XCB
TEST_F(View, droppedFileReplacesTheScene) {
    openSmall({"--no-dof"});
    writeTwoQuads(folder() / "two words.gltf");
    DropSource hand(display());
    const std::string uri = "file://" + (folder() / "two%20words.gltf").string();
    ASSERT_TRUE(hand.drop(uri + "\r\n", 120, 100));
    EXPECT_TRUE(showsScene("two words.gltf")) << state();
    // If a dropped file is not a scene, the viewer shows an error and keeps the old scene.
    std::ofstream(folder() / "notes.txt") << "no glTF";
    ASSERT_TRUE(hand.drop("file://" + (folder() / "notes.txt").string() + "\r\n", 120, 100));
    ASSERT_TRUE(reaches([](const json& s) { return s.at("fault") != ""; })) << state();
    EXPECT_NE(state().at("fault").get<std::string>().find("notes.txt"), std::string::npos);
    EXPECT_EQ(state().at("scene"), "two words.gltf");
}
#endif

// Panel, fonts and window scale with the screen's resolution in dots per inch.
TEST_F(View, interfaceFollowsTheScreensResolution) {
    if (std::system("command -v xrdb >/dev/null 2>&1") != 0)
        GTEST_SKIP() << "xrdb is needed (Debian: x11-xserver-utils)";
    writeTwoQuads(folder() / "quads.gltf");
    const auto setDpi = [](int dpi) {
        const std::string line = "echo 'Xft.dpi: " + std::to_string(dpi) + "' | DISPLAY=" + display() + " xrdb -merge";
        EXPECT_EQ(std::system(line.c_str()), 0);
    };
    for (const double scale : {1.0, 1.5, 2.0}) {
        SCOPED_TRACE(scale);
        setDpi(static_cast<int>(96 * scale));
        const std::string shot = "window" + std::to_string(static_cast<int>(10 * scale)) + ".png";
        start({"quads.gltf", "--size", "250x150", "--screenshot", shot, "--frames", "3"});
        ASSERT_EQ(ended(), 0) << textOf("stderr");
        EXPECT_EQ(state().at("scale"), scale);
        const Image image = readImage(folder() / shot);
        const auto scaled = [&](double units) { return static_cast<int>(std::lround(units * scale)); };
        ASSERT_EQ(image.width, scaled(614));
        ASSERT_EQ(image.height, scaled(150));
        // The panel's background begins at the right edge of the rendered image.
        const float* ground = image.at(scaled(250) + 2, scaled(3));
        EXPECT_NEAR(ground[0], 0.016f, 0.004f);
        EXPECT_EQ(ground[0], ground[2]);
        const float* picture = image.at(scaled(250) - 2, scaled(3));
        EXPECT_GT(std::abs(picture[0] - ground[0]) + std::abs(picture[2] - ground[2]), 0.02f);
    }
    setDpi(96);
}

TEST_F(View, exportedStillIsThatOfTheCommand) {
    openSmall({"--samples", "4", "--fstop", "1.4", "--focus-distance", "4"});
    exportByHand();
    ASSERT_TRUE(
        reaches([&](const json& s) { return fs::exists(folder() / "still.png") && s.at("exporting") == false; }));
    const std::string command = std::string(DEFOCUS_PROGRAM) + " render '" + (folder() / "quads.gltf").string() +
                                "' -o '" + (folder() / "render.png").string() +
                                "' --quiet --size 260x195 --samples 4 --fstop 1.4 --focus-distance 4";
    ASSERT_EQ(std::system(command.c_str()), 0);
    EXPECT_EQ(readImage(folder() / "still.png").pixels, readImage(folder() / "render.png").pixels);
}

TEST_F(View, recordedKeyIsCounted) {
    openSmall();
    key("k");
    ASSERT_TRUE(comesToRest()) << state();
    EXPECT_EQ(reached().at("shotKeys"), 1);
}

TEST_F(View, interfaceGrowsAndShrinksWhileItRuns) {
    openSmall({"--no-dof"});
    const auto hasScale = [&](double scale) { return reaches([&](const json& s) { return s.at("scale") == scale; }); };
    key("ctrl+equal");
    EXPECT_TRUE(hasScale(1.125)) << textOf("stderr");
    key("ctrl+0");
    EXPECT_TRUE(hasScale(1)) << textOf("stderr");
    key("ctrl+minus");
    EXPECT_TRUE(hasScale(0.875)) << textOf("stderr");
    key("ctrl+q");
    EXPECT_EQ(ended(), 0);
}

TEST_F(View, screenshotShowsPictureAndPanel) {
    writeTwoQuads(folder() / "quads.gltf");
    start({"quads.gltf", "--size", "260x195", "--screenshot", "window.png", "--frames", "12"});
    ASSERT_EQ(ended(), 0) << textOf("stderr");
    const Image image = readImage(folder() / "window.png");
    ASSERT_EQ(image.width, 624);
    ASSERT_EQ(image.height, 195);
    const float* near = image.at(130, 44);
    EXPECT_GT(near[0], 2 * near[2]);  // the square is red
    const float* panel = image.at(618, 98);
    EXPECT_EQ(panel[0], panel[2]);  // the panel is grey
    EXPECT_LT(panel[0], 0.1f);
}

TEST_F(View, withoutADisplaySaysWhatNeedsNone) {
    start({}, false);
    EXPECT_EQ(ended(), 1);
    const std::string fault = textOf("stderr");
    EXPECT_NE(fault.find("cannot open a window"), std::string::npos) << fault;
    EXPECT_NE(fault.find("defocus render"), std::string::npos) << fault;
    EXPECT_EQ(std::count(fault.begin(), fault.end(), '\n'), 1) << fault;
}

TEST_F(View, unreadableSceneOfAScriptIsAFault) {
    start({"missing.glb", "--frames", "3"});
    EXPECT_EQ(ended(), 1);
    EXPECT_NE(textOf("stderr").find("missing.glb"), std::string::npos);
}

}  // namespace
}  // namespace defocus::engine
