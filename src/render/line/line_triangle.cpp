#include "render/line/line_triangle.h"

#include <algorithm>

namespace defocus::engine {

namespace {

struct Linear {
    double at0 = 0;
    double slope = 0;
};

double crossed(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

void cut(LineInterval& interval, const Linear& f) {
    if (f.slope == 0) {
        if (f.at0 < 0) interval.last = interval.first;
        return;
    }
    const double root = -f.at0 / f.slope;
    if (f.slope > 0)
        interval.first = std::max(interval.first, root);
    else
        interval.last = std::min(interval.last, root);
}

}  // namespace

std::vector<LineInterval> seenOnLine(const std::array<LensVertex, 3>& corners, const LensLine& line, bool doubleSided) {
    std::array<glm::dvec2, 3> places;
    std::array<glm::dvec2, 3> ways;
    for (std::size_t i = 0; i < 3; ++i) {
        places[i] = glm::dvec2(corners[i].x, corners[i].y) - corners[i].w * line.place;
        ways[i] = corners[i].c * line.direction;
    }
    std::array<Linear, 3> edges;
    Linear sum;         // sum of the edge functions
    Linear beyondNear;  // sum of the edge functions times (w − near plane) of the opposite corner
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        const std::size_t k = (i + 2) % 3;
        edges[i] = {crossed(places[j], places[k]), crossed(places[j], ways[k]) + crossed(ways[j], places[k])};
        sum.at0 += edges[i].at0;
        sum.slope += edges[i].slope;
        beyondNear.at0 += edges[i].at0 * (corners[i].w - line.nearPlane);
        beyondNear.slope += edges[i].slope * (corners[i].w - line.nearPlane);
    }
    std::vector<LineInterval> seen;
    if (sum.at0 == 0 && sum.slope == 0) return seen;  // triangle has no area
    for (const bool front : {true, false}) {
        if (!front && !doubleSided) break;
        const double side = front ? 1 : -1;
        LineInterval interval{line.first, line.last, front};
        for (const Linear& edge : edges) cut(interval, {side * edge.at0, side * edge.slope});
        cut(interval, {side * beyondNear.at0, side * beyondNear.slope});
        if (interval.last > interval.first) seen.push_back(interval);
    }
    return seen;
}

}  // namespace defocus::engine
