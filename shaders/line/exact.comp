// Finds the visible surfaces of lines exactly. Each line keeps its visible parts as disjoint pieces. Each new segment
// is cut at the ends of these pieces and at intersections with them.

#include "line/kernel.glsl"
#include "line/envelope.glsl"
#include "line/visible.glsl"
