#pragma once
// Creates the fins of a fish: thin closed shells spanned by fin rays. Each fin ray is a quadratic Bézier curve from the
// body to the fin's edge.

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
    // Returns the fin ray at the position t across the fin: 0 is the first ray, 1 the last.
    std::function<FinRay(float t)> ray;
    glm::vec3 sideways{0.0f, 0.0f, 1.0f};  // unit direction in which the fin ripples
    float ripple = 0.02f;
    float phase = 0.0f;
    int rays = 20;
    bool rowsAlongRays = false;  // true: vertex rows follow the fin rays, for long low fins; false: rows cross the rays
};

// Vertex rows of a fin. If rows follow the fin rays, `at` holds the position t of each row across the fin. If rows
// cross the rays, `at` holds each row's fraction r of the distance from root to edge. `counts` holds the number of
// vertices of each row.
struct FinRows {
    std::vector<float> at;
    std::vector<std::uint32_t> counts;
};

std::vector<Fin> fishFins(const FishShape& shape);
FinRows finRows(const Fin& fin, float edge);
void addFin(const Fin& fin, const FinRows& rows, const FishPattern& pattern, FishSurface& surface);

}  // namespace defocus::engine
