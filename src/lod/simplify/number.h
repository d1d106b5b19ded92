#pragma once
// Numbers that count different things and so must not be mixed up. Vertices, half-edges and faces of the surface have
// OpenMesh's handles (surface_mesh.h); these are for the rest.

#include <compare>
#include <cstdint>

namespace defocus {

// A number of one kind of thing, from 0 on; by default it names none.
template <typename Kind>
struct Number {
    static constexpr std::uint32_t none = 0xffffffffu;
    std::uint32_t value = none;

    [[nodiscard]] bool isValid() const { return value != none; }
    auto operator<=>(const Number&) const = default;
};

using WedgeNumber = Number<struct WedgeKind>;          // into WedgeTable
using ComponentNumber = Number<struct ComponentKind>;  // into Simplifier::components
using PrimitiveNumber = Number<struct PrimitiveKind>;  // of the mesh's primitives

}  // namespace defocus
