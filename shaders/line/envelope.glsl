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

void beginLine(vec2 sides) { lineSides = sides; }

void emitPiece(float first, float last, uint triangle, vec4 depth) {
    if (!(last > first)) return;
    if (nextCount > 0u) {
        uint previous = nextList + nextCount - 1u;
        if (pieceTriangles[previous] == triangle && pieceEnds[previous].y == first && pieceDepths[previous] == depth) {
            pieceEnds[previous].y = last;
            return;
        }
    }
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

bool changes(Interval interval, uint triangle, vec4 depth) {
    float cursor = interval.first;
    for (uint i = 0u; i < pieceCount && cursor < interval.last; ++i) {
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
    if (!changes(interval, triangle, depth)) return;
    nextList = uint(SEGMENTS) - current;
    nextCount = 0u;
    float cursor = interval.first;
    for (uint i = 0u; i < pieceCount; ++i) {
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

void countDropped() {
    if (lostPieces == 0u) return;
    atomicAdd(droppedSegments, lostPieces);
    atomicAdd(droppedLight, uint(lost * 1024.0 + 0.5));
}
