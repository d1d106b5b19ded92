#include "view/method_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cctype>

#include "lod/pyramid/level_selection.h"
#include "view/setting_rows.h"
#include "view/widgets.h"

namespace defocus {

namespace {

// One of a method's own settings.
void settingRow(const MethodSetting& setting, MethodSettings& settings) {
    ImGui::PushID(setting.name.c_str());
    std::string label = setting.name;
    std::replace(label.begin(), label.end(), '-', ' ');
    label[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(label[0])));
    rowLabel(label.c_str(), fmt::format("{} (--{})", setting.description, setting.name).c_str());
    std::string& value = settings.at(setting.name);
    if (!setting.choices.empty()) {
        const int chosen = combo("##value", setting.choices, value);
        if (chosen >= 0) value = setting.choices[static_cast<std::size_t>(chosen)];
    } else if (setting.whole) {
        int number = std::stoi(value);
        if (ImGui::SliderInt("##value", &number, static_cast<int>(setting.least), static_cast<int>(setting.most), "%d",
                             ImGuiSliderFlags_AlwaysClamp))
            value = std::to_string(number);
    } else {
        double number = std::stod(value);
        if (ImGui::SliderScalar("##value", ImGuiDataType_Double, &number, &setting.least, &setting.most, "%.3g",
                                ImGuiSliderFlags_AlwaysClamp))
            value = fmt::format("{}", number);
    }
    ImGui::PopID();
}

}  // namespace

// Levels of detail; the thresholds follow the number of samples unless they are set.
void levelSection(ViewState& state) {
    if (!section("Level of detail", false)) return;
    Request& request = state.options;
    settingRow(request, "lod");
    settingRow(request, "lodMetric");
    const LodMetric metric = chosenMetric(request.settings.metric, request.settings.thresholds);
    const LodThresholds standard = defaultThresholds(metric, request.settings.sampleCount);
    if (metric == LodMetric::measured) {
        settingRow(request, "lightThreshold", fmt::format("{:.3g}", standard.light));
    } else {
        settingRow(request, "blurThreshold", fmt::format("{}", standard.blur));
        if (metric != LodMetric::score) settingRow(request, "sizeThreshold", fmt::format("{}", standard.size));
    }
    settingRow(request, "lodCoc");
}

// How the image is made, and where its samples lie.
void methodSection(ViewState& state) {
    if (!section("Method", false)) return;
    Request& options = state.options;
    std::vector<std::string> names;
    for (const Method& method : methods()) names.push_back(method.name);
    const MethodUse use = chosenMethod(options);
    rowLabel("Method", "How the image is made (--method)");
    const int method = combo("##method", names, use.method->name);
    if (method >= 0) {
        options.method = names[static_cast<std::size_t>(method)];
        options.methodSettings.clear();
        return;
    }
    MethodUse edited = use;
    for (const MethodSetting& setting : use.method->settings) settingRow(setting, edited.settings);
    if (edited.text() != use.text()) options.methodSettings = edited.settings;
    settingRow(options, "sequence");
    settingRow(options, "seed");
    settingRow(options, "cocTolerance");
}

}  // namespace defocus
