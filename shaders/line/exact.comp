// Finds exactly which surfaces are visible along each line over the lens (line sample). Each line keeps its visible
// parts as disjoint pieces. Each new segment, the part of a line from which a triangle is visible, is cut at the ends
// of these pieces and at intersections with them.

#include "line/kernel.glsl"
#include "line/envelope.glsl"
#include "line/visible.glsl"
