#pragma once
// Method "layered": Lee, Eisemann and Seidel 2010, Real-Time Lens Blur Effects and Focus Control. The scene is drawn as
// seen from the lens centre into depth layers, which also contain surfaces behind the nearest surface. The lens rays of
// each pixel are then intersected with the layers (lens_rays.h). The scene is drawn once per layer, for any number of
// lens samples.
//
// As published, layers have one sample per pixel, so edges in focus are jagged. Several pinholes with different
// subpixel offsets smooth these edges (setting "pinholes"). Each pinhole has its own layers and an equal part of the
// lens samples.
//
// Errors compared with a real lens: rays miss surfaces that are in no layer or face away from the lens centre, and
// reflections are computed as seen from the lens centre.

#include "render/methods.h"

namespace defocus::engine {

Method layeredMethod();

}  // namespace defocus::engine
