#pragma once
// Fixtures that open a scene of two squares in the viewer, and functions that simulate the user.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "cli/two_quads.h"
#include "view/view_program.h"

namespace defocus::engine {

// Fixture of a window with the rendered image at the left and the panel at the right.
class SessionWindow : public ViewProgram {
protected:
    // Opens an image of 400 × 300 px with two squares: "Near", 2 m from the camera, centred on pixel (200, 67), and
    // "Far", 8 m from the camera, centred on pixel (360, 150).
    void openTwoQuads(std::vector<std::string> more = {}) { openScene("400x300", std::move(more)); }
    // Opens the same scene in an image of 260 × 195 px: "Near" is centred on (130, 44), "Far" on (234, 98).
    void openSmall(std::vector<std::string> more = {}) { openScene("260x195", std::move(more)); }
    void openScene(const std::string& size, std::vector<std::string> more) {
        writeTwoQuads(folder() / "quads.gltf");
        more.insert(more.begin(), {"quads.gltf", "--size", size});
        start(more);
        ASSERT_TRUE(showsScene("quads.gltf")) << textOf("stderr");
    }
    bool focusesAt(double distance) const {
        return reaches([&](const nlohmann::json& s) {
            return s.at("focusDistance").is_number() && std::abs(s.at("focusDistance").get<double>() - distance) < 1e-6;
        });
    }
    double number(const char* name) const { return state().at(name).get<double>(); }
    // Switches between the dark and the light theme. Once the state shows the switch, earlier input has been processed.
    // Returns true once the image no longer changes.
    bool comesToRest() const {
        const bool dark = state().at("dark").get<bool>();
        key("t");
        return reaches([&](const nlohmann::json& s) {
            return s.at("dark") != dark && s.at("moving") == false && s.at("samples") > 130;
        });
    }
    // Opens the export dialog and accepts the proposed name.
    void exportByHand() const {
        const auto asks = [](const nlohmann::json& s) { return s.at("dialog") == "export"; };
        ASSERT_TRUE(insists([&] { key("ctrl+e"); }, asks)) << state();
        const auto goesOn = [](const nlohmann::json& s) { return s.at("dialog") == ""; };
        ASSERT_TRUE(insists([&] { key("Return"); }, goesOn)) << state();
    }
    // Types a path into the panel's first row and confirms it.
    void openByHand(const std::string& path) const {
        const auto isReady = [](const nlohmann::json& s) { return s.at("places").contains("open path"); };
        ASSERT_TRUE(reaches(isReady)) << state();
        const nlohmann::json field = reached().at("places").at("open path");
        ASSERT_TRUE(insists([&] { click(field.at(0), field.at(1)); },
                            [](const nlohmann::json& s) { return s.at("typing") == true; }))
            << state();
        const auto typed = [&](const nlohmann::json& s) { return s.at("openPath") == path; };
        const auto type = [&] {
            key("ctrl+a");
            act("type --delay 30 " + path);
        };
        ASSERT_TRUE(insists(type, typed)) << state();
        ASSERT_TRUE(insists([&] { key("Return"); }, [](const nlohmann::json& s) { return s.at("typing") == false; }))
            << state();
    }
};

// Fixture of a viewer whose PATH contains no desktop programs, such as file dialogs.
class ViewTools : public ViewProgram {
protected:
    // Opens an image of 400 × 300 px with two squares: "Near", 2 m from the camera, centred on pixel (200, 67), and
    // "Far", 8 m from the camera, centred on pixel (360, 150).
    void openTwoQuads(std::vector<std::string> more = {}) { openScene("400x300", std::move(more)); }
    // Opens the scene of two squares in an image of 260 px width, which is drawn faster.
    void openNarrow(int height, std::vector<std::string> more = {}) {
        openScene("260x" + std::to_string(height), std::move(more));
    }
    // Like openNarrow(), but without depth of field. The image soon comes to rest and the window then draws nothing.
    void openSharp(int height, std::vector<std::string> more = {}) {
        more.emplace_back("--no-dof");
        openNarrow(height, std::move(more));
    }
    // Opens the scene of two squares in a window that is tall enough for most of the panel.
    void openTall(std::vector<std::string> more = {}) { openScene("400x700", std::move(more)); }
    void openScene(const std::string& size, std::vector<std::string> more) {
        writeTwoQuads(folder() / "quads.gltf");
        more.insert(more.begin(), {"quads.gltf", "--size", size});
        startWithPath((folder() / "bin").string(), more);
        const auto shown = [](const nlohmann::json& s) {
            return s.at("scene") == "quads.gltf" && s.at("samples") > 0 && s.at("places").contains("open path");
        };
        ASSERT_TRUE(reaches(shown)) << textOf("stderr");
    }
    // Starts the viewer with a PATH that contains only the desktop programs that the test creates.
    void startWithPath(const std::string& path, const std::vector<std::string>& arguments) {
        const std::string before = std::getenv("PATH");
        ::setenv("PATH", path.c_str(), 1);
        start(arguments);
        ::setenv("PATH", before.c_str(), 1);
    }
    // Waits until the state that the window reports contains the widget's position, then clicks on the widget until
    // `condition` holds.
    [[nodiscard]] bool clicks(const std::string& place,
                              const std::function<bool(const nlohmann::json&)>& condition) const {
        if (!reaches([&](const nlohmann::json& s) { return s.at("places").contains(place); })) return false;
        const auto hand = [&] {
            const nlohmann::json places = state().at("places");
            if (places.contains(place)) click(places.at(place).at(0), places.at(place).at(1));
        };
        return insists(hand, condition);
    }
    // Opens a section of the panel. Returns whether the widget `inside` of this section then appears.
    [[nodiscard]] bool unfolds(const std::string& section, const std::string& inside) const {
        return clicks(section, [&](const nlohmann::json& s) { return s.at("places").contains(inside); });
    }
    // Collapses the focus and lens sections to make room for the sections below.
    [[nodiscard]] bool foldsFocusAndLens() const {
        return clicks("Focus", [](const nlohmann::json& s) { return s.at("places").contains("aperture ring"); }) &&
               clicks("Lens", [](const nlohmann::json& s) { return s.at("places").contains("Image"); });
    }
    // Presses a key until `condition` holds.
    [[nodiscard]] bool presses(const std::string& name,
                               const std::function<bool(const nlohmann::json&)>& condition) const {
        return insists([&] { key(name); }, condition);
    }
    [[nodiscard]] bool asks(const std::string& dialog) const {
        return reaches([&](const nlohmann::json& s) { return s.at("dialog") == dialog; });
    }
    [[nodiscard]] bool typesPath(const std::string& path) const {
        return insists(
            [&] {
                key("ctrl+a");
                act("type --delay 30 " + path);
            },
            [&](const nlohmann::json& s) { return s.at("exportPath") == path; });
    }
};

}  // namespace defocus::engine
