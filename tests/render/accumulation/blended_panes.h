#pragma once
// Helpers that make scenes of alpha-blended panes, and a fixture that compares the coverage layer with the image's
// alpha.

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <memory>
#include <vector>

#include "render/accumulation/drawn_layers.h"

namespace defocus::engine {

// A square that is alpha-blended, or opaque if its alpha is 1.
struct Pane {
    float alpha = 1;
    glm::dmat4 worldFromObject{1};
};

// Returns a scene of panes in front of a transparent background. Each pane is a separate object with its own material.
inline std::unique_ptr<SmallWorld> sceneOf(const std::vector<Pane>& panes) {
    auto small = std::make_unique<SmallWorld>();
    for (const Pane& pane : panes) {
        Material& material = small->scene.materials.emplace_back(unlitMaterial({0.5f, 0.25f, 1, pane.alpha}));
        if (pane.alpha < 1) material.alphaMode = AlphaMode::blend;
        material.doubleSided = true;
        const int index = static_cast<int>(small->scene.meshes.size());
        small->scene.meshes.push_back(quad(index));
        place(*small, index, pane.worldFromObject);
    }
    small->world.environment.visible = false;
    small->view.width = 32;
    small->view.height = 24;
    small->view.lens.fStop = 1;
    small->view.lens.focusDistance = 2;
    finish(*small);
    return small;
}

// Returns an opaque pane behind four blended panes. Two of these cross, and the other two are sorted by depth.
inline std::unique_ptr<SmallWorld> overlappingPanes() {
    return sceneOf({{0.5f, facing(-0.1, 0, 1, 0.3)},
                    {0.25f, facing(0.2, 0.1, 1.5, 0.4)},
                    {0.75f, glm::rotate(facing(0, 0, 2, 0.8), 0.6, glm::dvec3(0, 1, 0))},
                    {0.4f, glm::rotate(facing(0, 0, 2, 0.8), -0.6, glm::dvec3(0, 1, 0))},
                    {1, facing(1, -0.5, 4, 0.8)}});
}

class BlendedPanes : public LensLayer {
protected:
    // Draws data layers such as depth with the image, and expects the coverage layer to equal the image's alpha.
    static void expectCoverage(const SmallWorld& small, const std::vector<Layer>& layers) {
        const Drawn frame = drawn(small, 16, layers);
        EXPECT_EQ(frame.plan.samples.size(), 16u);
        double largest = 0;
        for (std::size_t i = 0; i < frame.layers.coverage.pixels.size(); ++i)
            largest = std::max(
                largest, std::abs(double{frame.layers.coverage.pixels[i]} - double{frame.picture.pixels[4 * i + 3]}));
        std::string names;
        for (const Layer layer : layers) names += std::to_string(static_cast<int>(layer)) + ' ';
        EXPECT_LT(largest, 5e-4) << names;  // tolerance for half floats, in which normals and albedo are drawn
    }
};

}  // namespace defocus::engine
