#include "plan/visible/focus_depth.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "core/error.h"
#include "scene/hidden_nodes.h"
#include "scene/pick.h"

namespace defocus::engine {

namespace {

constexpr int middlePoints = 9;  // test points along each side of the image's central third

// Returns the lens focused at infinity, for which focus breathing doesn't change the field of view.
Lens unfocused(const Lens& lens) {
    Lens result = lens;
    result.focusDistance = std::numeric_limits<double>::infinity();
    return result;
}

}  // namespace

double depthOfNode(const Scene& scene, const Pose& pose, const View& view, std::string_view name, const char* who) {
    const glm::dvec3 centre = nodeCentre(scene, pose, nodeCalled(scene, std::string(name)));
    const double depth = -(glm::inverse(view.worldFromCamera) * glm::dvec4(centre, 1)).z;
    if (!(depth > 0)) fail("{}: the centre of '{}' is behind the camera; choose an object in front of it", who, name);
    return depth;
}

std::vector<std::optional<glm::dvec3>> surfacesAt(const Scene& scene, const Pose& pose, const View& view,
                                                  const Lens& lens, const std::vector<glm::dvec2>& places) {
    const double tanX = tanHalfHorizontalFov(lens);
    const double tanY = tanX * view.height / view.width;
    std::vector<glm::dvec3> inView;
    std::vector<glm::dvec3> inWorld;
    for (const glm::dvec2& place : places) {
        inView.emplace_back((place.x / view.width * 2 - 1) * tanX, (1 - place.y / view.height * 2) * tanY, -1);
        inWorld.push_back(glm::dmat3(view.worldFromCamera) * inView.back());
    }
    const std::vector<std::optional<Hit>> hits = firstHits(scene, pose, glm::dvec3(view.worldFromCamera[3]), inWorld);
    std::vector<std::optional<glm::dvec3>> surfaces(places.size());
    for (std::size_t i = 0; i < hits.size(); ++i)
        if (hits[i] && hits[i]->distance > 0) surfaces[i] = glm::normalize(inView[i]) * hits[i]->distance;
    return surfaces;
}

glm::dvec3 surfaceAtPixel(const Scene& scene, const Pose& pose, const View& view, const Lens& lens,
                          const glm::ivec2& pixel, const char* who) {
    if (pixel.x >= view.width || pixel.y >= view.height)
        fail("{}: pixel {},{} is outside the image of {}x{} px", who, pixel.x, pixel.y, view.width, view.height);
    const auto point = surfacesAt(scene, pose, view, lens, {glm::dvec2(pixel) + 0.5}).front();
    if (!point)
        fail("{}: there is no surface at pixel {},{}; choose a pixel that shows an object", who, pixel.x, pixel.y);
    return *point;
}

// With focus breathing, the ray of a pixel depends on the focus distance, so the depth is found by iteration.
double depthAtPixel(const Scene& scene, const Pose& pose, const View& view, const glm::ivec2& pixel, const char* who) {
    Lens lens = unfocused(view.lens);
    const int rounds = lens.focusBreathing ? 4 : 1;
    for (int i = 0; i < rounds; ++i) {
        lens.focusDistance = -surfaceAtPixel(scene, pose, view, lens, pixel, who).z;
        checkLens(lens);
    }
    return lens.focusDistance;
}

std::optional<double> depthOfMiddle(const Scene& scene, const Pose& pose, const View& view) {
    const glm::dvec2 size(view.width, view.height);
    std::vector<glm::dvec2> places;
    for (int y = 0; y < middlePoints; ++y)
        for (int x = 0; x < middlePoints; ++x)
            places.push_back(size * (1.0 + (glm::dvec2(x, y) + 0.5) / static_cast<double>(middlePoints)) / 3.0);
    Pose subject;
    std::ranges::copy_if(pose.objects, std::back_inserter(subject.objects),
                         [](const Object& object) { return !object.ground; });
    std::vector<double> depths;
    for (const auto& point : surfacesAt(scene, subject, view, unfocused(view.lens), places))
        if (point) depths.push_back(-point->z);
    if (depths.empty()) return {};
    const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
    std::nth_element(depths.begin(), middle, depths.end());
    return *middle;
}

double depthOfMiddle(const Scene& scene, const Pose& pose, const View& view, const char* who) {
    const std::optional<double> depth = depthOfMiddle(scene, pose, view);
    if (!depth) fail("{}: there is no surface in the middle of the image; use another focus option", who);
    return *depth;
}

}  // namespace defocus::engine
