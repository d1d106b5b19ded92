// Outputs 1 for each fragment. With additive blending, the image counts the triangles per pixel.

layout(location = 0) out float touched;

void main() {
    touched = 1.0;
}
