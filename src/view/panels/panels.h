#pragma once
// Draws the panel beside the image, a list of sections, and the dialog for exporting stills. Each section is a function
// with a parameter of type Ui.

#include <vector>

#include "frame/settings/settings.h"
#include "view/widgets/ui.h"

namespace defocus::engine {

// The sections from top to bottom: function, title, whether initially open, condition under which the section is shown.
// A new section needs a function and a line here.
#define DEFOCUS_PANELS(PANEL)                                    \
    PANEL(scenePanel, "Scene", true, always)                     \
    PANEL(objectsPanel, "Objects", false, withScene)             \
    PANEL(materialPanel, "Material", false, withScene)           \
    PANEL(viewsPanel, "Views", false, withScene)                 \
    PANEL(animationPanel, "Animation", true, withAnimations)     \
    PANEL(focusPanel, "Focus", true, withScene)                  \
    PANEL(lensPanel, "Lens", true, withScene)                    \
    PANEL(aperturePanel, "Aperture", false, withScene)           \
    PANEL(surroundingsPanel, "Surroundings", false, withScene)   \
    PANEL(imagePanel, "Image", false, withScene)                 \
    PANEL(methodPanel, "Method", false, withScene)               \
    PANEL(settingsPanel, "Samples and levels", false, withScene) \
    PANEL(overlayPanel, "Overlays", false, withScene)            \
    PANEL(comparePanel, "Compare", false, withScene)             \
    PANEL(performancePanel, "Performance", false, withScene)     \
    PANEL(exportPanel, "Export", false, withScene)

#define DEFOCUS_DECLARE_PANEL(draw, ...) void draw(const Ui& ui);
DEFOCUS_PANELS(DEFOCUS_DECLARE_PANEL)
#undef DEFOCUS_DECLARE_PANEL

inline constexpr double panelWidth = 364;  // panel width in interface units; see interfaceScale

// Returns the settings of the section "Samples and levels" from top to bottom: all settings of samples, levels and
// methods that affect the pixels and have a widget.
std::vector<const Setting*> settingsPanelRows();

// Draws the panel to the right of the image.
void drawPanels(const Ui& ui);

// Draws the dialog for exporting a still if ViewState::exportDialog is set. The dialog asks before it replaces a file.
void drawExportDialog(const Ui& ui);

}  // namespace defocus::engine
