// Keeps the segments of a line in a fixed-size buffer in shared memory, as in Tzeng et al. 2012. Each incoming segment
// passes these steps in order:
//   occlusion   it is dropped if a stored segment hides it, and removes stored segments that it hides;
//   merge       it is joined with a stored segment that it continues, if colours, depths, orientations and slopes agree
//               within the tolerances below;
//   length      it is dropped if it is too short;
//   eviction    if the buffer is full, the shortest segment is dropped.
// The paper gives no thresholds; the constants below are this program's choice. After all segments have arrived, a
// sweep along the line finds the nearest segments. Where segments intersect, the sweep switches between them only at an
// end of a segment.
//
// With shortIntervals, the interval of a segment takes 16 bits, 8 for each end, beside its colour (16 bits) and depth.
// In the paper, an entire segment takes 16 bits.

struct Piece {
    float first;
    float last;
    uint triangle;
    float nextLast;      // end of the part of the line after this piece
    uint nextTriangle;   // triangle visible in the part of the line after this piece
};

struct Segment {
    vec2 ends;        // positions p along the line of the segment's two ends
    vec2 depths;      // inverse depth 1/w at both ends
    uint triangle;
    bool front;       // true: the triangle's front is visible
    vec3 color;       // radiance in the middle of the segment, mapped to [0, 1]; set only if vertices are lit
};

const float minLength = 1.0 / 512.0;         // min length of a kept segment, as a fraction of the line
// Two segments are joined only if no colour channel differs by more than this.
const float sameColor = 1.0 / 16.0;
// Two segments are joined only if 1/w (w: depth) at their common end differs by at most this fraction.
const float sameDepth = 0.02;
// Two segments are joined only if the difference of their slopes d(1/w)/dp, times their total length, is at most this
// fraction of 1/w. p: position along the line; w: depth.
const float sameSlope = 0.02;
// Max gap, in position p along the line, between a segment and its continuation.
const float continuation = shortIntervals ? 1.0 / 127.0 : 1e-3;

const uint slots = threads * uint(segmentCapacity);
shared vec2 longEnds[shortIntervals ? 1u : slots];
shared uint endsAndColors[slots];            // upper 16 bits: colour; lower: both ends if shortIntervals, else unused
shared vec2 segmentDepths[slots];
shared uint segmentTriangles[slots];         // index of the triangle; bit 31 is set if its back is visible
const uint backBit = 0x80000000u;
uint segmentCount = 0u;
vec2 lineSides;
float lost = 0.0;
uint lostSegments = 0u;
uint merged = 0u;
float hidden = 0.0;      // a segment over the entire line hides all surfaces with an inverse depth 1/w below this

#ifdef LIGHTS_VERTICES
// Two values per vertex: the radiance of the front, then the radiance of the back.
layout(std430, binding = 8) readonly buffer LightBlock { vec4 lights[]; };

// Returns the radiance L of a triangle at position p along the line, mapped to [0, 1] by L / (1 + L) for storage in few
// bits.
vec3 colorAt(uint triangle, OnLine line, bool front, float p) {
    vec3 edges = line.edgesAt0 + p * line.edgeSlopes;
    vec3 weights = edges / (edges.x + edges.y + edges.z);
    uvec3 at = 2u * triangles[triangle].xyz + (front ? 0u : 1u);
    vec3 light = max(weights.x * lights[at.x].rgb + weights.y * lights[at.y].rgb + weights.z * lights[at.z].rgb, vec3(0.0));
    return light / (1.0 + light);
}
#else
vec3 colorAt(uint triangle, OnLine line, bool front, float p) { return vec3(0.0); }
#endif

uint slotOf(uint i) { return i * threads + gl_LocalInvocationIndex; }   // adjacent threads access adjacent elements

void beginLine(vec2 sides) { lineSides = sides; }

float lineLength() { return 1.0 + lineSides.x; }

uint shortEnd(float p) { return uint(clamp(round((p + lineSides.x) / lineLength() * 255.0), 0.0, 255.0)); }
float fromShortEnd(uint end) { return end == 255u ? 1.0 : float(end) / 255.0 * lineLength() - lineSides.x; }

