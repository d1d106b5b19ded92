// One for each pixel that a triangle touches; blending adds them up.

layout(location = 0) out float touched;

void main() {
    touched = 1.0;
}
