#pragma once
// The independent truth: a thin-lens ray tracer on Embree 3 that shares no code with the rasteriser. It reads the view,
// the sample count, seed and offset of a FramePlan and decides everything else itself: own lens model (lens_rays.h),
// own sampling, the meshes as they were read, nothing left out.
//
// Box pixel filter of 1 px, linear RGBA premultiplied, sums in double. Opaque surfaces only; shading as in
// traced_shading.h. Environment maps are an Error.
//
// It is an opponent in benches too, so it is made to be fast: packets of rays (ray_packet.h), several samples of a tile
// one after the other. Where one lens sample serves all pixels, packets are traced as coherent ones. The image depends
// neither on tiles nor on threads.

#include <memory>

#include "render/renderer.h"

namespace defocus::engine {

enum class EmbreeSampling {
    perPixel,  // every pixel has its own scrambled lens and pixel samples: error is noise
    shared,    // all pixels share each sample's lens and pixel point, as accumulation does: error is banding
    // As `shared`, at the points of FramePlan::samples: leaves nothing but geometry and visibility to differ.
    // Watertight; the others lose about one ray in a million between two triangles.
    planned,
};

// Up to 16 samples of every pixel an advance(), on all cores.
std::unique_ptr<Renderer> makeEmbreeRenderer(const World& world, EmbreeSampling sampling = EmbreeSampling::perPixel);

// Adds "embree", "embree-shared" and "embree-planned" to the table of methods, once however often it is called.
void registerEmbree();

}  // namespace defocus::engine
