#pragma once
// The rows of the panel whose values come from files or belong to one object: surroundings, the aperture's image, the
// blur of what is selected. What they ask for stands in ViewActions::changed.

#include "view/panel.h"

namespace defocus {

void surroundingsSection(const PanelContext& context, ViewState& state, ViewActions& actions);
void apertureImageRow(const PanelContext& context, ViewState& state, ViewActions& actions);
// Of the object that was focused on last; nothing where its node has no name of its own to say it by.
void nodeBlurRow(const PanelContext& context, const ViewState& state, ViewActions& actions);

}  // namespace defocus
