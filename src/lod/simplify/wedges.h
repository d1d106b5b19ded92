#pragma once
// Stores the attributes and attribute quadrics of wedges. The surface is connected by position, but each face corner
// refers to a mesh vertex with attributes, called a wedge (Hoppe 1998, Efficient Implementation of Progressive Meshes).
// UV seams, creases and material borders can therefore exist on a closed surface.

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

// Weight of an attribute: the distance, in units of the mesh's longest side, that costs as much as a change of the
// attribute by 1. Texture coordinates are scaled to surface lengths, so that the error measures how far the texture
// slides. The weights come from a parameter sweep on the school of fish. Halving or doubling a weight costs up to 0.5
// dB of PSNR at the same triangle count.
constexpr float normalWeight = 0.003f;
constexpr float colorWeight = 0.005f;  // weight of colours with components in [0, 1]
constexpr float uvWeight = 0.05f;
// Weight of a vertex's blur modifiers (VertexBlur), each divided by its range over the mesh. This weight is four times
// the colour weight, so that coarse levels keep the modifiers at the positions of the original vertices.
constexpr float blurWeight = 0.02f;

class WedgeTable {
public:
    // Creates one wedge per vertex with the vertex's weighted attributes. `uvScale` converts texture coordinates to
    // lengths on the mesh scaled to unit size.
    void assign(const Vertices& vertices, float uvScale);
    // Returns whether attributes vary over a face with these three wedges at its corners.
    [[nodiscard]] bool changes(const WedgeNumber* corners) const;
    // Gives each wedge an empty quadric. Must precede addFace(). `changing` tells for each wedge whether attributes
    // vary over any of the wedge's faces.
    void startQuadrics(const std::vector<bool>& changing);
    // Keeps only the wedges in `order` (ascending), and renumbers them.
    void keep(std::span<const WedgeNumber> order);

    [[nodiscard]] std::size_t size() const { return sources_.size(); }
    // Returns the mesh vertex of the wedge.
    [[nodiscard]] MeshVertexNumber source(WedgeNumber w) const { return sources_[w.value]; }
    // Returns the weighted attributes of the wedge: normal, colour, blur and uv, without attributes that the mesh
    // lacks.
    [[nodiscard]] std::span<const float> row(WedgeNumber w) const {
        return {&rows_[w.value * attributeCount_], attributeCount_};
    }

    // Returns whether two wedges differ at most in their normals, so that no seam separates them.
    [[nodiscard]] bool sameChart(WedgeNumber a, WedgeNumber b) const {
        const auto first = row(a);
        return std::equal(first.begin() + 3, first.end(), row(b).begin() + 3);
    }
    // Returns the squared distance between two wedges in texture space, scaled to lengths on the unit-size mesh.
    [[nodiscard]] double uvDifference(WedgeNumber a, WedgeNumber b) const;
    // Returns the dissimilarity of two wedges: the sum of the squared differences of normal, colour (times 4), blur
    // (times 4) and texture coordinates.
    [[nodiscard]] double difference(WedgeNumber a, WedgeNumber b) const;

    // Adds a face to the quadrics of the wedges at its three corners; `places` are the positions of the corners.
    // Slivers are ignored, because their gradients are mostly noise.
    void addFace(const WedgeNumber* corners, const glm::dvec3* places);
    // Returns the cost of replacing the wedge `from` by the wedge `to`; never negative. `step` is the vector from the
    // position of `from` to that of `to`.
    [[nodiscard]] float cost(WedgeNumber from, WedgeNumber to, const glm::vec3& step) const;
    // Adds the quadric of the wedge `from` to the quadric of the wedge `to`, and clears the quadric of `from`. `step`
    // is as in cost().
    void moveQuadric(WedgeNumber from, WedgeNumber to, const glm::vec3& step);
    // Prefetch the memory of a wedge: prefetchStart() if the wedge will be passed to cost() as `to`, prefetch() if it
    // will be passed to moveQuadric().
    void prefetchStart(WedgeNumber w) const;
    void prefetch(WedgeNumber w) const;

private:
    // One alternative per possible number of attributes: normals (3), optionally with uv (2), colours (3) and blur (3).
    using Quadrics = std::variant<DenseQuadrics<3>, DenseQuadrics<5>, DenseQuadrics<6>, DenseQuadrics<8>,
                                  DenseQuadrics<9>, DenseQuadrics<11>, SparseQuadrics<3>>;

    std::size_t attributeCount_ = 3;
    bool hasColors_ = false;
    bool hasBlurs_ = false;
    bool hasUv_ = false;
    LargeVector<float> rows_;  // weighted attributes, attributeCount_ per wedge
    LargeVector<MeshVertexNumber> sources_;
    Quadrics quadrics_ = DenseQuadrics<3>(0);
};

}  // namespace defocus::engine
