#pragma once
// Exports stills, shots, and the picture as a command.

#include <optional>

#include "view/document/document.h"
#include "view/export/still_export.h"

namespace defocus::engine {

// Returns the `defocus render` command of the picture.
std::string pictureCommand(const Document& document, const ViewState& state);

// Records keyframes, saves shots, and starts or cancels stills as the actions ask. Returns the text for the clipboard,
// if any. Throws Error.
std::optional<std::string> actOnExport(std::optional<StillExport>& still, const Document& document, ViewState& state,
                                       const ViewActions& actions, bool software);

// Continues the still for a part of the frame's time.
void stepExport(std::optional<StillExport>& still, ViewState& state);

}  // namespace defocus::engine
