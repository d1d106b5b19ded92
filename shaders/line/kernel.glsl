// Declares the inputs and outputs of the kernel that finds the visible segments of line samples, which are lines across
// the lens. A workgroup processes one tile and one line sample of each of the tile's pixels.

#include "include/frame.glsl"
#include "include/lens.glsl"
#include "lens_space/triangles.glsl"
#include "lens_space/rays.glsl"
#include "lens_space/records.glsl"
#include "line/line.glsl"
#include "line/weights.glsl"

layout(local_size_x = tileSize, local_size_y = tileSize) in;

layout(std430, binding = 3) readonly buffer DrawBlock { Draw draws[]; };
// End of each tile's triangle list, as an index into `entries`.
layout(std430, binding = 4) readonly buffer TileBlock { uint tileEnds[]; };
layout(std430, binding = 5) readonly buffer EntryBlock { uint entries[]; };
layout(std430, binding = 1) buffer OutputBlock {
    uint recordCount;       // number of records (ray hits) that all lines together need
    uint droppedSegments;
    uint droppedLight;      // sum over all lines of the fraction of light in dropped segments, in units of 1/1024
    uint mergedSegments;
    uint laterJobs;         // jobs deferred to later dispatches
    uint unfinishedJobs;    // jobs of this dispatch that are not finished
    // The array has three ranges. The first holds (index of the first record, number of records) for each line that is
    // traced in this draw. The second holds two elements for each deferred job: (tile, line), and (index of the next
    // entry in the tile's triangle list, status such as jobIsNew). The third holds the states of the lines of
    // unfinished jobs, saved between dispatches.
    uvec2 ranges[];
};
// Bounds of one line sample. The angle of its line may differ slightly between pixels (rays.glsl); the bounds include
// the lines of all pixels.
struct Bounds {
    // Bounding box of the lines. xy: min (u, k·v); zw: max (u, k·v), for lens points (u, v) of the unit disk and the
    // image's aspect ratio k.
    vec4 box;
    // xy: unit vector in (u, v) perpendicular to the mean of the lines; z: max distance of their points from the mean
    // line.
    vec4 strip;
};
layout(std140, binding = 7) uniform BoundBlock { Bounds lensBounds[maxRays]; };

layout(location = 2) uniform uint firstTile;       // first tile whose triangle list is in `entries`
layout(location = 3) uniform uint recordCapacity;
// From the lens point at one end of a segment to the lens point at its other end, the visible surface moves in the
// image. The segment has one shading point per shadingStep px of this movement; 0: one shading point per segment.
layout(location = 5) uniform float shadingStep;
// A job is the work of a workgroup: one tile, and one line sample of each of its pixels. Mesa's software driver ends
// the loops of a thread after a total of 65,535 iterations (rounds). Jobs that need more continue in later dispatches.
layout(location = 6) uniform uint maxRounds;      // approximate max number of iterations per dispatch; 0: unlimited
// x: 1 to run deferred jobs, 0 to run the jobs of all tiles and lines. The other components are indices into `ranges`.
// y: first deferred job to run; z: first saved state of a line; w: where this dispatch stores the jobs that it defers.
layout(location = 7) uniform uvec4 jobs;

layout(location = 8) uniform uint binSize;         // max triangles per tile; only the nearest are kept; 0: unlimited

const uint threads = uint(tileSize * tileSize);
const uint maxKept = 64u;
// Max number of scans of the tile's triangle list before the segments of the triangles found so far are added to the
// lines. A scan tests one entry per thread.
const uint maxScans = 1024u;
shared vec4 keptCorners[maxKept * 3u];
shared uvec2 kept[maxKept];    // triangles that the tile's line samples may hit; x: index, y: 1 if double-sided, else 0
shared uint keptHere[2];        // one bit per thread: set if the thread's triangle is added to `kept`
shared uint keptCount;
shared uint nextBase;
shared uint open;               // 1 if any line of the job may still hit later triangles of the list
shared uint halted;             // bits set by threads to interrupt the job: hasSegments, hasNoRounds

const uint hasSegments = 1u;    // a thread has visible segments that it has not yet added to its line
const uint hasNoRounds = 2u;    // a thread has reached the max number of loop iterations

// Status of a job. jobGoesOn: the job resumes at the saved entry of the tile's triangle list. jobHasSeen: the job also
// resumes at this entry, and saved bit masks mark the visible triangles among the next ones, which must still be added
// to lines.
const uint jobIsNew = 0u;
const uint jobGoesOn = 1u;
const uint jobHasSeen = 2u;
const uint jobIsDone = 3u;

// Max number of threads per SIMD vector. All threads of a vector run as many iterations of a loop as the thread that
// needs most.
const uint widestVector = 16u;
// Counts that hasRoundsFor() compares with the driver's limit on iterations:
uint commonRounds = 0u;         // iterations so far of loops that run equally often in all threads
uint ownRounds = 0u;            // this thread's iterations so far of all other loops

bool hasRoundsFor(uint more, uint maximum) { return maxRounds == 0u || commonRounds + widestVector * ownRounds + more < maximum; }
