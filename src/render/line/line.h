#pragma once
// Line samples: each pixel looks along lines through the lens. The visible triangles on each line are found as
// intervals instead of points (Tzeng, Patney, Davidson, Ebeida, Mitchell and Owens 2012, High-Quality Parallel
// Depth-of-Field Using Line Samples).
//
// The published method keeps segments in a buffer of fixed size, whose heuristics may drop or merge segments.
// Intersecting segments swap only where a segment ends, and each segment is shaded once, at its midpoint. By default
// this implementation finds the visible pieces of a line exactly, intersections included. The number of shading points
// of a piece depends on how many pixels its surface moves along the line. They are placed at random, so that textures
// are blurred too.

#include "render/methods.h"

namespace defocus::engine {

Method lineMethod();

}  // namespace defocus::engine
