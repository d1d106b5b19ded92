#include "plan/lens_cells/automatic_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "plan/frame_plan.h"
#include "plan/lens_cells/lens_cells.h"
#include "plan/visible/visibility.h"

namespace defocus::engine {

namespace {

constexpr int columns = 32;
constexpr int rows = 24;
constexpr int depths = 9;

// Returns the fraction of the object's depth range in which the CoC diameter is at least `minCoc` px.
double blurredShareOf(const ObjectPlan& object, const FramePlan& plan, double minCoc) {
    const double nearest = std::max(object.nearestDepth, plan.view.nearPlane);
    const double farthest = std::max(object.farthestDepth, nearest);
    int blurred = 0;
    for (int i = 0; i < depths; ++i) {
        const double depth = nearest * std::pow(farthest / nearest, (i + 0.5) / depths);
        const double c =
            circleOfConfusion(plan.coc, depth, plan.view.width, {}, object.own.factorMax, object.own.addedMax);
        blurred += std::abs(c) >= minCoc ? 1 : 0;
    }
    return static_cast<double>(blurred) / depths;
}

// Returns the first and the last grid cell with a centre in [begin, end], out of `count` cells along an axis.
// Coordinates are normalised device coordinates.
std::array<int, 2> cellsIn(double begin, double end, int count) {
    const auto cell = [&](double ndc) { return (ndc + 1) / 2 * count - 0.5; };
    return {static_cast<int>(std::ceil(std::clamp(cell(begin), -0.5, count + 0.5))),
            static_cast<int>(std::floor(std::clamp(cell(end), -0.5, count - 0.5)))};
}

}  // namespace

double blurredShare(const FramePlan& plan, double minCoc) {
    std::array<bool, std::size_t{columns} * rows> covered{};
    double blurred = 0;
    int open = columns * rows;
    for (const ObjectPlan& object : plan.objects) {  // nearest first, so each grid cell counts for the nearest box
        CocBox box{.ndcMin = glm::dvec2(-1), .ndcMax = glm::dvec2(1)};
        if (object.nearestDepth > plan.view.nearPlane) box = cocBoxOf(object.viewBox, object.own, plan);
        const auto [left, right] = cellsIn(box.ndcMin.x, box.ndcMax.x, columns);
        const auto [bottom, top] = cellsIn(box.ndcMin.y, box.ndcMax.y, rows);
        int shown = 0;
        for (int row = bottom; row <= top; ++row)
            for (int column = left; column <= right; ++column)
                shown += std::exchange(covered[static_cast<std::size_t>(row * columns + column)], true) ? 0 : 1;
        if (shown > 0) blurred += shown * blurredShareOf(object, plan, minCoc);
        open -= shown;
    }
    if (plan.showsMap && largestCocAtInfinity(plan.coc, plan.view.width) >= minCoc) blurred += open;
    return blurred / (columns * rows);
}

std::string reasonForAccumulation(const FramePlan& plan) {
    if (plan.tile) return "the image is drawn in tiles";
    if (!plan.settings.layers.empty()) return "the layers that --exr-layers writes cannot be blurred with lens cells";
    if (std::string reason = reasonForNoCells(plan); !reason.empty()) return reason;
    const double share = blurredShare(plan, minBlurOfCells);
    if (share >= minShareOfCells) return "";
    return fmt::format("only about {:.1f} % of the image is blurred by {:g} px or more", 100 * share, minBlurOfCells);
}

}  // namespace defocus::engine
