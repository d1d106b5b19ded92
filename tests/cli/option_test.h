#pragma once
// Runs command lines and returns their results without the parts that differ from run to run, such as times.

#include <nlohmann/json.hpp>
#include <regex>

#include "cli/gl_program.h"
#include "cli/option_cases.h"

namespace defocus::engine {

// Returns the JSON value without times and without values derived from times.
inline nlohmann::json withoutTimes(const nlohmann::json& value) {
    using nlohmann::json;
    if (value.is_array()) {
        json rest = json::array();
        for (const json& each : value) rest.push_back(withoutTimes(each));
        return rest;
    }
    if (!value.is_object()) return value;
    json rest = json::object();
    for (const auto& [key, each] : value.items())
        if (!key.ends_with("illiseconds") && !key.ends_with("Seconds") && key != "speedUp" && !key.starts_with("front"))
            rest[key] = withoutTimes(each);
    return rest;
}

// Returns the pixels of an image as bytes, or "no picture" for a file with only part of the samples, which only `merge`
// reads.
inline std::string pixelsIn(const std::filesystem::path& path) try {
    const Image image = readImage(path);
    std::string text = std::to_string(image.width) + " ";
    return text.append(reinterpret_cast<const char*>(image.pixels.data()), image.pixels.size() * sizeof(float));
} catch (const Error&) {
    return "no picture";
}

inline nlohmann::json jsonIn(const std::filesystem::path& path) {
    std::ifstream file(path);
    return nlohmann::json::parse(file);
}

// Runs command lines in a folder with ball.glb, lamp.glb, pane.glb, sky.hdr, half.png, four shots of one frame and two
// shots of three frames.
class OptionTest : public GlProgramTest {
protected:
    void SetUp() override {
        GlProgramTest::SetUp();
        writeOptionScene(folder());
        using nlohmann::json;
        write("ball.json", {{"scene", "ball.glb"}, {"range", {0, 0}}, {"size", {48, 36}}});
        write("lamp.json", {{"scene", "lamp.glb"}, {"range", {0, 0}}, {"size", {48, 36}}});
        write("pane.json", {{"scene", "pane.glb"}, {"range", {0, 0}}, {"size", {48, 36}}});
        write("fish.json", {{"fish", {{"count", 1}, {"triangles", 900}}}, {"range", {0, 0}}, {"size", {48, 36}}});
        json shot = {{"scene", "ball.glb"}, {"range", {0, 2}}, {"size", {16, 12}}, {"samples", 2}, {"frameRate", 8}};
        shot["focus"] = {{"distance", 1}};
        shot["lens"] = {{"fStop", 0.5}};
        write("shot.json", shot);
        shot["lens"] = {{"fStop", 2}};
        write("other.json", shot);
    }

    void write(const std::string& name, const nlohmann::json& document) const {
        std::ofstream(folder() / name) << document.dump();
    }
};

inline std::string shownLine(const Words& line) {
    std::string text = "defocus";
    for (const std::string& word : line) text += " " + word;
    return text;
}

// Replaces the characters that GoogleTest does not allow in names.
inline std::string lettersOf(std::string text) {
    std::erase_if(text, [](unsigned char letter) { return std::isalnum(letter) == 0; });
    return text;
}

}  // namespace defocus::engine
