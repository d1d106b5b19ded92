#include "include/frame.glsl"
#include "include/layer_format.glsl"
#include "include/environment.glsl"

in vec3 viewDirection;
flat in float ditherOffset;

#ifdef LAYER_RGB9E5
layout(location = 0) out uint layerOut;
#else
layout(location = 0) out vec4 layerOut;
#endif

void main() {
#if ENVIRONMENT == 3
    vec4 radiance = vec4(environmentRadiance(normalize(mat3(frame.worldFromView) * viewDirection), 0.0), 1.0);
#elif ENVIRONMENT == 2
    vec4 radiance = vec4(gradientRadiance(normalize(mat3(frame.worldFromView) * viewDirection).y), 1.0);
#else
    vec4 radiance = vec4(frame.environment[0].rgb, 1.0);
#endif
#ifdef LAYER_LARGEST
    radiance.rgb = roundedToHalf(radiance.rgb);
#endif
#ifdef LAYER_RGB9E5
    layerOut = encodeLayer(radiance, ditherOffset);
#else
    layerOut = radiance;
#endif
}
