#pragma once
// Creates the individual fish of the school. Species are freely modelled on reef and pond fish; each has its own
// outline, fins and palettes. Fish of one species differ in proportions, relief, bend and pattern.

#include <cstdint>

#include "school/mesh.h"

namespace defocus::engine {

enum class FishSpecies { angelfish, butterflyfish, anthias, tang, fusilier, goldfish, clownfish, parrotfish, idol };
inline constexpr int fishSpeciesCount = 9;

// Returns a fish. `variant`, modulo the number of palettes, selects a palette of the species. Equal arguments give
// identical fish.
Fish makeFish(FishSpecies species, int variant, float length, std::uint32_t seed, std::uint32_t number);

}  // namespace defocus::engine
