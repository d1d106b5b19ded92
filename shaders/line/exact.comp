// Each line keeps its visible parts as disjoint pieces. Every new segment is cut at their ends and at intersections.

#include "line/kernel.glsl"
#include "line/envelope.glsl"
#include "line/visible.glsl"
