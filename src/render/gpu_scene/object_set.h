#pragma once

#include <cstddef>
#include <vector>

namespace defocus::engine {

// Subset of a plan's objects, as one flag per object. An empty vector stands for all objects.
using ObjectSet = std::vector<bool>;

inline bool contains(const ObjectSet& set, std::size_t object) {
    return set.empty() || set[object];
}

}  // namespace defocus::engine
