#pragma once
// Implements `defocus render --lens-images`, which renders a file of lens images (one image per lens sample) for
// `defocus refocus`.

#include <string>

#include "cli/command.h"
#include "cli/commands/render.h"

namespace defocus::engine {

// Parses "NEAR:FAR" in m; FAR may be "inf". Throws Error unless 0 < NEAR ≤ FAR.
FocusRange parseFocusRange(const std::string& text);

// Renders the lens images to the file RenderArguments::lensImages.
void renderLensImages(const RenderArguments& arguments, const GlobalOptions& global);

}  // namespace defocus::engine
