// What the rays of a wave meet. Shading turns a record into light: its red, green, blue and coverage, times its weight.

struct Record {
    uint triangle;   // or noTriangle: the sky
    uint ray;        // (ray of the wave · height + y) · width + x
    float place;     // along a line over the lens; the depth of what a point sees
    float weight;
};

layout(std430, binding = 7) buffer RecordBlock { Record records[]; };
