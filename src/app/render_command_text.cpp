#include "app/render_command_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "lens/lens_fields.h"
#include "lens/sequences.h"

namespace defocus {

namespace {

void add(std::string& command, std::string_view option, const std::string& value) {
    command += fmt::format(" {} {}", option, shellWord(value));
}

std::string pointText(const glm::dvec3& point) {
    return fmt::format("{},{},{}", point.x, point.y, point.z);
}

void addScene(std::string& command, const SceneOptions& options) {
    const SceneOptions standard;
    if (!options.path.empty()) command += " " + shellWord(options.path.string());
    if (options.fishCount != standard.fishCount) add(command, "--fish", fmt::format("{}", options.fishCount));
    if (options.trianglesPerFish != standard.trianglesPerFish)
        add(command, "--fish-triangles", fmt::format("{}", options.trianglesPerFish));
    if (!options.clip.empty()) add(command, "--clip", options.clip);
    if (options.loop) command += " --loop";
    if (options.time != 0) command += fmt::format(" --time={}", options.time);
    if (!options.environment.empty()) add(command, "--environment", options.environment.string());
    if (options.background == Background::none) add(command, "--background", "none");
    if (options.background == Background::uniform) {
        const glm::vec3& color = options.backgroundColor;
        add(command, "--background", fmt::format("{},{},{}", color.r, color.g, color.b));
    }
}

void addCamera(std::string& command, const RenderCommandText& text) {
    if (!text.options.camera.empty()) add(command, "--camera", text.options.camera);
    add(command, "--size", fmt::format("{}x{}", text.view.width, text.view.height));
    // With '=': a value that begins with a minus is no option.
    const glm::dmat4& camera = text.view.worldFromCamera;
    const glm::dvec3 position(camera[3]);
    const glm::dvec3 ahead = -text.pivotDistance * glm::dvec3(camera[2]);
    command += " --camera-position=" + pointText(position) + " --camera-target=" + pointText(position + ahead);
    const bool rolled = std::abs(camera[0].y) > 1e-9 || camera[1].y < 0;
    if (rolled) command += " --camera-up=" + pointText(glm::dvec3(camera[1]));
}

void addLens(std::string& command, const RenderCommandText& text) {
    for (const LensField& field : lensFields()) {
        const double value = lensFieldValue(text.view.lens, field);
        const std::string_view name = field.name;
        const bool always = name == "focalLength" || name == "focusDistance";  // else they follow from the scene
        if (value == lensFieldValue(text.frame.cameraLens, field) && !always) continue;
        if (std::holds_alternative<bool Lens::*>(field.member)) {
            const bool standard = lensFieldValue(Lens{}, field) != 0;
            const std::string option = field.option;
            if ((value != 0) != standard) command += " " + (standard ? "--no-" + option.substr(2) : option);
        } else {
            command += fmt::format(" {}={}", field.option, std::min(value, field.most));
        }
    }
    const SceneOptions& options = text.options;
    if (!options.apertureImage.empty()) add(command, "--aperture-image", options.apertureImage.string());
    for (const auto& [name, scale] : options.nodeBlur) add(command, "--node-blur", fmt::format("{}={}", name, scale));
    if (options.cocTolerance != SceneOptions{}.cocTolerance)
        add(command, "--coc-tolerance", fmt::format("{}", options.cocTolerance));
}

void addSettings(std::string& command, const RenderCommandText& text) {
    const SceneOptions& options = text.options;
    const SceneOptions standard;
    add(command, "--samples", fmt::format("{}", options.samples));
    if (options.sequence != standard.sequence) add(command, "--sequence", std::string(sequenceName(options.sequence)));
    if (options.seed != 0) add(command, "--seed", fmt::format("{}", options.seed));
    if (options.lod != standard.lod) add(command, "--lod", lodModeName(options.lod));
    if (options.metric != standard.metric) add(command, "--lod-metric", "error");
    if (options.lodCocAtCentre) add(command, "--lod-coc", "centre");
    if (options.blurThreshold) add(command, "--blur-threshold", fmt::format("{}", *options.blurThreshold));
    if (options.sizeThreshold) add(command, "--size-threshold", fmt::format("{}", *options.sizeThreshold));
    const MethodUse use = chosenMethod(options);
    if (use.text() != standard.method) add(command, "--method", use.text());
    const bool ofLens = text.view.lens.exposureTime > 0;
    if (text.write.exposure != 0 && !ofLens) command += fmt::format(" --exposure={}", text.write.exposure);
    if (text.write.toneMap != ToneMap::none)
        add(command, "--tonemap", text.write.toneMap == ToneMap::aces ? "aces" : "agx");
}

}  // namespace

std::string shellWord(const std::string& word) {
    const auto plain = [](char letter) {
        return std::isalnum(static_cast<unsigned char>(letter)) != 0 ||
               std::string_view("_-./,:=+@%").find(letter) != std::string_view::npos;
    };
    if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
    std::string quoted = "'";
    for (const char letter : word) quoted += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
    return quoted + "'";
}

std::string renderCommand(const RenderCommandText& text) {
    std::string command = "defocus render";
    addScene(command, text.options);
    add(command, "-o", text.output);
    addCamera(command, text);
    addLens(command, text);
    addSettings(command, text);
    return command;
}

}  // namespace defocus
