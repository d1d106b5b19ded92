// Kernel 3 of the method "line": finds the surfaces that are visible along each line across the lens, for the line
// samples of a tile's pixels. The including file (exact.comp, published.comp) chooses how the segments of a line are
// stored.

bool mayCover(vec4 corners[3], Bounds bounds, vec2 tileMin, vec2 tileMax) {
    vec2 minimum = vec2(1e30);
    vec2 maximum = vec2(-1e30);
    float aspect = float(imageSize.x) / float(imageSize.y);
    vec2 across = bounds.strip.xy * vec2(1.0, 1.0 / aspect);
    vec2 range = vec2(1e30, -1e30);
    for (uint i = 0u; i < 3u; ++i) {
        if (corners[i].z < frame.projection.z) return true;
        float blur = corners[i].w / corners[i].z;
        vec2 place = corners[i].xy / corners[i].z;
        vec2 a = place + blur * bounds.box.xy;
        vec2 b = place + blur * bounds.box.zw;
        minimum = min(minimum, min(a, b));
        maximum = max(maximum, max(a, b));
        float leaves = abs(blur) * bounds.strip.z;
        range = vec2(min(range.x, dot(place, across) - leaves), max(range.y, dot(place, across) + leaves));
    }
    if (any(greaterThan(minimum, tileMax)) || any(lessThan(maximum, tileMin))) return false;
    vec2 middle = 0.5 * (tileMin + tileMax);
    float reach = dot(0.5 * (tileMax - tileMin), abs(across));
    return range.x <= dot(middle, across) + reach && range.y >= dot(middle, across) - reach;
}

// Returns the number of shading points of the visible piece from p1 to p2. The surface moves in the image as the lens
// point moves along the piece; there is one shading point per shadingStep px of this movement.
uint shadingPoints(uint triangle, float p1, float p2, vec2 direction) {
    if (shadingStep == 0.0) return 1u;
    float blur = 0.0;   // CoC diameter, as a fraction of the image's width
    if (triangle == noTriangle) {
        // Only an environment map varies enough within the background's blur to need several shading points; other
        // backgrounds need one.
        if (backgroundType == 3) blur = frame.coc.w;
    } else {
        uvec4 vertices = triangles[triangle];
        for (int i = 0; i < 3; ++i) {
            vec4 clip = clips[vertices[i]];
            blur = max(blur, abs(clip.w) / max(clip.z, frame.projection.z));
        }
    }
    // Distance in px that the surface moves in the image as the lens point moves from p1 to p2.
    float way = 0.5 * abs(blur) * (p2 - p1) * length(direction * vec2(imageSize));
    return uint(clamp(ceil(way / shadingStep), 1.0, float(maxShadingPoints)));
}

uint recordsOf(uint triangle, float p1, float p2, vec2 direction) { return p2 > p1 ? shadingPoints(triangle, p1, p2, direction) : 0u; }

uint writeRecords(uint at, uint ray, uint triangle, float p1, float p2, Ray mine) {
    uint count = recordsOf(triangle, p1, p2, mine.lensAndPixel.xy);
    vec2 sides = mine.values.xy;
    for (uint i = 0u; i < count; ++i) {
        float from = i == 0u ? p1 : placeOfShare(p1, p2, float(i) / float(count));
        float to = i + 1u == count ? p2 : placeOfShare(p1, p2, float(i + 1u) / float(count));
        // With shadingStep = 0, the middle of the segment is shaded, as in Tzeng et al. 2012. Otherwise a random
        // position is shaded, so that the expected value is the mean radiance along the segment.
        float place = shadingStep == 0.0 ? 0.5 * (from + to) : placeOfShare(from, to, mine.values.z);
        records[at + i] = Record(triangle, ray, place, lightBetween(from, to, sides));
    }
    return count;
}

