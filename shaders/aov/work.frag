// Outputs 1 for each fragment of a triangle; additive blending counts the triangles per pixel.

layout(location = 0) out float touched;

void main() {
    touched = 1.0;
}
