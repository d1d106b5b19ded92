// Draws messages, progress and the list of keyboard shortcuts.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "view/hud/hud.h"
#include "view/state/key_commands.h"
#include "view/widgets/widgets.h"

namespace defocus::engine {

namespace {

void drawMessages(const Ui& ui) {
    std::erase_if(ui.state.messages, [&](const Message& message) { return message.until < ui.state.now; });
    ImVec2 at = pictureCorner(ui, 0.5, 0);
    at.y += 12 * ui.scale;
    for (const Message& message : ui.state.messages) {
        LabelStyle style{.color = message.fault ? faultColor : brightColor, .anchorX = 0.5f};
        if (labelWidth(ui, message.text) > 1.8f * at.x) style.width = 1.8f * at.x;
        at.y += drawLabel(ui, at, message.text, style).y + 6 * ui.scale;
    }
}

void drawBar(const Ui& ui, const ImVec2& centre, const std::string& text, double share) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const float s = ui.scale;
    const ImVec2 half(std::min(170 * s, 0.48f * static_cast<float>(ui.state.area.size.x)), 34 * s);
    list.AddRectFilled({centre.x - half.x, centre.y - half.y}, {centre.x + half.x, centre.y + half.y}, plateColor,
                       6 * s);
    list.PushClipRect({centre.x - half.x + 8 * s, centre.y - half.y}, {centre.x + half.x - 8 * s, centre.y + half.y},
                      true);
    list.AddText({centre.x - half.x + 16 * s, centre.y - 22 * s}, brightColor, text.c_str());
    list.PopClipRect();
    const ImVec2 bar(centre.x - half.x + 16 * s, centre.y + 10 * s);
    const float width = 2 * half.x - 32 * s;
    list.AddRectFilled(bar, {bar.x + width, bar.y + 5 * s}, IM_COL32(80, 80, 80, 255), 2 * s);
    list.AddRectFilled(bar, {bar.x + width * static_cast<float>(share), bar.y + 5 * s}, IM_COL32(84, 148, 217, 255),
                       2 * s);
}

void drawProgress(const Ui& ui) {
    ImVec2 bottom = pictureCorner(ui, 0.5, 1);
    bottom.y -= 90 * ui.scale;
    if (const auto opening = ui.document.loader.opening())
        drawBar(ui, ui.document.frame == nullptr ? pictureCorner(ui, 0.5, 0.5) : bottom,
                fmt::format("Opening {}: {}", opening->name, opening->stage), opening->share);
    if (!ui.still) return;
    const double seconds = ui.still->secondsLeft();
    const std::string left = std::isfinite(seconds) ? fmt::format(", about {:.0f} s left", std::max(1.0, seconds)) : "";
    drawBar(ui, bottom,
            fmt::format("{}: {:.0f} %{}. Esc cancels", ui.still->output().filename().string(), 100 * ui.still->share(),
                        left),
            ui.still->share());
}

void drawKeys(const Ui& ui) {
    if (!ui.state.help) return;
    ImGui::SetNextWindowPos(pictureCorner(ui, 0.5, 0.5), ImGuiCond_Always, {0.5f, 0.5f});
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowSizeConstraints({0, 0}, {window.x, std::max(64.0f, window.y - 16 * ui.scale)});
    ImGui::Begin("Keys", &ui.state.help,
                 ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings);
    if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
        for (const KeyCommand& entry : keyCommands()) {
            if (entry.keys == nullptr) continue;
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(entry.keys);
            ImGui::TableNextColumn();
            ImGui::TextDisabled("%s", entry.meaning);
            notePlace(entry.meaning);
        }
        ImGui::EndTable();
    }
    ImGui::End();
}

}  // namespace

void drawNotices(const Ui& ui) {
    drawProgress(ui);
    drawMessages(ui);
    drawKeys(ui);
}

}  // namespace defocus::engine
