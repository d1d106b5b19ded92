// Describes a triangle as seen along a line through the lens (Tzeng et al. 2012, High-Quality Parallel Depth-of-Field
// Using Line Samples).
//
// The line has the direction d = (cos φ, k·sin φ), k = image width / height. A vertex has the clip position (x, y, w)
// and the clip-space circle of confusion (CoC) C, the signed CoC times w. Seen from lens point p·d, the vertex lies at
// q(p) = α + p·β relative to an image position s, with α = (x, y) − w·s and β = C·d. All β are parallel, so the
// functions of the edges from vertex i to vertex j are linear in p:
//   e_ij(p) = α_i × α_j + p·(α_i × β_j + β_i × α_j).
// The triangle's front is visible from the positions p where all e_ij ≥ 0. There, the depth w of the triangle follows
// from 1/w = E/D. E is the sum of the e_ij. The determinant D is their sum weighted by the w of the vertex opposite to
// each edge. Both are linear in p, and so is D − near·E, which is ≥ 0 for the part of the triangle beyond the near
// plane.

struct OnLine {
    vec3 edgesAt0;
    vec3 edgeSlopes;
    // Linear functions of the position p along the line. x: value at p = 0; y: slope.
    vec2 sums;         // E, the sum of the three edge functions
    vec2 determinant;  // D, the triangle's determinant; the inverse depth is E/D
};

struct Interval {
    float first;
    float last;        // end of the interval; empty if last ≤ first
};

float crossed(vec2 a, vec2 b) {
    precise float c = a.x * b.y - a.y * b.x;
    return c;
}

float slopeOf(vec2 placeI, vec2 wayI, vec2 placeJ, vec2 wayJ) {
    precise float s = (placeI.x * wayJ.y - placeI.y * wayJ.x) + (wayI.x * placeJ.y - wayI.y * placeJ.x);
    return s;
}

vec2 placeAt0(vec4 clip, vec2 place) {
    precise vec2 q = clip.xy - clip.z * place;
    return q;
}

OnLine onLine(vec4 a, vec4 b, vec4 c, vec2 direction, vec2 place) {
    vec2 qa = placeAt0(a, place);
    vec2 qb = placeAt0(b, place);
    vec2 qc = placeAt0(c, place);
    vec2 wayA = a.w * direction;
    vec2 wayB = b.w * direction;
    vec2 wayC = c.w * direction;
    OnLine line;
    line.edgesAt0 = vec3(crossed(qb, qc), crossed(qc, qa), crossed(qa, qb));
    line.edgeSlopes = vec3(slopeOf(qb, wayB, qc, wayC), slopeOf(qc, wayC, qa, wayA), slopeOf(qa, wayA, qb, wayB));
    vec3 w = vec3(a.z, b.z, c.z);
    line.sums = vec2(line.edgesAt0.x + line.edgesAt0.y + line.edgesAt0.z, line.edgeSlopes.x + line.edgeSlopes.y + line.edgeSlopes.z);
    line.determinant = vec2(dot(line.edgesAt0, w), dot(line.edgeSlopes, w));
    return line;
}

// Returns the triangle's edge functions, their sum and the determinant along the line, negated, so that front and back
// are exchanged.
OnLine turned(OnLine line) { return OnLine(-line.edgesAt0, -line.edgeSlopes, -line.sums, -line.determinant); }

void cut(inout Interval interval, float at0, float slope) {
    if (slope == 0.0) {
        if (at0 < 0.0) interval.last = interval.first;
        return;
    }
    float root = -at0 / slope;
    if (slope > 0.0) interval.first = max(interval.first, root);
    else interval.last = min(interval.last, root);
}

// Returns the part of `whole`, an interval of positions p along the line, from which the triangle's front is visible.
Interval seen(OnLine line, Interval whole) {
    Interval interval = whole;
    if (line.sums == vec2(0.0)) return Interval(whole.first, whole.first);   // degenerate triangle
    for (int i = 0; i < 3; ++i) cut(interval, line.edgesAt0[i], line.edgeSlopes[i]);
    vec2 beyondNear = line.determinant - frame.projection.z * line.sums;
    cut(interval, beyondNear.x, beyondNear.y);
    return interval;
}

float inverseDepth(OnLine line, float p) { return (line.sums.x + p * line.sums.y) / (line.determinant.x + p * line.determinant.y); }
