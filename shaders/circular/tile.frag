// Computes the max of red and of green over each tile of tileSize × tileSize pixels. With ofChannels, the input is the
// near or far field, and the outputs are the max over its colour channels (radiance) and the max of alpha (weight).
layout(binding = 0) uniform sampler2D values;

layout(location = 0) out vec2 largest;

void main() {
    ivec2 first = tileSize * ivec2(gl_FragCoord.xy);
    ivec2 last = min(first + tileSize, textureSize(values, 0)) - 1;
    largest = vec2(0.0);
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) {
            vec4 value = texelFetch(values, ivec2(x, y), 0);
            largest = max(largest, ofChannels ? vec2(max(value.r, max(value.g, value.b)), value.a) : value.rg);
        }
}
