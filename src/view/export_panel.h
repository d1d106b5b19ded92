#pragma once
// Export: stills, shots and commands. The section of the panel, and the dialog that asks where a still shall go.

#include "view/panel.h"

namespace defocus {

void exportSection(const PanelContext& context, ViewState& state, ViewActions& actions);

// Where ViewState::exportDialog is open. A file that is there already is replaced only once somebody has said so.
void drawExportDialog(const PanelContext& context, ViewState& state, ViewActions& actions);

// "still-2.png" of "still.png", or the first number after it of which there is no file yet.
std::string freeName(const std::string& path);

}  // namespace defocus
