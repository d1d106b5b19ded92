layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;

in vec3 directionToGeometry[];
flat in vec2 ditherAndLayer[];
out vec3 viewDirection;
flat out float ditherOffset;

void main() {
    for (int i = 0; i < 3; ++i) {
        gl_Position = gl_in[i].gl_Position;
        gl_Layer = int(ditherAndLayer[i].y);
        ditherOffset = ditherAndLayer[i].x;
        viewDirection = directionToGeometry[i];
        EmitVertex();
    }
    EndPrimitive();
}
