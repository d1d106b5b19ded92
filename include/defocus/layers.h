#pragma once
// Layers: data images beside the colours of a picture. Each layer is the mean over the picture's lens samples, with the
// same pixel filter, premultiplied by the coverage of the surfaces.

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
    motion,     // movement from the shutter's opening to its closing, px: x right, y up
    coc,        // signed diameter of the circle of confusion, px; > 0 behind the focus plane
    objects,    // Cryptomatte of the objects
    materials,  // Cryptomatte of the materials
};

// Channel names in multi-layer EXR files: Nuke's (N.X, depth.Z) or Blender's (ViewLayer.Normal.X).
enum class ExrNames { nuke, blender };

}  // namespace defocus
