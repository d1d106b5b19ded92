#pragma once
// Layers are images of data, such as depth or normals, that are rendered together with the colour image. Each layer is
// the mean over the lens samples, filtered with the image's pixel filter and premultiplied by the coverage of the
// surfaces.

#include <cstdint>
#include <string>
#include <vector>

namespace defocus {

enum class Layer {
    depth,      // mean and nearest depth along the view axis, m
    position,   // position in world space, m
    normal,     // shading normal in world space
    albedo,     // base colour
    emission,   // emitted radiance
    motion,     // motion vector from the shutter's opening to its closing, px: x right, y up
    coc,        // signed diameter of the circle of confusion, px; > 0 behind the focus plane
    objects,    // Cryptomatte of the objects
    materials,  // Cryptomatte of the materials
};

// Channel names in multi-layer EXR files: Nuke's (N.X, depth.Z) or Blender's (ViewLayer.Normal.X).
enum class ExrNames { nuke, blender };

}  // namespace defocus
