#pragma once
// Ways to set the focus distance of a lens.

#include <string>
#include <variant>
#include <vector>

#include "defocus/image.h"

namespace defocus {

// Uses the focus distance of the camera in the scene file, or FocusAuto if the file gives none.
struct CameraFocus {
    bool operator==(const CameraFocus&) const = default;
};

struct FocusDistance {
    double metres = 1;  // distance along the view axis, > 0
    bool operator==(const FocusDistance&) const = default;
};

// Focuses on a node: on the centre of its mesh's bounding box, or on its origin if the node has no mesh.
struct FocusNode {
    std::string name;
    bool operator==(const FocusNode&) const = default;
};

// Focuses on the surface that is visible in a pixel.
struct FocusPixel {
    Pixel pixel;
    bool operator==(const FocusPixel&) const = default;
};

// Focuses on the surfaces visible in 3 to 16 pixels. Three pixels define a tilted focus plane. More pixels define a
// curved focus surface, fitted to these surface points by least squares.
struct FocusPoints {
    std::vector<Pixel> pixels;
    bool operator==(const FocusPoints&) const = default;
};

// Focuses at the median depth of the surfaces around the image's centre.
struct FocusAuto {
    bool operator==(const FocusAuto&) const = default;
};

// Focus distances in m; 0 < nearest ≤ farthest, and infinity is allowed.
struct FocusRange {
    double nearest = 0;
    double farthest = 0;
};

using Focus = std::variant<CameraFocus, FocusDistance, FocusNode, FocusPixel, FocusPoints, FocusAuto>;

}  // namespace defocus
