#pragma once
// The sections of the panel that show what the scene holds: its nodes as a tree whose boxes switch what is drawn, the
// materials of what is selected, what isn't drawn of the file, and the views that are kept of it.

#include "view/panel.h"

namespace defocus {

void treeSection(const PanelContext& context, ViewState& state, ViewActions& actions);
void materialSection(const PanelContext& context, const ViewState& state);
void viewsSection(ViewState& state, ViewActions& actions);
// What the file holds and the program ignores; nothing where it ignores nothing.
void ignoredRows(const PanelContext& context);

}  // namespace defocus
