#pragma once
// Where a lens is focused.

#include <string>
#include <variant>
#include <vector>

#include "defocus/image.h"

namespace defocus {

// The camera's own focus distance; FocusAuto if the file gives none.
struct CameraFocus {
    bool operator==(const CameraFocus&) const = default;
};

struct FocusDistance {
    double metres = 1;  // along the view axis, > 0
    bool operator==(const FocusDistance&) const = default;
};

// The centre of a node.
struct FocusNode {
    std::string name;
    bool operator==(const FocusNode&) const = default;
};

// The surface that a pixel shows.
struct FocusPixel {
    Pixel pixel;
    bool operator==(const FocusPixel&) const = default;
};

// The surfaces that 3 … 16 pixels show: three define a focus plane, more a curved focus surface near them.
struct FocusPoints {
    std::vector<Pixel> pixels;
    bool operator==(const FocusPoints&) const = default;
};

// The median depth of the surfaces in the image's middle.
struct FocusAuto {
    bool operator==(const FocusAuto&) const = default;
};

using Focus = std::variant<CameraFocus, FocusDistance, FocusNode, FocusPixel, FocusPoints, FocusAuto>;

}  // namespace defocus
