// Tests tools of the window: undo, dialogs, the scene tree, saved views, full screen.

#include <fmt/format.h>

#include "view/view_fixtures.h"

namespace defocus::engine {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

TEST_F(ViewTools, movingViewsAreDrawnAtHalfSizeOrLarger) {
    openNarrow(300, {"--fstop", "1.4", "--focus-distance", "4"});
    act("mousemove 50 200 keydown d");
    ASSERT_TRUE(reaches([](const json& s) { return s.at("moving") == true && s.at("changes") > 5; })) << state();
    EXPECT_GE(reached().at("drawn").at(0), 130);
    act("keyup d");
}

TEST_F(ViewTools, whereNothingIsBlurredOneSampleOfEachPixelIsDrawn) {
    openNarrow(300, {"--fstop", "64", "--blur-scale", "0.001"});
    act("mousemove 50 200 keydown d");
    ASSERT_TRUE(reaches([](const json& s) { return s.at("moving") == true && s.at("changes") > 5; })) << state();
    EXPECT_EQ(reached().at("drawn"), (json{260, 300, 1}));
    act("keyup d");
}

TEST_F(ViewTools, aPictureThatRestsSaysWhatIsOddAboutIt) {
    openNarrow(300, {"--fstop", "64", "--blur-scale", "0.001"});
    const auto says = [](const json& s) { return s.at("warnings").size() == 1; };
    ASSERT_TRUE(reaches(says)) << state();
    EXPECT_EQ(reached().at("warnings").at(0).get<std::string>().find("no visible blur"), 0u) << reached();
}

TEST_F(ViewTools, aPictureThatIsAllWhiteSaysWhichExposureHelps) {
    openNarrow(300, {"--fstop", "1.4", "--focus-distance", "4", "--exposure", "12"});
    ASSERT_TRUE(reaches([](const json& s) { return s.at("warnings").size() == 1; })) << state();
    EXPECT_NE(reached().at("warnings").at(0).get<std::string>().find("is white at an exposure of 12 EV"),
              std::string::npos)
        << reached();
}

TEST_F(ViewTools, aPictureAsItShouldBeSaysNothing) {
    openNarrow(300, {"--fstop", "1.4", "--focus-distance", "4"});
    ASSERT_TRUE(reaches([](const json& s) { return s.at("moving") == false && s.at("samples") > 1; })) << state();
    EXPECT_TRUE(reached().at("warnings").empty()) << reached();
}

TEST_F(ViewTools, lightsGetASizeAndTheirOwnBack) {
    openSharp(700, {"--shadows", "on"});
    const auto isSized = [](const json& s) {
        return s.at("command").get<std::string>().find("--light-angle 5 ") != std::string::npos;
    };
    ASSERT_TRUE(foldsFocusAndLens()) << state();
    ASSERT_TRUE(unfolds("Surroundings", "lightAngle")) << state();
    ASSERT_FALSE(isSized(state()));
    const std::uint64_t before = state().at("changes");
    ASSERT_TRUE(clicks("lightAngle", isSized)) << state();
    EXPECT_TRUE(reaches([&](const json& s) { return s.at("changes") > before; })) << state();  // the image is redrawn
    key("ctrl+z");
    EXPECT_TRUE(reaches([&](const json& s) { return !isSized(s); })) << state();
}

TEST_F(ViewTools, aPresetIsChosenAndLeftInThePanel) {
    openSharp(700);
    const auto hasPreset = [](const json& s) {
        return s.at("command").get<std::string>().find("--preset ") != std::string::npos;
    };
    ASSERT_TRUE(foldsFocusAndLens()) << state();
    ASSERT_TRUE(unfolds("Method", "preset")) << state();
    ASSERT_FALSE(hasPreset(state()));
    ASSERT_TRUE(clicks("preset", hasPreset)) << state();
    EXPECT_TRUE(clicks("preset", [&](const json& s) { return !hasPreset(s); })) << state();
}

TEST_F(ViewTools, theDesktopsDialogIsAskedWhereThereIsOne) {
    writeTwoQuads(folder() / "other.gltf");
    fs::create_directory(folder() / "bin");
    const fs::path zenity = folder() / "bin" / "zenity";
    std::ofstream(zenity) << "#!/bin/sh\n: > asked\nwhile [ ! -e answer ]; do /bin/sleep 0.05; done\necho '"
                          << (folder() / "other.gltf").string() << "'\n";
    fs::permissions(zenity, fs::perms::owner_all);
    openSharp(300);
    ASSERT_TRUE(presses("ctrl+o", [](const json& s) { return s.at("dialog") == "desktop"; })) << state();
    const double frames = state().at("frames");
    EXPECT_TRUE(reaches([&](const json& s) { return s.at("frames") > frames + 3; }));  // the window keeps drawing
    std::ofstream(folder() / "answer") << "yes";
    EXPECT_TRUE(showsScene("other.gltf")) << state();
}

TEST_F(ViewTools, aDesktopWhoseDialogFailsLeavesItToTheWindow) {
    fs::create_directory(folder() / "bin");
    const fs::path zenity = folder() / "bin" / "zenity";
    std::ofstream(zenity) << "#!/bin/sh\nexit 255\n";
    fs::permissions(zenity, fs::perms::owner_all);
    openSharp(300);
    EXPECT_TRUE(presses("ctrl+o", [](const json& s) { return s.at("dialog") == "open"; })) << state();
}

TEST_F(ViewTools, anExportShowsItsProgressAndCanBeCancelled) {
    openNarrow(300, {"--samples", "65536", "--fstop", "0.5", "--focus-distance", "4"});
    ASSERT_TRUE(presses("ctrl+e", [](const json& s) { return s.at("dialog") == "export"; })) << state();
    ASSERT_TRUE(presses("Return", [](const json& s) { return s.at("exporting") == true; })) << state();
    ASSERT_TRUE(reaches([](const json& s) { return s.at("exportShare") > 0; })) << state();
    EXPECT_TRUE(presses("Escape", [](const json& s) { return s.at("exporting") == false; })) << state();
    EXPECT_FALSE(fs::exists(folder() / "still.png"));
}

TEST_F(ViewTools, selectingInTheTreeShowsTheMaterial) {
    openSharp(300);
    ASSERT_TRUE(unfolds("Objects", "node Far")) << state();
    EXPECT_TRUE(clicks("node Far", [](const json& s) { return s.at("selected") == "Far"; })) << state();
}

TEST_F(ViewTools, f11CoversTheScreenAndGoesBack) {
    openSharp(300);
    ASSERT_TRUE(presses("F11", [](const json& s) {
        return s.at("fullscreen") == true && s.at("picture").at(3) == 800;
    })) << state();
    EXPECT_EQ(reached().at("picture").at(2), 1280 - 364);
    EXPECT_TRUE(presses("F11", [](const json& s) {
        return s.at("fullscreen") == false && s.at("picture").at(3) == 300;
    })) << state();
}

TEST_F(ViewTools, extensionsThatAreIgnoredAreListed) {
    writeTwoQuads(folder() / "quads.gltf");
    std::ifstream file(folder() / "quads.gltf");
    json document = json::parse(file);
    document["extensionsUsed"] = {"KHR_audio_emitter"};
    std::ofstream(folder() / "shiny.gltf") << document;
    start({"shiny.gltf", "--size", "260x700"});
    ASSERT_TRUE(showsScene("shiny.gltf")) << textOf("stderr");
    EXPECT_TRUE(reaches([](const json& s) { return s.at("places").contains("ignored"); })) << state();
}

// No input is lost if it arrives faster than frames are drawn. In the test, all input arrives within a single frame.
TEST_F(ViewTools, aHandThatIsFasterThanTheFramesLosesNothing) {
    openSharp(300);
    writeTwoQuads(folder() / "other.gltf");
    const json field = state().at("places").at("open path");
    act(fmt::format("mousemove {} {} click 1 type --delay 0 quadsss", field.at(0).get<int>(), field.at(1).get<int>()));
    ASSERT_TRUE(reaches([](const json& s) { return s.at("openPath") == "quadsss"; })) << state();
    act("key --delay 30 BackSpace BackSpace BackSpace");
    ASSERT_TRUE(reaches([](const json& s) { return s.at("openPath") == "quad"; })) << state();
    send("key --delay 0 ctrl+a type --delay 0 --args 1 other.gltf key --delay 0 Return");
    EXPECT_TRUE(showsScene("other.gltf")) << state();
    EXPECT_EQ(state().at("help"), false);  // typed letters do not trigger commands
}

}  // namespace
}  // namespace defocus::engine
