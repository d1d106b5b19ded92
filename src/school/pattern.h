#pragma once
// The colours of a fish, painted on its skin and fins. Linear Rec.709.

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "school/shape.h"

namespace defocus::engine {

struct FishBand {  // around the body
    float a = 0.5f;
    float halfWidth = 0.05f;
    float bow = 0.0f;    // bends the band: a shift at back and belly
    float slant = 0.0f;  // a shift from belly to back
    glm::vec3 color{0.0f};
    glm::vec3 rim{0.0f};
    float rimWidth = 0.0f;
};

struct FishStripes {      // along the body
    float count = 0.0f;   // over the height of the body; 0: none
    float share = 0.45f;  // of the stripes' period that is painted
    float slant = 0.0f;   // rises towards the tail, in half heights a body length
    float wave = 0.0f;    // wobble, in periods
    float from = 0.3f;
    float to = 1.0f;
    glm::vec3 color{0.0f};
};

struct FishSpots {
    float size = 0.0f;    // distance of the spots; 0: none
    float radius = 0.3f;  // in sizes
    float from = 0.3f;
    float to = 1.0f;
    float lowest = -1.0f;  // in half heights of the section
    float highest = 1.0f;
    glm::vec3 color{0.0f};
    glm::vec3 halo{0.0f};
    float haloAmount = 0.0f;
};

struct FishPattern {
    glm::vec3 back{0.1f};
    glm::vec3 flank{0.5f};
    glm::vec3 belly{0.8f};
    float bellyEdge = -0.35f;  // where the belly's colour takes over, in half heights
    glm::vec3 rear{0.5f};      // the tail half's colour
    float rearStart = 2.0f;    // beyond 1: none
    float rearSoftness = 0.15f;
    float rearSlant = 0.0f;
    glm::vec3 face{0.5f};
    float faceAmount = 0.0f;
    glm::vec3 lips{0.5f};
    float lipsAmount = 0.0f;
    std::vector<FishBand> bands;
    FishStripes stripes;
    FishSpots spots;
    glm::vec3 scaleEdge{1.0f};  // the pale rim of the scales
    float scaleEdgeAmount = 0.12f;
    float scaleVariation = 0.06f;
    glm::vec3 medianRoot{0.5f};  // dorsal and anal fin, at the root and at the edge
    glm::vec3 medianEdge{0.5f};
    glm::vec3 medianRim{0.5f};  // a thin line along the edge
    float medianRimWidth = 0.0f;
    glm::vec3 caudalRoot{0.5f};
    glm::vec3 caudalEdge{0.5f};
    glm::vec3 caudalRim{0.5f};  // along the upper and lower rays
    float caudalRimWidth = 0.0f;
    glm::vec3 pairedRoot{0.5f};
    glm::vec3 pairedEdge{0.5f};
    glm::vec3 iris{0.8f, 0.6f, 0.1f};
    std::uint32_t seed = 0;
};

glm::vec3 skinColor(const FishPattern& pattern, const FishShape& shape, const FishSkinPoint& point,
                    const FishRelief& relief);

// A fin at ray `t` (0 … 1 from the first to the last), `r` of the way to its edge; `ray` is 1 on a ray, 0 between two.
glm::vec3 finColor(const FishPattern& pattern, FinKind kind, float t, float r, float ray);

// The eye at `angle` radians from the middle of the pupil.
glm::vec3 eyeColor(const FishPattern& pattern, float angle);

// 0xRRGGBB in sRGB → linear.
glm::vec3 linearColor(std::uint32_t srgb);

}  // namespace defocus::engine
