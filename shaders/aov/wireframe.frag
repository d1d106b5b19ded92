// Draws a triangle edge in the colour that represents the object's level of detail.

#include "include/frame.glsl"
#include "include/tone_map.glsl"

layout(binding = 32) uniform sampler2D levelColours;   // linear colour for each level of detail

layout(location = 0) out vec4 colour;

void main() {
    vec3 linear = texture(levelColours, vec2(object.values.x / 8.0, 0.5)).rgb;
    colour = vec4(srgbEncoded(mix(linear, vec3(1.0), 0.15)), 1.0);
}
