// Dijkstra 1959, A Note on Two Problems in Connexion with Graphs, with neighbours found in a grid over the image.

#include "plan/lens_cells/contact.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <queue>
#include <tuple>
#include <utility>

namespace defocus::engine {

namespace {

constexpr double closedGap = 1;  // px
constexpr int mostGridSide = 512;
constexpr std::size_t mostCellsAnObject = 4;  // on average

// Lists of objects by the cells of the image that they may be seen in. What lies outside is in the cells at the border.
// Each cell knows a value that none of its objects lies below, so that heaps of objects that have all been raised are
// passed over.
class Grid {
public:
    // `reach`: px, of near().
    Grid(const std::vector<ContactBounds>& bounds, double reach)
        : bounds_(&bounds),
          reach_(reach),
          side_(std::clamp(static_cast<int>(std::sqrt(bounds.size())), 1, mostGridSide)),
          visitedFrom_(bounds.size(), bounds.size()) {
        glm::dvec2 least(ContactBounds::infinity);
        glm::dvec2 most(-ContactBounds::infinity);
        for (const ContactBounds& b : bounds) {
            if (!std::isfinite(b.seenLeast.x)) continue;
            least = glm::min(least, b.seenLeast);
            most = glm::max(most, b.seenMost);
        }
        if (!(most.x >= least.x) || !(most.y >= least.y)) least = most = glm::dvec2(0);
        origin_ = least;
        extent_ = std::max({most.x - least.x, most.y - least.y, reach});
        side_ = std::min(side_, static_cast<int>(std::min<double>(extent_ / reach, mostGridSide)));
        while (side_ > 1 && cellsCovered() > mostCellsAnObject * bounds.size()) side_ /= 2;
        cells_.resize(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_));
        for (std::uint32_t i = 0; i < bounds.size(); ++i)
            eachCell(bounds[i], 0, [&](std::size_t cell) { cells_[cell].objects.push_back(i); });
    }

    // Calls `raise` once with each other object that isn't settled and may lie within reach of object i, unless its
    // value is values[i] already. `raise` may raise the object's value. Settled objects are forgotten.
    template <typename Raise>
    void near(std::uint32_t i, const std::vector<bool>& settled, const std::vector<double>& values, Raise raise) {
        eachCell((*bounds_)[i], reach_, [&](std::size_t number) {
            Cell& cell = cells_[number];
            if (cell.least >= values[i]) return;
            cell.least = ContactBounds::infinity;
            for (std::size_t at = 0; at < cell.objects.size();) {
                const std::uint32_t j = cell.objects[at];
                if (settled[j]) {
                    cell.objects[at] = cell.objects.back();
                    cell.objects.pop_back();
                    continue;
                }
                ++at;
                if (std::exchange(visitedFrom_[j], i) != i) raise(j);
                cell.least = std::min(cell.least, values[j]);
            }
        });
    }

private:
    struct Cell {
        std::vector<std::uint32_t> objects;
        double least = -ContactBounds::infinity;  // of their values, which never fall
    };

    [[nodiscard]] std::size_t cellsCovered() const {
        std::size_t count = 0;
        for (const ContactBounds& b : *bounds_) eachCell(b, 0, [&](std::size_t) { ++count; });
        return count;
    }
    [[nodiscard]] int column(double pixel, int axis) const {
        const double at = std::floor((pixel - origin_[axis]) / extent_ * side_);
        return static_cast<int>(std::clamp<double>(at, 0, side_ - 1));
    }
    template <typename Visit>
    void eachCell(const ContactBounds& bounds, double reach, Visit visit) const {
        const int right = column(bounds.seenMost.x + reach, 0);
        const int top = column(bounds.seenMost.y + reach, 1);
        for (int y = column(bounds.seenLeast.y - reach, 1); y <= top; ++y)
            for (int x = column(bounds.seenLeast.x - reach, 0); x <= right; ++x)
                visit(static_cast<std::size_t>(y) * static_cast<std::size_t>(side_) + static_cast<std::size_t>(x));
    }

    const std::vector<ContactBounds>* bounds_;
    double reach_;
    int side_;
    std::vector<Cell> cells_;
    std::vector<std::size_t> visitedFrom_;
    glm::dvec2 origin_{0};
    double extent_ = 1;  // px, of the square that the grid covers
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
    // Of equal values the one that was raised last is next: it lies at the front of what is being raised, and what is
    // behind the front has nothing left to raise.
    struct Open {
        double value;
        std::uint64_t turn;
        std::uint32_t object;
        bool operator<(const Open& other) const { return std::tie(value, turn) < std::tie(other.value, other.turn); }
    };
    std::priority_queue<Open> open;
    for (std::uint32_t i = 0; i < values.size(); ++i) open.push({values[i], i, i});
    std::uint64_t turn = values.size();
    Grid grid(bounds, most - least + closedGap);
    std::vector<bool> settled(values.size(), false);
    while (!open.empty()) {
        const double value = open.top().value;
        const std::uint32_t i = open.top().object;
        open.pop();
        if (value <= least) break;
        if (settled[i]) continue;
        settled[i] = true;
        grid.near(i, settled, values, [&](std::uint32_t j) {
            const double raised = value - contactGap(bounds[i], bounds[j]);
            if (raised <= values[j]) return;
            values[j] = raised;
            open.push({raised, turn++, j});
        });
    }
    return values;
}

}  // namespace defocus::engine
