// A record holds the hit of a ray. Shading replaces the four members of the record by red, green, blue and coverage,
// multiplied by Record::weight.

struct Record {
    uint triangle;   // noTriangle if the ray hits the sky
    uint ray;        // (n · height + y) · width + x, where n is the ray's number counted from firstRay (rays.glsl)
    float place;     // line sample: position along the line over the lens; point sample: depth w of the hit
    float weight;
};

layout(std430, binding = 7) buffer RecordBlock { Record records[]; };
