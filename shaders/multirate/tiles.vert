// Rectangles of the image, in normalised device units.

layout(location = 0) in vec2 cornerIn;

void main() {
    gl_Position = vec4(cornerIn, 0.0, 1.0);
}
