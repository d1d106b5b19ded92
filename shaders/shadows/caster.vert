// Draws one instance of a shadow caster per lens sample, into the shadow map `shadowSlot` of the sample.

#include "include/frame.glsl"
#include "include/lens.glsl"
#include "include/shadow_projection.glsl"
#include "include/surface_vertex.glsl"

layout(location = 3) uniform int shadowSlot;

void main() {
    Vertex vertex = instanceVertex();
    Surface surface = surfaceOf(vertex, vec2(1.0, 0.0));
    int layer = int(eyeAndSampleIn.w);
    gl_Position = shadowPosition(shadowTexel(layer, shadowSlot), surface.position);
    surface.layer = float(layer * (shadowPoints * shadowMapCount) + shadowSlot);
    writeSurface(surface);
    chooseLayer(surface.layer);
}
