#pragma once
// Keeps the work that the driver has taken but not finished within bounds. A GPU needs no help; a software driver
// (Mesa's llvmpipe) keeps every submitted triangle with its attributes in memory until its rasteriser gets there, and
// lets gigabytes pile up when that is the slower side.

#include <cstdint>
#include <deque>

#include "gl/handle.h"

namespace defocus::engine {

class SubmissionPacer {
public:
    SubmissionPacer();
    ~SubmissionPacer();
    SubmissionPacer(const SubmissionPacer&) = delete;
    SubmissionPacer& operator=(const SubmissionPacer&) = delete;

    // Most triangles that one draw call should hold; 0: any number.
    [[nodiscard]] std::uint64_t maxTriangles() const { return batch_; }
    // To be called after a draw call; waits for earlier ones where too many are open.
    void submitted(std::uint64_t triangles);

private:
    std::uint64_t batch_ = 0;  // triangles between two fences; 0: no pacing
    std::uint64_t open_ = 0;   // triangles since the last fence
    std::deque<GLsync> fences_;
};

}  // namespace defocus::engine
