// Which share of each light, and how much light from all around, reaches a point (Williams 1978; Haeberli and Akeley 1990).
// SHADOW_FIRST, SHADOW_FACES: for each light, and then for the surroundings, its first map (−1: none) and how many it has.
//
// A texel holds one depth of all that it covers, that of its middle, so a plane would shadow itself. What is compared with it is the
// depth that the place's facet has at the texel's middle (Isidoro 2006, Shadow Mapping: GPU-Based Tips and Techniques), which is right
// for planes. For hollows, a place is lifted by a quarter of a texel along the normal n of its facet, and by the error by which levels of
// detail lie off the surface. Where light grazes the facet, its depth runs away: half a texel's diagonal, r, off its middle a plane lies
// r·tan θ nearer to the light, θ the angle between n and the light, and a way d along n brings a place d/cos θ nearer: d = r·sin θ is
// enough for any slope, and never more than r. So a place is lifted by a texel at most.

#include "include/shadow_projection.glsl"

layout(binding = 18) uniform sampler2DArray shadowMaps;   // reversed depth; 0 where nothing is

const int shadowFirst[LIGHT_COUNT + 1] = SHADOW_FIRST;
const int shadowFaces[LIGHT_COUNT + 1] = SHADOW_FACES;

struct Facet {
    vec3 place;     // m from the camera along the world's axes
    vec3 normal;    // unit
};

// By how much the depth of the facet's plane changes from `clip` to the middle of the texel, which lies `toMiddle` (ndc) from there.
float depthAlongFacet(int texel, vec4 clip, vec3 normal, float width, vec2 toMiddle) {
    const float farthest = 4.0;   // texels
    vec3 across = normalize(cross(normal, abs(normal.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0)));
    vec4 stepA = shadowDirection(texel, across * width);
    vec4 stepB = shadowDirection(texel, cross(normal, across) * width);
    vec3 a = (stepA.xyz - clip.xyz / clip.w * stepA.w) / clip.w;
    vec3 b = (stepB.xyz - clip.xyz / clip.w * stepB.w) / clip.w;
    float area = a.x * b.y - a.y * b.x;
    if (area == 0.0) return 0.0;
    vec2 steps = vec2(toMiddle.x * b.y - toMiddle.y * b.x, a.x * toMiddle.y - a.y * toMiddle.x) / area;
    float way = length(steps);
    return dot(vec2(a.z, b.z), steps) * (way > farthest ? farthest / way : 1.0);
}

// 1 or 0. `toLight`: unit.
float litAt(int slot, Facet facet, vec3 toLight) {
    int texel = shadowTexel(gl_Layer, slot);
    float cosine = dot(facet.normal, toLight);
    float width = texelFetch(shadowProjections, texel + 4).w * dot(texelFetch(shadowProjections, texel + 3), vec4(facet.place, 1.0));
    float grazing = 1.0 - smoothstep(0.15, 0.35, cosine);
    float sine = sqrt(max(1.0 - cosine * cosine, 0.0));
    float away = width * (0.25 + 0.75 * sine * grazing) + object.levels.x + SHADOW_ERROR;
    vec4 clip = shadowPosition(texel, facet.place + facet.normal * away);
    if (!all(lessThan(abs(clip.xy), vec2(clip.w)))) return 1.0;
    vec2 place = clip.xy / clip.w;
    ivec2 at = min(ivec2((0.5 + 0.5 * place) * float(SHADOW_SIZE)), ivec2(SHADOW_SIZE - 1));
    vec2 toMiddle = (vec2(at) + 0.5) * (2.0 / float(SHADOW_SIZE)) - 1.0 - place;
    float depth = clip.z / clip.w + depthAlongFacet(texel, clip, facet.normal, width, toMiddle);
    float nearest = texelFetch(shadowMaps, ivec3(at, gl_Layer * (SHADOW_POINTS * SHADOW_MAPS) + slot), 0).r;
    return nearest <= max(depth, 0.0) ? 1.0 : 0.0;
}

int cubeFace(vec3 direction) {
    vec3 size = abs(direction);
    if (size.x >= size.y && size.x >= size.z) return direction.x > 0.0 ? 0 : 1;
    if (size.y >= size.z) return direction.y > 0.0 ? 2 : 3;
    return direction.z > 0.0 ? 4 : 5;
}

// The share of light `i` that arrives from the direction `toLight`.
float lightShare(int i, Facet facet, vec3 toLight) {
    if (shadowFirst[i] < 0) return 1.0;
    int map = shadowFirst[i] + (shadowFaces[i] > 1 ? cubeFace(-toLight) : 0);
    float sum = 0.0;
    for (int point = 0; point < SHADOW_POINTS; ++point) sum += litAt(point * SHADOW_MAPS + map, facet, toLight);
    return sum / float(SHADOW_POINTS);
}

// Irradiance over π that the surroundings would throw on a surface with the normal `normal`, and that something hides.
vec3 hiddenIrradiance(Facet facet, vec3 normal) {
    int map = shadowFirst[LIGHT_COUNT];
    vec3 sum = vec3(0.0);
    if (map < 0) return sum;
    for (int point = 0; point < SHADOW_POINTS; ++point) {
        int slot = point * SHADOW_MAPS + map;
        int texel = shadowTexel(gl_Layer, slot);
        vec3 toLight = texelFetch(shadowProjections, texel + 4).xyz;
        float cosine = dot(normal, toLight);
        if (cosine > 0.0) sum += (cosine * (1.0 - litAt(slot, facet, toLight))) * texelFetch(shadowProjections, texel + 5).rgb;
    }
    return sum / float(SHADOW_POINTS);
}
