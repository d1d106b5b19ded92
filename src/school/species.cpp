#include "school/species.h"

#include <glm/glm.hpp>

#include "school/prototypes.h"
#include "school/random.h"

namespace defocus::engine {
namespace {

Fish prototype(FishSpecies species, int variant) {
    switch (species) {
        case FishSpecies::angelfish:
            return prototypes::angelfish(variant);
        case FishSpecies::butterflyfish:
            return prototypes::butterflyfish(variant);
        case FishSpecies::anthias:
            return prototypes::anthias(variant);
        case FishSpecies::tang:
            return prototypes::tang(variant);
        case FishSpecies::fusilier:
            return prototypes::fusilier(variant);
        case FishSpecies::goldfish:
            return prototypes::goldfish(variant);
        case FishSpecies::clownfish:
            return prototypes::clownfish(variant);
        case FishSpecies::parrotfish:
            return prototypes::parrotfish(variant);
        case FishSpecies::idol:
            return prototypes::idol(variant);
    }
    return prototypes::anthias(variant);
}

}  // namespace

Fish makeFish(FishSpecies species, int variant, float length, std::uint32_t seed, std::uint32_t number) {
    Fish fish = prototype(species, variant);
    FishRandom random(seed, number);
    FishShape& s = fish.shape;
    s.length = length;
    const float tall = random.uniform(0.95f, 1.06f);
    const float stout = random.uniform(0.92f, 1.1f);
    for (float& top : s.outline.top) top *= tall * random.uniform(0.99f, 1.01f);
    for (float& bottom : s.outline.bottom) bottom *= tall * random.uniform(0.98f, 1.02f);
    for (float& width : s.outline.width) width *= stout;
    for (MedianFin& fin : s.medianFins) {
        const float factor = random.uniform(0.9f, 1.12f);
        for (float& height : fin.heights) height *= factor * random.uniform(0.95f, 1.05f);
    }
    s.caudal.length = random.vary(s.caudal.length, 0.1f);
    s.caudal.spread = random.vary(s.caudal.spread, 0.1f);
    s.pectoral.outwards = random.vary(s.pectoral.outwards, 0.35f);
    s.pectoral.downwards = random.uniform(-0.1f, 0.55f);
    s.eyeRadius = random.vary(s.eyeRadius, 0.06f);
    s.scaleSize = random.vary(s.scaleSize, 0.08f);
    s.finPhase = random.uniform(0.0f, 6.28f);
    s.swimAmplitude = random.uniform(0.2f, 0.42f);
    s.swimPhase = random.uniform(0.0f, 6.28f);
    s.turn = random.uniform(-0.25f, 0.25f);

    FishPattern& p = fish.pattern;
    p.seed = random.next();
    for (FishBand& band : p.bands) {
        band.a += random.uniform(-0.008f, 0.008f);
        band.halfWidth = random.vary(band.halfWidth, 0.12f);
    }
    p.stripes.count = random.vary(p.stripes.count, 0.1f);
    const float brightness = random.uniform(0.93f, 1.05f);
    for (glm::vec3* color : {&p.back, &p.flank, &p.belly}) *color *= brightness;
    return fish;
}

}  // namespace defocus::engine
