#include "render/occlusion/occlusion.h"

#include <algorithm>
#include <iterator>
#include <optional>

#include "core/parallel.h"
#include "render/occlusion/lens_sight.h"

namespace defocus::engine {

namespace {

// Occlusion culling is off below either of these numbers of triangles, because the test would cost more than it saves.
constexpr std::uint64_t minTriangles = 50'000;  // triangles that one sample draws
constexpr std::uint64_t minInAll = 500'000;     // triangles that all samples except the first draw together
constexpr double maxShown = 0.8;                // max fraction of visible triangles; above it, drawing all is faster

std::uint64_t trianglesOfSample(const FramePlan& plan) {
    std::uint64_t triangles = 0;
    for (const ObjectPlan& object : plan.objects)
        triangles += std::max(object.coarse.triangleCount, object.fine.triangleCount);
    return triangles;
}

// Returns whether the index ranges `runs` contain `piece`, a group of neighbouring triangles. `runs` must be sorted and
// must not split pieces.
bool isIn(const std::vector<IndexRange>& runs, const IndexPiece& piece) {
    const auto after = std::ranges::upper_bound(runs, piece.indices.first, {}, &IndexRange::first);
    return after != runs.begin() && piece.indices.first < std::prev(after)->first + std::prev(after)->count;
}

bool hides(const DepthTiles& tiles, const LensSight& sight, const IndexPiece& piece) {
    const std::optional<SeenBox> seen = sight.of(piece.centre, piece.reach);
    if (!seen) return false;
    if (seen->left >= seen->right || seen->bottom >= seen->top) return true;
    return seen->depth < tiles.farthest(seen->left, seen->right, seen->bottom, seen->top);
}

std::vector<float> depthsOfLayer(const GlTexture& depths, std::uint32_t layer) {
    const TextureInfo& info = depths.info();
    std::vector<float> values(static_cast<std::size_t>(info.width) * static_cast<std::size_t>(info.height));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureSubImage(depths.name(), 0, 0, 0, static_cast<GLint>(layer), info.width, info.height, 1,
                         GL_DEPTH_COMPONENT, GL_FLOAT, static_cast<GLsizei>(values.size() * sizeof(float)),
                         values.data());
    return values;
}

}  // namespace

void Occlusion::prepare(const FramePlan& plan, const std::vector<OccludableDraw>& draws) {
    plan_ = &plan;
    tested_.clear();
    const std::uint64_t triangles = trianglesOfSample(plan);
    if (triangles < minTriangles || triangles * (plan.samples.size() - 1) < minInAll || !seesBoxes(plan)) return;
    for (const OccludableDraw& draw : draws) {
        const ObjectPlan& object = plan.objects[draw.object];
        const VisibleLevel* visible = visibleLevel(object, draw.level);
        Tested& tested = tested_.emplace_back(Tested{draw, {}, seesBoxes(object)});
        for (const IndexPiece& piece : piecesOf(draw))
            if (visible == nullptr || isIn(visible->primitives[draw.primitive], piece)) tested.pieces.push_back(&piece);
    }
}

const std::vector<IndexPiece>& Occlusion::piecesOf(const OccludableDraw& draw) {
    const int mesh = plan_->objects[draw.object].mesh;
    const auto [entry, isNew] = pieces_.try_emplace({mesh, draw.level, draw.primitive});
    if (isNew)
        entry->second = indexPieces(world_->pyramids[static_cast<std::size_t>(mesh)], draw.level, draw.primitive);
    return entry->second;
}

PieceVisibility Occlusion::visibilityIn(std::uint32_t sample, const GlTexture& depths, std::uint32_t layer) const {
    DepthTiles tiles;
    tiles.build(depthsOfLayer(depths, layer), depths.info().width, depths.info().height);
    PieceVisibility visibility;
    visibility.shown.resize(tested_.size());
    parallelFor(tested_.size(), [&](std::size_t i) { visibility.shown[i] = shownPieces(tested_[i], sample, tiles); });
    gatherShown(visibility);
    return visibility;
}

std::vector<bool> Occlusion::shownPieces(const Tested& tested, std::uint32_t sample, const DepthTiles& tiles) const {
    std::vector<bool> shown(tested.pieces.size(), true);
    if (!tested.canHide) return shown;
    const LensSight sight(*plan_, plan_->objects[tested.draw.object], sample);
    for (std::size_t p = 0; p < shown.size(); ++p) shown[p] = !hides(tiles, sight, *tested.pieces[p]);
    return shown;
}

void Occlusion::gatherShown(PieceVisibility& visibility) const {
    RemainingDraws& draws = visibility.draws;
    double shown = 0;
    double all = 0;
    for (std::size_t i = 0; i < tested_.size(); ++i) {
        const Tested& tested = tested_[i];
        const auto first = static_cast<std::uint32_t>(draws.indices.size());
        double whole = 0;
        for (std::size_t p = 0; p < tested.pieces.size(); ++p) {
            whole += tested.pieces[p]->indices.count;
            if (visibility.shown[i][p]) append(tested, *tested.pieces[p], draws.indices);
        }
        const auto count = static_cast<std::uint32_t>(draws.indices.size() - first);
        all += whole * tested.draw.sampleCount;
        shown += static_cast<double>(count) * tested.draw.sampleCount;
        if (count > 0) draws.draws.push_back({i, tested.draw.firstSample, tested.draw.sampleCount, first, count});
    }
    visibility.hidesMuch = shown < maxShown * all;
}

RemainingDraws Occlusion::uncovered(const PieceVisibility& visibility, std::uint32_t first, std::uint32_t count,
                                    const GlTexture& depths, std::uint32_t layer) const {
    std::vector<std::vector<float>> layers;
    for (std::uint32_t k = 0; k < count; ++k) layers.push_back(depthsOfLayer(depths, layer + k));
    std::vector<RemainingDraws> ofSamples(count);
    parallelFor(count, [&](std::size_t k) {
        DepthTiles tiles;
        tiles.build(layers[k], depths.info().width, depths.info().height);
        ofSamples[k] = uncoveredBy(visibility, first + static_cast<std::uint32_t>(k), tiles);
    });
    RemainingDraws all;
    for (RemainingDraws& own : ofSamples) {
        const auto begin = static_cast<std::uint32_t>(all.indices.size());
        for (RemainingDraw& draw : own.draws) draw.firstIndex += begin;
        all.draws.insert(all.draws.end(), own.draws.begin(), own.draws.end());
        all.indices.insert(all.indices.end(), own.indices.begin(), own.indices.end());
    }
    return all;
}

RemainingDraws Occlusion::uncoveredBy(const PieceVisibility& visibility, std::uint32_t sample,
                                      const DepthTiles& tiles) const {
    RemainingDraws remaining;
    for (std::size_t i = 0; i < tested_.size(); ++i) {
        const Tested& tested = tested_[i];
        const OccludableDraw& draw = tested.draw;
        if (!tested.canHide || sample < draw.firstSample || sample >= draw.firstSample + draw.sampleCount) continue;
        const LensSight sight(*plan_, plan_->objects[draw.object], sample);
        const auto first = static_cast<std::uint32_t>(remaining.indices.size());
        for (std::size_t p = 0; p < tested.pieces.size(); ++p)
            if (!visibility.shown[i][p] && !hides(tiles, sight, *tested.pieces[p]))
                append(tested, *tested.pieces[p], remaining.indices);
        const auto count = static_cast<std::uint32_t>(remaining.indices.size() - first);
        if (count > 0) remaining.draws.push_back({i, sample, 1, first, count});
    }
    return remaining;
}

void Occlusion::append(const Tested& tested, const IndexPiece& piece, std::vector<std::uint32_t>& indices) const {
    const int mesh = plan_->objects[tested.draw.object].mesh;
    const auto from = world_->pyramids[static_cast<std::size_t>(mesh)].indices.begin() + piece.indices.first;
    indices.insert(indices.end(), from, from + piece.indices.count);
}

}  // namespace defocus::engine
