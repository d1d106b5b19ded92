// Keeps the segments of lines in a buffer in shared memory and resolves visibility at the end, as in Tzeng et al. 2012.

#include "line/kernel.glsl"
#include "line/segment_buffer.glsl"
#include "line/visible.glsl"
