#pragma once
// Exports still images and shots, and composes the command line that renders the window's image.

#include <optional>

#include "view/document/document.h"
#include "view/export/still_export.h"

namespace defocus::engine {

// Returns the `defocus render` command that renders the window's image.
std::string pictureCommand(const Document& document, const ViewState& state);

// Executes the export actions: records keyframes, saves shots, and starts or cancels the export of a still image.
// Returns the text to copy to the clipboard, if any. Throws Error if an action fails.
std::optional<std::string> actOnExport(std::optional<StillExport>& still, const Document& document, ViewState& state,
                                       const ViewActions& actions);

// Spends part of the frame time on rendering the still image.
void stepExport(std::optional<StillExport>& still, ViewState& state);

}  // namespace defocus::engine
