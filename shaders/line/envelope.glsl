// Keeps the visible pieces of a line across the lens: disjoint intervals, sorted by the position p along the line. Each
// piece belongs to the triangle that is nearest there among the triangles added so far.

struct Piece {
    float first;
    float last;
    uint triangle;
    uint index;      // index of the next piece in the current list
};

// Double buffer for the list of the line's visible pieces: adding a segment reads one half and writes the other.
vec2 pieceEnds[2 * segmentCapacity];
// The inverse depth of a piece is E/D, where E and D are linear in the position p along the line (line.glsl). x: E at
// p = 0; y: slope of E; z: D at p = 0; w: slope of D.
vec4 pieceDepths[2 * segmentCapacity];
uint pieceTriangles[2 * segmentCapacity];
uint pieceCount = 0u;
uint current = 0u;                // index of the first piece of the current list: 0 or segmentCapacity
uint nextCount = 0u;
uint nextList = 0u;
vec2 lineSides;
float lost = 0.0;                 // fraction of the line's light in pieces that were dropped because the list was full
uint lostPieces = 0u;
float hidden = 0.0;               // surfaces with a smaller 1/w (w: depth) are hidden; 0 if the line has gaps
float nextMin = 1e30;           // min of 1/w over the pieces of the list that is being written
bool nextHasGaps = false;

void beginLine(vec2 sides) { lineSides = sides; }

float pieceInverseDepth(vec4 depth, float p) { return (depth.x + p * depth.y) / (depth.z + p * depth.w); }

void emitPiece(float first, float last, uint triangle, vec4 depth) {
    if (!(last > first)) return;
    nextMin = min(nextMin, min(pieceInverseDepth(depth, first), pieceInverseDepth(depth, last)));
    if (nextCount > 0u) {
        uint previous = nextList + nextCount - 1u;
        if (pieceTriangles[previous] == triangle && pieceEnds[previous].y == first && pieceDepths[previous] == depth) {
            pieceEnds[previous].y = last;
            return;
        }
    }
    float before = nextCount > 0u ? pieceEnds[nextList + nextCount - 1u].y : -lineSides.x;
    nextHasGaps = nextHasGaps || before != first;
    if (nextCount == uint(segmentCapacity)) {
        lost += lightBetween(first, last, lineSides);
        ++lostPieces;
        return;
    }
    pieceEnds[nextList + nextCount] = vec2(first, last);
    pieceDepths[nextList + nextCount] = depth;
    pieceTriangles[nextList + nextCount] = triangle;
    ++nextCount;
}

// Returns the coefficients (constant, linear, quadratic) of a polynomial in the position p along the line that is > 0
// where `a` is nearer than `b`. With the inverse depths E₁/D₁ of `a` and E₂/D₂ of `b` (pieceDepths), the polynomial is
// (E₁/D₁ − E₂/D₂)·D₁·D₂. D is positive where a triangle is visible, so the sign is that of the difference.
vec3 nearness(vec4 a, vec4 b) {
    return vec3(a.x * b.z - b.x * a.z, a.x * b.w + a.y * b.z - b.x * a.w - b.y * a.z, a.y * b.w - b.y * a.w);
}

bool nearer(vec3 f, float p, uint a, uint b) {
    float value = f.x + p * (f.y + p * f.z);
    return value > 0.0 || (value == 0.0 && a < b);
}

// Returns the two positions p along the line, in ascending order, where two segments intersect. `f`: nearness() of the
// segments, a polynomial in p whose roots are these positions. A position above 2 stands for no intersection.
vec2 crossings(vec3 f) {
    if (f.z == 0.0) return vec2(f.y == 0.0 ? 4.0 : -f.x / f.y, 4.0);
    float discriminant = f.y * f.y - 4.0 * f.x * f.z;
    if (discriminant <= 0.0) return vec2(4.0);
    float q = -0.5 * (f.y + (f.y < 0.0 ? -sqrt(discriminant) : sqrt(discriminant)));
    float a = q / f.z;
    float b = q == 0.0 ? 4.0 : f.x / q;
    return vec2(min(a, b), max(a, b));
}

// Returns true if a surface at inverse depth 1/w may be visible on the line.
bool maySee(float inverseDepth) { return inverseDepth >= hidden * (1.0 - 1e-5); }

// Returns true if any part of a segment may be visible. Tests only the nearer end, because 1/w (w: depth) has its max
// on a segment at an end.
bool mayChange(Interval interval, OnLine line) {
    if (!(interval.last > interval.first)) return false;
    return maySee(max(inverseDepth(line, interval.first), inverseDepth(line, interval.last)));
}

