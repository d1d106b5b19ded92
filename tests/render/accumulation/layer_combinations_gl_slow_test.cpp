// Tests that coverage is the same with every pair of data layers, such as depth and normals.

#include <bit>

#include "gl_conduct.h"
#include "render/accumulation/blended_panes.h"

namespace defocus::engine {
namespace {

class LayerCombination : public BlendedPanes {};

TEST_F(LayerCombination, ofTwoHasThePicturesAlphaAsCoverage) {
    SKIP_ON_SECOND_DRIVER();
    const auto small = overlappingPanes();
    small->view.width = 24;
    small->view.height = 16;
    for (unsigned chosen = 1; chosen < 1u << everyLayer.size(); ++chosen) {
        if (std::popcount(chosen) != 2) continue;
        std::vector<Layer> layers;
        for (std::size_t i = 0; i < everyLayer.size(); ++i)
            if ((chosen >> i & 1) != 0) layers.push_back(everyLayer[i]);
        expectCoverage(*small, layers);
    }
}

}  // namespace
}  // namespace defocus::engine
