// defocus view under mouse and keyboard input.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "cli/two_quads.h"
#include "image/image_io.h"
#include "image/metrics.h"
#include "view/view_program.h"
#ifdef DEFOCUS_XCB
#include "view/drop_source.h"
#endif

namespace defocus::engine {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class View : public ViewProgram {
protected:
    // Opens a picture of 400 × 300 px with two squares: "Near" at 2 m around (200, 67), "Far" at 8 m around (360, 150).
    void openTwoQuads(std::vector<std::string> more = {}) {
        writeTwoQuads(folder() / "quads.gltf");
        more.insert(more.begin(), {"quads.gltf", "--size", "400x300"});
        start(more);
        ASSERT_TRUE(showsScene("quads.gltf")) << textOf("stderr");
    }
    bool focusesAt(double distance) const {
        return reaches([&](const json& s) {
            return s.at("focusDistance").is_number() && std::abs(s.at("focusDistance").get<double>() - distance) < 1e-6;
        });
    }
    double number(const char* name) const { return state().at(name).get<double>(); }
    // Presses a key that changes the state, which proves that earlier input has been processed. Without animation, the
    // view has come to rest too.
    bool comesToRest() const {
        const bool dark = state().at("dark").get<bool>();
        key("t");
        return reaches(
            [&](const json& s) { return s.at("dark") != dark && s.at("moving") == false && s.at("samples") > 130; });
    }
    // Opens the export dialog and accepts the proposed name.
    void exportByHand() const {
        const auto asks = [](const json& s) { return s.at("dialog") == "export"; };
        ASSERT_TRUE(insists([&] { key("ctrl+e"); }, asks)) << state();
        const auto goesOn = [](const json& s) { return s.at("dialog") == ""; };
        ASSERT_TRUE(insists([&] { key("Return"); }, goesOn)) << state();
    }
    // Types a path into the panel's first row and confirms it.
    void openByHand(const std::string& path) const {
        ASSERT_TRUE(insists([&] { click(500, 45); }, [](const json& s) { return s.at("typing") == true; })) << state();
        const auto typed = [&](const json& s) { return s.at("openPath") == path; };
        const auto type = [&] {
            key("ctrl+a");
            act("type --delay 30 " + path);
        };
        ASSERT_TRUE(insists(type, typed)) << state();
        ASSERT_TRUE(insists([&] { key("Return"); }, [](const json& s) { return s.at("typing") == false; })) << state();
    }
};

TEST_F(View, clickFocusesOnWhatIsUnderTheCursor) {
    openTwoQuads({"--focus-distance", "4"});
    click(360, 150);
    EXPECT_TRUE(focusesAt(8)) << state();
    EXPECT_EQ(state().at("selected"), "Far");
    click(200, 67);
    EXPECT_TRUE(focusesAt(2)) << state();
    EXPECT_EQ(state().at("selected"), "Near");
    click(30, 280);  // empty background
    ASSERT_TRUE(comesToRest()) << state();
    EXPECT_NEAR(reached().at("focusDistance").get<double>(), 2, 1e-6);
    EXPECT_EQ(reached().at("selected"), "Near");
}

// The three clicks hit the squares on the plane w + tan(swing)·X + tan(tilt)·Y = focus distance, in view space.
TEST_F(View, threePointsTiltTheFocusPlane) {
    openTwoQuads({"--focus-distance", "4"});
    const std::array<std::array<int, 3>, 3> clicks = {{{180, 60, 2}, {190, 90, 2}, {360, 150, 8}}};  // x, y, depth
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

TEST_F(View, stillViewGathersSamplesAndAChangeBeginsAnew) {
    openTwoQuads({"--focus-distance", "4", "--fstop", "1.4"});
    ASSERT_TRUE(reaches([](const json& s) { return s.at("samples") > 130; })) << state();
    EXPECT_EQ(state().at("moving"), false);
    const double changes = number("changes");
    const double begun = number("begun");
    key("bracketright");  // next f-stop
    ASSERT_TRUE(reaches([&](const json& s) { return s.at("begun") > begun && s.at("samples") > 130; })) << state();
    EXPECT_GT(number("changes"), changes);
    EXPECT_DOUBLE_EQ(number("fStop"), 1.6);
}

TEST_F(View, dragOrbitsAndTheWheelZooms) {
    openTwoQuads();
    const json before = state().at("cameraPosition");
    inTurn({"mousemove 100 200", "mousedown 1", "mousemove 140 210", "mousemove 180 220", "mouseup 1"});
    ASSERT_TRUE(reaches([&](const json& s) { return s.at("cameraPosition") != before; })) << state();
    const json after = state().at("cameraPosition");
    EXPECT_EQ(state().at("selected"), "");  // a drag is not a click
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
    key("x");  // nearest level
    key("x");  // the reference, which has other samples
    EXPECT_TRUE(reaches([](const json& s) {
        return s.at("comparison") == 3 && s.at("psnr").is_number() && s.at("psnr") > 20;
    })) << state();
}

TEST_F(View, workIsCountedInAllSamplesOfTheViewAndAnewAfterAChange) {
    openTwoQuads({"--fstop", "1.4", "--focus-distance", "4"});
    EXPECT_EQ(state().at("workSamples"), 0);  // measured only on request
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
    openTwoQuads();
    std::ofstream(folder() / "bad.glb") << "no glTF";
    openByHand("bad.glb");
    ASSERT_TRUE(reaches([](const json& s) { return s.at("fault") != ""; })) << state();
    EXPECT_NE(state().at("fault").get<std::string>().find("bad.glb"), std::string::npos);
    EXPECT_EQ(state().at("scene"), "quads.gltf");
    EXPECT_TRUE(running());
}

TEST_F(View, openedFileReplacesTheScene) {
    openTwoQuads();
    writeTwoQuads(folder() / "other.gltf");
    openByHand("other.gltf");
    EXPECT_TRUE(showsScene("other.gltf")) << state();
}

#ifdef DEFOCUS_XCB
TEST_F(View, droppedFileReplacesTheScene) {
    openTwoQuads();
    writeTwoQuads(folder() / "two words.gltf");
    DropSource hand(display());
    const std::string uri = "file://" + (folder() / "two%20words.gltf").string();
    ASSERT_TRUE(hand.drop(uri + "\r\n", 120, 100));
    EXPECT_TRUE(showsScene("two words.gltf")) << state();
    // A file that is not a scene is reported, and the old scene stays.
    std::ofstream(folder() / "notes.txt") << "no glTF";
    ASSERT_TRUE(hand.drop("file://" + (folder() / "notes.txt").string() + "\r\n", 120, 100));
    ASSERT_TRUE(reaches([](const json& s) { return s.at("fault") != ""; })) << state();
    EXPECT_NE(state().at("fault").get<std::string>().find("notes.txt"), std::string::npos);
    EXPECT_EQ(state().at("scene"), "two words.gltf");
}
#endif

// The interface scales with the screen's resolution: panel, fonts and window.
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
        // The panel's background begins at the edge of the picture.
        const float* ground = image.at(scaled(250) + 2, scaled(3));
        EXPECT_NEAR(ground[0], 0.016f, 0.004f);
        EXPECT_EQ(ground[0], ground[2]);
        const float* picture = image.at(scaled(250) - 2, scaled(3));
        EXPECT_GT(std::abs(picture[0] - ground[0]) + std::abs(picture[2] - ground[2]), 0.02f);
    }
    setDpi(96);
}

