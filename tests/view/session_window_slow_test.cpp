// Tests the window of `defocus view` with longer sequences of mouse and keyboard input.

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "image/image_io.h"
#include "image/metrics.h"
#include "view/view_fixtures.h"

namespace defocus::engine {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

using View = SessionWindow;

// Three Ctrl-clicks tilt the focus plane so that it contains the three points on the squares. In view space, (X, Y) at
// depth w lies on the plane if w + tan(swing)·X + tan(tilt)·Y = focus distance.
TEST_F(View, threePointsTiltTheFocusPlane) {
    openTwoQuads({"--focus-distance", "4"});
    // x, y (px), depth (m)
    const std::array<std::array<int, 3>, 3> clicks = {{{180, 60, 2}, {190, 90, 2}, {360, 150, 8}}};
    for (const auto& [x, y, depth] : clicks)
        inTurn({fmt::format("mousemove {} {}", x, y), "keydown ctrl", "click 1", "keyup ctrl"});
    ASSERT_TRUE(reaches([](const json& s) { return s.at("focusTilt") != 0.0 && s.at("focusSwing") != 0.0; }))
        << state();
    for (const auto& [x, y, depth] : clicks) {
        const double across = (x / 200.0 - 1) * 0.36 * depth;
        const double up = (1 - y / 150.0) * 0.27 * depth;
        EXPECT_NEAR(depth + std::tan(number("focusSwing")) * across + std::tan(number("focusTilt")) * up,
                    number("focusDistance"), 1e-5);
    }
    EXPECT_EQ(state().at("selected"), "");  // the clicks set focus points and select nothing
}

TEST_F(View, dragOrbitsAndTheWheelZooms) {
    openTwoQuads();
    const json before = state().at("cameraPosition");
    inTurn({"mousemove 100 200", "mousedown 1", "mousemove 140 210", "mousemove 180 220", "mouseup 1"});
    ASSERT_TRUE(reaches([&](const json& s) { return s.at("cameraPosition") != before; })) << state();
    const json after = state().at("cameraPosition");
    EXPECT_EQ(state().at("selected"), "");  // a drag does not select objects as a click does
    inTurn({"mousemove 100 200", "click 4 click 4"});
    EXPECT_TRUE(reaches([&](const json& s) { return s.at("cameraPosition") != after; })) << state();
}

TEST_F(View, wheelRacksFocusAndTurnsTheApertureRing) {
    openTwoQuads({"--focus-distance", "4", "--fstop", "2.8"});
    inTurn({"mousemove 100 200", "keydown ctrl", "click 4 click 4", "keyup ctrl"});
    EXPECT_TRUE(focusesAt(4 * std::exp(0.06))) << state();
    inTurn({"keydown shift", "click 5", "keyup shift"});
    EXPECT_TRUE(reaches([](const json& s) { return s.at("fStop") == 3.2; })) << state();
}

TEST_F(View, dividerMovesUnderTheHandAndPsnrIsShown) {
    openTwoQuads({"--fstop", "1.4", "--focus-distance", "4"});
    key("x");
    ASSERT_TRUE(reaches([](const json& s) { return s.at("comparison") == 1 && s.at("divider") == 0.5; })) << state();
    inTurn({"mousemove 201 200", "mousedown 1", "mousemove 250 200", "mousemove 300 200", "mouseup 1"});
    EXPECT_TRUE(reaches([](const json& s) { return std::abs(s.at("divider").get<double>() - 0.75) < 0.01; }))
        << state();
    key("x");  // switches to a comparison with level mode `nearest`
    key("x");  // switches to a comparison with the reference image, whose lens samples differ from the view's
    EXPECT_TRUE(reaches([](const json& s) {
        return s.at("comparison") == 3 && s.at("psnr").is_number() && s.at("psnr") > 20;
    })) << state();
}

// With an open shutter, and after a step to the next frame, the exported image equals the image that `defocus render`
// renders for the same time and shutter.
TEST_F(View, shutterStaysOpenAtAnotherTime) {
    const std::string scene = std::string(DEFOCUS_SOURCE_DIR) + "/meshes/swimmers.glb";
    start({scene, "--size", "260x150", "--samples", "4", "--lod", "off", "--time", "0.5", "--shutter", "0.2"});
    ASSERT_TRUE(reaches([](const json& s) { return s.at("samples") > 0 && s.at("draft") == false; })) << state();
    key("period");
    ASSERT_TRUE(reaches([](const json& s) { return s.at("time") > 0.51; })) << state();
    exportByHand();
    ASSERT_TRUE(
        reaches([&](const json& s) { return fs::exists(folder() / "still.png") && s.at("exporting") == false; }));
    const auto rendered = [&](const std::string& name, const std::string& more) {
        const std::string command =
            std::string(DEFOCUS_PROGRAM) + " render '" + scene + "' -o '" + (folder() / name).string() +
            "' --quiet --size 260x150 --samples 4 --lod off --time " + state().at("time").dump() + more;
        EXPECT_EQ(std::system(command.c_str()), 0);
        return readImage(folder() / name);
    };
    const Image still = readImage(folder() / "still.png");
    EXPECT_GT(compareImages(rendered("blurred.png", " --shutter 0.2"), still).psnr, 50);
    EXPECT_LT(compareImages(rendered("sharp.png", ""), still).psnr, 45);
}

TEST_F(View, keysSwitchWhatTheyName) {
    openTwoQuads();
    key("t");
    EXPECT_TRUE(reaches([](const json& s) { return s.at("dark") == false; }));
    key("question");
    EXPECT_TRUE(reaches([](const json& s) { return s.at("help") == true && s.at("places").contains("pan"); }));
    key("Escape");
    EXPECT_TRUE(reaches([](const json& s) { return s.at("help") == false; }));
    key("b");
    EXPECT_TRUE(reaches([](const json& s) { return s.at("poppingTest") == true; }));
    for (const char* overlay : {"c", "l", "z", "p", "o", "m"}) key(overlay);
    key("ctrl+q");
    EXPECT_EQ(ended(), 0);
    start({"quads.gltf"});  // the viewer remembers the light theme between runs
    ASSERT_TRUE(showsScene("quads.gltf"));
    EXPECT_EQ(state().at("dark"), false);
}

TEST_F(View, survivesEverySizeAndScenesThatKeepComing) {
    openTwoQuads();
    // Repeat all sizes three times, so that some frames fall between two queries to the display server.
    for (int turn = 0; turn < 3; ++turn)
        for (const char* size : {"1 1", "700 1", "1 300", "640 480"}) {
            act(std::string("search --onlyvisible --name defocus windowsize ") + size);
            ASSERT_TRUE(running()) << size << '\n' << textOf("stderr");
        }
    act("search --onlyvisible --name defocus windowunmap windowmap mousemove 100 100");
    EXPECT_TRUE(reaches([](const json& s) { return s.at("picture").at(3) == 480; })) << state();
    ASSERT_TRUE(running());
    key("ctrl+q");
    EXPECT_EQ(ended(), 0);
    std::filesystem::remove(folder() / "state.json");
    start({"--fish", "3", "--fish-triangles", "40000"});
    ASSERT_TRUE(reaches([](const json& s) { return s.at("loading") == true || s.at("samples") > 0; })) << state();
    key("ctrl+q");  // quits while a scene is being opened
    EXPECT_EQ(ended(), 0);
}

// Coarse shapes appear before the pyramids are finished, and edits made during that time are kept. The test uses larger
// and larger fish until the input arrives before the pyramids are finished, even on a fast machine.
TEST_F(View, coarseShapesAppearFirstAndWhatWasDoneWithThemStays) {
    double before = 0;
    const auto changesTheStopOfCoarseShapes = [&](int triangles) {
        fs::remove(folder() / "state.json");
        start({"--fish", "4", "--fish-triangles", std::to_string(triangles), "--size", "320x240"});
        if (!reaches([](const json& s) { return s.at("samples") > 0; }) || reached().at("draft") == false) return false;
        EXPECT_EQ(reached().at("loading"), true);
        before = reached().at("fStop").get<double>();
        send("key bracketright");  // next f-stop
        return reaches([&](const json& s) { return s.at("fStop") > before; }) && reached().at("draft") == true;
    };
    int triangles = 90'000;
    while (!changesTheStopOfCoarseShapes(triangles)) {
        ASSERT_LT(triangles, 3'000'000) << "the coarse shapes must appear first: " << state();
        key("ctrl+q");
        ASSERT_EQ(ended(), 0);
        triangles *= 2;
    }
    const auto stop = reached().at("fStop").get<double>();
    ASSERT_TRUE(reaches([](const json& s) { return s.at("draft") == false && s.at("samples") > 0; })) << state();
    EXPECT_EQ(reached().at("loading"), false);
    EXPECT_EQ(reached().at("fStop"), stop);
}

}  // namespace
}  // namespace defocus::engine
