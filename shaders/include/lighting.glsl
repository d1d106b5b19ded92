// What lights the surfaces, in the world's axes: no camera changes it. Where no clip does either, it is constants (LIGHTING_VALUES), which
// software rasterisers read far faster than a uniform block: Mesa 22.3 fetches that anew for each pixel.

struct LightData {
    vec4 directionType;   // the way the light shines; w: 0 directional, 1 point, 2 spot
    vec4 colorScale;      // colour · intensity / π; w: spot cone scale
    vec4 cone;            // x: spot cone offset
};

#define LIGHTING_MEMBERS \
    vec4 environment[3];  /* zenith, horizon, nadir radiance */ \
    vec4 irradiance[9];   /* E(n)/π in the real spherical harmonics of Ramamoorthi and Hanrahan 2001 */ \
    LightData lights[MAX_LIGHTS];

#ifdef LIGHTING_VALUES
struct LightingData { LIGHTING_MEMBERS };
const LightingData lighting = LightingData(LIGHTING_VALUES);
#else
layout(std140, binding = 5) uniform LightingBlock { LIGHTING_MEMBERS } lighting;
#endif
