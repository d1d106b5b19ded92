// Edges under blurs that leave nothing of them in focus: a straight edge through the image, as the disk's area on its
// side.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "eval/stability/board_scene.h"
#include "eval/stability/stability.h"

namespace defocus::engine {

namespace {

constexpr double edgeTurn = 0.5;   // of the edge about the image's middle, radians: neither rows nor columns
constexpr double edgeOffset = 10;  // of the edge from the image's middle, px
constexpr std::uint32_t edgeSamples = 4096;

// A half plane whose edge crosses the image, before a wall; both of one colour.
struct Edge {
    View view;
    double depth = 3;   // m
    double wall = 1e7;  // m
};

// The share of a disk of diameter `diameter` that lies on one side of a line, `distance` from its centre into it.
double diskShare(double distance, double diameter) {
    const double x = std::clamp(2 * distance / diameter, -1.0, 1.0);
    return 0.5 + (x * std::sqrt(1 - x * x) + std::asin(x)) / std::numbers::pi;
}

// The largest error of a pixel. Light on its way to the wall passes the half plane's depth in the same disk, so the
// wall is hidden by as much as the half plane shows.
double edgeError(const Edge& edge) {
    const View& view = edge.view;
    const glm::dvec3 near(0.9, 0.5, 0.1);
    const glm::dvec3 far(0.1, 0.3, 0.8);
    BoardScene boards(view, {squareAt(view, edge.depth, 2, near), squareAt(view, edge.wall, 1e6, far)});
    boards.settings.sampleCount = edgeSamples;
    const double pixel = view.lens.horizontalAperture / view.lens.focalLength * edge.depth / view.width;  // m
    const double half = 1e5 * pixel;
    const glm::dmat4 turned = glm::rotate(glm::dmat4(1), edgeTurn, glm::dvec3(0, 0, 1));
    boards.world.pose.objects[0].worldFromObject = glm::scale(
        glm::translate(turned, glm::dvec3(edgeOffset * pixel - half, 0, -edge.depth)), glm::dvec3(half, half, 1));

    const Image image = rendered(boards);
    const glm::dvec2 normal(std::cos(edgeTurn), std::sin(edgeTurn));  // out of the half plane; up
    const double diameter = blurDiameter(view, edge.depth);
    double largest = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const glm::dvec2 place(x + 0.5 - 0.5 * image.width, 0.5 * image.height - y - 0.5);
            const glm::dvec3 truth = glm::mix(far, near, diskShare(edgeOffset - glm::dot(normal, place), diameter));
            for (int c = 0; c < 3; ++c)
                largest = std::max(largest, std::abs(static_cast<double>(image.at(x, y)[c]) - truth[c]));
        }
    return largest;
}

Edge macroEdge(double fStop, double depth) {
    Edge edge{.view = boardView(), .depth = depth};
    edge.view.lens.fStop = fStop;
    edge.view.lens.focusDistance = 0.06;
    return edge;
}

// The edge at 0.02 m, the wall at 2,000 km, and the focus where both are blurred.
Edge deepEdge() {
    Edge edge{.view = boardView(), .depth = 0.02, .wall = 2e6};
    edge.view.lens.focusDistance = 0.035;
    setBlur(edge.view, edge.depth, 30);
    return edge;
}

}  // namespace

void addEdgeCases(std::vector<StabilityCase>& cases) {
    const auto add = [&](std::string name, const std::function<Edge()>& edge) {
        cases.push_back({"lens", std::move(name), "largest error of an edge's profile", "closed form", 0.01,
                         [edge] { return edgeError(edge()); }});
    };
    add("macro: blur 1.6 images wide, behind", [] { return macroEdge(0.7, 3); });
    add("macro: blur 11 images wide, behind", [] { return macroEdge(0.1, 3); });
    add("macro: blur 3.3 images wide, in front", [] { return macroEdge(0.7, 0.02); });
    add("an edge at 0.02 m before a wall at 2,000 km, both blurred", deepEdge);
}

}  // namespace defocus::engine
