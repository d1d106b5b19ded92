#pragma once
// The sections of the panel that say how the image is made: levels of detail, method, samples.

#include "view/state.h"

namespace defocus {

void levelSection(ViewState& state);
void methodSection(ViewState& state);

}  // namespace defocus
