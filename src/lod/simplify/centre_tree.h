#pragma once
// The centres of components, to find the nearest of those that serve. nanoflann's k-d tree takes two thirds of the time
// that a tree of our own (the middle of each range parts it) took for 50,000 of them.

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <nanoflann.hpp>
#include <vector>

#include "lod/simplify/state.h"

namespace defocus {

class CentreTree {
public:
    // Holds the components that are not removed now. Keeps a reference to `components`.
    explicit CentreTree(const std::vector<Component>& components) : centres_(components), tree_(3, centres_) {}
    CentreTree(const CentreTree&) = delete;
    CentreTree& operator=(const CentreTree&) = delete;

    // The nearest component that counts(component), or an invalid number; `point` in the units of the centres. The
    // search gives up after mostVisits, so that it may miss one among many that don't count.
    template <typename Counts>
    [[nodiscard]] ComponentNumber nearest(const glm::dvec3& point, const Counts& counts) const {
        Search<Counts> search(centres_.numbers, counts);
        tree_.findNeighbors(search, &point.x, nanoflann::SearchParams());
        return search.best;
    }

private:
    static constexpr std::uint32_t mostVisits = 4096;

    // The points, as nanoflann reads them.
    struct Centres {
        const std::vector<Component>& components;
        std::vector<ComponentNumber> numbers;

        explicit Centres(const std::vector<Component>& all) : components(all) {
            for (std::uint32_t c = 0; c < all.size(); ++c)
                if (!all[c].removed) numbers.push_back({c});
        }
        [[nodiscard]] std::size_t kdtree_get_point_count() const { return numbers.size(); }
        [[nodiscard]] double kdtree_get_pt(std::size_t i, std::size_t axis) const {
            return components[numbers[i].value].ball.centre[static_cast<glm::length_t>(axis)];
        }
        template <typename Box>
        bool kdtree_get_bbox(Box&) const {
            return false;  // nanoflann finds it
        }
    };

    // What nanoflann hands the points that are nearer than the best to.
    template <typename Counts>
    struct Search {
        const std::vector<ComponentNumber>& numbers;
        const Counts& counts;
        double leastSquared = std::numeric_limits<double>::infinity();
        ComponentNumber best;
        std::uint32_t visits = 0;

        Search(const std::vector<ComponentNumber>& numbered, const Counts& counted)
            : numbers(numbered), counts(counted) {}
        [[nodiscard]] double worstDist() const { return leastSquared; }
        [[nodiscard]] bool full() const { return best.isValid(); }
        // False ends the search.
        bool addPoint(double squared, std::size_t i) {
            if (squared < leastSquared && counts(numbers[i])) {
                leastSquared = squared;
                best = numbers[i];
            }
            return ++visits < mostVisits;
        }
    };

    Centres centres_;
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Centres>, Centres, 3, std::uint32_t> tree_;
};

}  // namespace defocus
