#pragma once

#include <cstddef>
#include <vector>

namespace defocus::engine {

// A subset of a plan's objects: one flag per object. An empty set stands for all objects.
using ObjectSet = std::vector<bool>;

inline bool contains(const ObjectSet& set, std::size_t object) {
    return set.empty() || set[object];
}

}  // namespace defocus::engine
