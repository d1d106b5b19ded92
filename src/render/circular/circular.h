#pragma once
// Method "circular": Garcia 2018, Circular Separable Convolution Depth of Field (EA; after Niemitalo 2010). A pinhole
// image is split at the focus plane into a near and a far field. Separable complex kernels (complex_blur.h) blur each
// field with an approximate disk. The near field is blurred at the largest radius that reaches a pixel, so that it
// bleeds over its edges. The sharp image, the far field and the near field are then composited in this order.

#include "render/methods.h"

namespace defocus::engine {

Method circularMethod();

}  // namespace defocus::engine
