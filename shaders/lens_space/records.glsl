// Hits of a wave's rays. Shading replaces a record by its light: red, green, blue and coverage, times its weight.

struct Record {
    uint triangle;   // noTriangle: the sky
    uint ray;        // (ray of the wave · height + y) · width + x
    float place;     // line: position along the line over the lens; point: depth of the hit
    float weight;
};

layout(std430, binding = 7) buffer RecordBlock { Record records[]; };
