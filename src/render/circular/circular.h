#pragma once
// Method "circular": Garcia 2018, Circular Separable Convolution Depth of Field (EA; after Niemitalo 2010). A pinhole
// image is split at the focus plane; each field is blurred by disks that separable complex kernels approximate
// (complex_blur.h), the near field at the largest radius that reaches a pixel, so that it bleeds over its edges; then
// the sharp image, the far field and the near field are laid over each other.

#include "render/methods.h"

namespace defocus::engine {

Method circularMethod();

}  // namespace defocus::engine
