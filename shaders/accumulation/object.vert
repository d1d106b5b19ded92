// Draws one instance of an object per lens sample. The lens shear (include/lens.glsl) moves the vertices, and gl_Layer
// selects the sample's layer.

#include "include/frame.glsl"
#include "include/lens.glsl"
#include "include/surface_vertex.glsl"

void main() {
    Vertex vertex = instanceVertex();
    vec2 ownBlur = vertexBlur(momentIn.z);
    writeSurface(surfaceOf(vertex, ownBlur));
    if (chromatic) bandShift = bandShiftIn;
    gl_Position = throughLens(vertex.pinhole, ownBlur, lensAndJitterIn);
    chooseLayer(eyeAndSampleIn.w);
}
