#pragma once
// Method "line": each pixel samples the lens along lines instead of at points, and finds the intervals of each line
// from which a triangle is visible (Tzeng, Patney, Davidson, Ebeida, Mitchell and Owens 2012, High-Quality Parallel
// Depth-of-Field Using Line Samples).
//
// The published method stores a line's segments in a buffer of fixed size (shaders/line/segment_buffer.glsl).
// Intersecting segments change order only at the end of a segment, and each segment is shaded once, at its midpoint. By
// default, this implementation finds the visible intervals exactly, including intersections. The number of shading
// points per interval depends on the parallax of its surface in pixels. Shading points have random positions in the
// interval, so that textures are also blurred.

#include "render/methods.h"

namespace defocus::engine {

Method lineMethod();

}  // namespace defocus::engine
