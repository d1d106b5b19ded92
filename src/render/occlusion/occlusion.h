#pragma once
// Finds the triangles that each lens sample hides, from its own depth buffer, so that a software rasterizer can skip
// them. A hidden triangle costs such a rasterizer nearly as much as a visible one.
//
// The first sample of a block draws all triangles and sorts pieces of levels into visible and hidden. Each other sample
// first draws the visible pieces. It then tests the hidden pieces against its own depths and draws those that may be
// visible. (Greene, Kass and Miller 1993, Hierarchical Z-Buffer Visibility, use the previous frame where this uses the
// first sample.) No visible triangle is lost. Of two surfaces with equal depth, the one drawn first is visible, which
// may differ from the result without occlusion culling.

#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "gl/texture.h"
#include "plan/frame_plan.h"
#include "render/occlusion/depth_tiles.h"
#include "render/occlusion/index_pieces.h"

namespace defocus::engine {

// A primitive of an object at one level, as a pass draws it for a range of samples.
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

// Draws with hidden pieces removed, ordered by draw, or by sample first if samples differ.
struct RemainingDraws {
    std::vector<RemainingDraw> draws;
    std::vector<std::uint32_t> indices;
};

class Occlusion {
public:
    // `world` must outlive this object.
    explicit Occlusion(const World& world) : world_(&world) {}

    // Begins a plan, which must outlive the drawing. Culling stays off if it can't pay: with few triangles, or if the
    // lens or motion rules out the test.
    void prepare(const FramePlan& plan, const std::vector<OccludableDraw>& draws);

    // Returns whether all triangles of `sample` must be drawn so that its depths sort the pieces.
    [[nodiscard]] bool needsDepthsOf(std::uint32_t sample) const;
    // Sorts the pieces by sample `sample`, of which all triangles were drawn into layer `layer` of `depths`.
    void sortBy(std::uint32_t sample, const GlTexture& depths, std::uint32_t layer);
    // Returns whether the sorting found enough hidden triangles to skip.
    [[nodiscard]] bool hidesMuch() const { return hidesMuch_; }

    // Returns the draws to submit first, for all samples: pieces visible in the sorting sample, and objects that can't
    // be tested.
    [[nodiscard]] const RemainingDraws& shown() const { return shown_; }
    // Returns the further pieces that samples [first, first + count) may show after those draws. Sample `first` is in
    // layer `layer` of `depths`, the others in the following layers.
    [[nodiscard]] RemainingDraws uncovered(std::uint32_t first, std::uint32_t count, const GlTexture& depths,
                                           std::uint32_t layer) const;

private:
    struct Piece {
        const IndexPiece* piece = nullptr;
        bool shown = true;  // whether the sorting sample shows it
    };
    struct Sorted {
        OccludableDraw draw;
        std::vector<Piece> pieces;  // pieces in the plan's visible clusters
        bool canHide = false;
    };

    [[nodiscard]] const std::vector<IndexPiece>& piecesOf(const OccludableDraw& draw);
    void sortPieces(Sorted& sorted, std::uint32_t sample, const DepthTiles& tiles) const;
    void gatherShown();
    [[nodiscard]] RemainingDraws uncoveredBy(std::uint32_t sample, const DepthTiles& tiles) const;
    void append(const Sorted& sorted, const IndexPiece& piece, std::vector<std::uint32_t>& indices) const;

    const World* world_;
    const FramePlan* plan_ = nullptr;
    // Keyed by mesh, level and primitive.
    std::map<std::tuple<int, std::uint32_t, std::uint32_t>, std::vector<IndexPiece>> pieces_;
    std::vector<Sorted> sorted_;  // empty if culling is off
    std::int64_t sortedBlock_ = -1;
    bool hidesMuch_ = false;
    RemainingDraws shown_;
};

}  // namespace defocus::engine