// Collects in `kept` the next triangles that the tile's line samples may hit, from entry `base` of the tile's list on.
// Stops after maxKept triangles or maxScans scans, each of which tests one entry per thread. All threads must call this
// function. The triangles stay in list order, because the order determines which segments a full segment buffer drops.
void keepMore(inout uint base, uint end, uint ray, vec2 tileMin, vec2 tileMax) {
    uint count = 0u;
    uint word = gl_LocalInvocationIndex >> 5u;
    uint bit = 1u << (gl_LocalInvocationIndex & 31u);
    for (uint scans = 0u; scans < maxScans && base < end && count < maxKept; ++scans) {
        ++commonRounds;
        if (gl_LocalInvocationIndex == 0u) {
            keptHere[0] = 0u;
            keptHere[1] = 0u;
            nextBase = base + threads;
        }
        barrier();
        uint at = base + gl_LocalInvocationIndex;
        uvec2 candidate = uvec2(noTriangle, 0u);
        vec4 corners[3];
        if (at < end) {
            uvec4 vertices = triangles[entries[at]];
            Draw draw = draws[vertices.w];
            for (int i = 0; i < 3; ++i) corners[i] = clips[vertices[i]];
            if (firstRay + ray >= draw.firstRay && firstRay + ray < draw.endRay &&
                mayCover(corners, lensBounds[ray], tileMin, tileMax)) {
                candidate = uvec2(entries[at], draw.doubleSided);
                atomicOr(keptHere[word], bit);
            }
        }
        barrier();
        uint slot = count + bitCount(keptHere[word] & (bit - 1u)) + (word == 1u ? bitCount(keptHere[0]) : 0u);
        count += bitCount(keptHere[0]) + bitCount(keptHere[1]);
        if (candidate.x != noTriangle) {
            if (slot < maxKept) {
                kept[slot] = candidate;
                for (uint i = 0u; i < 3u; ++i) keptCorners[slot * 3u + i] = corners[i];
            } else {
                atomicMin(nextBase, at);
            }
        }
        barrier();
        base = nextBase;
        barrier();
    }
    if (gl_LocalInvocationIndex == 0u) {
        keptCount = min(count, maxKept);
        halted = 0u;
        open = 0u;
    }
    barrier();
}

bool isOpen() {
    if (keptCount == 0u) return true;
    float minimum = min(min(keptCorners[0].z, keptCorners[1].z), keptCorners[2].z);
    return minimum < frame.projection.z || maySee(1.0 / minimum);
}

OnLine keptOnLine(uint i, vec2 direction, vec2 place) {
    return onLine(keptCorners[3u * i], keptCorners[3u * i + 1u], keptCorners[3u * i + 2u], direction, place);
}

// Returns bit masks of the triangles in `kept` that may be visible on this thread's line: xy for front faces, zw for
// back faces. addSeen() then adds the nth visible triangle of every line in iteration n, so that SIMD lanes rarely
// idle.
uvec4 seenOfKept(vec2 direction, vec2 place, Interval whole) {
    uvec4 sides = uvec4(0u);
    for (uint i = 0u; i < keptCount; ++i) {
        ++commonRounds;
        OnLine line = keptOnLine(i, direction, place);
        bool front = mayChange(seen(line, whole), line);
        line = turned(line);
        bool back = kept[i].y != 0u && mayChange(seen(line, whole), line);
        uint bit = 1u << (i & 31u);
        uvec2 word = i < 32u ? uvec2(bit, 0u) : uvec2(0u, bit);
        if (front) sides.xy |= word;
        if (back) sides.zw |= word;
    }
    return sides;
}

// Adds to this thread's line the segments of the triangles whose bits are set in `sides`, the result of seenOfKept(),
// and clears these bits. Stops when the max number of loop iterations is reached.
void addSeen(inout uvec4 sides, vec2 direction, vec2 place, Interval whole) {
    while (sides != uvec4(0u) && hasRoundsFor(0u, maxRounds)) {
        ++ownRounds;
        uvec2 either = sides.xy | sides.zw;
        uint i = either.x != 0u ? uint(findLSB(either.x)) : 32u + uint(findLSB(either.y));
        uint bit = 1u << (i & 31u);
        uvec2 word = i < 32u ? uvec2(bit, 0u) : uvec2(0u, bit);
        bool front = (sides.xy & word) != uvec2(0u);
        OnLine line = keptOnLine(i, direction, place);
        if (!front) line = turned(line);
        addSegment(seen(line, whole), kept[i].x, line, front);
        if (front) sides.xy &= ~word;
        else sides.zw &= ~word;
    }
}

