// Tools around the picture: undo, dialogs, the scene tree, saved views, full screen.

#include <fmt/format.h>

#include <cmath>

#include "cli/two_quads.h"
#include "image/image_io.h"
#include "view/view_program.h"

namespace defocus::engine {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class ViewTools : public ViewProgram {
protected:
    // Opens a picture of 400 × 300 px with two squares: "Near" at 2 m around (200, 67), "Far" at 8 m around (360, 150).
    void openTwoQuads(std::vector<std::string> more = {}) { openScene("400x300", std::move(more)); }
    // The same picture in a window tall enough for most of the panel.
    void openTall(std::vector<std::string> more = {}) { openScene("400x700", std::move(more)); }
    void openScene(const std::string& size, std::vector<std::string> more) {
        writeTwoQuads(folder() / "quads.gltf");
        more.insert(more.begin(), {"quads.gltf", "--size", size});
        startWithPath((folder() / "bin").string(), more);
        const auto shown = [](const json& s) {
            return s.at("scene") == "quads.gltf" && s.at("samples") > 0 && s.at("places").contains("open path");
        };
        ASSERT_TRUE(reaches(shown)) << textOf("stderr");
    }
    // Starts the window with a PATH that has only the desktop programs that the test creates.
    void startWithPath(const std::string& path, const std::vector<std::string>& arguments) {
        const std::string before = std::getenv("PATH");
        ::setenv("PATH", path.c_str(), 1);
        start(arguments);
        ::setenv("PATH", before.c_str(), 1);
    }
    // Clicks on a widget, once the state contains its position, until `condition` holds.
    [[nodiscard]] bool clicks(const std::string& place, const std::function<bool(const json&)>& condition) const {
        if (!reaches([&](const json& s) { return s.at("places").contains(place); })) return false;
        const auto hand = [&] {
            const json places = state().at("places");
            if (places.contains(place)) click(places.at(place).at(0), places.at(place).at(1));
        };
        return insists(hand, condition);
    }
    // Opens a section of the panel.
    [[nodiscard]] bool unfolds(const std::string& section, const std::string& inside) const {
        return clicks(section, [&](const json& s) { return s.at("places").contains(inside); });
    }
    // Collapses the focus and lens sections to make room for those below.
    [[nodiscard]] bool foldsFocusAndLens() const {
        return clicks("Focus", [](const json& s) { return s.at("places").contains("aperture ring"); }) &&
               clicks("Lens", [](const json& s) { return s.at("places").contains("Image"); });
    }
    // Presses a key until `condition` holds.
    [[nodiscard]] bool presses(const std::string& name, const std::function<bool(const json&)>& condition) const {
        return insists([&] { key(name); }, condition);
    }
    [[nodiscard]] bool asks(const std::string& dialog) const {
        return reaches([&](const json& s) { return s.at("dialog") == dialog; });
    }
    [[nodiscard]] bool typesPath(const std::string& path) const {
        return insists(
            [&] {
                key("ctrl+a");
                act("type --delay 30 " + path);
            },
            [&](const json& s) { return s.at("exportPath") == path; });
    }
};

TEST_F(ViewTools, movingViewsAreDrawnAtHalfSizeOrLarger) {
    openTwoQuads({"--fstop", "1.4", "--focus-distance", "4"});
    act("mousemove 100 200 keydown d");
    ASSERT_TRUE(reaches([](const json& s) { return s.at("moving") == true && s.at("changes") > 5; })) << state();
    EXPECT_GE(reached().at("drawn").at(0), 200);
    act("keyup d");
}

TEST_F(ViewTools, whereNothingIsBlurredOneSampleOfEachPixelIsDrawn) {
    openTwoQuads({"--fstop", "64", "--blur-scale", "0.001"});
    act("mousemove 100 200 keydown d");
    ASSERT_TRUE(reaches([](const json& s) { return s.at("moving") == true && s.at("changes") > 5; })) << state();
    EXPECT_EQ(reached().at("drawn"), (json{400, 300, 1}));
    act("keyup d");
}

TEST_F(ViewTools, aPictureThatRestsSaysWhatIsOddAboutIt) {
    openTwoQuads({"--fstop", "64", "--blur-scale", "0.001"});
    const auto says = [](const json& s) { return s.at("warnings").size() == 1; };
    ASSERT_TRUE(reaches(says)) << state();
    EXPECT_EQ(reached().at("warnings").at(0).get<std::string>().find("nothing is blurred"), 0u) << reached();
}

TEST_F(ViewTools, aPictureThatIsAllWhiteSaysWhichExposureHelps) {
    openTwoQuads({"--fstop", "1.4", "--focus-distance", "4", "--exposure", "12"});
    ASSERT_TRUE(reaches([](const json& s) { return s.at("warnings").size() == 1; })) << state();
    EXPECT_NE(reached().at("warnings").at(0).get<std::string>().find("is white at an exposure of 12 EV"),
              std::string::npos)
        << reached();
}

TEST_F(ViewTools, aPictureAsItShouldBeSaysNothing) {
    openTwoQuads({"--fstop", "1.4", "--focus-distance", "4"});
    ASSERT_TRUE(reaches([](const json& s) { return s.at("moving") == false && s.at("samples") > 1; })) << state();
    EXPECT_TRUE(reached().at("warnings").empty()) << reached();
}

TEST_F(ViewTools, lightsGetASizeAndTheirOwnBack) {
    openTall({"--shadows", "on"});
    const auto isSized = [](const json& s) {
        return s.at("command").get<std::string>().find("--light-angle 5 ") != std::string::npos;
    };
    ASSERT_TRUE(foldsFocusAndLens()) << state();
    ASSERT_TRUE(unfolds("Surroundings", "lightAngle")) << state();
    ASSERT_FALSE(isSized(state()));
    const std::uint64_t before = state().at("changes");
    ASSERT_TRUE(clicks("lightAngle", isSized)) << state();
    EXPECT_TRUE(reaches([&](const json& s) { return s.at("changes") > before; })) << state();  // the picture is redrawn
    key("ctrl+z");
    EXPECT_TRUE(reaches([&](const json& s) { return !isSized(s); })) << state();
}

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
    key("ctrl+z");  // a reset is an undo step
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

TEST_F(ViewTools, theDesktopsDialogIsAskedWhereThereIsOne) {
    writeTwoQuads(folder() / "other.gltf");
    fs::create_directory(folder() / "bin");
    const fs::path zenity = folder() / "bin" / "zenity";
    std::ofstream(zenity) << "#!/bin/sh\n: > asked\nwhile [ ! -e answer ]; do /bin/sleep 0.05; done\necho '"
                          << (folder() / "other.gltf").string() << "'\n";
    fs::permissions(zenity, fs::perms::owner_all);
    openTwoQuads();
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
    openTwoQuads();
    EXPECT_TRUE(presses("ctrl+o", [](const json& s) { return s.at("dialog") == "open"; })) << state();
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

TEST_F(ViewTools, anExportShowsItsProgressAndCanBeCancelled) {
    openTwoQuads({"--samples", "65536", "--fstop", "0.5", "--focus-distance", "4"});
    ASSERT_TRUE(presses("ctrl+e", [](const json& s) { return s.at("dialog") == "export"; })) << state();
    ASSERT_TRUE(presses("Return", [](const json& s) { return s.at("exporting") == true; })) << state();
    ASSERT_TRUE(reaches([](const json& s) { return s.at("exportShare") > 0; })) << state();
    EXPECT_TRUE(presses("Escape", [](const json& s) { return s.at("exporting") == false; })) << state();
    EXPECT_FALSE(fs::exists(folder() / "still.png"));
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
    click(200, 67);  // a hidden object cannot be clicked
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

TEST_F(ViewTools, selectingInTheTreeShowsTheMaterial) {
    openTwoQuads();
    ASSERT_TRUE(unfolds("Objects", "node Far")) << state();
    EXPECT_TRUE(clicks("node Far", [](const json& s) { return s.at("selected") == "Far"; })) << state();
}

TEST_F(ViewTools, f11CoversTheScreenAndGoesBack) {
    openTwoQuads();
    ASSERT_TRUE(presses("F11", [](const json& s) {
        return s.at("fullscreen") == true && s.at("picture").at(3) == 800;
    })) << state();
    EXPECT_EQ(reached().at("picture").at(2), 1280 - 364);
    EXPECT_TRUE(presses("F11", [](const json& s) {
        return s.at("fullscreen") == false && s.at("picture").at(3) == 300;
    })) << state();
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

TEST_F(ViewTools, extensionsThatAreIgnoredAreListed) {
    writeTwoQuads(folder() / "quads.gltf");
    std::ifstream file(folder() / "quads.gltf");
    json document = json::parse(file);
    document["extensionsUsed"] = {"KHR_materials_iridescence"};
    std::ofstream(folder() / "shiny.gltf") << document;
    start({"shiny.gltf", "--size", "400x700"});
    ASSERT_TRUE(showsScene("shiny.gltf")) << textOf("stderr");
    EXPECT_TRUE(reaches([](const json& s) { return s.at("places").contains("ignored"); })) << state();
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

// All input arrives within one frame of a slow machine.
TEST_F(ViewTools, aHandThatIsFasterThanTheFramesLosesNothing) {
    openTwoQuads();
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
