#pragma once
// Line samples: each pixel looks along lines through the lens and finds which triangle is visible where on each of
// them, as intervals instead of points (Tzeng, Patney, Davidson, Ebeida, Mitchell and Owens 2012, High-Quality Parallel
// Depth-of-Field Using Line Samples).
//
// As published, segments are kept in a buffer of fixed size whose heuristics may drop or merge some, intersecting
// segments change places only where one ends, and a segment is shaded once, in its middle. By default the visible
// pieces of a line are exact, intersections included, and a piece is shaded at as many points as its surface moves by
// steps of some pixels, at random places, so that textures are blurred too.

#include "render/methods.h"

namespace defocus::engine {

Method lineMethod();

}  // namespace defocus::engine
