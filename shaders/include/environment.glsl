// Evaluates the environment: its radiance along a direction, and the irradiance of a surface. environmentType: 0 none,
// 1 uniform, 2 gradient, 3 map. backgroundType: type of the environment drawn behind surfaces, 0 or equal to
// environmentType.

#include "include/lighting.glsl"

#ifdef ENVIRONMENT_MAP
layout(binding = 5) uniform sampler2D environmentMap;   // equirectangular; rough reflections read coarse mip levels

vec2 equirectangular(vec3 d) {
    return vec2(0.5 + atan(d.x, -d.z) * 0.15915494309, acos(clamp(d.y, -1.0, 1.0)) * 0.31830988618);
}

// Returns the radiance of the environment map along a unit direction. `level` is a mip level; > 0 for rough
// reflections.
vec3 environmentRadiance(vec3 worldDirection, float level) {
    return textureLod(environmentMap, equirectangular(worldDirection), level).rgb;
}
#else
vec3 environmentRadiance(vec3 worldDirection, float level) { return vec3(0.0); }
#endif

// Returns the irradiance over π of a surface with unit normal n, from second-order spherical harmonics (Ramamoorthi and
// Hanrahan 2001).
vec3 environmentDiffuse(vec3 n) {
    return max(lighting.irradiance[0].rgb + lighting.irradiance[1].rgb * n.y + lighting.irradiance[2].rgb * n.z +
               lighting.irradiance[3].rgb * n.x + lighting.irradiance[4].rgb * (n.x * n.y) + lighting.irradiance[5].rgb * (n.y * n.z) +
               lighting.irradiance[6].rgb * (3.0 * n.z * n.z - 1.0) + lighting.irradiance[7].rgb * (n.x * n.z) +
               lighting.irradiance[8].rgb * (n.x * n.x - n.y * n.y), vec3(0.0));
}

// Returns the radiance of the gradient environment along a unit direction with y = `height`.
vec3 gradientRadiance(float height) {
    vec3 pole = height > 0.0 ? lighting.environment[0].rgb : lighting.environment[2].rgb;
    return mix(lighting.environment[1].rgb, pole, abs(height));
}

// Returns the irradiance over π from the gradient environment, a polynomial of the unit normal's y (`height`).
vec3 gradientDiffuse(float height) {
    return lighting.irradiance[0].rgb + height * (lighting.irradiance[1].rgb + height * lighting.irradiance[2].rgb);
}

// Returns the radiance of an environment of type `type` (1 … 3, as in environmentType) along a unit direction.
vec3 skyRadiance(int type, vec3 worldDirection) {
    if (type == 3) return environmentRadiance(worldDirection, 0.0);
    if (type == 2) return gradientRadiance(worldDirection.y);
    return lighting.environment[0].rgb;
}
