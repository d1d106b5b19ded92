#pragma once
// The fins of a fish: thin closed shells spanned between rays, each ray a quadratic Bézier curve from the body to the
// edge.

#include <cstdint>
#include <functional>
#include <vector>

#include "school/mesh.h"

namespace defocus::engine {

struct FinRay {
    glm::vec3 root{0.0f};
    glm::vec3 middle{0.0f};
    glm::vec3 tip{0.0f};
};

struct Fin {
    FinKind kind = FinKind::dorsal;
    std::function<FinRay(float t)> ray;    // t in 0 … 1 from the first to the last
    glm::vec3 sideways{0.0f, 0.0f, 1.0f};  // the way it ripples
    float ripple = 0.02f;
    float phase = 0.0f;
    int rays = 20;
    bool rowsAlongRays = false;  // rows of vertices follow the rays (long low fins), else cross them (fans)
};

// Where a fin's rows of vertices lie (t, or r across the rays) and how many each has, for triangle edges of `edge`.
struct FinRows {
    std::vector<float> at;
    std::vector<std::uint32_t> counts;
};

std::vector<Fin> fishFins(const FishShape& shape);
FinRows finRows(const Fin& fin, float edge);
void addFin(const Fin& fin, const FinRows& rows, const FishPattern& pattern, FishSurface& surface);

}  // namespace defocus::engine
