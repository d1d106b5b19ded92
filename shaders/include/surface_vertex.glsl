// Computes a vertex of a surface as seen by one lens sample. Each lens sample is one instance of an instanced draw.

#include "include/vertex.glsl"
#include "include/layer_choice.glsl"
#include "include/surface.glsl"
#include "include/surface_output.glsl"

layout(location = 6) in vec4 lensAndJitterIn;   // per instance: lens point (u, k·v), k: aspect ratio; jitter (NDC)
layout(location = 7) in vec4 eyeAndSampleIn;    // per instance: lens point (m); sample index in the frame; layer
layout(location = 13) in vec3 momentIn;         // per instance: shutter time, passed to vertexAt() as `moment`
layout(location = 14) in float bandShiftIn;     // per instance: bandShift (lens.glsl), CoC change with wavelength
// Min and max of the vertex colours of all triangles that share the vertex. Each channel is 256 · max + min, in units
// of 1/255.
layout(location = 15) in vec4 colorRangeIn;

Vertex instanceVertex() { return vertexAt(momentIn, vec3(eyeAndSampleIn.xy, 0.0)); }

#ifdef MOTION_SLOT
// Returns the clip position (x, y, w) of the vertex as seen through a pinhole, at the shutter time with index `pose`.
vec3 placeInPose(int pose) {
#ifdef POSED
    return pinholePosition(posedVertex(moving ? pose : 0, Posed(positionIn, normalIn, tangentIn.xyz)).position);
#else
    return pinholePosition((object.viewFromObject * vec4(positionIn, 1.0)).xyz);
#endif
}
#endif

Surface surfaceOf(Vertex vertex, vec2 ownBlur) {
    mat3 worldFromView = mat3(frame.worldFromView);
    vec4 maximum = floor(colorRangeIn / 256.0);
    Surface s;
    s.color = vertexColors ? material.baseColor * colorIn : material.baseColor;
    s.minColor = material.baseColor * ((colorRangeIn - 256.0 * maximum) / 255.0);
    s.maxColor = material.baseColor * (maximum / 255.0);
    s.normal = worldFromView * vertex.view.normal;
    s.agreement = length(normalIn);
    s.toEye = worldFromView * (vertex.eye - vertex.view.position);
    s.position = worldFromView * vertex.view.position;
    s.lens = lensAndJitterIn.xy;
    s.bandShift = chromatic ? bandShiftIn : 0.0;
    s.uv = vec4(uv0In, uv1In);
    s.tangent = vec4(worldFromView * vertex.view.tangent, tangentIn.w);
    s.ownBlur = ownBlur;
    s.facet = gl_VertexID;
    s.sampleNumber = eyeAndSampleIn.z;
    s.layer = eyeAndSampleIn.w;
    s.opening = s.closing = vec3(0.0);
#ifdef MOTION_SLOT
    s.opening = placeInPose(0);
    s.closing = placeInPose(lastPose);
#endif
    return s;
}
