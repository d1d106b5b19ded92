#include "refocus/focal_stack.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/parallel.h"

namespace defocus::engine {

namespace {

// Bilinear interpolation of an RGBA image at a position in px; the position is clamped to the image.
void addAt(const Image& image, double x, double y, float* sum) {
    x = std::clamp(x, 0.0, image.width - 1.0);
    y = std::clamp(y, 0.0, image.height - 1.0);
    const int column = std::min(static_cast<int>(x), std::max(image.width - 2, 0));
    const int row = std::min(static_cast<int>(y), std::max(image.height - 2, 0));
    const auto right = static_cast<float>(x - column);
    const auto down = static_cast<float>(y - row);
    const int nextColumn = std::min(column + 1, image.width - 1);
    const int nextRow = std::min(row + 1, image.height - 1);
    for (int c = 0; c < 4; ++c) {
        const float above = (1 - right) * image.at(column, row)[c] + right * image.at(nextColumn, row)[c];
        const float below = (1 - right) * image.at(column, nextRow)[c] + right * image.at(nextColumn, nextRow)[c];
        sum[c] += (1 - down) * above + down * below;
    }
}

double inverse(float depth) {
    return 1 / static_cast<double>(depth);  // 0 for +∞
}

}  // namespace

Image centralDepth(LightField& field) {
    const PartSize& size = field.info().size;
    const Image full = field.depth(field.central());
    Image depth(size.width, size.height, 1);
    for (int y = 0; y < size.height; ++y)
        std::copy_n(full.at(size.margin, y + size.margin), size.width, depth.at(0, y));
    return depth;
}

Image allInFocus(LightField& field, const Progress& progress) {
    const LightFieldInfo& info = field.info();
    const PartSize& size = info.size;
    const Image depth = centralDepth(field);
    const double tolerance = 1 / std::max(info.pixelsPerDioptre, 1e-12);  // in dioptres: one pixel of blur
    Image sum(size.width, size.height, 4);
    std::vector<int> counts(depth.pixels.size());
    // The central image comes first: pixels at which no other image shows the surface keep its colour.
    std::vector<std::size_t> order = {field.central()};
    for (std::size_t i = 0; i < info.points.size(); ++i)
        if (i != field.central()) order.push_back(i);
    for (std::size_t done = 0; done < order.size(); ++done) {
        const std::size_t i = order[done];
        const std::shared_ptr<const Image> colours = field.colour(i);
        const Image depths = field.depth(i);
        const glm::dvec2& point = info.points[i];
        parallelFor(static_cast<std::size_t>(size.height), [&](std::size_t row) {
            const int y = static_cast<int>(row);
            for (int x = 0; x < size.width; ++x) {
                const double surface = inverse(*depth.at(x, y));
                const double shift = info.pixelsPerDioptre * (surface - 1 / info.focusDistance);
                const double column = x + size.margin - shift * point.x;
                const double line = y + size.margin + shift * point.y;
                const int nearColumn = std::clamp(static_cast<int>(std::lround(column)), 0, depths.width - 1);
                const int nearRow = std::clamp(static_cast<int>(std::lround(line)), 0, depths.height - 1);
                if (done > 0 && std::abs(inverse(*depths.at(nearColumn, nearRow)) - surface) > tolerance) continue;
                addAt(*colours, column, line, sum.at(x, y));
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
