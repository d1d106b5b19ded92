// A record holds the hit of a ray. Shading overwrites all four members with red, green, blue and coverage, each
// multiplied by the record's former weight.

struct Record {
    uint triangle;   // noTriangle if the ray hits the sky
    uint ray;        // (n · height + y) · width + x, where n is the ray's number counted from firstRay (rays.glsl)
    float place;     // line sample: position p along the line (line.glsl); point sample: depth w of the hit
    float weight;    // weight in the pixel's sum; < 0: the ray passes through the surface (let_through.comp)
};

layout(std430, binding = 7) buffer RecordBlock { Record records[]; };
