// Inputs of the kernel that finds the segments of lines. A workgroup processes one tile and one line of each of its
// pixels.

#include "include/frame.glsl"
#include "lens_space/triangles.glsl"
#include "lens_space/rays.glsl"
#include "lens_space/records.glsl"
#include "line/line.glsl"
#include "line/weights.glsl"

layout(local_size_x = tileSize, local_size_y = tileSize) in;

layout(std430, binding = 3) readonly buffer DrawBlock { Draw draws[]; };
// Ends of the tiles' triangle lists in the entries.
layout(std430, binding = 4) readonly buffer TileBlock { uint tileEnds[]; };
layout(std430, binding = 5) readonly buffer EntryBlock { uint entries[]; };
layout(std430, binding = 1) buffer OutputBlock {
    uint recordCount;       // number of requested records
    uint droppedSegments;
    uint droppedLight;      // in units of 1/1024 of a line
    uint mergedSegments;
    uint laterJobs;         // jobs deferred to later dispatches
    uint unfinishedJobs;    // jobs of this dispatch that are not finished
    // Per ray of the wave: first record, number of records. Then the deferred jobs, two elements each: (tile, ray) and
    // (next entry, status). Then the saved state of the lines of unfinished jobs.
    uvec2 ranges[];
};
struct Bounds {
    vec4 box;               // box of the line over the variants: min (u, k·v), max (u, k·v)
    // xy: unit vector across the line in (u, v); z: max offset of any variant from the middle along it.
    vec4 strip;
};
layout(std140, binding = 7) uniform BoundBlock { Bounds lensBounds[maxRays]; };

layout(location = 2) uniform uint firstTile;       // first tile that the entries cover
layout(location = 3) uniform uint recordCapacity;
// Surface motion in px that one shading point covers; 0: one shading point per segment.
layout(location = 5) uniform float shadingStep;
// A job is the work of a workgroup: one tile and one line of each of its pixels. Mesa's software driver ends the loops
// of a thread after a total of 65,535 rounds. Jobs that need more are deferred and continue in later dispatches.
layout(location = 6) uniform uint maxRounds;      // approximate limit on loop rounds per dispatch; 0: none
// x: 1 for deferred jobs, 0 for all tiles and rays; y: first job of the dispatch; z: start of the saved states; w:
// where to store deferred jobs. y, z and w are indices into `ranges`.
layout(location = 7) uniform uvec4 jobs;

const uint threads = uint(tileSize * tileSize);
const uint maxKept = 64u;
// Max number of scans before the kept triangles' segments are added. A scan covers as many entries as there are
// threads.
const uint maxScans = 1024u;
shared vec4 keptCorners[maxKept * 3u];
shared uvec2 kept[maxKept];    // triangle, double-sided
shared uint keptHere[2];        // one bit for each thread whose candidate is kept
shared uint keptCount;
shared uint nextBase;
shared uint open;               // true if some line may still see later triangles
shared uint halted;             // status of threads that ran out of rounds: the flags below

const uint hasSegments = 1u;    // visible segments are not yet added
const uint hasNoRounds = 2u;

const uint jobIsNew = 0u;
const uint jobGoesOn = 1u;      // continues with the triangles from the next entry on
const uint jobHasSeen = 2u;     // has scanned the triangles there; some segments are not yet added
const uint jobIsDone = 3u;

// A driver's vector of threads runs a loop as often as its slowest thread.
const uint widestVector = 16u;
uint commonRounds = 0u;         // rounds of loops that all threads run equally often
uint ownRounds = 0u;

bool hasRoundsFor(uint more, uint maximum) { return maxRounds == 0u || commonRounds + widestVector * ownRounds + more < maximum; }