void main() {
    uint slot = gl_WorkGroupID.x;
    uint job = jobs.y + 2u * slot;
    uint tile = firstTile + gl_WorkGroupID.x;
    uint ray = gl_WorkGroupID.y;
    uint status = jobIsNew;
    if (jobs.x != 0u) {
        tile = ranges[job].x;
        ray = ranges[job].y;
        status = ranges[job + 1u].y;
        if (status == jobIsDone) return;
    }
    uint across = uint(imageSize.x + tileSize - 1) / uint(tileSize);
    uvec2 corner = uvec2(tile % across, tile / across) * uint(tileSize);
    uvec2 pixel = corner + gl_LocalInvocationID.xy;
    Ray mine = rayOf(ray, pixel);
    vec2 place = placeOf(mine, pixel);
    vec2 direction = mine.lensAndPixel.xy;
    Interval whole = Interval(-mine.values.x, 1.0);
    vec2 margin = vec2(2e-3) / vec2(imageSize);   // 0.001 px
    vec2 tileMin = 2.0 * vec2(corner) / vec2(imageSize) - 1.0 - margin;
    vec2 tileMax = 2.0 * vec2(corner + uint(tileSize)) / vec2(imageSize) - 1.0 + margin;

    beginLine(mine.values.xy);
    uint base = tile == firstTile ? 0u : tileEnds[tile - 1u];
    uint end = tileEnds[tile];
    if (binSize > 0u) end = min(end, base + binSize);
    uvec4 sides = uvec4(0u);
    uint state = jobs.z + (slot * threads + gl_LocalInvocationIndex) * (2u + stateSize);
    if (status != jobIsNew) {
        base = ranges[job + 1u].x;
        sides = uvec4(ranges[state], ranges[state + 1u]);
        loadLine(state + 2u);
    }
    bool finished = false;
    while (!finished) {
        uint first = base;
        keepMore(base, end, ray, tileMin, tileMax);
        // Triangles are sorted by min depth. A line is open if the next triangle may be visible on it. The tile is
        // finished once none of its lines is open.
        if (isOpen()) atomicOr(open, 1u);
        barrier();
        if (open == 0u) {
            sides = uvec4(0u);
            base = end;
        } else if (status != jobHasSeen) {
            sides = seenOfKept(direction, place, whole);
        }
        addSeen(sides, direction, place, whole);
        finished = base >= end;
        status = jobGoesOn;
        if (maxRounds == 0u) continue;
        if (sides != uvec4(0u)) atomicOr(halted, hasSegments);
        else if (finished ? !hasRoundsFor(walkRounds(), 2u * maxRounds) : !hasRoundsFor(0u, maxRounds)) atomicOr(halted, hasNoRounds);
        barrier();
        if ((halted & hasSegments) != 0u) {
            base = first;
            status = jobHasSeen;
        }
        if (halted == 0u) continue;

        // A job that does not finish in the first dispatch is put off and starts again in a later dispatch, because the
        // buffer may have no room for the states of all jobs. Later dispatches save the state of an unfinished job.
        bool putOff = jobs.x == 0u;
        if (gl_LocalInvocationIndex == 0u) {
            if (putOff) {
                uint later = jobs.w + 2u * atomicAdd(laterJobs, 1u);
                ranges[later] = uvec2(tile, ray);
                ranges[later + 1u] = uvec2(0u, jobIsNew);
            } else {
                atomicAdd(unfinishedJobs, 1u);
                ranges[job + 1u] = uvec2(base, status);
            }
        }
        if (putOff) return;
        ranges[state] = sides.xy;
        ranges[state + 1u] = sides.zw;
        saveLine(state + 2u);
        return;
    }
    if (jobs.x != 0u && gl_LocalInvocationIndex == 0u) ranges[job + 1u].y = jobIsDone;
    if (any(greaterThanEqual(pixel, uvec2(imageSize)))) return;
    uint index = (ray * uint(imageSize.y) + pixel.y) * uint(imageSize.x) + pixel.x;

    // Visits the visible pieces of the line twice: first to count the records (ray hits), then to write them.
    uint needed = 0u;
    for (Piece piece = firstPiece(whole); piece.last > piece.first; piece = nextPiece(piece, whole))
        needed += recordsOf(piece.triangle, piece.first, piece.last, direction);
    uint at = atomicAdd(recordCount, needed);
    ranges[index] = uvec2(at, needed);
    countDropped();
    if (at + needed > recordCapacity) return;   // the CPU enlarges the buffer and repeats the draw
    for (Piece piece = firstPiece(whole); piece.last > piece.first; piece = nextPiece(piece, whole))
        at += writeRecords(at, index, piece.triangle, piece.first, piece.last, mine);
}
