// Shades a surface for one lens sample. Writes its radiance to the sample's layer, and its data (depth, normal, …) to
// the data layers. A define such as DEPTH_SLOT is the index of a data layer's colour attachment; a data layer without a
// define is not drawn. Data are premultiplied by the surface's alpha, like radiance, so that blending treats all layers
// alike.

#include "include/frame.glsl"
#include "include/lens.glsl"
#include "include/surface_light.glsl"

layout(location = 0) out vec4 layerOut;
#ifdef DEPTH_SLOT
layout(location = DEPTH_SLOT) out vec4 depthOut;         // depth (m), alpha, CoC (px); see drawnDepth()
#endif
#ifdef POSITION_SLOT
layout(location = POSITION_SLOT) out vec4 positionOut;   // position relative to the camera (m)
#endif
#ifdef NORMAL_SLOT
layout(location = NORMAL_SLOT) out vec4 normalOut;
#endif
#ifdef ALBEDO_SLOT
layout(location = ALBEDO_SLOT) out vec4 albedoOut;
#endif
#ifdef EMISSION_SLOT
layout(location = EMISSION_SLOT) out vec4 emissionOut;
#endif
#ifdef MOTION_SLOT
layout(location = MOTION_SLOT) out vec4 motionOut;       // motion during the exposure (px)
#endif
#ifdef NUMBER_SLOT
layout(location = NUMBER_SLOT) out vec4 numberOut;       // 1 + index of the object, 1 + index of the material
layout(location = 4) uniform float materialNumber;
#endif

// Returns the premultiplied data. NaN and infinity become 0, because they would persist in the sum of all samples.
vec4 covering(vec3 data, float alpha) {
    return vec4(any(isnan(data)) || any(isinf(data)) ? vec3(0.0) : data * alpha, alpha);
}

#ifdef DRAWS_COC
// Returns the surface's signed CoC in px, evaluated at the surface point's position in the pinhole image.
float pinholeCoc() {
    vec3 place = transpose(mat3(frame.worldFromView)) * surface.position;
    return circleOfConfusion(gl_FragCoord.z, place.xy * frame.projection.xy / -place.z, surface.ownBlur);
}
#endif

#ifdef DEPTH_SLOT
// Returns premultiplied depth, alpha and CoC. Without a CoC the layer has only two channels, but blending still reads
// alpha from the fourth component of the output.
vec4 drawnDepth(float alpha) {
    float coc = 0.0;
#ifdef DRAWS_COC
    coc = pinholeCoc();
#endif
    vec4 data = covering(vec3(1.0 / gl_FragCoord.w, 0.0, coc), alpha);
    return vec4(data.r, alpha, data.ba);
}
#endif

#ifdef MOTION_SLOT
vec2 movement() {
    if (surface.opening.z <= 0.0 || surface.closing.z <= 0.0) return vec2(0.0);
    return 0.5 * frame.window.zw * (surface.closing.xy / surface.closing.z - surface.opening.xy / surface.opening.z);
}
#endif

#ifdef NUMBER_SLOT
// Returns 1 if the surface's object and material are counted in this lens sample, else 0. An alpha-blended surface is
// counted with probability alpha, independently of other surfaces, and replaces the surfaces behind it. A surface is
// therefore counted in the fraction alpha · Π (1 − alpha of each nearer surface) of the samples, which is also its
// weight in the image.
float chosen(float alpha) {
#ifdef CHOOSES_BY_ALPHA
    if (alphaBlended) return alpha > alphaThreshold(pixelOfImage()) ? 1.0 : 0.0;
#endif
    return 1.0;
}
#endif

void main() {
    readSurface();
    layerOut = surfaceLight();
#ifdef TRANSMISSIVE
    float alpha = 1.0;   // in the data layers (depth, normal, …), a transmissive surface is opaque
#else
    float alpha = alphaBlended ? surfaceBase.a : 1.0;
#endif
#ifdef DEPTH_SLOT
    depthOut = drawnDepth(alpha);
#endif
#ifdef POSITION_SLOT
    positionOut = covering(surface.position, alpha);
#endif
#ifdef NORMAL_SLOT
    normalOut = covering(lit ? shownNormal : towardsViewer(normalize(surface.normal)), alpha);
#endif
#ifdef ALBEDO_SLOT
    albedoOut = covering(surfaceBase.rgb, alpha);
#endif
#ifdef EMISSION_SLOT
    emissionOut = covering(lit ? shownEmission : surfaceBase.rgb, alpha);
#endif
#ifdef MOTION_SLOT
    motionOut = covering(vec3(movement(), 0.0), alpha);
#endif
#ifdef NUMBER_SLOT
    numberOut = vec4(object.values.z + 1.0, materialNumber, 0.0, 1.0) * chosen(alpha);
#endif
}
