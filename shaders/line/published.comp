// Segments are kept in a buffer in shared memory, as published, and resolved at the end.

#include "line/kernel.glsl"
#include "line/segment_buffer.glsl"
#include "line/visible.glsl"
