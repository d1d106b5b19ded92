#pragma once
// The kinds of fish in the school: free interpretations of reef and pond fish, each with its own outline, fins and
// palette. Two fish of a kind differ in proportions, relief, bend and pattern.

#include <cstdint>

#include "school/mesh.h"

namespace defocus::engine {

enum class FishSpecies { angelfish, butterflyfish, anthias, tang, fusilier, goldfish, clownfish, parrotfish, idol };
inline constexpr int fishSpeciesCount = 9;

// `variant` picks one of the kind's palettes (any number, taken modulo their count); equal arguments give an equal
// fish.
Fish makeFish(FishSpecies species, int variant, float length, std::uint32_t seed, std::uint32_t number);

}  // namespace defocus::engine
