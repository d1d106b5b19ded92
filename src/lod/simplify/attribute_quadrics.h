#pragma once
// Stores the attribute quadrics (quadric.h) of all wedges (the vertices at face corners, see wedges.h). The dense and
// the sparse representation have the same interface.

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

#include "core/memory.h"
#include "lod/simplify/number.h"
#include "lod/simplify/quadric.h"

namespace defocus::engine {

template <std::size_t n>
class DenseQuadrics {
public:
    static constexpr std::size_t attributes = n;

    explicit DenseQuadrics(std::size_t wedges) : all_(wedges) {}

    [[nodiscard]] const AttributeQuadric<n>& operator[](WedgeNumber w) const { return all_[w.value]; }
    [[nodiscard]] float costInPlace(WedgeNumber w) const { return all_[w.value].squares.c; }
    // Adds a face's quadric to the quadric of wedge `w`.
    void addFace(WedgeNumber w, const AttributeQuadric<n>& face) { all_[w.value].addFaces(face); }
    // Moves the quadric of wedge `from` into the quadric of wedge `to`, when a collapse replaces `from` by `to`. `step`
    // and `change` are the differences in position and attributes from `from` to `to`.
    void move(WedgeNumber from, WedgeNumber to, const glm::vec3& step, const AttributeRow<n>& change) {
        all_[to.value].add(all_[from.value], step, change);
        all_[from.value] = {};
    }
    // Keeps only the wedges in `order` (ascending) and renumbers them.
    void keep(std::span<const WedgeNumber> order) {
        for (std::size_t i = 0; i < order.size(); ++i) all_[i] = all_[order[i].value];
        all_.resize(order.size());
        giveBackRoom(all_);
    }
    void prefetchStart(WedgeNumber w) const { __builtin_prefetch(&all_[w.value]); }
    void prefetch(WedgeNumber w) const {
        const auto* const bytes = reinterpret_cast<const std::byte*>(&all_[w.value]);
        for (std::size_t i = 0; i < sizeof(all_[0]); i += 64) __builtin_prefetch(bytes + i);
    }

private:
    LargeVector<AttributeQuadric<n>> all_;
};

// Attribute quadrics for meshes whose attributes are mostly constant over each face, such as flat-shaded meshes. The
// quadric of a face with constant attributes does not depend on position. It takes a quarter of a general quadric's
// memory, and so does a sum of such quadrics.
template <std::size_t n>
class SparseQuadrics {
public:
    static constexpr std::size_t attributes = n;

    // `changing`: for each wedge, true if attributes vary over any of the wedge's faces.
    explicit SparseQuadrics(const std::vector<bool>& changing) : even_(changing.size()) {
        changesOf_.reserve(changing.size());
        std::uint32_t count = 0;
        for (const bool changes : changing) changesOf_.push_back(changes ? count++ : none);
        changes_.resize(count);
    }

    [[nodiscard]] AttributeQuadric<n> operator[](WedgeNumber w) const {
        AttributeQuadric<n> quadric;
        const Even& even = even_[w.value];
        if (changesOf_[w.value] != none) {
            quadric.squares = changes_[changesOf_[w.value]].squares;
            quadric.gradients = changes_[changesOf_[w.value]].gradients;
        }
        quadric.squares.c = even.c;
        quadric.squares.weight = even.weight;
        quadric.offset = even.offset;
        return quadric;
    }
    [[nodiscard]] float costInPlace(WedgeNumber w) const { return even_[w.value].c; }
    void addFace(WedgeNumber w, const AttributeQuadric<n>& face) {
        AttributeQuadric<n> sum = (*this)[w];
        sum.addFaces(face);
        set(w, sum);
    }
    void move(WedgeNumber from, WedgeNumber to, const glm::vec3& step, const AttributeRow<n>& change) {
        AttributeQuadric<n> sum = (*this)[to];
        sum.add((*this)[from], step, change);
        if (changesOf_[to.value] == none) changesOf_[to.value] = changesOf_[from.value];
        changesOf_[from.value] = none;
        even_[from.value] = {};
        set(to, sum);
    }
    void keep(std::span<const WedgeNumber> order) {
        LargeVector<Changes> kept;
        std::size_t count = 0;
        for (const WedgeNumber w : order) count += changesOf_[w.value] != none ? 1 : 0;
        kept.reserve(count);
        for (std::size_t i = 0; i < order.size(); ++i) {
            even_[i] = even_[order[i].value];
            const std::uint32_t at = changesOf_[order[i].value];
            changesOf_[i] = at != none ? static_cast<std::uint32_t>(kept.size()) : none;
            if (at != none) kept.push_back(changes_[at]);
        }
        even_.resize(order.size());
        changesOf_.resize(order.size());
        giveBackRoom(even_);
        giveBackRoom(changesOf_);
        changes_.swap(kept);
    }
    void prefetchStart(WedgeNumber w) const { __builtin_prefetch(&even_[w.value]); }
    void prefetch(WedgeNumber w) const {
        prefetchStart(w);
        __builtin_prefetch(&changesOf_[w.value]);
    }

private:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    struct Even {  // Terms of a quadric that do not depend on position.
        float c = 0;
        float weight = 0;
        AttributeRow<n> offset{};
    };
    struct Changes {
        Quadric squares;
        AttributeGradients<n> gradients{};
    };

    void set(WedgeNumber w, const AttributeQuadric<n>& quadric) {
        even_[w.value] = {quadric.squares.c, quadric.squares.weight, quadric.offset};
        if (changesOf_[w.value] != none) changes_[changesOf_[w.value]] = {quadric.squares, quadric.gradients};
    }

    LargeVector<Even> even_;
    // For each wedge, the index in changes_ of its position-dependent terms; `none` if it has no such terms.
    LargeVector<std::uint32_t> changesOf_;
    LargeVector<Changes> changes_;
};

}  // namespace defocus::engine
