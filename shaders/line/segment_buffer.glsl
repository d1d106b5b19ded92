// The segments of a line in a buffer of fixed size in shared memory, as Tzeng et al. 2012 keep them. Segments that another one hides
// are left out, and so are those whose share of the line's light is too small to be seen. Where the buffer is full, a segment that
// continues another one of the same surface is merged with it, and otherwise the one that contributes least is dropped. In the end a
// sweep along the line finds the nearest. Segments that intersect change places only where one of them ends.

struct Piece {
    float first;
    float last;
    uint triangle;
    uint unused;
};

const float leastLight = 1.0 / 4096.0;       // of the line
const float continuation = 1e-3;             // of the line: as near as this, one segment continues another
const float sameDepth = 0.02;                // of the inverse depth

shared vec4 segments[threads * uint(SEGMENTS)];         // p at both ends, 1/w at both ends
shared uint segmentTriangles[threads * uint(SEGMENTS)];
uint segmentCount = 0u;
vec2 lineSides;
float lost = 0.0;
uint lostSegments = 0u;
uint merged = 0u;

uint slotOf(uint i) { return i * threads + gl_LocalInvocationIndex; }   // neighbours lie in neighbouring words

void beginLine(vec2 sides) { lineSides = sides; }

float inverseDepthAt(vec4 segment, float p) {
    return mix(segment.z, segment.w, clamp((p - segment.x) / (segment.y - segment.x), 0.0, 1.0));
}

// Whether `a` covers all of `b` and lies in front of it at both of its ends.
bool hides(vec4 a, vec4 b) {
    return a.x <= b.x && a.y >= b.y && inverseDepthAt(a, b.x) >= b.z && inverseDepthAt(a, b.y) >= b.w;
}

void drop(vec4 segment) {
    lost += lightBetween(segment.x, segment.y, lineSides);
    ++lostSegments;
}

bool mergedInto(uint i, vec4 segment, uint triangle) {
    vec4 other = segments[slotOf(i)];
    if (triangles[segmentTriangles[slotOf(i)]].w != triangles[triangle].w) return false;
    bool after = abs(segment.x - other.y) < continuation && abs(segment.z - other.w) < sameDepth * other.w;
    bool before = abs(segment.y - other.x) < continuation && abs(segment.w - other.z) < sameDepth * other.z;
    if (!after && !before) return false;
    segments[slotOf(i)] = after ? vec4(other.x, segment.y, other.z, segment.w) : vec4(segment.x, other.y, segment.z, other.w);
    // The triangle that shows more of itself shades both.
    if (segment.y - segment.x > other.y - other.x) segmentTriangles[slotOf(i)] = triangle;
    ++merged;
    return true;
}

void addSegment(Interval interval, uint triangle, OnLine line) {
    vec4 segment = vec4(interval.first, interval.last, inverseDepth(line, interval.first), inverseDepth(line, interval.last));
    if (lightBetween(segment.x, segment.y, lineSides) < leastLight) {
        drop(segment);
        return;
    }
    for (uint i = 0u; i < segmentCount; ++i)
        if (hides(segments[slotOf(i)], segment)) return;
    for (uint i = 0u; i < segmentCount;) {
        if (!hides(segment, segments[slotOf(i)])) {
            ++i;
            continue;
        }
        --segmentCount;
        segments[slotOf(i)] = segments[slotOf(segmentCount)];
        segmentTriangles[slotOf(i)] = segmentTriangles[slotOf(segmentCount)];
    }
    if (segmentCount == uint(SEGMENTS)) {
        uint least = 0u;
        float leastShare = 2.0;
        for (uint i = 0u; i < segmentCount; ++i) {
            vec4 other = segments[slotOf(i)];
            if (mergedInto(i, segment, triangle)) return;
            float share = lightBetween(other.x, other.y, lineSides);
            if (share < leastShare) {
                leastShare = share;
                least = i;
            }
        }
        if (lightBetween(segment.x, segment.y, lineSides) <= leastShare) {
            drop(segment);
            return;
        }
        drop(segments[slotOf(least)]);
        segments[slotOf(least)] = segment;
        segmentTriangles[slotOf(least)] = triangle;
        return;
    }
    segments[slotOf(segmentCount)] = segment;
    segmentTriangles[slotOf(segmentCount)] = triangle;
    ++segmentCount;
}

// What is nearest from p on, up to where another segment begins or this one ends.
Piece partFrom(float p, Interval whole) {
    float last = whole.last;
    for (uint i = 0u; i < segmentCount; ++i) {
        vec2 ends = segments[slotOf(i)].xy;
        if (ends.x > p) last = min(last, ends.x);
        else if (ends.y > p) last = min(last, ends.y);
    }
    Piece piece = Piece(p, last, noTriangle, 0u);
    float middle = 0.5 * (p + last);
    float nearest = 0.0;
    for (uint i = 0u; i < segmentCount; ++i) {
        vec4 segment = segments[slotOf(i)];
        if (segment.x > p || segment.y <= p) continue;
        float here = inverseDepthAt(segment, middle);
        uint triangle = segmentTriangles[slotOf(i)];
        if (here > nearest || (here == nearest && triangle < piece.triangle)) {
            nearest = here;
            piece.triangle = triangle;
        }
    }
    return piece;
}

Piece pieceFrom(float p, Interval whole) {
    Piece piece = partFrom(p, whole);
    while (piece.last < whole.last) {
        Piece next = partFrom(piece.last, whole);
        if (next.triangle != piece.triangle || !(next.last > piece.last)) break;
        piece.last = next.last;
    }
    return piece;
}

Piece firstPiece(Interval whole) { return pieceFrom(whole.first, whole); }

Piece nextPiece(Piece piece, Interval whole) { return pieceFrom(piece.last, whole); }

void countDropped() {
    if (lostSegments > 0u) {
        atomicAdd(droppedSegments, lostSegments);
        atomicAdd(droppedLight, uint(lost * 1024.0 + 0.5));
    }
    if (merged > 0u) atomicAdd(mergedSegments, merged);
}
