// Kernel 1 of the lens-space methods: poses the vertices of a level for transform feedback. ATTRIBUTES: outputs shading
// attributes; otherwise pinhole position and C.

#include "include/frame.glsl"
#include "include/lens.glsl"

layout(location = 0) in vec3 positionIn;
layout(location = 1) in vec3 normalIn;
layout(location = 2) in vec4 colorIn;
layout(location = 3) in vec2 uv0In;
layout(location = 4) in vec2 uv1In;
layout(location = 5) in vec4 tangentIn;
layout(location = 8) in vec3 blurIn;   // factor; added blur in mm on the sensor at shutter opening and closing
#ifdef SKIN_INFLUENCES
layout(location = 9) in vec4 jointsIn;
layout(location = 10) in vec4 weightsIn;
#if SKIN_INFLUENCES == 8
layout(location = 11) in vec4 joints1In;
layout(location = 12) in vec4 weights1In;
#endif
#endif
#ifdef POSED
#include "include/posing.glsl"
#endif
#if defined(MOVING) || defined(BLUR_MOVES)
layout(location = 0) uniform vec3 moment;   // shutter moment, fraction of the way to the next, time in [0, 1]
#endif

#ifdef ATTRIBUTES
layout(xfb_buffer = 0, xfb_offset = 0) out vec4 positionOut;   // m from the camera along the world's axes
layout(xfb_buffer = 0, xfb_offset = 16) out vec4 normalOut;    // in world axes; w: length in the mesh, the agreement
layout(xfb_buffer = 0, xfb_offset = 32) out vec4 colorOut;
layout(xfb_buffer = 0, xfb_offset = 48) out vec4 uvOut;        // both UV sets
layout(xfb_buffer = 0, xfb_offset = 64) out vec4 tangentOut;
#else
layout(xfb_buffer = 0, xfb_offset = 0) out vec4 clipOut;       // x, y, w of clip space; C
#endif

void main() {
#ifdef POSED
    Posed rest = Posed(positionIn, normalIn, tangentIn.xyz);
#ifdef MOVING
    Posed vertex = posedVertex(int(moment.x), rest);
    if (moment.y > 0.0) vertex = between(vertex, posedVertex(int(moment.x) + 1, rest), moment.y);
#else
    Posed vertex = posedVertex(0, rest);
#endif
    vec3 pinhole = pinholePosition(vertex.position);
#ifdef CAMERA_MOVES
    vec3 eye = vec3(0.0);
    toMiddle(moment.xy, vertex, eye);
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
#ifdef ATTRIBUTES
    mat3 worldFromView = mat3(frame.worldFromView);
    positionOut = vec4(worldFromView * viewPosition, 1.0);
    normalOut = vec4(worldFromView * viewNormal, length(normalIn));
#ifdef VERTEX_COLORS
    colorOut = colorIn;
#else
    colorOut = vec4(1.0);
#endif
    uvOut = vec4(uv0In, uv1In);
    tangentOut = vec4(worldFromView * viewTangent, tangentIn.w);
#else
    vec2 own = vec2(object.values.w, 0.0);
#ifdef VERTEX_BLURS
#ifdef BLUR_MOVES
    float time = moment.z;
#else
    const float time = 0.5;
#endif
    own = object.values.w * vec2(blurIn.x, frame.cocOther.y * mix(blurIn.y, blurIn.z, time));
#endif
#ifdef COC_CONTROLS
    // Vertices at the near plane have one linear C, because the methods reject objects with a kinked C there.
    float w = pinhole.z == 0.0 ? 1e-20 : pinhole.z;
    float c = w * relativeCircleOfConfusion(1.0 / w, pinhole.xy / w, own);
#else
    float c = frame.coc.x + frame.coc.y * pinhole.z;
#endif
    clipOut = vec4(pinhole, c);
#endif
    gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
}
