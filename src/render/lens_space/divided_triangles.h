#pragma once
// Divides triangles for the lens-space methods, because the circle of confusion C is not linear inside them. Each
// triangle of an object becomes n² small triangles, with C evaluated at their corners. All triangles of an object are
// divided equally, so that no gaps open between them.

#include <filesystem>
#include <vector>

#include "gl/buffer.h"
#include "gl/program.h"
#include "plan/frame_plan.h"

namespace defocus::engine {

// Range of triangles, each of which is divided into `parts`² small triangles.
struct DividedRun {
    std::uint32_t firstBase = 0;  // index of the range's first triangle in the buffer of undivided triangles
    std::uint32_t baseCount = 0;
    std::uint32_t parts = 1;
    std::uint32_t firstVertex = 0;    // index of the first new vertex among the frame's vertices
    std::uint32_t firstTriangle = 0;  // index of the first small triangle among the frame's triangles

    [[nodiscard]] std::uint64_t vertexCount() const { return std::uint64_t{baseCount} * (parts + 1) * (parts + 2) / 2; }
    [[nodiscard]] std::uint64_t triangleCount() const { return std::uint64_t{baseCount} * parts * parts; }
};

// Max number of small triangles of a frame. Their vertices fit into 128 MiB, the smallest max buffer size of the
// supported drivers (Mesa's llvmpipe).
inline constexpr double maxSmallTriangles = 1'000'000;

// Returns the number of parts n ≤ 64 into which each edge is divided, so that the circle of confusion deviates from
// linear by at most `tolerance` px. n is limited so that the object's `triangles` triangles become at most
// `maxTriangles` small triangles.
std::uint32_t partsOfEdges(const ObjectPlan& object, std::uint64_t triangles, double tolerance, double maxTriangles);

class DividedTriangles {
public:
    explicit DividedTriangles(std::filesystem::path shaderFolder, bool lightsVertices);

    // Removes all ranges of triangles. `defines`: preprocessor macros of the shaders, see LensFront::defines().
    void start(const ShaderDefines& defines);
    void add(const DividedRun& run) { runs_.push_back(run); }
    [[nodiscard]] bool empty() const { return runs_.empty(); }
    // Writes the small triangles. Needs buffers at storage binding points 1 (undivided triangles) and 2 (the frame's
    // triangles), and with per-vertex lighting also at 3 (the first triangle of each vertex).
    void makeTriangles(const Buffer& bases) const;
    // Both functions write the vertices of the small triangles to the buffer that holds the vertices of the undivided
    // triangles: makeClips() their clip positions, makeAttributes() their attributes.
    void makeClips(const Buffer& bases, const Buffer& clips, const Buffer& ownBlurs) const;
    void makeAttributes(const Buffer& bases, const Buffer& attributes) const;

private:
    void dispatch(const Program& program, const Buffer& bases, bool triangles) const;

    std::filesystem::path shaderFolder_;
    std::vector<DividedRun> runs_;
    ShaderDefines defines_;
    Program trianglesProgram_, clipsProgram_, attributesProgram_;
};

}  // namespace defocus::engine
