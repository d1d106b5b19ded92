#include "refocus/focal_stack.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <vector>

#include "core/parallel.h"

namespace defocus::engine {

namespace {

// Returns 1/depth; 0 for +∞, NaN and depths ≤ 0.
double inverse(float depth) {
    return depth > 0 ? 1 / static_cast<double>(depth) : 0;
}

}  // namespace

double distanceAt(double from, double to, int i, int count) {
    return 1 / glm::mix(1 / from, 1 / to, count > 1 ? static_cast<double>(i) / (count - 1) : 0.0);
}

std::vector<double> stackDistances(const FocusRange& range, int count) {
    std::vector<double> distances;
    for (int i = 0; i < count; ++i)
        distances.push_back(
            std::clamp(distanceAt(range.nearest, range.farthest, i, count), range.nearest, range.farthest));
    return distances;
}

Image centralDepth(LightField& field) {
    const PartSize& size = field.info().size;
    const Image full = field.depth(field.central());
    Image depth(size.width, size.height, 1);
    for (int y = 0; y < size.height; ++y)
        std::copy_n(full.at(size.margin, y + size.margin), size.width, depth.at(0, y));
    return depth;
}

Image centralCoc(LightField& field, const Refocusing& refocusing) {
    const LightFieldInfo& info = field.info();
    static_cast<void>(shiftedImages(info, refocusing, field.name()));  // throws for values outside the rendered range
    const double diameter = diameterPerDioptre(info, refocusing);
    Image image = centralDepth(field);
    for (float& value : image.pixels)
        value = static_cast<float>(diameter * (1 / refocusing.focusDistance - inverse(value)));
    return image;
}

Image allInFocus(LightField& field, const Progress& progress) {
    const LightFieldInfo& info = field.info();
    const PartSize& size = info.size;
    const Image depth = centralDepth(field);
    const double tolerance = 1 / std::max(info.pixelsPerDioptre, 1e-12);  // tolerance in dioptres: one pixel of blur
    Image sum(size.width, size.height, 4);
    std::vector<int> counts(depth.pixels.size());
    // The image of the lens's centre comes first. The depths of the others are compared with its depth, so its own
    // colours are always added and no pixel stays empty.
    std::vector<std::size_t> order = {field.central()};
    for (std::size_t i = 0; i < info.points.size(); ++i)
        if (i != field.central()) order.push_back(i);
    for (std::size_t done = 0; done < order.size(); ++done) {
        const std::size_t i = order[done];
        const std::shared_ptr<const HalfImage> colours = field.colour(i);
        const Image depths = field.depth(i);
        parallelFor(static_cast<std::size_t>(size.height), [&](std::size_t row) {
            const int y = static_cast<int>(row);
            for (int x = 0; x < size.width; ++x) {
                const double surface = inverse(*depth.at(x, y));
                const double shift = info.pixelsPerDioptre * (surface - 1 / info.focusDistance);
                const glm::ivec2 move = integerMove(info, i, shift);
                const int column = std::clamp(x + size.margin - move.x, 0, depths.width - 1);
                const int line = std::clamp(y + size.margin + move.y, 0, depths.height - 1);
                if (done > 0 && std::abs(inverse(*depths.at(column, line)) - surface) > tolerance) continue;
                for (int c = 0; c < 4; ++c) sum.at(x, y)[c] += fromHalf(colours->at(column, line)[c]);
                ++counts[row * static_cast<std::size_t>(size.width) + static_cast<std::size_t>(x)];
            }
        });
        report(progress, "lens images", done + 1, order.size());
    }
    for (std::size_t p = 0; p < counts.size(); ++p)
        for (std::size_t c = 0; c < 4; ++c) sum.pixels[4 * p + c] /= static_cast<float>(counts[p]);
    return sum;
}

}  // namespace defocus::engine
