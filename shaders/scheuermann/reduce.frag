// Averages blocks of reduction × reduction pixels; blocks at the border average only the pixels inside the image.
layout(binding = 0) uniform sampler2D full;

layout(location = 0) out vec4 mean;

void main() {
    ivec2 first = reduction * ivec2(gl_FragCoord.xy);
    ivec2 last = min(first + reduction, textureSize(full, 0)) - 1;
    vec4 sum = vec4(0.0);
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) sum += texelFetch(full, ivec2(x, y), 0);
    ivec2 size = last - first + 1;
    mean = sum / float(size.x * size.y);
}
