#pragma once
// Stochastic rasterisation: each pixel has points of its own on the lens, in the pixel and in time, and each of them
// sees the nearest triangle there (Munkberg, Toth and Akenine-Möller 2012, Per-Vertex Defocus Blur for Stochastic
// Rasterization, whose setting this is; Akenine-Möller, Munkberg and Hasselgren 2007, Stochastic Rasterization using
// Time-Continuous Triangles, for time). What few samples miss is noise, where the accumulation shows images that are
// laid over each other.

#include "render/methods.h"

namespace defocus::engine {

Method stochasticMethod();

}  // namespace defocus::engine
