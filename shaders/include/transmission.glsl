// Light from behind a transmitting surface.

// This layer and the others, as they were before this object.
layout(binding = 22) uniform sampler2DArray backdrop;

vec2 ndcThroughLens(vec3 viewPosition) {
    vec4 clip = throughLens(pinholePosition(viewPosition), vec2(1.0, 0.0), vec4(surface.lens, 0.0, 0.0));
    return clip.xy / clip.w;
}

// Returns the colour seen through the surface at `offset` (m, along the world's axes). `roughness` in [0, 1] blurs it
// as in KHR_materials_transmission's sample viewer; 1 blurs over the whole image. Each lens sample shifts the square
// mip texels, so that they average out over the samples.
vec4 seenBehind(vec3 offset, float roughness) {
    if (chromatic) bandShift = surface.bandShift;
    ivec2 size = textureSize(backdrop, 0).xy;
    vec2 at = gl_FragCoord.xy / vec2(size);
    if (offset != vec3(0.0)) {
        mat3 worldFromView = mat3(frame.worldFromView);
        at += 0.5 * (ndcThroughLens((surface.position + offset) * worldFromView) - ndcThroughLens(surface.position * worldFromView));
    }
    float level = roughness * log2(float(size.x));
    at += (exp2(level) - 1.0) * (fract(vec2(1.0, 17.0) * surface.ditherOffset) - 0.5) / vec2(size);
    return textureLod(backdrop, vec3(at, gl_Layer), level);
}

// KHR_materials_transmission and KHR_materials_volume. A thin wall shows the background straight behind it. A volume
// shows the background at the end of the refracted ray, after the volume's thickness, with Beer–Lambert absorption.
void addTransmission(inout SurfacePoint point, vec3 baseColor, float metallic) {
    float share = material.transmission.x * materialTexel(transmissionTexture).r;
    float thickness = material.transmission.y * materialTexel(thicknessTexture).g;
    float scale = pow(abs(determinant(mat3(object.viewFromObject))), 1.0 / 3.0);
    vec3 way = scale * thickness * refract(-point.toEye, point.normal, material.transmission.z);
    vec4 behind = seenBehind(way, point.roughness * material.transmission.w);
    vec3 tint = baseColor * exp(-material.absorption.rgb * length(way));
    share *= 1.0 - metallic;
    point.diffuse *= 1.0 - share;
    point.transmitted = share * tint * behind.rgb;
    surfaceCoverage = 1.0 - share * (1.0 - behind.a) * max(tint.r, max(tint.g, tint.b));
}
