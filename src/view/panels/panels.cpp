#include "view/panels/panels.h"

#include "view/widgets/widgets.h"

namespace defocus::engine {

namespace {

bool always(const Ui& /*ui*/) {
    return true;
}

bool withScene(const Ui& ui) {
    return ui.document.frame != nullptr;
}

bool withAnimations(const Ui& ui) {
    return withScene(ui) && !ui.scene().clips.empty();
}

struct Panel {
    void (*draw)(const Ui&);
    const char* title;
    bool openAtFirst;
    bool (*shown)(const Ui&);
};

constexpr Panel panels[] = {
#define DEFOCUS_PANEL_ENTRY(...) {__VA_ARGS__},
    DEFOCUS_PANELS(DEFOCUS_PANEL_ENTRY)
#undef DEFOCUS_PANEL_ENTRY
};

}  // namespace

void drawPanels(const Ui& ui) {
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    const auto left = static_cast<float>(ui.state.area.size.x);
    ImGui::SetNextWindowPos({left, 0});
    ImGui::SetNextWindowSize({window.x - left, window.y});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
    ImGui::Begin("Panel", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoBringToFrontOnFocus);
    ImGui::PopStyleVar(2);
    for (const Panel& panel : panels) {
        if (!panel.shown(ui) || !section(panel.title, panel.openAtFirst)) continue;
        ImGui::PushID(panel.title);
        panel.draw(ui);
        ImGui::PopID();
    }
    ImGui::Separator();
    if (ImGui::Button("? Keys")) ui.state.help = !ui.state.help;
    ImGui::SameLine();
    if (ImGui::Button(ui.state.dark ? "Light" : "Dark")) ui.state.dark = !ui.state.dark;
    tooltip("T");
    ImGui::End();
}

}  // namespace defocus::engine
