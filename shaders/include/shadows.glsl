// Computes how much of each light and of the environment is visible from a surface point (Williams 1978; Haeberli and
// Akeley 1990). shadowFirst and shadowFaces hold, for each light and then the environment, the first shadow map (−1:
// none) and the number of maps.
//
// A texel stores only the depth at its centre, so a tilted plane would shadow itself. The comparison therefore uses the
// depth of the receiver's facet at the texel centre (Isidoro 2006, Shadow Mapping: GPU-Based Tips and Techniques). This
// is exact for planes. For concave surfaces, the receiver is offset along the facet's normal n by a quarter of a texel
// plus the deviation of the level of detail from the surface.
//
// Where the facet descends towards the texel centre, its plane may reach below a neighbouring facet. For example, a
// wall's plane continues below the floor, and the floor would shadow the foot of the wall. There, the slope's sign is
// reversed: the comparison uses the depth of a plane that rises from the receiver as steeply as the facet descends, but
// by at most 45°. This never darkens the receiver, and it leaves facets that face the light unchanged.
//
// At grazing incidence of the light, the facet is steep in the map, so the offset along n grows from a quarter of a
// texel to at most one texel. Let θ be the angle between n and the light, and r half a texel's diagonal. At distance r
// from the texel centre, the facet's plane may be r·tan θ nearer to the light than at the centre. An offset of d along
// n moves the receiver by d/cos θ towards the light. An offset of d = r·sin θ ≤ r is therefore sufficient for any
// slope.

#include "include/shadow_projection.glsl"

// Reversed depth; 0: empty. With tintedShadows, one depth per colour channel.
layout(binding = 29) uniform sampler2DArray shadowMaps;

struct Facet {
    vec3 place;     // position relative to the camera, in m, world axes
    vec3 normal;    // unit normal of the surface
};

// Returns how much the depth of the facet's plane changes between `clip` and the centre of the shadow map texel that
// contains `clip`. `toMiddle`: offset to this centre (NDC). `width` is the size of a texel at this depth, in m.
float depthAlongFacet(int texel, vec4 clip, vec3 normal, float width, vec2 toMiddle) {
    const float farthest = 4.0;   // max distance along the facet over which depth is extrapolated, in texels
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

// Returns, for each colour channel, 1 if the facet is lit according to shadow map `slot` of this layer's sample, else
// 0. The channels differ only with tintedShadows, where coloured casters block only some channels. `toLight` is a unit
// vector.
vec3 litAt(int slot, Facet facet, vec3 toLight) {
    int texel = shadowTexel(gl_Layer, slot);
    float cosine = dot(facet.normal, toLight);
    float width = texelFetch(shadowProjections, texel + 4).w * dot(texelFetch(shadowProjections, texel + 3), vec4(facet.place, 1.0));
    float grazing = 1.0 - smoothstep(0.15, 0.35, cosine);
    float sine = sqrt(max(1.0 - cosine * cosine, 0.0));
    float away = width * (0.25 + 0.75 * sine * grazing) + object.levels.x + shadowError;
    vec4 clip = shadowPosition(texel, facet.place + facet.normal * away);
    if (!all(lessThan(abs(clip.xy), vec2(clip.w)))) return vec3(1.0);
    vec2 place = clip.xy / clip.w;
    ivec2 at = min(ivec2((0.5 + 0.5 * place) * float(shadowSize)), ivec2(shadowSize - 1));
    vec2 toMiddle = (vec2(at) + 0.5) * (2.0 / float(shadowSize)) - 1.0 - place;
    float rise = depthAlongFacet(texel, clip, facet.normal, width, toMiddle);
    vec4 diagonal = shadowDirection(texel, toLight * (0.5 * float(shadowSize) * length(toMiddle) * width));
    // depth change from the receiver to the texel centre on a plane inclined by 45° to the map, rising towards the
    // light
    float steepest = (diagonal.z - clip.z / clip.w * diagonal.w) / clip.w;
    float depth = clip.z / clip.w + (rise < 0.0 ? min(-rise, steepest) : rise);
    vec3 nearest = texelFetch(shadowMaps, ivec3(at, gl_Layer * (shadowPoints * shadowMapCount) + slot), 0).rgb;
    return vec3(lessThanEqual(tintedShadows ? nearest : nearest.rrr, vec3(max(depth, 0.0))));
}

int cubeFace(vec3 direction) {
    vec3 size = abs(direction);
    if (size.x >= size.y && size.x >= size.z) return direction.x > 0.0 ? 0 : 1;
    if (size.y >= size.z) return direction.y > 0.0 ? 2 : 3;
    return direction.z > 0.0 ? 4 : 5;
}

// Returns the fraction of light i that reaches the facet, per colour channel. `toLight`: unit vector to the light.
vec3 lightShare(int i, Facet facet, vec3 toLight) {
    if (shadowFirst[i] < 0) return vec3(1.0);
    int map = shadowFirst[i] + (shadowFaces[i] > 1 ? cubeFace(-toLight) : 0);
    vec3 sum = vec3(0.0);
    for (int point = 0; point < shadowPoints; ++point) sum += litAt(point * shadowMapCount + map, facet, toLight);
    return sum / float(shadowPoints);
}

// Returns the part of the environment's irradiance, divided by π, that occluders block on a surface with the given
// normal.
vec3 hiddenIrradiance(Facet facet, vec3 normal) {
    int map = shadowFirst[lightCount];
    vec3 sum = vec3(0.0);
    if (map < 0) return sum;
    for (int point = 0; point < shadowPoints; ++point) {
        int slot = point * shadowMapCount + map;
        int texel = shadowTexel(gl_Layer, slot);
        vec3 toLight = texelFetch(shadowProjections, texel + 4).xyz;
        float cosine = dot(normal, toLight);
        if (cosine > 0.0) sum += (cosine * (1.0 - litAt(slot, facet, toLight))) * texelFetch(shadowProjections, texel + 5).rgb;
    }
    return sum / float(shadowPoints);
}

void addShadows(inout SurfacePoint point, vec3 place) {
    vec3 across = cross(dFdx(place), dFdy(place));
    float across2 = dot(across, across);
    Facet facet = Facet(place, across2 > 0.0 ? across * inversesqrt(across2) : point.normal);
    for (int i = 0; i < lightCount; ++i) {
        vec3 toLight = -lighting.lights[i].directionType.xyz;
        if (localLights && lighting.lights[i].directionType.w != 0.0) toLight = normalize(frame.lightPositions[i].xyz - place);
        lightShares[i] = lightShare(i, facet, toLight);
    }
    point.hidden = hiddenIrradiance(facet, point.normal);
}
