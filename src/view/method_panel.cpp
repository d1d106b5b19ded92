#include "view/method_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cctype>

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
    SceneOptions& options = state.options;
    rowLabel("Mode", "How levels are drawn (--lod)");
    int mode = static_cast<int>(options.lod);
    if (ImGui::Combo("##lod", &mode, "fractional\0continuous\0nearest\0off\0"))
        options.lod = static_cast<LodMode>(mode);
    rowLabel("Metric", "What levels are chosen by (--lod-metric)");
    int metric = static_cast<int>(options.metric);
    if (ImGui::Combo("##metric", &metric, "size\0error\0")) options.metric = static_cast<LodMetric>(metric);
    bool own = options.blurThreshold.has_value() || options.sizeThreshold.has_value();
    rowLabel("Own thresholds", "Otherwise they follow the number of samples");
    if (ImGui::Checkbox("##own", &own)) {
        const LodThresholds standard = defaultThresholds(options.metric, options.samples);
        options.blurThreshold = own ? std::optional(standard.blur) : std::nullopt;
        options.sizeThreshold = own ? std::optional(standard.size) : std::nullopt;
    }
    const double least = 0;
    const double most = 1e3;
    for (const auto& [label, threshold] :
         {std::pair{"Blur threshold", &options.blurThreshold}, std::pair{"Size threshold", &options.sizeThreshold}}) {
        if (!threshold->has_value()) continue;
        ImGui::PushID(label);
        rowLabel(label);
        ImGui::DragScalar("##value", ImGuiDataType_Double, &**threshold, 0.01f, &least, &most, "%.3g");
        ImGui::PopID();
    }
    rowLabel("Blur counted", "The blur that an object's level may count on (--lod-coc)");
    int centre = options.lodCocAtCentre ? 1 : 0;
    if (ImGui::Combo("##centre", &centre, "smallest of the box\0at its centre\0")) options.lodCocAtCentre = centre == 1;
}

// How the image is made, and where its samples lie.
void methodSection(ViewState& state) {
    if (!section("Method", false)) return;
    SceneOptions& options = state.options;
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
    std::vector<std::string> sequences;
    for (const Sequence sequence : allSequences) sequences.emplace_back(sequenceName(sequence));
    rowLabel("Sequence", "Where the samples lie on the lens and in the pixel (--sequence)");
    const int sequence = combo("##sequence", sequences, std::string(sequenceName(options.sequence)));
    if (sequence >= 0) options.sequence = allSequences[static_cast<std::size_t>(sequence)];
    rowLabel("Seed", "Picks another set of sample points (--seed)");
    const std::uint32_t step = 1;
    ImGui::InputScalar("##seed", ImGuiDataType_U32, &options.seed, &step);
    rowLabel("Blur tolerance",
             "By how much the blur inside a triangle may differ from what its corners give (--coc-tolerance)");
    const double least = 1e-3;
    const double most = 1e3;
    ImGui::DragScalar("##tolerance", ImGuiDataType_Double, &options.cocTolerance, 0.01f, &least, &most, "%.3g px",
                      ImGuiSliderFlags_AlwaysClamp);
}

}  // namespace defocus
