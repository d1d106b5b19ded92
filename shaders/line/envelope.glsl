// The visible pieces of a line: disjoint, in order of p, each of the nearest of all segments so far.

struct Piece {
    float first;
    float last;
    uint triangle;
    uint index;      // among the line's pieces, for the walk over them
};

// Two lists, of which each new segment turns one into the other.
vec2 pieceEnds[2 * SEGMENTS];
vec4 pieceDepths[2 * SEGMENTS];   // E at 0, its slope; D at 0, its slope
uint pieceTriangles[2 * SEGMENTS];
uint pieceCount = 0u;
uint current = 0u;                // 0 or SEGMENTS: where the list begins
uint nextCount = 0u;
uint nextList = 0u;
vec2 lineSides;
float lost = 0.0;                 // light of pieces that found no room
uint lostPieces = 0u;
float hidden = 0.0;               // the least 1/w that is visible, if all of the line is covered
float nextMin = 1e30;           // of the new list
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
    if (nextCount == uint(SEGMENTS)) {
        lost += lightBetween(first, last, lineSides);
        ++lostPieces;
        return;
    }
    pieceEnds[nextList + nextCount] = vec2(first, last);
    pieceDepths[nextList + nextCount] = depth;
    pieceTriangles[nextList + nextCount] = triangle;
    ++nextCount;
}

// > 0 where `a` is nearer than `b`: E₁/D₁ − E₂/D₂ times both determinants, which are positive where their triangles are seen.
vec3 nearness(vec4 a, vec4 b) {   // constant, linear, quadratic term
    return vec3(a.x * b.z - b.x * a.z, a.x * b.w + a.y * b.z - b.x * a.w - b.y * a.z, a.y * b.w - b.y * a.w);
}

bool nearer(vec3 f, float p, uint a, uint b) {
    float value = f.x + p * (f.y + p * f.z);
    return value > 0.0 || (value == 0.0 && a < b);
}

// Where two segments intersect, in order; beyond 2 where they don't.
vec2 crossings(vec3 f) {
    if (f.z == 0.0) return vec2(f.y == 0.0 ? 4.0 : -f.x / f.y, 4.0);
    float discriminant = f.y * f.y - 4.0 * f.x * f.z;
    if (discriminant <= 0.0) return vec2(4.0);
    float q = -0.5 * (f.y + (f.y < 0.0 ? -sqrt(discriminant) : sqrt(discriminant)));
    float a = q / f.z;
    float b = q == 0.0 ? 4.0 : f.x / q;
    return vec2(min(a, b), max(a, b));
}

// Whether anything as near as this may be visible.
bool maySee(float inverseDepth) { return inverseDepth >= hidden * (1.0 - 1e-5); }

// Whether a segment may be visible anywhere. 1/w has its greatest value at one of its ends.
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

void addSegment(Interval interval, uint triangle, OnLine line) {
    vec4 depth = vec4(line.sums, line.determinant);
    if (!(interval.last > interval.first) || !changes(interval, triangle, depth)) return;
    nextList = uint(SEGMENTS) - current;
    nextCount = 0u;
    nextMin = 1e30;
    nextHasGaps = false;
    float cursor = interval.first;
    for (uint i = 0u; i < pieceCount; ++i) {
        ownRounds += 4u;   // with the three parts below
        vec2 ends = pieceEnds[current + i];
        vec4 otherDepth = pieceDepths[current + i];
        uint other = pieceTriangles[current + i];
        if (ends.y <= cursor) {
            emitPiece(ends.x, ends.y, other, otherDepth);
            continue;
        }
        // The free part before the piece, the part they share, and what of the piece lies before or behind.
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

// The piece at p, or the gap up to the next one.
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

// Rounds of the loops that walk over the line in the end, at most.
uint walkRounds() { return (2u * pieceCount + 1u) * (2u + uint(MOST_SHADING_POINTS)); }

const uint stateSize = 2u + 4u * uint(SEGMENTS);

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
