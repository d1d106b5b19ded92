#pragma once
// Defines the fish species before random variation: each function returns a species' outline and fins with one of its
// colour palettes. `variant`, modulo the number of palettes, selects the palette. Tall disk-shaped fish are in
// prototypes_disks.cpp, oval fish in prototypes_ovals.cpp, and long swimmers in prototypes_swimmers.cpp.

#include "school/mesh.h"

namespace defocus::engine::prototypes {

Fish angelfish(int variant);
Fish butterflyfish(int variant);
Fish idol(int variant);

Fish anthias(int variant);
Fish tang(int variant);
Fish clownfish(int variant);
Fish goldfish(int variant);

Fish fusilier(int variant);
Fish parrotfish(int variant);

// Helper functions that set the colours of a species. Colours are 0xRRGGBB in sRGB.
inline glm::vec3 rgb(std::uint32_t srgb) {
    return linearColor(srgb);
}

inline void setBody(FishPattern& p, std::uint32_t back, std::uint32_t flank, std::uint32_t belly) {
    p.back = rgb(back);
    p.flank = rgb(flank);
    p.belly = rgb(belly);
}

inline void setMedianFins(FishPattern& p, std::uint32_t root, std::uint32_t edge) {
    p.medianRoot = rgb(root);
    p.medianEdge = rgb(edge);
}

inline void setCaudalFin(FishPattern& p, std::uint32_t root, std::uint32_t edge) {
    p.caudalRoot = rgb(root);
    p.caudalEdge = rgb(edge);
}

inline void setPairedFins(FishPattern& p, std::uint32_t root, std::uint32_t edge) {
    p.pairedRoot = rgb(root);
    p.pairedEdge = rgb(edge);
}

}  // namespace defocus::engine::prototypes
