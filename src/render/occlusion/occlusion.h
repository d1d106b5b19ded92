#pragma once
// Finds which triangles each lens sample hides behind others, by its own depth buffer, so that a software rasteriser
// needn't draw them: it takes nearly as long for a triangle that nobody sees as for one that shows.
//
// The first sample of a block of the sum draws everything. The others first draw the pieces of levels that it doesn't
// hide. Then each asks its own depths which of the rest may show, and draws those too. (Greene, Kass and Miller 1993,
// Hierarchical Z-Buffer Visibility, whose image of the frame before is that of the first sample here.) So nothing that
// shows is left out. Where two surfaces have equal depths the one that is drawn first shows, which may be another than
// without this.

#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "gl/texture.h"
#include "plan/frame_plan.h"
#include "render/occlusion/depth_tiles.h"
#include "render/occlusion/index_pieces.h"

namespace defocus::engine {

// A primitive of an object at a level, as a pass draws it for some samples.
struct OccludableDraw {
    std::uint32_t object = 0;  // into FramePlan::objects
    std::uint32_t level = 0;
    std::uint32_t primitive = 0;
    std::uint32_t firstSample = 0;
    std::uint32_t sampleCount = 0;
};

struct RemainingDraw {
    std::size_t draw = 0;  // into those that Occlusion was prepared for
    std::uint32_t firstSample = 0;
    std::uint32_t sampleCount = 0;
    std::uint32_t firstIndex = 0;  // into RemainingDraws::indices
    std::uint32_t indexCount = 0;
};

// In the order of the draws, and of the samples where those differ.
struct RemainingDraws {
    std::vector<RemainingDraw> draws;
    std::vector<std::uint32_t> indices;
};

class Occlusion {
public:
    // `world` must outlive it.
    explicit Occlusion(const World& world) : world_(&world) {}

    // Begins a plan, which must outlive the drawing. Where nothing can be gained, all draws remain whole: the lens or
    // what moves may forbid it, or there are few triangles.
    void prepare(const FramePlan& plan, const std::vector<OccludableDraw>& draws);

    // Whether `sample` has to be drawn whole, so that its depths sort the pieces.
    [[nodiscard]] bool needsDepthsOf(std::uint32_t sample) const;
    // `sample` was drawn whole into layer `layer` of `depths`.
    void sortBy(std::uint32_t sample, const GlTexture& depths, std::uint32_t layer);
    // Whether that has found enough to leave out.
    [[nodiscard]] bool hidesMuch() const { return hidesMuch_; }

    // What comes first, for all samples: what the sorting sample doesn't hide, and objects that can't be asked.
    [[nodiscard]] const RemainingDraws& shown() const { return shown_; }
    // What else samples [first, first + count) may show once that is drawn. Sample `first` is in layer `layer` of
    // `depths`, the others in those after it.
    [[nodiscard]] RemainingDraws uncovered(std::uint32_t first, std::uint32_t count, const GlTexture& depths,
                                           std::uint32_t layer) const;

private:
    struct Piece {
        const IndexPiece* piece = nullptr;
        bool shown = true;  // to the sorting sample
    };
    struct Sorted {
        OccludableDraw draw;
        std::vector<Piece> pieces;  // that the plan's clusters leave
        bool canHide = false;
    };

    [[nodiscard]] const std::vector<IndexPiece>& piecesOf(const OccludableDraw& draw);
    void sortPieces(Sorted& sorted, std::uint32_t sample, const DepthTiles& tiles) const;
    void gatherShown();
    [[nodiscard]] RemainingDraws uncoveredBy(std::uint32_t sample, const DepthTiles& tiles) const;
    void append(const Sorted& sorted, const IndexPiece& piece, std::vector<std::uint32_t>& indices) const;

    const World* world_;
    const FramePlan* plan_ = nullptr;
    // By mesh, level and primitive.
    std::map<std::tuple<int, std::uint32_t, std::uint32_t>, std::vector<IndexPiece>> pieces_;
    std::vector<Sorted> sorted_;  // empty where nothing can be gained
    std::int64_t sortedBlock_ = -1;
    bool hidesMuch_ = false;
    RemainingDraws shown_;
};

}  // namespace defocus::engine
