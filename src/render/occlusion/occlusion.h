#pragma once
// Uses the depth buffer of a lens sample to find the triangles that are hidden in the sample, so that a software
// rasterizer can skip them. Without culling, a hidden triangle costs nearly as much as a visible triangle.
//
// In the first sample of a block of 64, all triangles are drawn, and each piece (a few neighbouring triangles,
// index_pieces.h) is classified as visible or hidden. In each later sample, the pieces classified as visible are drawn
// first. The hidden pieces are then tested against the sample's depth buffer, and drawn if they may be visible, so no
// visible triangle is lost. Source: Greene, Kass and Miller 1993, Hierarchical Z-Buffer Visibility, where the previous
// frame takes the role of the first sample. Where two surfaces have equal depth, culling may change which of them is
// visible, because it changes the order of draws.
//
// Several threads may draw the batches (waves) of samples of a frame. The thread that draws the first sample of a block
// classifies the pieces, and the threads that draw the block's other batches wait for the classification.

#include <cstdint>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>
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
    std::size_t draw = 0;  // index into the draws passed to Occlusion::prepare
    std::uint32_t firstSample = 0;
    std::uint32_t sampleCount = 0;
    std::uint32_t firstIndex = 0;  // offset into RemainingDraws::indices
    std::uint32_t indexCount = 0;
};

// Draw calls without the hidden triangles, in the order of the original draw calls; one draw call per sample if samples
// need different triangles.
struct RemainingDraws {
    std::vector<RemainingDraw> draws;
    std::vector<std::uint32_t> indices;
};

// Classification of all pieces (groups of neighbouring triangles) as visible or hidden in the first sample of a block
// of 64 lens samples.
struct PieceVisibility {
    // For each draw passed to Occlusion::prepare: whether each of its pieces (groups of triangles) is visible.
    std::vector<std::vector<bool>> shown;
    RemainingDraws draws;    // draws of the visible pieces, and of objects that cannot be tested
    bool hidesMuch = false;  // whether enough triangles are hidden for culling to save time
};

// Gives a batch (wave) access to its block's PieceVisibility, the classification of triangles as visible or hidden. The
// batch with the block's first sample makes the classification and passes it to the promise `made`; all batches of the
// block use it. If that batch fails or is abandoned, it destroys the promise, and the waiting batches throw
// std::future_error.
struct WaveVisibility {
    using Value = std::shared_ptr<const PieceVisibility>;
    // Promise of the classification. Set only in the batch with the block's first sample, until make() fulfils the
    // promise.
    std::optional<std::promise<Value>> made;
    std::shared_future<Value> shared;

    void make(PieceVisibility visibility) {
        made->set_value(std::make_shared<const PieceVisibility>(std::move(visibility)));
        made.reset();
    }
};

class Occlusion {
public:
    // `world` must outlive this object.
    explicit Occlusion(const World& world) : world_(&world) {}

    // Prepares culling for `plan`, which must outlive all draws. Nothing is culled if there are few triangles, or if
    // the lens or motion makes the test impossible.
    void prepare(const FramePlan& plan, const std::vector<OccludableDraw>& draws);
    // Returns whether hidden triangles are culled. If so, the first sample of each block of 64 samples must be drawn
    // with all triangles, because its depth buffer is used to classify triangles as visible or hidden.
    [[nodiscard]] bool culls() const { return !tested_.empty(); }

    // Any number of threads may call the functions below. Each thread needs a current OpenGL context.

    // Classifies the pieces (groups of triangles) as visible or hidden in sample `sample`. All triangles of this sample
    // must have been drawn into layer `layer` of `depths`.
    [[nodiscard]] PieceVisibility visibilityIn(std::uint32_t sample, const GlTexture& depths,
                                               std::uint32_t layer) const;
    // Returns the draws of pieces (groups of triangles) that are classified as hidden but may be visible in samples
    // [first, first + count). Must be called after the pieces classified as visible have been drawn. The depths of
    // sample `first` are in layer `layer` of `depths`, and the depths of later samples are in the layers after it.
    [[nodiscard]] RemainingDraws uncovered(const PieceVisibility& visibility, std::uint32_t first, std::uint32_t count,
                                           const GlTexture& depths, std::uint32_t layer) const;

private:
    struct Tested {
        OccludableDraw draw;
        std::vector<const IndexPiece*> pieces;  // groups of triangles in the clusters that the plan draws
        bool canHide = false;
    };

    [[nodiscard]] const std::vector<IndexPiece>& piecesOf(const OccludableDraw& draw);
    [[nodiscard]] std::vector<bool> shownPieces(const Tested& tested, std::uint32_t sample,
                                                const DepthTiles& tiles) const;
    void gatherShown(PieceVisibility& visibility) const;
    [[nodiscard]] RemainingDraws uncoveredBy(const PieceVisibility& visibility, std::uint32_t sample,
                                             const DepthTiles& tiles) const;
    void append(const Tested& tested, const IndexPiece& piece, std::vector<std::uint32_t>& indices) const;

    const World* world_;
    const FramePlan* plan_ = nullptr;
    // Pieces (groups of neighbouring triangles), keyed by mesh, level of detail and primitive.
    std::map<std::tuple<int, std::uint32_t, std::uint32_t>, std::vector<IndexPiece>> pieces_;
    std::vector<Tested> tested_;  // tested draws; empty if culling is off
};

}  // namespace defocus::engine