TEST_F(View, exportedStillIsThatOfTheCommand) {
    openTwoQuads({"--samples", "4", "--fstop", "1.4", "--focus-distance", "4"});
    exportByHand();
    ASSERT_TRUE(
        reaches([&](const json& s) { return fs::exists(folder() / "still.png") && s.at("exporting") == false; }));
    const std::string command = std::string(DEFOCUS_PROGRAM) + " render '" + (folder() / "quads.gltf").string() +
                                "' -o '" + (folder() / "render.png").string() +
                                "' --quiet --size 400x300 --samples 4 --fstop 1.4 --focus-distance 4";
    ASSERT_EQ(std::system(command.c_str()), 0);
    EXPECT_EQ(readImage(folder() / "still.png").pixels, readImage(folder() / "render.png").pixels);
}

// With an open shutter, one frame later, the exported image equals the one that the command renders.
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

TEST_F(View, recordedKeyIsCounted) {
    openTwoQuads();
    key("k");
    ASSERT_TRUE(comesToRest()) << state();
    EXPECT_EQ(reached().at("shotKeys"), 1);
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
    start({"quads.gltf"});  // the window remembers the light theme
    ASSERT_TRUE(showsScene("quads.gltf"));
    EXPECT_EQ(state().at("dark"), false);
}

TEST_F(View, interfaceGrowsAndShrinksWhileItRuns) {
    openTwoQuads();
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

TEST_F(View, survivesEverySizeAndScenesThatKeepComing) {
    openTwoQuads();
    // Repeats in turn, so that frames also fall between two queries to the display.
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
    key("ctrl+q");  // while a scene is being opened
    EXPECT_EQ(ended(), 0);
}

// Larger fish keep the pyramids unfinished until the input arrives, even on a fast machine.
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

TEST_F(View, screenshotShowsPictureAndPanel) {
    writeTwoQuads(folder() / "quads.gltf");
    start({"quads.gltf", "--size", "400x300", "--screenshot", "window.png", "--frames", "12"});
    ASSERT_EQ(ended(), 0) << textOf("stderr");
    const Image image = readImage(folder() / "window.png");
    ASSERT_EQ(image.width, 764);
    ASSERT_EQ(image.height, 300);
    const float* near = image.at(200, 67);
    EXPECT_GT(near[0], 2 * near[2]);  // the square is red
    const float* panel = image.at(758, 150);
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
