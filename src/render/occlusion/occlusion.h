#pragma once
// Finds the triangles that are hidden in a lens sample from the sample's depth buffer, so that a software rasterizer
// can skip them. Without culling, a hidden triangle costs nearly as much as a visible triangle.
//
// In the first sample of a block, all triangles are drawn, and the pieces of each level (index_pieces.h) are classified
// as visible or hidden. In each later sample, the pieces classified as visible are drawn first. The hidden pieces are
// then tested against the sample's depth buffer, and drawn if they may be visible, so no visible triangle is lost.
// Source: Greene, Kass and Miller 1993, Hierarchical Z-Buffer Visibility, where the previous frame takes the role of
// the first sample. Where two surfaces have equal depth, the visible surface may differ from that without culling,
// because the order of draws differs.

#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "gl/texture.h"
#include "plan/frame_plan.h"
#include "render/occlusion/depth_tiles.h"
#include "render/occlusion/index_pieces.h"

namespace defocus::engine {

// Draw of a primitive of an object at one level of detail, for a range of samples.
struct OccludableDraw {
    std::uint32_t object = 0;  // index into FramePlan::objects
    std::uint32_t level = 0;
    std::uint32_t primitive = 0;
    std::uint32_t firstSample = 0;
    std::uint32_t sampleCount = 0;
};

struct RemainingDraw {
    std::size_t draw = 0;  // index into the draws of Occlusion::prepare
    std::uint32_t firstSample = 0;
    std::uint32_t sampleCount = 0;
    std::uint32_t firstIndex = 0;  // offset into RemainingDraws::indices
    std::uint32_t indexCount = 0;
};

// Draws that omit hidden pieces, in the order of the original draws; sample by sample if samples need different pieces.
struct RemainingDraws {
    std::vector<RemainingDraw> draws;
    std::vector<std::uint32_t> indices;
};

class Occlusion {
public:
    // `world` must outlive this object.
    explicit Occlusion(const World& world) : world_(&world) {}

    // Prepares culling for `plan`, which must exist until the last draw. Culling is off with few triangles, and if the
    // lens or motion rules out the test.
    void prepare(const FramePlan& plan, const std::vector<OccludableDraw>& draws);

    // Returns whether all triangles of `sample` must be drawn, because its depths are needed for sortBy().
    [[nodiscard]] bool needsDepthsOf(std::uint32_t sample) const;
    // Classifies the pieces as visible or hidden in sample `sample`, all of whose triangles were drawn into layer
    // `layer` of `depths`.
    void sortBy(std::uint32_t sample, const GlTexture& depths, std::uint32_t layer);
    // Returns whether the latest sortBy() found enough hidden triangles for culling to be faster.
    [[nodiscard]] bool hidesMuch() const { return hidesMuch_; }

    // Returns the draws to submit first for all samples: the pieces classified as visible, and objects that cannot be
    // tested.
    [[nodiscard]] const RemainingDraws& shown() const { return shown_; }
    // Returns the draws of hidden pieces that may be visible in samples [first, first + count), after shown() has been
    // drawn. The depths of sample `first` are in layer `layer` of `depths`, and the depths of later samples are in the
    // layers after it.
    [[nodiscard]] RemainingDraws uncovered(std::uint32_t first, std::uint32_t count, const GlTexture& depths,
                                           std::uint32_t layer) const;

private:
    struct Piece {
        const IndexPiece* piece = nullptr;
        bool shown = true;  // whether the piece is classified as visible
    };
    struct Sorted {
        OccludableDraw draw;
        std::vector<Piece> pieces;  // pieces of the clusters that the plan draws
        bool canHide = false;
    };

    [[nodiscard]] const std::vector<IndexPiece>& piecesOf(const OccludableDraw& draw);
    void sortPieces(Sorted& sorted, std::uint32_t sample, const DepthTiles& tiles) const;
    void gatherShown();
    [[nodiscard]] RemainingDraws uncoveredBy(std::uint32_t sample, const DepthTiles& tiles) const;
    void append(const Sorted& sorted, const IndexPiece& piece, std::vector<std::uint32_t>& indices) const;

    const World* world_;
    const FramePlan* plan_ = nullptr;
    // Pieces, keyed by mesh, level of detail and primitive.
    std::map<std::tuple<int, std::uint32_t, std::uint32_t>, std::vector<IndexPiece>> pieces_;
    std::vector<Sorted> sorted_;  // empty if culling is off
    std::int64_t sortedBlock_ = -1;
    bool hidesMuch_ = false;
    RemainingDraws shown_;
};

}  // namespace defocus::engine
