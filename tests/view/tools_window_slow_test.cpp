// Tests tools of the window that take several steps: undo, dialogs, the scene tree, saved views.

#include <fmt/format.h>

#include "image/image_io.h"
#include "view/view_fixtures.h"

namespace defocus::engine {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

TEST_F(ViewTools, aClickIsMarkedForAMoment) {
    openTwoQuads({"--focus-distance", "4"});
    click(360, 150);
    ASSERT_TRUE(reaches([](const json& s) { return s.at("marker").at("number") == 1; })) << state();
    EXPECT_EQ(reached().at("marker").at("name"), "Far");
    EXPECT_NEAR(reached().at("marker").at("distance").get<double>(), 8, 1e-6);
    EXPECT_TRUE(reaches([](const json& s) { return s.at("marker").at("shown") == false; })) << state();
    click(30, 280);  // empty background
    EXPECT_TRUE(reaches([](const json& s) { return s.at("marker").at("number") == 2; })) << state();
    EXPECT_EQ(reached().at("marker").at("name"), "");
}

TEST_F(ViewTools, aDragIsUndoneAndRedoneAsOneStep) {
    openTwoQuads();
    const json before = state().at("cameraPosition");
    inTurn({"mousemove 100 200", "mousedown 1", "mousemove 140 410", "mousemove 180 420", "mouseup 1"});
    ASSERT_TRUE(reaches([&](const json& s) { return s.at("cameraPosition") != before && s.at("undoSteps") == 1; }))
        << state();
    const json after = reached().at("cameraPosition");
    inTurn({"keydown bracketright", "keyup bracketright"});
    ASSERT_TRUE(reaches([&](const json& s) { return s.at("undoSteps") == 2; })) << state();
    key("ctrl+z");
    key("ctrl+z");
    ASSERT_TRUE(reaches([&](const json& s) { return s.at("cameraPosition") == before && s.at("redoSteps") == 2; }))
        << state();
    key("ctrl+shift+z");
    ASSERT_TRUE(reaches([&](const json& s) { return s.at("cameraPosition") == after && s.at("redoSteps") == 1; }))
        << state();
    ASSERT_TRUE(clicks("Reset all", [&](const json& s) { return s.at("cameraPosition") == before; })) << state();
    key("ctrl+z");  // undoes the reset, which is a separate step
    EXPECT_TRUE(reaches([&](const json& s) { return s.at("cameraPosition") == after; })) << state();
}

TEST_F(ViewTools, theWindowsOwnBrowserOpensScenesAndRecentOnesAreKept) {
    openTwoQuads();
    writeTwoQuads(folder() / "other.gltf");
    ASSERT_TRUE(presses("ctrl+o", [](const json& s) { return s.at("dialog") == "open"; })) << state();
    EXPECT_TRUE(presses("Escape", [](const json& s) { return s.at("dialog") == ""; })) << state();
    ASSERT_TRUE(presses("ctrl+o", [](const json& s) { return s.at("dialog") == "open"; })) << state();
    act("type --delay 30 oth");
    key("Return");
    ASSERT_TRUE(showsScene("other.gltf")) << state();
    ASSERT_TRUE(clicks("recent", [](const json& s) { return s.at("places").contains("recent quads.gltf"); }));
    EXPECT_TRUE(clicks("recent quads.gltf", [](const json& s) { return s.at("scene") == "quads.gltf"; })) << state();
}

TEST_F(ViewTools, exportAsksBeforeItReplacesAFile) {
    openTwoQuads({"--samples", "2"});
    std::ofstream(folder() / "still.png") << "mine";
    ASSERT_TRUE(presses("ctrl+e", [](const json& s) { return s.at("dialog") == "export"; })) << state();
    ASSERT_TRUE(presses("Return", [](const json& s) { return s.at("dialog") == "replace"; })) << state();
    EXPECT_EQ(textOf("still.png"), "mine");
    ASSERT_TRUE(clicks("another name", [](const json& s) { return s.at("dialog") == ""; })) << state();
    ASSERT_TRUE(
        reaches([&](const json& s) { return fs::exists(folder() / "still-2.png") && s.at("exporting") == false; }));
    EXPECT_EQ(textOf("still.png"), "mine");
    EXPECT_EQ(readImage(folder() / "still-2.png").width, 400);

    ASSERT_TRUE(presses("ctrl+e", [](const json& s) { return s.at("dialog") == "export"; })) << state();
    ASSERT_TRUE(typesPath("still.png")) << state();
    ASSERT_TRUE(presses("Return", [](const json& s) { return s.at("dialog") == "replace"; })) << state();
    ASSERT_TRUE(clicks("replace", [](const json& s) { return s.at("dialog") == ""; })) << state();
    ASSERT_TRUE(reaches([&](const json& s) { return s.at("exporting") == false && textOf("still.png") != "mine"; }));
    EXPECT_EQ(readImage(folder() / "still.png").width, 400);
}

TEST_F(ViewTools, whatTheTreeHidesIsMissingInPictureStillAndCommand) {
    openTwoQuads({"--samples", "4", "--fstop", "1.4", "--focus-distance", "4"});
    click(200, 67);
    ASSERT_TRUE(reaches([](const json& s) { return s.at("selected") == "Near"; })) << state();
    ASSERT_TRUE(unfolds("Objects", "show Near")) << state();
    ASSERT_TRUE(clicks("show Near", [](const json& s) { return s.at("objects") == 1; })) << state();
    EXPECT_EQ(state().at("hidden"), json{"Near"});
    EXPECT_NE(state().at("command").get<std::string>().find("--hide Near"), std::string::npos);
    const std::uint64_t clicks = state().at("marker").at("number");
    click(200, 67);  // a click at the position of a hidden object does not select it
    ASSERT_TRUE(reaches([&](const json& s) { return s.at("marker").at("number") > clicks; })) << state();
    EXPECT_EQ(reached().at("marker").at("name"), "");

    ASSERT_TRUE(presses("ctrl+e", [](const json& s) { return s.at("dialog") == "export"; })) << state();
    ASSERT_TRUE(presses("Return", [](const json& s) { return s.at("dialog") == ""; })) << state();
    ASSERT_TRUE(
        reaches([&](const json& s) { return fs::exists(folder() / "still.png") && s.at("exporting") == false; }));
    const auto rendered = [&](const std::string& name, const std::string& more) {
        const std::string command =
            fmt::format("'{}' render '{}' -o '{}' --quiet --size 400x300 --samples 4 --fstop 1.4 --focus-distance 2 {}",
                        DEFOCUS_PROGRAM, (folder() / "quads.gltf").string(), (folder() / name).string(), more);
        EXPECT_EQ(std::system(command.c_str()), 0);
        return readImage(folder() / name).pixels;
    };
    const std::vector<float> still = readImage(folder() / "still.png").pixels;
    EXPECT_EQ(still, rendered("hidden.png", "--hide Near"));
    EXPECT_NE(still, rendered("whole.png", ""));

    key("ctrl+z");
    EXPECT_TRUE(reaches([](const json& s) { return s.at("objects") == 2 && s.at("hidden").empty(); })) << state();
    key("ctrl+shift+z");
    ASSERT_TRUE(reaches([](const json& s) { return s.at("objects") == 1; })) << state();
    writeTwoQuads(folder() / "other.gltf");
    ASSERT_TRUE(presses("ctrl+o", [](const json& s) { return s.at("dialog") == "open"; })) << state();
    act("type --delay 30 other");
    key("Return");
    ASSERT_TRUE(showsScene("other.gltf")) << state();
    EXPECT_EQ(state().at("objects"), 2);  // another scene starts with all objects visible
}

TEST_F(ViewTools, savedViewsComeBackInTheNextRun) {
    openTall({"--fstop", "2"});
    const json before = state().at("cameraPosition");
    ASSERT_TRUE(unfolds("Views", "save view")) << state();
    const json button = state().at("places").at("save view");
    const auto types = [&] { click(button.at(0).get<int>() - 120, button.at(1)); };
    ASSERT_TRUE(insists(types, [](const json& s) { return s.at("typing") == true; })) << state();
    act("type --delay 30 wide");
    ASSERT_TRUE(clicks("save view", [](const json& s) { return s.at("views") == 1; })) << state();
    inTurn({"mousemove 100 200", "click 4 click 4", "key bracketright"});
    ASSERT_TRUE(reaches([&](const json& s) { return s.at("cameraPosition") != before && s.at("fStop") != 2.0; }))
        << state();
    key("ctrl+q");
    ASSERT_EQ(ended(), 0);
    fs::remove(folder() / "state.json");
    openTall({"--fstop", "8", "--camera-position", "1,2,3"});
    ASSERT_EQ(state().at("views"), 1);
    ASSERT_TRUE(unfolds("Views", "view wide")) << state();
    EXPECT_TRUE(clicks("view wide", [&](const json& s) {
        return s.at("cameraPosition") == before && s.at("fStop") == 2.0;
    })) << state();
}

TEST_F(ViewTools, theMeterExposesWhereTheViewRests) {
    openTall({"--exposure", "3"});
    EXPECT_EQ(state().at("exposure"), 3);
    ASSERT_TRUE(foldsFocusAndLens()) << state();
    ASSERT_TRUE(unfolds("Image", "auto-exposure")) << state();
    ASSERT_TRUE(clicks("auto-exposure", [](const json& s) { return s.at("exposure") != 3; })) << state();
    const double metered = reached().at("exposure");
    key("ctrl+z");
    EXPECT_TRUE(reaches([](const json& s) { return s.at("exposure") == 3; })) << state();
    key("ctrl+shift+z");
    EXPECT_TRUE(reaches([&](const json& s) { return s.at("exposure") == metered; })) << state();
}

TEST_F(ViewTools, theWheelOverTheApertureRingTurnsIt) {
    openTall({"--fstop", "2.8"});
    ASSERT_TRUE(clicks("Focus", [](const json& s) { return s.at("places").contains("aperture ring"); })) << state();
    const json ring = state().at("places").at("aperture ring");
    act(fmt::format("mousemove {} {}", ring.at(0).get<int>(), ring.at(1).get<int>()));
    act("click 5");
    ASSERT_TRUE(reaches([](const json& s) { return s.at("fStop") == 3.2; })) << state();
    act("click 4 click 4");
    ASSERT_TRUE(reaches([](const json& s) { return s.at("fStop") == 2.5; })) << state();
    EXPECT_EQ(state().at("places").at("aperture ring"), ring);  // the panel keeps its scroll position
}

}  // namespace
}  // namespace defocus::engine
