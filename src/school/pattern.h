#pragma once
// Computes the colours of a fish's skin, fins and eyes from a pattern. Colours are in linear Rec. 709.

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "school/shape.h"

namespace defocus::engine {

struct FishBand {  // coloured band around the fish's body; lengths are in body lengths
    float a = 0.5f;
    float halfWidth = 0.05f;
    float bow = 0.0f;    // shift of the band's ends, at back and belly, towards the tail
    float slant = 0.0f;  // shift of the band towards the tail along the back, and towards the head along the belly
    glm::vec3 color{0.0f};
    glm::vec3 rim{0.0f};
    float rimWidth = 0.0f;
};

struct FishStripes {      // coloured stripes along the fish's body
    float count = 0.0f;   // number of stripes over the body's height; 0: none
    float share = 0.45f;  // painted fraction of a stripe's period
    float slant = 0.0f;   // rise of the stripes towards the tail, in half body heights per body length
    float wave = 0.0f;    // amplitude of random waviness, in stripe periods
    float from = 0.3f;
    float to = 1.0f;
    glm::vec3 color{0.0f};
};

struct FishSpots {
    float size = 0.0f;    // distance between spots in body lengths; 0: no spots
    float radius = 0.3f;  // spot radius relative to `size`
    float from = 0.3f;
    float to = 1.0f;
    float lowest = -1.0f;  // min height of spots, from −1 at the belly to 1 at the back
    float highest = 1.0f;
    glm::vec3 color{0.0f};
    glm::vec3 halo{0.0f};
    float haloAmount = 0.0f;
};

struct FishPattern {
    glm::vec3 back{0.1f};
    glm::vec3 flank{0.5f};
    glm::vec3 belly{0.8f};
    float bellyEdge = -0.35f;  // upper edge of the belly colour, from −1 at the belly to 1 at the back
    glm::vec3 rear{0.5f};      // colour of the rear part of the body
    float rearStart = 2.0f;    // start of the rear colour along the body, 0 (snout) to 1 (tail); above 1: none
    float rearSoftness = 0.15f;
    float rearSlant = 0.0f;
    glm::vec3 face{0.5f};
    float faceAmount = 0.0f;
    glm::vec3 lips{0.5f};
    float lipsAmount = 0.0f;
    std::vector<FishBand> bands;
    FishStripes stripes;
    FishSpots spots;
    glm::vec3 scaleEdge{1.0f};  // colour of the pale rims of fish scales
    float scaleEdgeAmount = 0.12f;
    float scaleVariation = 0.06f;
    glm::vec3 medianRoot{0.5f};  // colour of the dorsal and anal fins at their roots
    glm::vec3 medianEdge{0.5f};
    glm::vec3 medianRim{0.5f};  // colour of a thin line along the edges of the dorsal and anal fins
    float medianRimWidth = 0.0f;
    glm::vec3 caudalRoot{0.5f};
    glm::vec3 caudalEdge{0.5f};
    glm::vec3 caudalRim{0.5f};  // colour of lines along the outermost rays of the tail fin
    float caudalRimWidth = 0.0f;
    glm::vec3 pairedRoot{0.5f};
    glm::vec3 pairedEdge{0.5f};
    glm::vec3 iris{0.8f, 0.6f, 0.1f};
    std::uint32_t seed = 0;
};

glm::vec3 skinColor(const FishPattern& pattern, const FishShape& shape, const FishSkinPoint& point,
                    const FishRelief& relief);

// Returns a fin's colour at a point. `t` is the position across the fin (0 at the first fin ray, 1 at the last); `r` is
// the fraction of the distance from the fin's root to its edge. `ray` is 1 on a fin ray and 0 halfway between two fin
// rays.
glm::vec3 finColor(const FishPattern& pattern, FinKind kind, float t, float r, float ray);

// Returns the eye's colour at `angle` radians from the pupil's centre.
glm::vec3 eyeColor(const FishPattern& pattern, float angle);

// Converts an sRGB colour 0xRRGGBB to linear Rec. 709.
glm::vec3 linearColor(std::uint32_t srgb);

}  // namespace defocus::engine
