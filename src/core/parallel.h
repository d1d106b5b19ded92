#pragma once
// Runs body(0) … body(count - 1) on all cores, each index once, in no set order; returns when all are done. The first
// exception of a body is thrown again in the caller. Results must not depend on the order.

#include <cstddef>
#include <functional>

namespace defocus {

void parallelFor(std::size_t count, const std::function<void(std::size_t)>& body);

}  // namespace defocus