// Returns the ends of a segment, rounded to the precision of the buffer.
vec2 storedEnds(vec2 ends) {
    return shortIntervals ? vec2(fromShortEnd(shortEnd(ends.x)), fromShortEnd(shortEnd(ends.y))) : ends;
}

void store(uint i, Segment segment) {
    uint at = slotOf(i);
    uvec3 color = uvec3(round(segment.color * vec3(31.0, 63.0, 31.0)));
    uint bits = (color.r << 11u | color.g << 5u | color.b) << 16u;
    if (shortIntervals) bits |= shortEnd(segment.ends.y) << 8u | shortEnd(segment.ends.x);
    else longEnds[at] = segment.ends;
    endsAndColors[at] = bits;
    segmentDepths[at] = segment.depths;
    segmentTriangles[at] = segment.triangle | (segment.front ? 0u : backBit);
}

Segment load(uint i) {
    uint at = slotOf(i);
    uint bits = endsAndColors[at];
    vec2 ends = shortIntervals ? vec2(fromShortEnd(bits & 255u), fromShortEnd((bits >> 8u) & 255u)) : longEnds[at];
    uint triangle = segmentTriangles[at];
    return Segment(ends, segmentDepths[at], triangle & ~backBit, (triangle & backBit) == 0u,
                   vec3(bits >> 27u, (bits >> 21u) & 63u, (bits >> 16u) & 31u) / vec3(31.0, 63.0, 31.0));
}

float lengthOf(Segment segment) { return (segment.ends.y - segment.ends.x) / lineLength(); }

float inverseDepthAt(Segment segment, float p) {
    return mix(segment.depths.x, segment.depths.y, clamp((p - segment.ends.x) / (segment.ends.y - segment.ends.x), 0.0, 1.0));
}

// Returns true if segment `a` covers all of segment `b` and is at least as near as `b` at both ends of `b`.
bool hides(Segment a, Segment b) {
    return a.ends.x <= b.ends.x && a.ends.y >= b.ends.y && inverseDepthAt(a, b.ends.x) >= b.depths.x &&
           inverseDepthAt(a, b.ends.y) >= b.depths.y;
}

void drop(Segment segment) {
    lost += lightBetween(segment.ends.x, segment.ends.y, lineSides);
    ++lostSegments;
}

float slopeOf(Segment segment) { return (segment.depths.y - segment.depths.x) / max(segment.ends.y - segment.ends.x, 1e-6); }

// Returns true if the colours of two segments agree. Segments store no colour if vertices are not lit; they agree if
// they have the same object and material.
bool sameColors(Segment a, Segment b) {
    if (!lightsVertices) return triangles[a.triangle].w == triangles[b.triangle].w;
    return all(lessThanEqual(abs(a.color - b.color), vec3(sameColor)));
}

bool mergedInto(uint i, Segment segment) {
    Segment other = load(i);
    if (!sameColors(segment, other)) return false;
    bool after = abs(segment.ends.x - other.ends.y) <= continuation &&
                 abs(segment.depths.x - other.depths.y) <= sameDepth * other.depths.y;
    bool before = abs(segment.ends.y - other.ends.x) <= continuation &&
                  abs(segment.depths.y - other.depths.x) <= sameDepth * other.depths.x;
    if (!after && !before) return false;
    if (segment.front != other.front) return false;
    float both = segment.ends.y - segment.ends.x + other.ends.y - other.ends.x;
    if (abs(slopeOf(segment) - slopeOf(other)) * both > sameSlope * max(other.depths.x, other.depths.y)) return false;
    // The joined segment gets the triangle and the colour of the longer segment.
    Segment result = lengthOf(segment) > lengthOf(other) ? segment : other;
    result.ends = after ? vec2(other.ends.x, segment.ends.y) : vec2(segment.ends.x, other.ends.y);
    result.depths = after ? vec2(other.depths.x, segment.depths.y) : vec2(segment.depths.x, other.depths.y);
    store(i, result);
    ++merged;
    return true;
}

// Returns true if a surface at inverse depth 1/w may be visible on the line.
bool maySee(float inverseDepth) { return inverseDepth >= hidden * (1.0 - 1e-5); }

