// Draws the panel sections for rendering: environment, level of detail, method.

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cctype>

#include "frame/settings/presets.h"
#include "lod/pyramid/level_selection.h"
#include "scene/built_in_environment.h"
#include "view/panels/panels.h"
#include "view/widgets/rows.h"
#include "view/widgets/widgets.h"

namespace defocus::engine {

namespace {

// Draws the rows that set the environment map: the scene's own, a built-in one, or a file.
void environmentRows(ViewState& state) {
    std::filesystem::path& environment = state.options.environment;
    std::vector<std::string> names = {"the scene's own"};
    for (const std::string_view name : builtInEnvironments()) names.emplace_back(name);
    names.emplace_back("a file");
    const bool isFile = !environment.empty() && !isBuiltInEnvironment(environment.string());
    std::string chosen = state.environmentIsFile || isFile ? names.back()
                         : environment.empty()             ? names.front()
                                                           : environment.string();
    rowLabel("Environment", "Environment map that lights the scene and is its background (--environment)");
    if (combo("##environment", names, chosen)) {
        state.environmentIsFile = chosen == names.back();
        if (!state.environmentIsFile) environment = chosen == names.front() ? "" : chosen;
    }
    if (state.environmentIsFile || isFile) {
        rowLabel("File", "Equirectangular .hdr or .exr file");
        if (pathRow("environment", "sky.hdr", "Load", state.environmentPath)) environment = state.environmentPath;
    }
    if (!environment.empty()) settingRow(state.options, "environmentRotation");
}

bool hasPlainRow(const Setting& setting) {
    const bool group = setting.group == SettingGroup::samples || setting.group == SettingGroup::method ||
                       setting.group == SettingGroup::developer;
    const bool widget =
        setting.kind != SettingKind::text && setting.kind != SettingKind::path && setting.kind != SettingKind::other;
    return group && widget && setting.effect == SettingEffect::pixels;
}

void backgroundCombo(Background& background) {
    static const Background choices[] = {EnvironmentBackground{}, TransparentBackground{}, Color{}};
    int chosen = static_cast<int>(background.index());
    if (ImGui::Combo("##background", &chosen, "environment\0none: transparent\0one colour\0"))
        background = choices[chosen];
}

// Draws the row that applies a preset: the settings of a published paper. The window stores the lens separately
// (ViewState::lens), so the lens values of the previous and the new preset are also updated there.
void presetRow(ViewState& state) {
    const Preset* const before = presetOf(state.options);
    if (!settingRow(state.options, "preset", presets().front().name)) return;
    const LensValues given = givenLensValues(state.options);
    for (const Preset* const preset : {before, presetOf(state.options)}) {
        if (preset == nullptr) continue;
        for (const PresetValue& value : preset->values) {
            const LensField* const field = lensFieldNamed(value.setting);
            if (field == nullptr) continue;
            const auto found = given.find(value.setting);
            setLensField(state.lens, *field, found != given.end() ? found->second : lensFieldValue(Lens{}, *field));
        }
    }
}

}  // namespace

void surroundingsPanel(const Ui& ui) {
    Request& options = ui.state.options;
    ImGui::BeginDisabled(ui.still.has_value());
    rowLabel("Background", "Background of the scene (--background)");
    backgroundCombo(options.background);
    if (auto* const colour = std::get_if<Color>(&options.background)) {
        rowLabel("Colour", "Linear colour of the background, which also lights the scene (--background R,G,B)");
        ImGui::ColorEdit3("##colour", colour->data(),
                          ImGuiColorEditFlags_Float | ImGuiColorEditFlags_HDR | ImGuiColorEditFlags_NoLabel);
    } else {
        environmentRows(ui.state);
    }
    settingRow(options, "ground");
    settingRow(options, "shadows");
    const Shadows shadows = options.shadows;
    if (shadows == Shadows::on || (shadows == Shadows::automatic && options.ground)) {
        settingRow(options, "lightAngle");
        settingRow(options, "lightRadius");
    }
    ImGui::EndDisabled();
}

std::vector<const Setting*> settingsPanelRows() {
    std::vector<const Setting*> rows;
    for (const Setting& setting : settings())
        if (hasPlainRow(setting)) rows.push_back(&setting);
    return rows;
}

void settingsPanel(const Ui& ui) {
    Request& request = ui.state.options;
    for (const Setting* setting : settingsPanelRows()) {
        const SettingContext context{request, *chosenMethod(request).method, ui.scene(), ui.state.lens};
        const std::string reason = setting->unused ? setting->unused(context) : "";
        ImGui::BeginDisabled(!reason.empty());
        settingRow(request, setting->name);
        ImGui::EndDisabled();
    }
}

void methodPanel(const Ui& ui) {
    presetRow(ui.state);
    Request& options = ui.state.options;
    const MethodUse use = chosenMethod(options);
    rowLabel("Method", "Rendering method (--method)");
    std::string method = use.method->name;
    if (methodCombo(method)) {
        options.method = method;
        options.methodSettings.clear();
        return;
    }
    MethodUse edited = use;
    for (const MethodSetting& setting : use.method->settings)
        methodSettingRow(setting, edited.settings.at(setting.name));
    if (edited.text() != use.text()) options.methodSettings = edited.settings;
}

}  // namespace defocus::engine
