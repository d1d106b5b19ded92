// Tests straight edges under extreme blur. The exact coverage of a pixel is the fraction of the blur disk on one side
// of the edge.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "stability/board_scene.h"
#include "stability/stability.h"

namespace defocus::engine {

namespace {

constexpr double edgeTurn = 0.5;   // rotation of the edge in radians; the edge is parallel to neither rows nor columns
constexpr double edgeOffset = 10;  // distance of the edge from the image's centre, px
constexpr std::uint32_t edgeSamples = 4096;

// A half plane whose edge crosses the image, in front of a wall. Both have a uniform colour.
struct Edge {
    View view;
    double depth = 3;   // depth of the half plane, m
    double wall = 1e7;  // depth of the wall, m
};

// Returns the fraction of a disk's area on one side of a line. `distance`: signed distance of the disk's centre from
// the line, positive on that side.
double diskShare(double distance, double diameter) {
    const double x = std::clamp(2 * distance / diameter, -1.0, 1.0);
    return 0.5 + (x * std::sqrt(1 - x * x) + std::asin(x)) / std::numbers::pi;
}

// Returns the max error of a pixel relative to the exact image. In the exact image, the rays of a pixel fill a disk at
// the depth of the half plane. The part of the disk that the half plane covers has its colour, the rest has the wall's.
double edgeError(const Edge& edge) {
    const View& view = edge.view;
    const glm::dvec3 near(0.9, 0.5, 0.1);
    const glm::dvec3 far(0.1, 0.3, 0.8);
    BoardScene boards(view, {squareAt(view, edge.depth, 2, near), squareAt(view, edge.wall, 1e6, far)});
    boards.settings.sampleCount = edgeSamples;
    const double pixel = view.lens.horizontalAperture / view.lens.focalLength * edge.depth / view.width;  // m/px
    const double half = 1e5 * pixel;
    const glm::dmat4 turned = glm::rotate(glm::dmat4(1), edgeTurn, glm::dvec3(0, 0, 1));
    boards.world.pose.objects[0].worldFromObject = glm::scale(
        glm::translate(turned, glm::dvec3(edgeOffset * pixel - half, 0, -edge.depth)), glm::dvec3(half, half, 1));

    const Image image = rendered(boards);
    const glm::dvec2 normal(std::cos(edgeTurn), std::sin(edgeTurn));  // outward normal of the edge; y is up
    const double diameter = blurDiameter(view, edge.depth);
    double largest = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const glm::dvec2 place(x + 0.5 - 0.5 * image.width, 0.5 * image.height - y - 0.5);
            const glm::dvec3 expected = glm::mix(far, near, diskShare(edgeOffset - glm::dot(normal, place), diameter));
            for (int c = 0; c < 3; ++c)
                largest = std::max(largest, std::abs(static_cast<double>(image.at(x, y)[c]) - expected[c]));
        }
    return largest;
}

Edge macroEdge(double fStop, double depth) {
    Edge edge{.view = boardView(), .depth = depth};
    edge.view.lens.fStop = fStop;
    edge.view.lens.focusDistance = 0.06;
    return edge;
}

// Returns an edge 0.02 m from the camera, in front of a wall 2,000 km away. The focus lies between them, so both are
// blurred.
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
    add("macro: blur 1.6 times the image width, behind the focus", [] { return macroEdge(0.7, 3); });
    add("macro: blur 11 times the image width, behind the focus", [] { return macroEdge(0.1, 3); });
    add("macro: blur 3.3 times the image width, in front of the focus", [] { return macroEdge(0.7, 0.02); });
    add("an edge 0.02 m away, a wall 2,000 km away, both blurred", deepEdge);
}

}  // namespace defocus::engine
