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
constexpr int maxGridSide = 512;
constexpr std::size_t maxCellsAnObject = 4;  // on average

// Lists of objects by the cells of the image that they may be seen in. What lies outside is in the cells at the border.
// Each cell knows a value that none of its objects lies below, so that heaps of objects that have all been raised are
// passed over.
class Grid {
public:
    // `reach`: px, of near().
    Grid(const std::vector<ContactBounds>& bounds, double reach)
        : bounds_(&bounds),
          reach_(reach),
          side_(std::clamp(static_cast<int>(std::sqrt(bounds.size())), 1, maxGridSide)),
          visitedFrom_(bounds.size(), bounds.size()) {
        glm::dvec2 min(ContactBounds::infinity);
        glm::dvec2 max(-ContactBounds::infinity);
        for (const ContactBounds& b : bounds) {
            if (!std::isfinite(b.seenMin.x)) continue;
            min = glm::min(min, b.seenMin);
            max = glm::max(max, b.seenMax);
        }
        if (!(max.x >= min.x) || !(max.y >= min.y)) min = max = glm::dvec2(0);
        origin_ = min;
        extent_ = std::max({max.x - min.x, max.y - min.y, reach});
        side_ = std::min(side_, static_cast<int>(std::min<double>(extent_ / reach, maxGridSide)));
        while (side_ > 1 && cellsCovered() > maxCellsAnObject * bounds.size()) side_ /= 2;
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
            if (cell.min >= values[i]) return;
            cell.min = ContactBounds::infinity;
            for (std::size_t at = 0; at < cell.objects.size();) {
                const std::uint32_t j = cell.objects[at];
                if (settled[j]) {
                    cell.objects[at] = cell.objects.back();
                    cell.objects.pop_back();
                    continue;
                }
                ++at;
                if (std::exchange(visitedFrom_[j], i) != i) raise(j);
                cell.min = std::min(cell.min, values[j]);
            }
        });
    }

private:
    struct Cell {
        std::vector<std::uint32_t> objects;
        double min = -ContactBounds::infinity;  // of their values, which never fall
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
        const int right = column(bounds.seenMax.x + reach, 0);
        const int top = column(bounds.seenMax.y + reach, 1);
        for (int y = column(bounds.seenMin.y - reach, 1); y <= top; ++y)
            for (int x = column(bounds.seenMin.x - reach, 0); x <= right; ++x)
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
    bounds.seenMin = glm::dvec2(ContactBounds::infinity);
    bounds.seenMax = glm::dvec2(-ContactBounds::infinity);
    for (const glm::dvec3& corner : object.viewBox.corners()) {
        const glm::dvec2 place = middle + glm::dvec2(corner) / -corner.z * pixelsPerTangent;
        bounds.seenMin = glm::min(bounds.seenMin, place);
        bounds.seenMax = glm::max(bounds.seenMax, place);
    }
    bounds.unit = 1 / pixelsPerTangent;
    bounds.min = glm::dvec3(glm::dvec2(object.viewBox.minimum), object.nearestDepth) * pixelsPerTangent;
    bounds.max = glm::dvec3(glm::dvec2(object.viewBox.maximum), object.farthestDepth) * pixelsPerTangent;
    return bounds;
}

double contactGap(const ContactBounds& a, const ContactBounds& b) {
    const auto apart = [](double minA, double maxA, double minB, double maxB) {
        return std::max(minA - maxB, minB - maxA);
    };
    double inImage = 0;
    double inSpace = 0;
    for (int axis = 0; axis < 2; ++axis)
        inImage = std::max(inImage, apart(a.seenMin[axis], a.seenMax[axis], b.seenMin[axis], b.seenMax[axis]));
    for (int axis = 0; axis < 3; ++axis)
        inSpace = std::max(inSpace, apart(a.min[axis], a.max[axis], b.min[axis], b.max[axis]));
    if (inSpace > 0) {
        // The farthest depth that both have, or the nearest that the one behind has: px are largest there.
        const double depth = std::max(std::min(a.max.z, b.max.z), std::max(a.min.z, b.min.z));
        inSpace /= depth * std::max(a.unit, b.unit);
    }
    return std::max(0.0, std::max(inImage, inSpace) - closedGap);
}

std::vector<double> spreadOverContact(const std::vector<ContactBounds>& bounds, std::vector<double> values, double min,
                                      double max) {
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
    Grid grid(bounds, max - min + closedGap);
    std::vector<bool> settled(values.size(), false);
    while (!open.empty()) {
        const double value = open.top().value;
        const std::uint32_t i = open.top().object;
        open.pop();
        if (value <= min) break;
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
