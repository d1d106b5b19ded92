// Draws one instance per lens sample: the shear moves the object, and gl_Layer selects the sample's layer. With
// REFINED, a later stage applies the shear after dividing the triangles (object.tesc, object.tese, split.geom).
#ifdef VERTEX_LAYER
#extension GL_ARB_shader_viewport_layer_array : enable
#extension GL_AMD_vertex_shader_layer : enable
#endif

#include "include/frame.glsl"
#include "include/lens.glsl"

layout(location = 0) in vec3 positionIn;
layout(location = 1) in vec3 normalIn;
layout(location = 2) in vec4 colorIn;
layout(location = 3) in vec2 uv0In;
layout(location = 4) in vec2 uv1In;
layout(location = 5) in vec4 tangentIn;
layout(location = 6) in vec4 lensAndJitterIn;   // per instance
layout(location = 7) in vec4 eyeAndDitherIn;    // per instance: lens point (m), dither offset, layer
layout(location = 8) in vec3 blurIn;           // factor; added blur in mm on the sensor at shutter opening and closing
#ifdef SKIN_INFLUENCES
layout(location = 9) in vec4 jointsIn;
layout(location = 10) in vec4 weightsIn;
#if SKIN_INFLUENCES == 8
layout(location = 11) in vec4 joints1In;
layout(location = 12) in vec4 weights1In;
#endif
#endif
#if defined(MOVING) || defined(BLUR_MOVES)
// Per instance: shutter moment, fraction of the way to the next moment, time in [0, 1].
layout(location = 13) in vec3 momentIn;
#endif
#ifdef CHROMATIC
layout(location = 14) in float bandShiftIn;     // per instance
#endif
#ifdef VERTEX_COLOR_RANGES
// Colour range of the adjacent corners. Each channel is 256 · max + min, in units of 1/255.
layout(location = 15) in vec4 colorRangeIn;
#endif
#ifdef SHADOW_CASTER
#include "include/shadow_projection.glsl"
layout(location = 3) uniform int shadowSlot;
#endif
#ifdef POSED
#include "include/posing.glsl"
#endif

#ifdef VERTEX_LAYER
#define STAGE_OUT surface
#else
#define STAGE_OUT toNext
#endif
out Surface {
#include "include/surface_varyings.glsl"
} STAGE_OUT;
#ifdef REFINED
out Unsheared {
#include "include/unsheared_varyings.glsl"
} unsheared;
#elif defined(VERTEX_LAYER)
flat out float ditherOffset;
#else
flat out vec2 ditherAndLayer;
#endif

void main() {
    vec3 eye = vec3(eyeAndDitherIn.xy, 0.0);
#ifdef POSED
    Posed rest = Posed(positionIn, normalIn, tangentIn.xyz);
#ifdef MOVING
    // The clip position is linear in time (Munkberg et al. 2012). C is evaluated at the interpolated position. For a
    // plain lens this is the paper's linear C(t). With controls it matches a still frame at that moment.
    Posed vertex = posedVertex(int(momentIn.x), rest);
    if (momentIn.y > 0.0) vertex = between(vertex, posedVertex(int(momentIn.x) + 1, rest), momentIn.y);
#else
    Posed vertex = posedVertex(0, rest);
#endif
    vec3 pinhole = pinholePosition(vertex.position);
#ifdef CAMERA_MOVES
    toMiddle(momentIn.xy, vertex, eye);
#endif
    vec3 viewPosition = vertex.position;
    vec3 viewNormal = vertex.normal;
    vec3 viewTangent = vertex.tangent;
#else
    vec3 viewPosition = (object.viewFromObject * vec4(positionIn, 1.0)).xyz;
    vec3 viewNormal = mat3(object.normalMatrix) * normalIn;
    vec3 viewTangent = mat3(object.viewFromObject) * tangentIn.xyz;
    vec3 pinhole = pinholePosition(viewPosition);
#endif
    vec2 ownBlur = vec2(object.values.w, 0.0);
#ifdef VERTEX_BLURS
#ifdef BLUR_MOVES
    float time = momentIn.z;
#else
    const float time = 0.5;
#endif
    ownBlur = object.values.w * vec2(blurIn.x, frame.cocOther.y * mix(blurIn.y, blurIn.z, time));
#endif

#ifdef VERTEX_COLORS
    STAGE_OUT.color = material.baseColor * colorIn;
#else
    STAGE_OUT.color = material.baseColor;
#endif
#ifdef VERTEX_COLOR_RANGES
    vec4 maximum = floor(colorRangeIn / 256.0);
    STAGE_OUT.minColor = material.baseColor * ((colorRangeIn - 256.0 * maximum) / 255.0);
    STAGE_OUT.maxColor = material.baseColor * (maximum / 255.0);
#endif
#ifndef UNLIT
#ifdef COARSE_LEVEL
    STAGE_OUT.agreement = length(normalIn);
#endif
    mat3 worldFromView = mat3(frame.worldFromView);
    STAGE_OUT.normal = worldFromView * viewNormal;
    STAGE_OUT.toEye = worldFromView * (eye - viewPosition);
#endif
#if defined(LOCAL_LIGHTS) || defined(TRANSMISSION) || (defined(SHADOWS) && !defined(UNLIT))
    STAGE_OUT.position = worldFromView * viewPosition;
#endif
#ifdef TRANSMISSION
    STAGE_OUT.lens = lensAndJitterIn.xy;
#ifdef CHROMATIC
    STAGE_OUT.bandShift = bandShiftIn;
#else
    STAGE_OUT.bandShift = 0.0;
#endif
#endif
#ifdef TEXTURED
    STAGE_OUT.uv = vec4(uv0In, uv1In);
#endif
#ifdef TANGENTS
    STAGE_OUT.tangent = vec4(mat3(frame.worldFromView) * viewTangent, tangentIn.w);
#endif
#if defined(OWN_BLUR) && defined(READS_OWN_BLUR)
    STAGE_OUT.ownBlur = ownBlur;
#endif

#ifdef CHROMATIC
    bandShift = bandShiftIn;
#endif
    int layer = int(eyeAndDitherIn.w);
#ifdef SHADOW_CASTER
    gl_Position = shadowPosition(shadowTexel(layer, shadowSlot), mat3(frame.worldFromView) * viewPosition);
    layer = layer * (SHADOW_POINTS * SHADOW_MAPS) + shadowSlot;
#elif defined(REFINED)
    gl_Position = vec4(pinhole, 1.0);
    unsheared.pinhole = pinhole;
    unsheared.ownBlur = ownBlur;
    unsheared.lensAndJitter = lensAndJitterIn;
    unsheared.ditherAndLayer = eyeAndDitherIn.zw;
    unsheared.bandShift = bandShift;
#else
    gl_Position = throughLens(pinhole, ownBlur, lensAndJitterIn);
#endif
#ifndef REFINED
#ifdef VERTEX_LAYER
    ditherOffset = eyeAndDitherIn.z;
    gl_Layer = layer;
#else
    ditherAndLayer = vec2(eyeAndDitherIn.z, float(layer));
#endif
#endif
}
