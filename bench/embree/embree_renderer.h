#pragma once
// Renders independent reference images with a thin-lens ray tracer on Embree 3 that shares no code with the rasteriser.
// Of a FramePlan, the ray tracer uses only the view, whether there are shadows, and the sample count, seed and offset;
// with EmbreeSampling::planned, also the lens samples. It has its own lens model (lens_rays.h) and sampling, and traces
// the loaded meshes without any culling.
//
// The pixel filter is a box of 1 px. The output is linear premultiplied RGBA, summed in double. Surfaces are opaque and
// shaded as in traced_shading.h. Throws Error for environment maps, for blur that objects or vertices have
// themselves, and for blur controls that no physical lens has, except a foreground limit above 0 px.
//
// The code is optimised, because benches also compare its speed: rays are traced in packets (ray_packet.h), and each
// tile is traced for several samples in succession. If all pixels share a lens sample, packets are traced with Embree's
// flag for coherent rays. The image doesn't depend on the tile size or the number of threads.

#include <memory>

#include "render/renderer.h"

namespace defocus::engine {

enum class EmbreeSampling {
    perPixel,  // each pixel has its own scrambled points on the lens and in the pixel; errors appear as noise
    shared,    // all pixels share these points, as in method "accumulation"; errors appear as banding
    // Like `shared`, but with the points of FramePlan::samples, so that only geometry and visibility can differ from
    // the rasteriser. Uses Embree's watertight intersection tests. In the other modes, about one ray in a million
    // passes between two adjacent triangles.
    planned,
};

// Returns a ray tracer whose advance() traces up to 16 samples of every pixel on all cores.
std::unique_ptr<Renderer> makeEmbreeRenderer(const World& world, EmbreeSampling sampling = EmbreeSampling::perPixel);

// Adds the methods "embree", "embree-shared" and "embree-planned" to the table of methods. Further calls have no
// effect.
void registerEmbree();

}  // namespace defocus::engine
