#include "view/widgets/rows.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/parse.h"
#include "view/widgets/widgets.h"

namespace defocus::engine {

namespace {

constexpr double maxSliderRange = 64;  // integers with a larger range get no slider, because it would be too coarse

// Returns ImGui's format string for a value of the setting.
std::string numberFormat(const Setting& setting, double value) {
    if (setting.unit == "s") return secondsFormat(value);
    const std::string digits = std::abs(value) >= 1e4 ? "%.0f" : std::abs(value) >= 100 ? "%.4g" : "%.3g";
    if (setting.unit == "degrees") return digits + "°";
    return setting.unit.empty() ? digits : digits + " " + setting.unit;
}

// Each function below draws a widget and returns the edited text; nullopt if the user didn't edit it.

std::optional<std::string> numberText(const Setting& setting, const std::string& text) {
    double value = parseNumber(text, {setting.min, setting.max});
    const std::string format = numberFormat(setting, value);
    const double minStep = setting.unit == "degrees" ? 0.25 : setting.unit == "s" ? 1e-5 : 1e-3;
    const auto step = static_cast<float>(std::max(minStep, 0.005 * std::abs(value)));
    const bool slides = setting.min >= -1 && setting.min <= 0 && setting.max <= 1;
    const bool edited = slides
                            ? slider("##value", value, setting.min, setting.max, "%.2f", ImGuiSliderFlags_AlwaysClamp)
                            : ImGui::DragScalar("##value", ImGuiDataType_Double, &value, step, &setting.min,
                                                &setting.max, format.c_str(), ImGuiSliderFlags_AlwaysClamp);
    return edited ? std::optional(fmt::format("{}", value)) : std::nullopt;
}

std::optional<std::string> integerText(const Setting& setting, const std::string& text) {
    const auto min = static_cast<std::uint32_t>(setting.min);
    const auto max = static_cast<std::uint32_t>(setting.max);
    auto value = static_cast<std::uint32_t>(parseInteger(text, min, max));
    const std::uint32_t step = 1;
    const bool edited = max - min <= maxSliderRange ? slider("##value", value, min, max)
                                                    : ImGui::InputScalar("##value", ImGuiDataType_U32, &value, &step);
    return edited ? std::optional(fmt::format("{}", std::clamp(value, min, max))) : std::nullopt;
}

std::optional<std::string> choiceText(const Setting& setting, const std::string& text) {
    std::string chosen = text;
    return combo("##value", setting.choices, chosen) ? std::optional(chosen) : std::nullopt;
}

std::optional<std::string> booleanText(const std::string& text) {
    bool on = text == "true";
    return ImGui::Checkbox("##value", &on) ? std::optional<std::string>(on ? "true" : "false") : std::nullopt;
}

std::optional<std::string> editedText(const Setting& setting, const std::string& text) {
    switch (setting.kind) {
        case SettingKind::number:
            return numberText(setting, text);
        case SettingKind::integer:
            return integerText(setting, text);
        case SettingKind::choice:
            return choiceText(setting, text);
        case SettingKind::boolean:
            return booleanText(text);
        case SettingKind::text:
        case SettingKind::path:
        case SettingKind::other:
            break;
    }
    ImGui::TextUnformatted(text.c_str());
    return {};
}

// Draws a checkbox that, when checked, sets `text` to `first` and otherwise clears it. Returns whether `text` is set.
bool valueIsSet(const std::string& name, std::string& text, const std::string& first) {
    bool set = !text.empty();
    if (ImGui::Checkbox("##set", &set)) text = set ? first : "";
    notePlace(name);
    ImGui::SameLine();
    if (text.empty()) ImGui::TextDisabled("default");
    ImGui::SetNextItemWidth(-1);
    return !text.empty();
}

}  // namespace

bool settingRow(Request& request, const std::string& name) {
    return settingRow(request, name, settingNamed(name)->example);
}

bool settingRow(Request& request, const std::string& name, const std::string& first) {
    const Setting& setting = *settingNamed(name);
    ImGui::PushID(name.c_str());
    rowLabel(fieldLabel(name), fmt::format("{} ({})", setting.help, setting.option));
    // Some settings accept either a number or a word such as "auto"; here the word counts as unset.
    const bool words = setting.kind != SettingKind::choice && !setting.choices.empty();
    const auto unset = [&](const std::string& text) { return words && text == setting.choices.front() ? "" : text; };
    const std::string before = unset(setting.text(request).value_or(""));
    std::string after = before;
    if (first.empty() || valueIsSet(name, after, first)) after = editedText(setting, after).value_or(after);
    ImGui::PopID();
    if (after == before) return false;
    Request changed = request;
    try {
        if (after.empty())
            setting.clear(changed);
        else
            setting.set(changed, after);
    } catch (const Error&) {
        return false;
    }
    request = changed;
    return true;
}

bool lensFieldRow(Lens& lens, const LensField& field) {
    const double value = lensFieldValue(lens, field);
    const double unset = lensFieldValue(Lens{}, field);
    const bool isTime = field.name == std::string_view("exposureTime");
    const std::string first = isTime ? "0.008" : std::isinf(unset) ? "16" : "";
    Request request;
    if (first.empty() || value != unset) giveLensValue(request, field, std::clamp(value, field.min, field.max));
    ImGui::BeginDisabled(overridden(lens, field));
    const bool changed = settingRow(request, field.name, first);
    ImGui::EndDisabled();
    if (!changed) return false;
    Lens edited = lens;
    try {
        if (const LensValues given = givenLensValues(request); given.contains(field.name))
            setLensField(edited, field, given.find(field.name)->second);
        else
            edited.*std::get<double Lens::*>(field.member) = unset;
        checkLens(edited);
    } catch (const Error&) {
        return false;
    }
    lens = edited;
    return true;
}

bool methodCombo(std::string& name) {
    std::vector<std::string> names;
    for (const Method& method : methods()) names.push_back(method.name);
    return combo("##method", names, name);
}

void methodSettingRow(const MethodSetting& setting, std::string& value) {
    std::string label = setting.name;
    std::ranges::replace(label, '-', ' ');
    label[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(label[0])));
    ImGui::PushID(setting.name.c_str());
    rowLabel(label, fmt::format("{} (--{})", setting.description, setting.name));
    value = editedText(rowOf(setting), value).value_or(value);
    ImGui::PopID();
}

std::string secondsFormat(double seconds) {
    const bool fraction = seconds > 0 && seconds < 0.4;
    return (fraction ? fmt::format("1/{:.0f}   ", 1 / seconds) : "") + "%.3g s";
}

std::string fieldLabel(std::string_view name) {
    std::string label;
    for (const char letter : name) {
        const bool capital = letter >= 'A' && letter <= 'Z';
        if (capital) label += ' ';
        label += capital ? static_cast<char>(letter - 'A' + 'a') : letter;
    }
    if (label == "f stop") return "f-stop";
    if (label == "dof enabled") return "Depth of field";
    if (label == "iso") return "ISO";
    if (label == "axial chromatic aberration") return "Axial colour";
    if (!label.empty() && label[0] >= 'a' && label[0] <= 'z') label[0] = static_cast<char>(label[0] - 'a' + 'A');
    return label;
}

}  // namespace defocus::engine