// Returns true if any part of a segment may be visible. Tests only the nearer end, because 1/w (w: depth) has its max
// on a segment at an end.
bool mayChange(Interval interval, OnLine line) {
    if (!(interval.last > interval.first)) return false;
    return maySee(max(inverseDepth(line, interval.first), inverseDepth(line, interval.last)));
}

void addSegment(Interval interval, uint triangle, OnLine line, bool front) {
    if (!(interval.last > interval.first)) return;
    Segment segment;
    segment.ends = storedEnds(vec2(interval.first, interval.last));
    segment.depths = vec2(inverseDepth(line, interval.first), inverseDepth(line, interval.last));
    segment.triangle = triangle;
    segment.front = front;
    segment.color = colorAt(triangle, line, front, 0.5 * (interval.first + interval.last));
    ownRounds += 3u * segmentCount;

    // Step "occlusion": drop the segment if a stored segment hides it, and remove stored segments that it hides.
    for (uint i = 0u; i < segmentCount; ++i)
        if (hides(load(i), segment)) return;
    if (segment.ends.x <= -lineSides.x && segment.ends.y >= 1.0) hidden = max(hidden, min(segment.depths.x, segment.depths.y));
    for (uint i = 0u; i < segmentCount;) {
        if (!hides(segment, load(i))) {
            ++i;
            continue;
        }
        --segmentCount;
        store(i, load(segmentCount));
    }

    // Step "merge": join the segment with a stored segment that it continues.
    for (uint i = 0u; i < segmentCount; ++i)
        if (mergedInto(i, segment)) return;

    // Step "length": drop segments that are too short.
    if (lengthOf(segment) < minLength) {
        segment.ends = vec2(interval.first, interval.last);
        drop(segment);
        return;
    }

    // Add the segment if the buffer has room. Otherwise (step "eviction"), drop the shortest segment.
    if (segmentCount < uint(segmentCapacity)) {
        store(segmentCount, segment);
        ++segmentCount;
        return;
    }
    uint shortest = 0u;
    float shortestLength = 2.0;
    for (uint i = 0u; i < segmentCount; ++i) {
        float length = lengthOf(load(i));
        if (length < shortestLength) {
            shortestLength = length;
            shortest = i;
        }
    }
    if (lengthOf(segment) <= shortestLength) {
        drop(segment);
        return;
    }
    drop(load(shortest));
    store(shortest, segment);
}

struct Part {
    float last;
    uint triangle;
};

// Returns the part of the line from p to the next start or end of any segment, with the nearest triangle in this part.
Part partFrom(float p, Interval whole) {
    float last = whole.last;
    for (uint i = 0u; i < segmentCount; ++i) {
        vec2 ends = load(i).ends;
        if (ends.x > p) last = min(last, ends.x);
        else if (ends.y > p) last = min(last, ends.y);
    }
    uint triangle = noTriangle;
    float middle = 0.5 * (p + last);
    float nearest = 0.0;
    for (uint i = 0u; i < segmentCount; ++i) {
        Segment segment = load(i);
        if (segment.ends.x > p || segment.ends.y <= p) continue;
        float here = inverseDepthAt(segment, middle);
        uint other = segment.triangle;
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

// Returns an upper bound on the loop iterations that writing the line's records (ray hits) will take.
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
        ranges[to] = floatBitsToUint(load(i).ends);
        ranges[to + 1u] = floatBitsToUint(segmentDepths[slotOf(i)]);
        ranges[to + 2u] = uvec2(segmentTriangles[slotOf(i)], endsAndColors[slotOf(i)]);
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
        if (!shortIntervals) longEnds[slotOf(i)] = uintBitsToFloat(ranges[from]);
        segmentDepths[slotOf(i)] = uintBitsToFloat(ranges[from + 1u]);
        segmentTriangles[slotOf(i)] = ranges[from + 2u].x;
        endsAndColors[slotOf(i)] = ranges[from + 2u].y;
    }
}

void countDropped() {
    if (lostSegments > 0u) {
        atomicAdd(droppedSegments, lostSegments);
        atomicAdd(droppedLight, uint(lost * 1024.0 + 0.5));
    }
    if (merged > 0u) atomicAdd(mergedSegments, merged);
}
