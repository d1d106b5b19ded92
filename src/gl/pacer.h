#pragma once
// Limits the number of triangles that are submitted but not yet drawn. Mesa's llvmpipe keeps all submitted triangles in
// memory until its rasterizer reaches them, which can take gigabytes. GPU drivers need no limit.

#include <cstdint>
#include <deque>

#include "gl/fence.h"

namespace defocus::engine {

// Memory of one pending triangle in llvmpipe, in bytes, measured.
inline constexpr std::uint64_t pendingTriangleBytes = 224;

class SubmissionPacer {
public:
    static constexpr std::uint64_t defaultBytes = 1'500'000 * pendingTriangleBytes;

    // `bytes`: max memory that a software driver may use for triangles that are not yet drawn.
    explicit SubmissionPacer(std::uint64_t bytes = defaultBytes);

    // Returns the maximum number of triangles per draw call; 0: unlimited.
    [[nodiscard]] std::uint64_t maxTriangles() const { return batch_; }
    // Records a draw call of `triangles` triangles; call it after each draw call. Waits for earlier draw calls if too
    // many triangles are pending.
    void submitted(std::uint64_t triangles);

private:
    std::uint64_t batch_ = 0;  // number of triangles after which a fence is inserted; 0: no fences
    std::uint64_t open_ = 0;   // triangles since the last fence
    std::deque<Fence> fences_;
};

}  // namespace defocus::engine
