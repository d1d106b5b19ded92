#pragma once
// Wedges. The surface is joined by position, but each corner of a face draws a mesh vertex of its own, its wedge (Hoppe
// 1998, Efficient Implementation of Progressive Meshes), so that UV seams, creases and material borders live on a
// closed surface. The table holds each wedge's attributes and its attribute quadric.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "core/memory.h"
#include "lod/simplify/attribute_quadrics.h"
#include "lod/simplify/number.h"
#include "scene/mesh.h"

namespace defocus::engine {

// The distance, in the mesh's longest sides, that weighs as much as a unit of an attribute (of uv: scaled to lengths of
// the surface, so that it tells a texture that slides). Swept on the school of fish: half or twice as much costs up to
// 0.5 dB at the same triangles.
constexpr float normalWeight = 0.003f;
constexpr float colorWeight = 0.005f;  // of colours in [0, 1]
constexpr float uvWeight = 0.05f;
// Of a blur that vertices have themselves, over the mesh's range of it. A level must show a blur where the file has it:
// four times a colour's weight.
constexpr float blurWeight = 0.02f;

class WedgeTable {
public:
    // Makes one wedge a vertex, with the weighted attributes that the vertices have. `uvScale` leads from uv to lengths
    // of the unit frame.
    void assign(const Vertices& vertices, float uvScale);
    // Whether attributes change over a face with these wedges at its corners.
    [[nodiscard]] bool changes(const WedgeNumber* corners) const;
    // Gives each wedge an empty quadric. Must be called before addFace(). `changing` says of each wedge whether it is
    // on a face that changes().
    void startQuadrics(const std::vector<bool>& changing);
    // Keeps the wedges that are named, in this order (ascending).
    void keep(std::span<const WedgeNumber> order);

    [[nodiscard]] std::size_t size() const { return sources_.size(); }
    // The mesh vertex that the wedge's corners draw.
    [[nodiscard]] MeshVertexNumber source(WedgeNumber w) const { return sources_[w.value]; }
    // Weighted attributes: normal, then colour, then blur, then uv, as far as the mesh has them.
    [[nodiscard]] std::span<const float> row(WedgeNumber w) const {
        return {&rows_[w.value * attributeCount_], attributeCount_};
    }

    // Whether no seam lies between two wedges: they differ in nothing but their normals.
    [[nodiscard]] bool sameChart(WedgeNumber a, WedgeNumber b) const {
        const auto first = row(a);
        return std::equal(first.begin() + 3, first.end(), row(b).begin() + 3);
    }
    // Returns the squared distance between two wedges in texture space, in units of the frame.
    [[nodiscard]] double uvDifference(WedgeNumber a, WedgeNumber b) const;
    // Returns how unlike two wedges are: the sum of the squared distances between their normals, between their colours
    // and blurs (times 4) and in texture space.
    [[nodiscard]] double difference(WedgeNumber a, WedgeNumber b) const;

    // Adds a face to the quadrics of the three wedges at its corners, which lie at `places`. Leaves a sliver out,
    // because its gradients would be noise.
    void addFace(const WedgeNumber* corners, const glm::dvec3* places);
    // Returns the cost of drawing `to`, which is `step` away, where `from` was drawn; never negative.
    [[nodiscard]] float cost(WedgeNumber from, WedgeNumber to, const glm::vec3& step) const;
    // Moves what the quadric of `from` holds to that of `to`, which is `step` away.
    void moveQuadric(WedgeNumber from, WedgeNumber to, const glm::vec3& step);
    // Asks the caches for the first of what cost() needs of a survivor, and for all that moveQuadric() needs.
    void prefetchStart(WedgeNumber w) const;
    void prefetch(WedgeNumber w) const;

private:
    // All numbers of attributes that a mesh can have: its normals alone, or with uv (2), with colours (3), with blurs
    // (3), with some of them.
    using Quadrics = std::variant<DenseQuadrics<3>, DenseQuadrics<5>, DenseQuadrics<6>, DenseQuadrics<8>,
                                  DenseQuadrics<9>, DenseQuadrics<11>, SparseQuadrics<3>>;

    std::size_t attributeCount_ = 3;
    bool hasColors_ = false;
    bool hasBlurs_ = false;
    bool hasUv_ = false;
    LargeVector<float> rows_;  // attributeCount_ a wedge
    LargeVector<MeshVertexNumber> sources_;
    Quadrics quadrics_ = DenseQuadrics<3>(0);
};

}  // namespace defocus::engine
