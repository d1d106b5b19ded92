#pragma once
// Method "circular": Garcia 2018, Circular Separable Convolution Depth of Field (EA; after Niemitalo 2010). A pinhole
// image is split at the focus plane into a near and a far field. Separable complex kernels (complex_blur.h) blur each
// field with an approximate disk. Each pixel of the near field is blurred with the largest radius of all near pixels
// whose disk reaches it, so that near objects have soft edges. The sharp image, the far field and the near field are
// composited in this order.

#include "render/methods.h"

namespace defocus::engine {

Method circularMethod();

}  // namespace defocus::engine
