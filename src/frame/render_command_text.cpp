#include "frame/render_command_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "lens/lens_fields.h"
#include "lens/sequences.h"

namespace defocus {

namespace {

// With '=' where the value would be taken for an option.
void add(std::string& command, std::string_view option, const std::string& value) {
    command += fmt::format(" {}{}{}", option, value.starts_with('-') ? '=' : ' ', shellWord(value));
}

void addPath(std::string& command, std::string_view option, const std::filesystem::path& path) {
    command += fmt::format(" {}{}", option, option.empty() ? "" : " ");
    const std::string text = path.string();
    command += shellWord(text.starts_with('-') ? "./" + text : text);
}

std::string pointText(const glm::dvec3& point) {
    return fmt::format("{},{},{}", point.x, point.y, point.z);
}

void addShutterWords(std::string& command, const ShutterSettings& shutter) {
    const ShutterSettings standard;
    if (shutter.seconds != standard.seconds) add(command, "--shutter", fmt::format("{}", shutter.seconds));
    if (shutter.position != standard.position)
        add(command, "--shutter-position", shutter.position == ShutterPosition::start ? "start" : "end");
    if (shutter.exactMotion) add(command, "--motion-segments", "exact");
    if (!shutter.exactMotion && shutter.motionSegments != standard.motionSegments)
        add(command, "--motion-segments", fmt::format("{}", shutter.motionSegments));
}

void addScene(std::string& command, const SceneOptions& options) {
    const SceneOptions standard;
    if (!options.path.empty()) addPath(command, "", options.path);
    if (options.fishCount != standard.fishCount) add(command, "--fish", fmt::format("{}", options.fishCount));
    if (options.trianglesPerFish != standard.trianglesPerFish)
        add(command, "--fish-triangles", fmt::format("{}", options.trianglesPerFish));
    if (!options.clip.empty()) add(command, "--clip", options.clip);
    if (options.loop) command += " --loop";
    if (options.time != 0) command += fmt::format(" --time={}", options.time);
    addShutterWords(command, options.shutter);
    if (!options.environment.empty()) addPath(command, "--environment", options.environment);
    if (options.background == Background::none) add(command, "--background", "none");
    if (options.background == Background::uniform) {
        const glm::vec3& color = options.backgroundColor;
        add(command, "--background", fmt::format("{},{},{}", color.r, color.g, color.b));
    }
}

void addCamera(std::string& command, const RenderCommandText& text) {
    if (!text.options.camera.empty()) add(command, "--camera", text.options.camera);
    add(command, "--size", fmt::format("{}x{}", text.view.width, text.view.height));
    if (!text.view.shutterCameras.empty()) return;  // the file's, moving as only the file can say
    const glm::dmat4& camera = text.view.worldFromCamera;
    const glm::dvec3 position(camera[3]);
    const glm::dvec3 ahead = -text.pivotDistance * glm::dvec3(camera[2]);
    command += " --camera-position=" + pointText(position) + " --camera-target=" + pointText(position + ahead);
    const bool rolled = std::abs(camera[0].y) > 1e-9 || camera[1].y < 1e-6;  // or looking straight up or down
    if (rolled) command += " --camera-up=" + pointText(glm::dvec3(camera[1]));
}

// Brightness: by the lens, or by an exposure value, which exclude each other.
bool exposedByLens(const RenderCommandText& text) {
    return text.view.lens.exposureTime > 0;
}

void addLensField(std::string& command, const LensField& field, double value) {
    const std::string_view option = field.option;
    if (std::holds_alternative<bool Lens::*>(field.member))
        command += fmt::format(" --{}{}", value != 0 ? "" : "no-", option.substr(2));
    else
        command += fmt::format(" {}={}", option, std::min(value, field.most));
}

void addLens(std::string& command, const RenderCommandText& text) {
    for (const LensField& field : lensFields()) {
        const double value = lensFieldValue(text.view.lens, field);
        const std::string_view name = field.name;
        const bool always = name == "focalLength" || name == "focusDistance";  // else they follow from the scene
        const bool brightness = name == "exposureTime" || name == "iso";
        if (brightness && !exposedByLens(text)) continue;
        if (always || value != lensFieldValue(text.frame.cameraLens, field)) addLensField(command, field, value);
    }
}

// What is no field of a lens.
void addBlur(std::string& command, const SceneOptions& options) {
    if (!options.apertureImage.empty()) addPath(command, "--aperture-image", options.apertureImage);
    for (const auto& [name, scale] : options.nodeBlur) add(command, "--node-blur", fmt::format("{}={}", name, scale));
    if (options.cocTolerance != SceneOptions{}.cocTolerance)
        add(command, "--coc-tolerance", fmt::format("{}", options.cocTolerance));
}

void addRunning(std::string& command, const SceneOptions& options) {
    if (options.lodCocAtCentre) add(command, "--lod-coc", "centre");
    if (options.keepAll) command += " --keep-all";
    if (!options.cacheFolder.empty()) addPath(command, "--cache-dir", options.cacheFolder);
    if (options.noCache) command += " --no-cache";
    if (options.wave != SceneOptions{}.wave) add(command, "--wave", fmt::format("{}", options.wave));
}

void addSettings(std::string& command, const RenderCommandText& text) {
    const SceneOptions& options = text.options;
    const SceneOptions standard;
    add(command, "--samples", fmt::format("{}", options.samples));
    if (options.sequence != standard.sequence) add(command, "--sequence", std::string(sequenceName(options.sequence)));
    if (options.seed != 0) add(command, "--seed", fmt::format("{}", options.seed));
    if (options.lod != standard.lod) add(command, "--lod", lodModeName(options.lod));
    if (options.metric != standard.metric) add(command, "--lod-metric", "error");
    if (options.blurThreshold) add(command, "--blur-threshold", fmt::format("{}", *options.blurThreshold));
    if (options.sizeThreshold) add(command, "--size-threshold", fmt::format("{}", *options.sizeThreshold));
    const MethodUse use = chosenMethod(options);
    if (use.text() != standard.method) add(command, "--method", use.text());
    if (options.layerFormat != standard.layerFormat)
        add(command, "--layer-format", std::string(layerFormatName(options.layerFormat)));
    addRunning(command, options);
    const bool cameraExposes = text.frame.cameraLens.exposureTime > 0;
    if (!exposedByLens(text) && (text.write.exposure != 0 || cameraExposes))
        command += fmt::format(" --exposure={}", text.write.exposure);
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

std::string captureCommand(const std::filesystem::path& shot, const SceneOptions& options) {
    std::string command = "defocus capture";
    addPath(command, "", shot);
    addBlur(command, options);
    addRunning(command, options);
    return command;
}

std::string renderCommand(const RenderCommandText& text) {
    std::string command = "defocus render";
    addScene(command, text.options);
    addPath(command, "-o", text.output);
    addCamera(command, text);
    addLens(command, text);
    addBlur(command, text.options);
    addSettings(command, text);
    return command;
}

}  // namespace defocus
