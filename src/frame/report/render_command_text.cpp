#include "frame/report/render_command_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "frame/program_facts.h"
#include "frame/settings/settings.h"
#include "lens/lens_fields.h"

namespace defocus::engine {

namespace {

// Appends an option and its value to the command, joined by '=' if the value begins with '-'.
void addWords(std::string& command, std::string_view option, const std::string& value) {
    command += fmt::format(" {}{}{}", option, value.starts_with('-') ? '=' : ' ', shellWord(value));
}

std::string pathWord(const std::string& path) {
    return shellWord(path.starts_with('-') ? fmt::format("./{}", path) : path);
}

void addSetting(std::string& command, const Setting& setting, const Request& request) {
    const std::optional<std::string> text = setting.text(request);
    if (!text) return;
    if (setting.repeated) {
        for (const std::string& each : setting.texts(request)) addWords(command, setting.option, each);
    } else if (setting.kind == SettingKind::boolean) {
        if (*text == "true")
            command += fmt::format(" {}", setting.option);
        else if (setting.lensField)
            command += fmt::format(" --no-{}", setting.option.substr(2));
    } else if (setting.kind == SettingKind::path) {
        command += fmt::format(" {}{}", setting.option.starts_with('-') ? setting.option + " " : "", pathWord(*text));
    } else {
        addWords(command, setting.option, *text);
    }
}

// Sets the request's camera to the camera of the view. Does nothing for a camera that moves during the exposure,
// because options cannot describe such a movement.
void placeCameraOf(const RenderCommandText& text, Request& request) {
    if (!text.view.shutterCameras.empty()) return;
    const glm::dmat4& camera = text.view.worldFromCamera;
    const glm::dvec3 position(camera[3]);
    request.cameraPosition = asArray(position);
    request.cameraTarget = asArray(position - text.pivotDistance * glm::dvec3(camera[2]));
    // The camera is rolled, or it looks straight up or down.
    const bool rolled = std::abs(camera[0].y) > 1e-9 || camera[1].y < 1e-6;
    request.cameraUp.reset();
    if (rolled) request.cameraUp = asArray(camera[1]);
}

// Returns the lens values of the view that differ from the lens values of the scene's camera. The focal length is
// always included, because its default depends on the scene. The focus distance is left out.
LensSettings lensOf(const RenderCommandText& text) {
    const Lens& lens = text.view.lens;
    LensSettings given;
    given.apertureImage = text.options.lens.apertureImage;
    for (const LensField& field : lensFields()) {
        const double value = lensFieldValue(lens, field);
        const std::string_view name = field.name;
        const bool brightness = name == "exposureTime" || name == "iso";
        if (brightness && !(lens.exposureTime > 0)) continue;
        if (name == "focusDistance") continue;
        if (name == "focalLength" || value != lensFieldValue(text.frame.cameraLens, field))
            giveLensValue(given, field, std::min(value, field.max));
    }
    return given;
}

// Returns the request that makes `defocus render` reproduce the image that the view shows.
Request requestOf(const RenderCommandText& text) {
    Request request = text.options;
    request.size = {text.view.width, text.view.height};
    placeCameraOf(text, request);
    request.lens = lensOf(text);
    request.focus = FocusDistance{std::min(text.view.lens.focusDistance, lensFieldNamed("focusDistance")->max)};
    const double metresPerUnit = text.frame.scene->metresPerUnit;
    if (metresPerUnit != 1) request.units = metresPerUnit;  // without --units, `render` may guess another unit
    request.toneMap = text.write.toneMap;
    // Write either the lens's exposure time or an exposure value, because the options exclude each other.
    request.exposure = DefaultExposure{};
    const bool byLens = text.view.lens.exposureTime > 0;
    const bool meters = !text.frame.scene->school && !text.frame.scene->lights.empty();
    if (!byLens && (text.write.exposure != 0 || text.frame.cameraLens.exposureTime > 0 || meters))
        request.exposure = ExposureValue{text.write.exposure};
    return request;
}

}  // namespace

std::string captureCommand(const std::filesystem::path& shot, const Request& options) {
    std::string command = "defocus capture " + pathWord(shot.string());
    for (const Setting& setting : settings()) {
        const bool keyed = setting.group == SettingGroup::camera || setting.name.starts_with("focus");
        if (setting.shotPlace.empty() && !keyed && changedText(setting, options)) addSetting(command, setting, options);
    }
    return command;
}

std::string renderCommand(const RenderCommandText& text) {
    const Request request = requestOf(text);
    // Leave out options whose values the preset already sets.
    const Setting& preset = *settingNamed("preset");
    const std::optional<std::string> presetName = preset.text(request);
    Request defaults;
    if (presetName) preset.set(defaults, *presetName);
    std::string command = "defocus render";
    if (!request.scene.empty()) command += fmt::format(" {}", pathWord(request.scene.string()));
    command += fmt::format(" -o {}", pathWord(text.output));
    for (const Setting& setting : settings()) {
        if (setting.name == "scene") continue;
        const bool always = setting.name == "size" || (setting.name == "samples" && request.samples);
        const bool changed = setting.name == preset.name || setting.text(request) != setting.text(defaults);
        if (always || changed) addSetting(command, setting, request);
    }
    return command;
}

}  // namespace defocus::engine