bool changes(Interval interval, uint triangle, vec4 depth) {
    float cursor = interval.first;
    for (uint i = 0u; i < pieceCount && cursor < interval.last; ++i) {
        ++ownRounds;
        vec2 ends = pieceEnds[current + i];
        if (ends.y <= cursor) continue;
        if (ends.x > cursor) return true;
        float last = min(ends.y, interval.last);
        vec3 f = nearness(depth, pieceDepths[current + i]);
        vec2 at = clamp(crossings(f), cursor, last);
        uint other = pieceTriangles[current + i];
        if (nearer(f, 0.5 * (cursor + at.x), triangle, other) || nearer(f, 0.5 * (at.x + at.y), triangle, other) ||
            nearer(f, 0.5 * (at.y + last), triangle, other))
            return true;
        cursor = last;
    }
    return cursor < interval.last;
}

void addSegment(Interval interval, uint triangle, OnLine line, bool front) {
    vec4 depth = vec4(line.sums, line.determinant);
    if (!(interval.last > interval.first) || !changes(interval, triangle, depth)) return;
    nextList = uint(segmentCapacity) - current;
    nextCount = 0u;
    nextMin = 1e30;
    nextHasGaps = false;
    float cursor = interval.first;
    for (uint i = 0u; i < pieceCount; ++i) {
        ownRounds += 4u;   // one iteration of this loop and three of the inner loop
        vec2 ends = pieceEnds[current + i];
        vec4 otherDepth = pieceDepths[current + i];
        uint other = pieceTriangles[current + i];
        if (ends.y <= cursor) {
            emitPiece(ends.x, ends.y, other, otherDepth);
            continue;
        }
        // The new segment fills the gap before this piece.
        if (cursor < interval.last && ends.x > cursor) {
            float last = min(ends.x, interval.last);
            emitPiece(cursor, last, triangle, depth);
            cursor = last;
        }
        if (cursor >= interval.last) {
            emitPiece(max(ends.x, cursor), ends.y, other, otherDepth);
            continue;
        }
        emitPiece(ends.x, cursor, other, otherDepth);
        float last = min(ends.y, interval.last);
        vec3 f = nearness(depth, otherDepth);
        vec2 at = clamp(crossings(f), cursor, last);
        float from = cursor;
        for (int part = 0; part < 3; ++part) {
            float to = part == 0 ? at.x : part == 1 ? at.y : last;
            if (!(to > from)) continue;
            if (nearer(f, 0.5 * (from + to), triangle, other)) emitPiece(from, to, triangle, depth);
            else emitPiece(from, to, other, otherDepth);
            from = to;
        }
        emitPiece(last, ends.y, other, otherDepth);
        cursor = last;
    }
    emitPiece(cursor, interval.last, triangle, depth);
    current = nextList;
    pieceCount = nextCount;
    hidden = nextHasGaps || pieceEnds[current + pieceCount - 1u].y != 1.0 ? 0.0 : nextMin;
}

// Returns the part of the line that begins at p: the piece there, or the gap up to the next piece.
Piece pieceFrom(uint index, float p, Interval whole) {
    if (index < pieceCount) {
        vec2 ends = pieceEnds[current + index];
        if (ends.x > p) return Piece(p, ends.x, noTriangle, index);
        return Piece(p, ends.y, pieceTriangles[current + index], index + 1u);
    }
    return Piece(p, whole.last, noTriangle, index);
}

Piece firstPiece(Interval whole) { return pieceFrom(0u, whole.first, whole); }

Piece nextPiece(Piece piece, Interval whole) { return pieceFrom(piece.index, piece.last, whole); }

// Returns an upper bound on the loop iterations that writing the line's records (ray hits) will take.
uint walkRounds() { return (2u * pieceCount + 1u) * (2u + uint(maxShadingPoints)); }

const uint stateSize = 2u + 4u * uint(segmentCapacity);

void saveLine(uint at) {
    ranges[at] = uvec2(pieceCount, lostPieces);
    ranges[at + 1u] = floatBitsToUint(vec2(lost, hidden));
    for (uint i = 0u; i < pieceCount; ++i) {
        uint to = at + 2u + 4u * i;
        vec4 depth = pieceDepths[current + i];
        ranges[to] = floatBitsToUint(pieceEnds[current + i]);
        ranges[to + 1u] = floatBitsToUint(depth.xy);
        ranges[to + 2u] = floatBitsToUint(depth.zw);
        ranges[to + 3u] = uvec2(pieceTriangles[current + i], 0u);
    }
}

void loadLine(uint at) {
    pieceCount = ranges[at].x;
    lostPieces = ranges[at].y;
    lost = uintBitsToFloat(ranges[at + 1u].x);
    hidden = uintBitsToFloat(ranges[at + 1u].y);
    for (uint i = 0u; i < pieceCount; ++i) {
        uint from = at + 2u + 4u * i;
        pieceEnds[i] = uintBitsToFloat(ranges[from]);
        pieceDepths[i] = vec4(uintBitsToFloat(ranges[from + 1u]), uintBitsToFloat(ranges[from + 2u]));
        pieceTriangles[i] = ranges[from + 3u].x;
    }
    ownRounds += pieceCount / widestVector;
}

void countDropped() {
    if (lostPieces == 0u) return;
    atomicAdd(droppedSegments, lostPieces);
    atomicAdd(droppedLight, uint(lost * 1024.0 + 0.5));
}
