// Shades a surface for one lens sample and writes it to the sample's layer.

#include "include/frame.glsl"
#include "include/lens.glsl"
#include "include/surface_light.glsl"

layout(location = 0) out vec4 layerOut;
layout(location = 1) out vec4 ownBlurOut;   // surface's blur factor and added blur; written only with passesOwnBlur

void main() {
    readSurface();
    layerOut = surfaceLight();
    if (passesOwnBlur) ownBlurOut = vec4(surface.ownBlur, 0.0, 1.0);
}
