#pragma once
// Which part of a mesh is nearest? A k-d tree over the centres of components (Bentley 1975, Multidimensional Binary
// Search Trees): the middle of each range parts it. Private to simplify_components.cpp.

#include <algorithm>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "lod/simplify/state.h"

namespace defocus {

// Of the components that are not removed. Keeps a reference to `components`.
class CentreTree {
public:
    explicit CentreTree(const std::vector<Component>& components) : components_(components) {
        for (std::uint32_t c = 0; c < components.size(); ++c)
            if (!components[c].removed) order_.push_back(c);
        build(0, order_.size(), 0);
    }

    // The nearest that counts(component), in the units of the centres, or Corner::none; the search gives up after
    // mostVisits, so that it may miss one among many that don't count.
    template <typename Counts>
    [[nodiscard]] std::uint32_t nearest(const glm::dvec3& point, const Counts& counts) const {
        Search search{point};
        visit(0, order_.size(), 0, search, counts);
        return search.best;
    }

private:
    static constexpr std::uint32_t mostVisits = 4096;

    struct Search {
        glm::dvec3 point;
        double leastSquared = std::numeric_limits<double>::infinity();
        std::uint32_t best = Corner::none;
        std::uint32_t visits = 0;
    };

    [[nodiscard]] const glm::dvec3& centre(std::size_t i) const { return components_[order_[i]].ball.centre; }

    void build(std::size_t begin, std::size_t end, int axis) {
        if (end - begin < 2) return;
        const std::size_t middle = begin + (end - begin) / 2;
        const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
        std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t a, std::uint32_t b) {
            return components_[a].ball.centre[axis] < components_[b].ball.centre[axis];
        });
        build(begin, middle, (axis + 1) % 3);
        build(middle + 1, end, (axis + 1) % 3);
    }

    template <typename Counts>
    void visit(std::size_t begin, std::size_t end, int axis, Search& search, const Counts& counts) const {
        if (begin >= end || ++search.visits > mostVisits) return;
        const std::size_t middle = begin + (end - begin) / 2;
        const glm::dvec3 offset = search.point - centre(middle);
        const double squared = glm::dot(offset, offset);
        if (squared < search.leastSquared && counts(order_[middle])) {
            search.leastSquared = squared;
            search.best = order_[middle];
        }
        const bool below = offset[axis] < 0;
        const int next = (axis + 1) % 3;
        visit(below ? begin : middle + 1, below ? middle : end, next, search, counts);
        if (offset[axis] * offset[axis] < search.leastSquared)
            visit(below ? middle + 1 : begin, below ? end : middle, next, search, counts);
    }

    const std::vector<Component>& components_;
    std::vector<std::uint32_t> order_;
};

}  // namespace defocus
