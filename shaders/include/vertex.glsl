// Transforms a vertex of a mesh to view space. With POSED, the pose of the object is applied first.

layout(location = 0) in vec3 positionIn;
layout(location = 1) in vec3 normalIn;
layout(location = 2) in vec4 colorIn;
layout(location = 3) in vec2 uv0In;
layout(location = 4) in vec2 uv1In;
layout(location = 5) in vec4 tangentIn;
// x: blur factor; y, z: added blur in mm on the sensor, at shutter opening and at shutter closing
layout(location = 8) in vec3 blurIn;

struct Posed {
    vec3 position;
    vec3 normal;
    vec3 tangent;
};

struct Vertex {
    Posed view;     // vertex in the view space of the camera at the middle of the exposure
    vec3 eye;       // point on the lens (m) in the view space of the camera at the middle of the exposure
    vec3 pinhole;   // clip position (x, y, w) seen through a pinhole, at the time of the lens sample
};

#ifdef POSED
#include "include/posing.glsl"
#else
Vertex vertexAt(vec2 moment, Posed rest, vec3 eye) {
    Posed view = Posed((object.viewFromObject * vec4(rest.position, 1.0)).xyz, object.normalMatrix * rest.normal,
                       mat3(object.viewFromObject) * rest.tangent);
    return Vertex(view, eye, pinholePosition(view.position));
}
#endif

// Returns the vertex at a time within the exposure. `moment`: index of a shutter time, fraction of the way to the next
// shutter time, time from 0 to 1. `eye`: lens point (m) in view space.
Vertex vertexAt(vec3 moment, vec3 eye) { return vertexAt(moment.xy, Posed(positionIn, normalIn, tangentIn.xyz), eye); }

// Returns the blur modifiers of the vertex, (factor, added fraction of the image's width), at a time in [0, 1].
vec2 vertexBlur(float time) {
    if (!vertexBlurs) return vec2(object.values.w, 0.0);
    return object.values.w * vec2(blurIn.x, frame.cocOther.y * mix(blurIn.y, blurIn.z, blurMoves ? time : 0.5));
}
