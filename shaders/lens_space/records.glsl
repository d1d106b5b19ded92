// Records: hits of a wave's rays. Shading replaces a record's four members by red, green, blue and coverage, multiplied
// by its weight.

struct Record {
    uint triangle;   // noTriangle: the sky
    uint ray;        // (ray of the wave · height + y) · width + x
    float place;     // line sample: position along the line over the lens; point sample: depth w of the hit
    float weight;
};

layout(std430, binding = 7) buffer RecordBlock { Record records[]; };
