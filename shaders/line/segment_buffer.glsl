// Keeps the segments of a line in a fixed-size buffer in shared memory, as in Tzeng et al. 2012. Hidden segments and
// segments with a negligible fraction of the line's light are dropped. If the buffer is full, a new segment is merged
// with a segment that it continues on the same surface. Without such a segment, the segment with the smallest fraction
// of the light is dropped. A final sweep along the line finds the nearest segments. Where segments intersect, the sweep
// switches between them only at an end of a segment.

struct Piece {
    float first;
    float last;
    uint triangle;
    float nextLast;      // end of the next part of the line, in which another triangle is visible
    uint nextTriangle;   // triangle in the next part
};

const float minLight = 1.0 / 4096.0;       // min fraction of the line's light; smaller segments are dropped
const float continuation = 1e-3;             // max gap in p between a segment and its continuation
const float sameDepth = 0.02;                // max relative difference of 1/w at the gap

shared vec4 segments[threads * uint(segmentCapacity)];         // p at both ends, 1/w at both ends
shared uint segmentTriangles[threads * uint(segmentCapacity)];
uint segmentCount = 0u;
vec2 lineSides;
float lost = 0.0;
uint lostSegments = 0u;
uint merged = 0u;
float hidden = 0.0;      // surfaces with a smaller 1/w are hidden by a segment over the entire line

uint slotOf(uint i) { return i * threads + gl_LocalInvocationIndex; }   // adjacent threads access adjacent elements

void beginLine(vec2 sides) { lineSides = sides; }

float inverseDepthAt(vec4 segment, float p) {
    return mix(segment.z, segment.w, clamp((p - segment.x) / (segment.y - segment.x), 0.0, 1.0));
}

// Returns true if segment `a` covers all of segment `b` and is not farther at both ends of `b`.
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
    // The triangle with the longer segment provides the shading for both segments.
    if (segment.y - segment.x > other.y - other.x) segmentTriangles[slotOf(i)] = triangle;
    ++merged;
    return true;
}

// Returns true if a surface at inverse depth 1/w may be visible on the line.
bool maySee(float inverseDepth) { return inverseDepth >= hidden * (1.0 - 1e-5); }

// Returns true if any part of a segment may be visible. The max of 1/w on a segment is at one of the segment's ends.
bool mayChange(Interval interval, OnLine line) {
    if (!(interval.last > interval.first)) return false;
    return maySee(max(inverseDepth(line, interval.first), inverseDepth(line, interval.last)));
}

void addSegment(Interval interval, uint triangle, OnLine line) {
    if (!(interval.last > interval.first)) return;
    vec4 segment = vec4(interval.first, interval.last, inverseDepth(line, interval.first), inverseDepth(line, interval.last));
    if (lightBetween(segment.x, segment.y, lineSides) < minLight) {
        drop(segment);
        return;
    }
    ownRounds += 3u * segmentCount;
    for (uint i = 0u; i < segmentCount; ++i)
        if (hides(segments[slotOf(i)], segment)) return;
    if (segment.x <= -lineSides.x && segment.y >= 1.0) hidden = max(hidden, min(segment.z, segment.w));
    for (uint i = 0u; i < segmentCount;) {
        if (!hides(segment, segments[slotOf(i)])) {
            ++i;
            continue;
        }
        --segmentCount;
        segments[slotOf(i)] = segments[slotOf(segmentCount)];
        segmentTriangles[slotOf(i)] = segmentTriangles[slotOf(segmentCount)];
    }
    if (segmentCount == uint(segmentCapacity)) {
        uint minimum = 0u;
        float minShare = 2.0;
        for (uint i = 0u; i < segmentCount; ++i) {
            vec4 other = segments[slotOf(i)];
            if (mergedInto(i, segment, triangle)) return;
            float share = lightBetween(other.x, other.y, lineSides);
            if (share < minShare) {
                minShare = share;
                minimum = i;
            }
        }
        if (lightBetween(segment.x, segment.y, lineSides) <= minShare) {
            drop(segment);
            return;
        }
        drop(segments[slotOf(minimum)]);
        segments[slotOf(minimum)] = segment;
        segmentTriangles[slotOf(minimum)] = triangle;
        return;
    }
    segments[slotOf(segmentCount)] = segment;
    segmentTriangles[slotOf(segmentCount)] = triangle;
    ++segmentCount;
}

