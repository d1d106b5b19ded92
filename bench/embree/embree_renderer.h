#pragma once
// An independent reference: a thin-lens ray tracer on Embree 3 that shares no code with the rasteriser. From a
// FramePlan it takes only the view and the sample count, seed and offset. It has its own lens model (lens_rays.h) and
// sampling, and traces the loaded meshes without any culling.
//
// Box pixel filter of 1 px, linear RGBA premultiplied, sums in double. Opaque surfaces only; shading as in
// traced_shading.h. Environment maps are an Error.
//
// Benches also compare speed with it, so it is optimised: rays are traced in packets (ray_packet.h), with several
// samples of a tile in succession. If all pixels share a lens sample, packets are traced as coherent ones. The image is
// independent of tiles and threads.

#include <memory>

#include "render/renderer.h"

namespace defocus::engine {

enum class EmbreeSampling {
    perPixel,  // scrambled lens and pixel samples of each pixel's own: the error is noise
    shared,    // all pixels share lens and pixel points, as in accumulation: the error is banding
    // Like `shared`, with the points of FramePlan::samples, so that only geometry and visibility can differ from the
    // rasteriser. Watertight; the other modes lose about one ray in a million between two triangles.
    planned,
};

// Returns a renderer that traces up to 16 samples of every pixel per advance(), on all cores.
std::unique_ptr<Renderer> makeEmbreeRenderer(const World& world, EmbreeSampling sampling = EmbreeSampling::perPixel);

// Adds "embree", "embree-shared" and "embree-planned" to the table of methods. Further calls have no effect.
void registerEmbree();

}  // namespace defocus::engine
