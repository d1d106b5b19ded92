// Keeps the segments of lines in a buffer in shared memory and resolves visibility after all segments have arrived, as
// in Tzeng et al. 2012.

#include "line/kernel.glsl"
#include "line/segment_buffer.glsl"
#include "line/visible.glsl"
