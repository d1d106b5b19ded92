#pragma once
// Stochastic rasterization: each pixel has its own points on the lens, in the pixel and in time, and each point sees
// the nearest triangle (Munkberg, Toth and Akenine-Möller 2012, Per-Vertex Defocus Blur for Stochastic Rasterization;
// for time Akenine-Möller, Munkberg and Hasselgren 2007, Stochastic Rasterization using Time-Continuous Triangles).
// With few samples the error is noise, whereas the accumulation shows overlaid images.

#include "render/methods.h"

namespace defocus::engine {

Method stochasticMethod();

}  // namespace defocus::engine
