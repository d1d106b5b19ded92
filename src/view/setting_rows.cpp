#include "view/setting_rows.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <optional>

#include "core/error.h"
#include "core/parse.h"
#include "view/lens_rows.h"
#include "view/widgets.h"

namespace defocus {

namespace {

// What the row's widget makes of the text; none where nobody touched it.
std::optional<std::string> numberText(const Setting& setting, const std::string& text) {
    double value = parseNumber(text, {setting.least, setting.most});
    const std::string format = setting.unit.empty() ? "%.3g" : "%.3g " + setting.unit;
    const double least = setting.least > 0 ? std::min(setting.least, 1e-3) : 1e-3;
    const float step = static_cast<float>(std::max(least, 0.02 * value));
    if (!ImGui::DragScalar("##value", ImGuiDataType_Double, &value, step, &setting.least, &setting.most, format.c_str(),
                           ImGuiSliderFlags_AlwaysClamp))
        return {};
    return fmt::format("{}", value);
}

std::optional<std::string> wholeText(const Setting& setting, const std::string& text) {
    const auto least = static_cast<std::uint32_t>(setting.least);
    const auto most = static_cast<std::uint32_t>(setting.most);
    auto value = static_cast<std::uint32_t>(parseWhole(text, least, most));
    const std::uint32_t step = 1;
    if (!ImGui::InputScalar("##value", ImGuiDataType_U32, &value, &step)) return {};
    return fmt::format("{}", std::clamp(value, least, most));
}

std::optional<std::string> choiceText(const Setting& setting, const std::string& text) {
    const int chosen = combo("##value", setting.choices, text);
    return chosen < 0 ? std::nullopt : std::optional(setting.choices[static_cast<std::size_t>(chosen)]);
}

std::optional<std::string> truthText(const std::string& text) {
    bool on = text == "true";
    return ImGui::Checkbox("##value", &on) ? std::optional<std::string>(on ? "true" : "false") : std::nullopt;
}

std::optional<std::string> editedText(const Setting& setting, const std::string& text) {
    switch (setting.kind) {
        case SettingKind::number:
            return numberText(setting, text);
        case SettingKind::whole:
            return wholeText(setting, text);
        case SettingKind::choice:
            return choiceText(setting, text);
        case SettingKind::truth:
            return truthText(text);
        case SettingKind::text:
        case SettingKind::path:
        case SettingKind::other:
            break;
    }
    ImGui::TextUnformatted(text.c_str());
    return {};
}

// A box that switches a value on that is open otherwise. Open again: true.
bool openBox(std::string& text, const std::string& first) {
    bool given = !text.empty();
    if (ImGui::Checkbox("##given", &given)) text = given ? first : "";
    ImGui::SameLine();
    if (text.empty()) ImGui::TextDisabled("by the number of samples");
    ImGui::SetNextItemWidth(-1);
    return text.empty();
}

}  // namespace

bool settingRow(Request& request, const std::string& name, const std::string& first) {
    const Setting& setting = *settingNamed(name);
    ImGui::PushID(name.c_str());
    rowLabel(fieldLabel(name).c_str(), fmt::format("{} ({})", setting.help, setting.option).c_str());
    const std::string before = setting.text(request).value_or("");
    std::string after = before;
    if (first.empty() || !openBox(after, first)) after = editedText(setting, after).value_or(after);
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

}  // namespace defocus
