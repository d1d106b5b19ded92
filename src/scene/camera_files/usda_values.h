#pragma once
// Evaluates USD attributes, and the transforms of prims, at a time code.

#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/camera_files/usda_layer.h"

namespace defocus::engine {

// Returns the numbers of an attribute at a time code, with linear interpolation between samples; nullopt if the
// attribute is missing or empty. Throws Error if the attribute does not consist of `count` finite numbers. `where` is
// the start of the error message.
std::optional<std::vector<double>> usdNumbers(const UsdPrim& prim, std::string_view name, std::size_t count,
                                              double timeCode, const std::string& where);

// Returns the number in an attribute, or `otherwise` if the attribute is missing or empty.
double usdNumber(const UsdPrim& prim, std::string_view name, double timeCode, double otherwise,
                 const std::string& where);

// Returns the first string in the value of an attribute; empty if the attribute is missing or has no string.
std::string usdText(const UsdPrim& prim, std::string_view name);

struct UsdTransform {
    glm::dmat4 parentFromPrim{1.0};
    bool resetsStack = false;  // true: the ancestors' transforms do not apply
};

// Returns a prim's transform from xformOpOrder. Throws Error for an operation that is missing or unknown.
UsdTransform usdTransform(const UsdPrim& prim, double timeCode, const std::string& where);

}  // namespace defocus::engine
