// Outputs 1 for each pixel that a triangle touches; additive blending counts the triangles.

layout(location = 0) out float touched;

void main() {
    touched = 1.0;
}