struct Part {
    float last;
    uint triangle;
};

// Returns the part of the line from p to the next start or end of any segment, with the nearest triangle in this part.
Part partFrom(float p, Interval whole) {
    float last = whole.last;
    for (uint i = 0u; i < segmentCount; ++i) {
        vec2 ends = segments[slotOf(i)].xy;
        if (ends.x > p) last = min(last, ends.x);
        else if (ends.y > p) last = min(last, ends.y);
    }
    uint triangle = noTriangle;
    float middle = 0.5 * (p + last);
    float nearest = 0.0;
    for (uint i = 0u; i < segmentCount; ++i) {
        vec4 segment = segments[slotOf(i)];
        if (segment.x > p || segment.y <= p) continue;
        float here = inverseDepthAt(segment, middle);
        uint other = segmentTriangles[slotOf(i)];
        if (here > nearest || (here == nearest && other < triangle)) {
            nearest = here;
            triangle = other;
        }
    }
    return Part(last, triangle);
}

// Returns the piece of the line that begins at p; `part` is the first part of the piece. Consecutive parts with the
// same triangle form one piece.
Piece pieceFrom(float p, Part part, Interval whole) {
    Piece piece = Piece(p, part.last, part.triangle, part.last, noTriangle);
    while (piece.last < whole.last) {
        Part next = partFrom(piece.last, whole);
        piece.nextLast = next.last;
        piece.nextTriangle = next.triangle;
        if (next.triangle != piece.triangle || !(next.last > piece.last)) break;
        piece.last = next.last;
    }
    return piece;
}

Piece firstPiece(Interval whole) { return pieceFrom(whole.first, partFrom(whole.first, whole), whole); }

Piece nextPiece(Piece piece, Interval whole) { return pieceFrom(piece.last, Part(piece.nextLast, piece.nextTriangle), whole); }

// Returns an upper bound on the loop iterations for writing the line's records (ray hits) at the end.
uint walkRounds() {
    uint parts = 2u * segmentCount + 1u;
    return parts * (4u * segmentCount + 2u + uint(maxShadingPoints));
}

const uint stateSize = 3u + 3u * uint(segmentCapacity);

void saveLine(uint at) {
    ranges[at] = uvec2(segmentCount, lostSegments);
    ranges[at + 1u] = uvec2(floatBitsToUint(lost), merged);
    ranges[at + 2u] = uvec2(floatBitsToUint(hidden), 0u);
    for (uint i = 0u; i < segmentCount; ++i) {
        uint to = at + 3u + 3u * i;
        vec4 segment = segments[slotOf(i)];
        ranges[to] = floatBitsToUint(segment.xy);
        ranges[to + 1u] = floatBitsToUint(segment.zw);
        ranges[to + 2u] = uvec2(segmentTriangles[slotOf(i)], 0u);
    }
}

void loadLine(uint at) {
    segmentCount = ranges[at].x;
    lostSegments = ranges[at].y;
    lost = uintBitsToFloat(ranges[at + 1u].x);
    merged = ranges[at + 1u].y;
    hidden = uintBitsToFloat(ranges[at + 2u].x);
    for (uint i = 0u; i < segmentCount; ++i) {
        uint from = at + 3u + 3u * i;
        segments[slotOf(i)] = vec4(uintBitsToFloat(ranges[from]), uintBitsToFloat(ranges[from + 1u]));
        segmentTriangles[slotOf(i)] = ranges[from + 2u].x;
    }
}

void countDropped() {
    if (lostSegments > 0u) {
        atomicAdd(droppedSegments, lostSegments);
        atomicAdd(droppedLight, uint(lost * 1024.0 + 0.5));
    }
    if (merged > 0u) atomicAdd(mergedSegments, merged);
}
