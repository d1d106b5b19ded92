#pragma once
// Fixture that draws an image together with its data layers, such as depth and normals.

#include "render/accumulation/accumulated.h"
#include "render/accumulation/accumulation.h"

namespace defocus::engine {

inline const std::vector<Layer> everyLayer = {Layer::depth,  Layer::position, Layer::normal,
                                              Layer::albedo, Layer::emission, Layer::motion,
                                              Layer::coc,    Layer::objects,  Layer::materials};

struct Drawn {
    Image picture;
    LayerImages layers;
    FramePlan plan;
};

class LensLayer : public Accumulation {
protected:
    static Drawn drawn(const SmallWorld& small, std::uint32_t samples, const std::vector<Layer>& layers = everyLayer,
                       std::uint32_t wave = 0) {
        RenderSettings settings = settingsFor(samples, LodMode::off);
        settings.layers = layers;
        return drawnBy(small, planFrame(small.world, small.view, settings), wave);
    }

    static Drawn drawnBy(const SmallWorld& small, FramePlan plan, std::uint32_t wave = 0) {
        const RendererOptions options{.layerFormat = LayerFormat::rgba32f, .wave = wave};
        const auto renderer = makeAccumulationRenderer(small.world, options);
        Drawn result;
        result.plan = std::move(plan);
        result.picture = imageOf(*renderer, result.plan);
        result.layers = renderer->layerImages().value();
        return result;
    }
};

// Returns the transform of a square that faces the camera, with its centre at (x, y) m.
inline glm::dmat4 facing(double x, double y, double depth, double halfSize) {
    return glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(x, y, -depth)), glm::dvec3(halfSize));
}

inline float valueAt(const Image& image, int x, int y, int channel = 0) {
    return image.at(x, y)[channel];
}

}  // namespace defocus::engine
