#include "view/widgets/widgets.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace defocus::engine {

namespace {

Places& places() {
    static Places noted;  // recorded widget positions; global, like ImGui's own state
    return noted;
}

}  // namespace

void notePlace(const std::string& name) {
    if (!ImGui::IsItemVisible()) return;
    const ImVec2 min = ImGui::GetItemRectMin();
    const ImVec2 max = ImGui::GetItemRectMax();
    places()[name] = {std::lround(0.5f * (min.x + max.x)), std::lround(0.5f * (min.y + max.y))};
}

Places takePlaces() {
    return std::exchange(places(), {});
}

bool section(const char* title, bool openAtFirst) {
    const bool open = ImGui::CollapsingHeader(title, openAtFirst ? ImGuiTreeNodeFlags_DefaultOpen : 0);
    notePlace(title);
    return open;
}

void tooltip(const std::string& text) {
    if (text.empty() || !ImGui::IsItemHovered()) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 24);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

void rowLabel(const std::string& label, const std::string& help) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(label.c_str());
    tooltip(help);
    ImGui::SameLine(ImGui::GetFontSize() * 10.2f);
    ImGui::SetNextItemWidth(-1);
}

void textRow(const char* label, const std::string& text, const char* help) {
    rowLabel(label, help);
    ImGui::TextUnformatted(text.c_str());
}

bool combo(const char* id, const std::vector<std::string>& names, std::string& chosen) {
    if (!ImGui::BeginCombo(id, chosen.c_str())) return false;
    const std::string before = chosen;
    bool clicked = false;
    for (const std::string& name : names) {
        if (!ImGui::Selectable(name.c_str(), name == before)) continue;
        chosen = name;
        clicked = true;
    }
    ImGui::EndCombo();
    return clicked;
}

bool slider(const char* id, double& value, double min, double max, const char* format, ImGuiSliderFlags flags) {
    return ImGui::SliderScalar(id, ImGuiDataType_Double, &value, &min, &max, format, flags);
}

bool slider(const char* id, std::uint32_t& value, std::uint32_t min, std::uint32_t max, ImGuiSliderFlags flags) {
    return ImGui::SliderScalar(id, ImGuiDataType_U32, &value, &min, &max, "%u", flags | ImGuiSliderFlags_AlwaysClamp);
}

bool pathRow(const char* id, const char* hint, const char* button, std::string& path) {
    ImGui::PushID(id);
    const ImGuiStyle& style = ImGui::GetStyle();
    ImGui::SetNextItemWidth(-ImGui::CalcTextSize(button).x - 2 * style.FramePadding.x - style.ItemSpacing.x);
    const bool entered = ImGui::InputTextWithHint("##path", hint, &path, ImGuiInputTextFlags_EnterReturnsTrue);
    ImGui::SameLine();
    const bool pressed = ImGui::Button(button);
    ImGui::PopID();
    return entered || pressed;
}

void centreDialog(float width, float height) {
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * window.x, 0.5f * window.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(width, window.x - 8), std::min(height, window.y - 8)});
}

}  // namespace defocus::engine
