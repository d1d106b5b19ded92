// Draws one instance of an object per lens sample. Later stages divide the triangles (refined.tesc, refined.tese) and
// apply the lens shear (refined.geom).

#include "include/frame.glsl"
#include "include/lens.glsl"
#include "include/surface_vertex.glsl"

out Unsheared {
#include "include/unsheared_varyings.glsl"
} unsheared;

void main() {
    Vertex vertex = instanceVertex();
    vec2 ownBlur = vertexBlur(momentIn.z);
    writeSurface(surfaceOf(vertex, ownBlur));
    gl_Position = vec4(vertex.pinhole, 1.0);
    unsheared.pinhole = vertex.pinhole;
    unsheared.ownBlur = ownBlur;
    unsheared.lensAndJitter = lensAndJitterIn;
    unsheared.bandShift = chromatic ? bandShiftIn : 0.0;
}
