#pragma once
// Defines strongly typed indices, and arrays that accept only one type of index. Vertices, half-edges and faces of the
// surface being simplified use OpenMesh's handles (surface_mesh.h), which also work as index types.

#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <numeric>
#include <ranges>
#include <span>
#include <utility>
#include <vector>

#include "core/memory.h"

namespace defocus::engine {

// Typed index, from 0. The tag type `Kind` separates indices of different arrays. Invalid by default.
template <typename Kind>
struct Number {
    static constexpr std::uint32_t none = 0xffffffffu;
    std::uint32_t value = none;

    [[nodiscard]] constexpr bool isValid() const { return value != none; }
    auto operator<=>(const Number&) const = default;
};

using FileVertexNumber = Number<struct FileVertexKind>;  // index into Mesh::vertices
// Index of a vertex of the mesh to simplify. Equal vertices in Mesh::vertices share one index. Copies of vertices
// (Simplification::twins) have the indices after the mesh's own vertices.
using MeshVertexNumber = Number<struct MeshVertexKind>;
using PositionNumber = Number<struct PositionKind>;            // a position, which several vertices may share
using SurfaceVertexNumber = Number<struct SurfaceVertexKind>;  // vertex of the manifold before any collapse
using SurfaceFaceNumber = Number<struct SurfaceFaceKind>;      // face of the manifold before any collapse
using WedgeNumber = Number<struct WedgeKind>;                  // index into WedgeTable
using ComponentNumber = Number<struct ComponentKind>;          // index into Simplifier::components
using PrimitiveNumber = Number<struct PrimitiveKind>;          // index into Mesh::primitives
using TriangleNumber = Number<struct TriangleKind>;            // index into a TriangleSet
using LevelVertexNumber = Number<struct LevelVertexKind>;      // vertex of one level, numbered by first use
using PyramidVertexNumber = Number<struct PyramidVertexKind>;  // index into Pyramid::vertices

// Tag type for the corners of faces. Corner 3·f + i is corner i of face f.
template <typename Face>
struct CornerOf;
template <typename Face>
using CornerNumber = Number<CornerOf<Face>>;

using TriangleCorner = CornerNumber<TriangleNumber>;

template <typename Face>
constexpr Face faceOf(Number<CornerOf<Face>> corner) {
    return {corner.value / 3};
}
template <typename Face>
constexpr CornerNumber<Face> cornerAt(Face face, std::uint32_t i) {
    return {3 * face.value + i};
}
// nextCorner() and previousCorner() return the next and the previous corner of the same face.
template <typename Face>
constexpr Number<CornerOf<Face>> nextCorner(Number<CornerOf<Face>> corner) {
    return {corner.value % 3 == 2 ? corner.value - 2 : corner.value + 1};
}
template <typename Face>
constexpr Number<CornerOf<Face>> previousCorner(Number<CornerOf<Face>> corner) {
    return {corner.value % 3 == 0 ? corner.value + 2 : corner.value - 1};
}

// indexOf() converts a typed number or an OpenMesh handle to an array index; itemAt() converts an array index to a
// typed number or a handle.
template <typename Key>
constexpr std::size_t indexOf(Key item) {
    if constexpr (requires { item.value; })
        return item.value;
    else if constexpr (std::unsigned_integral<Key>)
        return item;  // an integer key is itself the array index
    else
        return static_cast<std::size_t>(item.idx());
}
template <typename Key>
constexpr Key itemAt(std::size_t index) {
    if constexpr (requires { Key::none; })
        return Key{static_cast<std::uint32_t>(index)};
    else
        return Key(static_cast<int>(index));
}

// Returns the range of typed numbers 0 … count − 1.
template <typename Key>
auto numbersBelow(std::size_t count) {
    return std::views::iota(std::size_t{0}, count) | std::views::transform(itemAt<Key>);
}

// A LargeVector that is indexed by a typed number.
template <typename Key, typename T>
class Numbered : LargeVector<T> {
    using Values = LargeVector<T>;

public:
    using typename Values::const_iterator;
    using typename Values::iterator;
    using typename Values::value_type;
    using Values::assign;
    using Values::back;
    using Values::begin;
    using Values::clear;
    using Values::data;
    using Values::emplace_back;
    using Values::empty;
    using Values::end;
    using Values::front;
    using Values::insert;
    using Values::push_back;
    using Values::reserve;
    using Values::resize;
    using Values::shrink_to_fit;
    using Values::size;
    using Values::Values;

    T& operator[](Key item) { return Values::operator[](indexOf(item)); }
    const T& operator[](Key item) const { return Values::operator[](indexOf(item)); }
    bool operator==(const Numbered&) const = default;

    [[nodiscard]] auto numbers() const { return numbersBelow<Key>(size()); }
    // Returns the number that the next appended value will have.
    [[nodiscard]] Key next() const { return itemAt<Key>(size()); }
};

// Items grouped by key. Items with the same key are contiguous and keep their order.
template <typename Key, typename Item>
class Buckets {
public:
    // Groups the items 0 … itemCount − 1 by their keys keyOf(item), which are below keyCount. Items whose key is
    // invalid (Number::none or an invalid handle) are left out.
    template <typename KeyOf>
    Buckets(std::size_t keyCount, std::size_t itemCount, const KeyOf& keyOf) : first_(keyCount + 1, 0) {
        const auto items = numbersBelow<Item>(itemCount);
        for (const Item item : items)
            if (const Key key = keyOf(item); isKey(key)) ++first_[indexOf(key) + 1];
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
        items_.resize(first_.back());
        std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
        for (const Item item : items)
            if (const Key key = keyOf(item); isKey(key)) items_[next[indexOf(key)]++] = item;
    }

    [[nodiscard]] std::span<const Item> operator[](Key key) const {
        return std::span(items_).subspan(at(key), count(key));
    }
    [[nodiscard]] std::span<Item> operator[](Key key) { return std::span(items_).subspan(at(key), count(key)); }
    [[nodiscard]] auto keys() const { return numbersBelow<Key>(first_.size() - 1); }
    [[nodiscard]] std::size_t itemCount() const { return items_.size(); }
    // Moves all items out of this object, sorted by key.
    std::vector<Item> takeItems() { return std::move(items_); }

private:
    static bool isKey(Key key) {
        if constexpr (requires { key.isValid(); })
            return key.isValid();
        else
            return key.is_valid();
    }
    [[nodiscard]] std::size_t at(Key key) const { return first_[indexOf(key)]; }
    [[nodiscard]] std::size_t count(Key key) const { return first_[indexOf(key) + 1] - at(key); }

    std::vector<std::uint32_t> first_;
    std::vector<Item> items_;
};

}  // namespace defocus::engine

template <typename Kind>
struct std::hash<defocus::engine::Number<Kind>> {
    std::size_t operator()(defocus::engine::Number<Kind> number) const { return number.value; }
};
