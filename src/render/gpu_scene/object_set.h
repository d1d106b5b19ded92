#pragma once

#include <cstddef>
#include <vector>

namespace defocus::engine {

// Some of a plan's objects: whether each is among them. An empty set stands for all.
using ObjectSet = std::vector<bool>;

inline bool contains(const ObjectSet& set, std::size_t object) {
    return set.empty() || set[object];
}

}  // namespace defocus::engine
