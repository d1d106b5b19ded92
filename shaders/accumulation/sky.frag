#include "include/frame.glsl"
#include "include/lens.glsl"
#include "include/layer_format.glsl"
#include "include/environment.glsl"

in vec2 place;                // in normalised device coordinates
flat in vec4 lensAndJitter;
flat in float skyBandShift;

layout(location = 0) out vec4 layerOut;

// Returns the direction of the sky that the lens moves to this pixel. A fixed-point iteration finds it, because C at
// infinity may depend on the position.
vec3 directionOfSky() {
#ifdef CHROMATIC
    bandShift = skyBandShift;
#endif
    vec2 unblurred = place - lensAndJitter.zw;
    vec2 pinhole = unblurred - shiftThroughLens(0.0, unblurred, vec2(1.0, 0.0), lensAndJitter.xy);
#ifdef COC_CONTROLS
    for (int i = 0; i < 3; ++i) pinhole = unblurred - shiftThroughLens(0.0, pinhole, vec2(1.0, 0.0), lensAndJitter.xy);
#endif
    return vec3(pinhole / frame.projection.xy, -1.0);
}

void main() {
    vec3 viewDirection = directionOfSky();
#if ENVIRONMENT == 3
    vec4 radiance = vec4(environmentRadiance(normalize(mat3(frame.worldFromView) * viewDirection), 0.0), 1.0);
#elif ENVIRONMENT == 2
    vec4 radiance = vec4(gradientRadiance(normalize(mat3(frame.worldFromView) * viewDirection).y), 1.0);
#else
    vec4 radiance = vec4(lighting.environment[0].rgb, 1.0);
#endif
#ifdef LAYER_LARGEST
    radiance.rgb = roundedToHalf(radiance.rgb);
#endif
    layerOut = radiance;
}
