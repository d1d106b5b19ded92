// Declares the light sources in world axes, independent of the camera. A few lights that are not animated are compiled
// as constants (LIGHTING_VALUES). Software rasterizers read constants far faster than a uniform block, which Mesa 22.3
// fetches for each pixel.

struct LightData {
    vec4 directionType;   // direction of the light's rays; w: 0 directional, 1 point, 2 spot
    vec4 colorScale;      // rgb: colour · intensity / π; w: scale of the spot cone's falloff
    vec4 cone;            // x: offset o of the spot cone's falloff: cosine · scale + o, clamped to [0, 1] and squared
};

#define LIGHTING_MEMBERS \
    vec4 environment[3];  /* zenith, horizon, nadir radiance */ \
    vec4 irradiance[9];   /* E(n)/π in the real spherical harmonics of Ramamoorthi and Hanrahan 2001 */ \
    LightData lights[maxLights];

#ifdef LIGHTING_VALUES
struct LightingData { LIGHTING_MEMBERS };
const LightingData lighting = LightingData(LIGHTING_VALUES);
#else
layout(std140, binding = 5) uniform LightingBlock { LIGHTING_MEMBERS } lighting;
#endif
