#pragma once
// Method "stochastic": neighbouring pixels use different sample points on the lens, in the pixel and in time. For each
// point, the method finds the nearest triangle (Munkberg, Toth and Akenine-Möller 2012, Per-Vertex Defocus Blur for
// Stochastic Rasterization; for time Akenine-Möller, Munkberg and Hasselgren 2007, Stochastic Rasterization using
// Time-Continuous Triangles). With few samples, the error looks like noise, whereas with method "accumulation" it looks
// like superimposed images.

#include "render/methods.h"

namespace defocus::engine {

Method stochasticMethod();

}  // namespace defocus::engine
