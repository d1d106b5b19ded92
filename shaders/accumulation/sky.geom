layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;

flat in vec4 lensAndJitterToGeometry[];
flat in float bandShiftToGeometry[];
flat in int layerToGeometry[];
out vec2 place;
flat out vec4 lensAndJitter;
flat out float skyBandShift;

void main() {
    for (int i = 0; i < 3; ++i) {
        gl_Position = gl_in[i].gl_Position;
        gl_Layer = layerToGeometry[i];
        place = gl_in[i].gl_Position.xy;
        lensAndJitter = lensAndJitterToGeometry[i];
        skyBandShift = bandShiftToGeometry[i];
        EmitVertex();
    }
    EndPrimitive();
}
