// Dijkstra 1959, A Note on Two Problems in Connexion with Graphs, with neighbours found in a grid over the image.

#include "plan/contact.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <queue>
#include <utility>

namespace defocus {

namespace {

constexpr double closedGap = 1;  // px
constexpr int mostGridSide = 32;

// Lists of objects by the cells of the image that they may be seen in. What lies outside is in the cells at the border.
class Grid {
public:
    explicit Grid(const std::vector<ContactBounds>& bounds)
        : bounds_(&bounds),
          side_(std::clamp(static_cast<int>(std::sqrt(bounds.size())), 1, mostGridSide)),
          cells_(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_)),
          visitedFrom_(bounds.size(), bounds.size()) {
        glm::dvec2 least(ContactBounds::infinity);
        glm::dvec2 most(-ContactBounds::infinity);
        for (const ContactBounds& b : bounds) {
            if (!std::isfinite(b.seenLeast.x)) continue;
            least = glm::min(least, b.seenLeast);
            most = glm::max(most, b.seenMost);
        }
        if (!(most.x > least.x) || !(most.y > least.y)) least = glm::dvec2(0), most = glm::dvec2(1);
        origin_ = least;
        cellsPerPixel_ = static_cast<double>(side_) / (most - least);
        for (std::uint32_t i = 0; i < bounds.size(); ++i)
            eachCell(bounds[i], 0, [&](std::vector<std::uint32_t>& cell) { cell.push_back(i); });
    }

    // Calls `visit` once with each other object that isn't settled and may lie within `reach` px of object i. Settled
    // objects are forgotten.
    template <typename Visit>
    void near(std::uint32_t i, double reach, const std::vector<bool>& settled, Visit visit) {
        eachCell((*bounds_)[i], reach, [&](std::vector<std::uint32_t>& cell) {
            for (std::size_t at = 0; at < cell.size();) {
                const std::uint32_t j = cell[at];
                if (settled[j]) {
                    cell[at] = cell.back();
                    cell.pop_back();
                    continue;
                }
                ++at;
                if (std::exchange(visitedFrom_[j], i) != i) visit(j);
            }
        });
    }

private:
    [[nodiscard]] int column(double pixel, int axis) const {
        const double at = std::floor((pixel - origin_[axis]) * cellsPerPixel_[axis]);
        return static_cast<int>(std::clamp<double>(at, 0, side_ - 1));
    }
    template <typename Visit>
    void eachCell(const ContactBounds& bounds, double reach, Visit visit) {
        const int right = column(bounds.seenMost.x + reach, 0);
        const int top = column(bounds.seenMost.y + reach, 1);
        for (int y = column(bounds.seenLeast.y - reach, 1); y <= top; ++y)
            for (int x = column(bounds.seenLeast.x - reach, 0); x <= right; ++x)
                visit(cells_[static_cast<std::size_t>(y) * static_cast<std::size_t>(side_) +
                             static_cast<std::size_t>(x)]);
    }

    const std::vector<ContactBounds>* bounds_;
    int side_;
    std::vector<std::vector<std::uint32_t>> cells_;
    std::vector<std::size_t> visitedFrom_;
    glm::dvec2 origin_{0};
    glm::dvec2 cellsPerPixel_{1};
};

}  // namespace

ContactBounds contactBounds(const ObjectPlan& object, const FramePlan& plan) {
    if (object.nearestDepth <= plan.view.nearPlane) return {};
    const double pixelsPerTangent = plan.view.width / (2 * plan.tanHalfHorizontal);
    const glm::dvec2 middle(plan.view.width / 2.0, plan.view.height / 2.0);
    ContactBounds bounds;
    bounds.seenLeast = glm::dvec2(ContactBounds::infinity);
    bounds.seenMost = glm::dvec2(-ContactBounds::infinity);
    for (const glm::dvec3& corner : object.viewBox.corners()) {
        const glm::dvec2 place = middle + glm::dvec2(corner) / -corner.z * pixelsPerTangent;
        bounds.seenLeast = glm::min(bounds.seenLeast, place);
        bounds.seenMost = glm::max(bounds.seenMost, place);
    }
    bounds.unit = 1 / pixelsPerTangent;
    bounds.least = glm::dvec3(glm::dvec2(object.viewBox.minimum), object.nearestDepth) * pixelsPerTangent;
    bounds.most = glm::dvec3(glm::dvec2(object.viewBox.maximum), object.farthestDepth) * pixelsPerTangent;
    return bounds;
}

double contactGap(const ContactBounds& a, const ContactBounds& b) {
    const auto apart = [](double leastA, double mostA, double leastB, double mostB) {
        return std::max(leastA - mostB, leastB - mostA);
    };
    double inImage = 0;
    double inSpace = 0;
    for (int axis = 0; axis < 2; ++axis)
        inImage = std::max(inImage, apart(a.seenLeast[axis], a.seenMost[axis], b.seenLeast[axis], b.seenMost[axis]));
    for (int axis = 0; axis < 3; ++axis)
        inSpace = std::max(inSpace, apart(a.least[axis], a.most[axis], b.least[axis], b.most[axis]));
    if (inSpace > 0) {
        // The farthest depth that both have, or the nearest that the one behind has: px are largest there.
        const double depth = std::max(std::min(a.most.z, b.most.z), std::max(a.least.z, b.least.z));
        inSpace /= depth * std::max(a.unit, b.unit);
    }
    return std::max(0.0, std::max(inImage, inSpace) - closedGap);
}

std::vector<double> spreadOverContact(const std::vector<ContactBounds>& bounds, std::vector<double> values,
                                      double least, double most) {
    std::priority_queue<std::pair<double, std::uint32_t>> open;
    for (std::uint32_t i = 0; i < values.size(); ++i) open.emplace(values[i], i);
    Grid grid(bounds);
    std::vector<bool> settled(values.size(), false);
    while (!open.empty()) {
        const auto [value, i] = open.top();
        open.pop();
        if (value <= least) break;
        if (settled[i]) continue;
        settled[i] = true;
        grid.near(i, most - least + closedGap, settled, [&, from = i, height = value](std::uint32_t j) {
            const double raised = height - contactGap(bounds[from], bounds[j]);
            if (raised <= values[j]) return;
            values[j] = raised;
            open.emplace(raised, j);
        });
    }
    return values;
}

}  // namespace defocus
