// Records: hits of a wave's rays. Shading replaces the four members of a record by red, green, blue and coverage,
// multiplied by Record::weight.

struct Record {
    uint triangle;   // noTriangle if the ray hits the sky
    uint ray;        // (ray of the wave · height + y) · width + x
    float place;     // line sample: position along the line over the lens; point sample: depth w of the hit
    float weight;
};

layout(std430, binding = 7) buffer RecordBlock { Record records[]; };
