#include "plan/visible/blend_order.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <iterator>
#include <queue>

#include "core/bounds.h"
#include "core/parallel.h"
#include "plan/visible/blend_part.h"

namespace defocus::engine {

namespace {

constexpr std::size_t maxConvexTriangles = 1000;  // max triangles of a primitive that isConvex() tests
constexpr std::size_t maxParts = 5000;            // max parts to sort in a frame; limits the time for comparing pairs
constexpr double tolerance = 1e-4;                // allowance for rounded positions, relative to the primitive's size

// An alpha-blended or transmissive primitive of an object.
struct Candidate {
    std::uint32_t object = 0;
    std::uint32_t primitive = 0;
    bool transmits = false;
    bool doubleSided = false;
};

// A node of the sorting graph: a convex part of a primitive, or an entire primitive.
struct BlendNode {
    std::size_t candidate = 0;
    BlendRun run;
    BlendPart part;  // unset if the node is an entire primitive, transmissive or drawn by stochastic transparency
};

// Draw-order constraints between a node and the nodes before it in BlendSorter::nodes_, as indices of these nodes.
struct Relations {
    std::vector<std::size_t> before;     // nodes that must be drawn before this node
    std::vector<std::size_t> after;      // nodes that must be drawn after this node
    std::vector<std::size_t> unordered;  // nodes that cannot be sorted relative to this node
};

class BlendSorter {
public:
    BlendSorter(FramePlan& plan, const World& world) : plan_(&plan), world_(&world) {}

    // Returns the value for FramePlan::blendOrder, and sets ObjectPlan::blended.
    std::vector<BlendRun> runs();

private:
    void findCandidates();
    void addNodes(std::size_t candidate);
    [[nodiscard]] std::vector<BlendNode> partsOf(std::size_t candidate) const;
    void relate();
    [[nodiscard]] Relations relationsOf(std::size_t node) const;
    [[nodiscard]] std::vector<std::size_t> backToFront();
    [[nodiscard]] bool transmits(std::size_t node) const { return candidates_[nodes_[node].candidate].transmits; }

    FramePlan* plan_;
    const World* world_;
    std::vector<Candidate> candidates_;  // sorted by object, the nearest object first
    std::vector<BlendNode> nodes_;
    std::vector<Relations> relations_;  // draw-order constraints, one entry per node
};

void BlendSorter::findCandidates() {
    const Scene& scene = *world_->scene;
    for (std::uint32_t i = 0; i < plan_->objects.size(); ++i) {
        ObjectPlan& object = plan_->objects[i];
        const Mesh& mesh = scene.meshes[static_cast<std::size_t>(object.mesh)];
        for (std::uint32_t p = 0; p < mesh.primitives.size(); ++p) {
            if (mesh.primitives[p].material < 0) continue;
            const Material& material = scene.materials[static_cast<std::size_t>(mesh.primitives[p].material)];
            object.blended |= material.alphaMode == AlphaMode::blend;
            if (material.alphaMode == AlphaMode::blend || material.transmits())
                candidates_.push_back({i, p, material.transmits(), material.doubleSided});
        }
    }
}

// Returns the convex parts of a primitive at its drawn levels; empty if there are too many parts, or if the mesh
// deforms.
std::vector<BlendNode> BlendSorter::partsOf(std::size_t candidate) const {
    const Candidate& from = candidates_[candidate];
    const ObjectPlan& object = plan_->objects[from.object];
    if (object.deformed || object.skinned) return {};
    const Pyramid& pyramid = world_->pyramids[static_cast<std::size_t>(object.mesh)];
    std::vector<std::uint32_t> levels;
    for (const LevelDraw& draw : {object.fine, object.coarse})
        if (draw.sampleCount > 0) levels.push_back(draw.level);
    const auto positionsOf = [&](std::uint32_t level) -> const auto& {
        return pyramid.levels[level].positions;
    };
    const auto rangeOf = [&](std::uint32_t level) { return pyramid.levels[level].primitives[from.primitive]; };
    const auto indicesOf = [&](const IndexRange& range) {
        return std::span(pyramid.indices).subspan(range.first, range.count);
    };
    const auto node = [&](std::uint32_t level, const IndexRange& range, std::vector<IndexRange> triangles) {
        BlendRun run{from.object, from.primitive, level, std::move(triangles), false};
        return BlendNode{candidate, std::move(run), blendPart(object, *plan_, positionsOf(level), indicesOf(range))};
    };
    const auto convex = [&](std::uint32_t level) { return isConvex(positionsOf(level), indicesOf(rangeOf(level))); };
    std::vector<BlendNode> nodes;
    if (std::ranges::all_of(levels, convex)) {
        nodes.push_back(node(levels.front(), rangeOf(levels.front()), {}));
        return nodes;
    }
    std::size_t count = nodes_.size();
    for (const std::uint32_t level : levels) count += rangeOf(level).count / 3;
    if (count > maxParts) return nodes;
    for (const std::uint32_t level : levels)
        for (std::uint32_t i = 0; i < rangeOf(level).count; i += 3) {
            const IndexRange triangle{rangeOf(level).first + i, 3};
            nodes.push_back(node(level, triangle, {triangle}));
        }
    if (!from.doubleSided)
        std::erase_if(nodes, [&](const BlendNode& part) { return showsOnlyBacks(part.part, *plan_); });
    return nodes;
}

void BlendSorter::addNodes(std::size_t candidate) {
    const Candidate& from = candidates_[candidate];
    std::vector<BlendNode> parts;
    if (!from.transmits) parts = partsOf(candidate);
    if (parts.empty()) parts.push_back({candidate, {from.object, from.primitive, 0, {}, !from.transmits}, {}});
    std::ranges::move(parts, std::back_inserter(nodes_));
}

// Returns the draw-order constraints between a node and the nodes before it in nodes_.
Relations BlendSorter::relationsOf(std::size_t node) const {
    Relations relations;
    const BlendNode& b = nodes_[node];
    for (std::size_t i = 0; i < node; ++i) {
        const BlendNode& a = nodes_[i];
        if (transmits(i) || transmits(node)) {
            // Candidates are sorted front to back, so `a`, the earlier one, is drawn after `b`.
            if (a.candidate != b.candidate) relations.after.push_back(i);
            continue;
        }
        if (a.run.stochastic || b.run.stochastic || !overlap(a.part, b.part)) continue;
        // Levels of the same object are drawn in different samples or at different pixels, so they need no order.
        if (a.run.object == b.run.object && a.run.level != b.run.level) continue;
        const bool aMayHide = mayHide(a.part, b.part, *plan_);
        const bool bMayHide = mayHide(b.part, a.part, *plan_);
        if (aMayHide && bMayHide) relations.unordered.push_back(i);
        if (aMayHide && !bMayHide) relations.after.push_back(i);
        if (bMayHide && !aMayHide) relations.before.push_back(i);
    }
    return relations;
}

// Finds the draw-order constraints of all nodes. A node that cannot be sorted relative to an earlier sorted node is
// drawn by stochastic transparency.
void BlendSorter::relate() {
    relations_.resize(nodes_.size());
    parallelFor(nodes_.size(), [&](std::size_t i) { relations_[i] = relationsOf(i); });
    for (std::size_t i = 0; i < nodes_.size(); ++i)
        nodes_[i].run.stochastic |= std::ranges::any_of(
            relations_[i].unordered, [&](std::size_t earlier) { return !nodes_[earlier].run.stochastic; });
}

// Returns the indices of the nodes in an order that satisfies the constraints between sorted nodes. Where several nodes
// could be next, the node of the farthest object comes first. If a cycle of constraints leaves no node free to be next,
// a remaining node is drawn with stochastic transparency, which needs no order.
std::vector<std::size_t> BlendSorter::backToFront() {
    const std::size_t count = nodes_.size();
    std::vector<std::vector<std::size_t>> later(count);
    std::vector<std::size_t> earlier(count);  // number of remaining nodes that must be drawn before each node
    const auto constrain = [&](std::size_t first, std::size_t then) {
        const bool free = nodes_[first].run.stochastic || nodes_[then].run.stochastic;
        if (free && !transmits(first) && !transmits(then)) return;
        later[first].push_back(then);
        ++earlier[then];
    };
    for (std::size_t i = 0; i < count; ++i) {
        for (const std::size_t first : relations_[i].before) constrain(first, i);
        for (const std::size_t then : relations_[i].after) constrain(i, then);
    }
    const auto isLater = [&](std::size_t a, std::size_t b) {
        const std::size_t candidateA = nodes_[a].candidate;
        const std::size_t candidateB = nodes_[b].candidate;
        return candidateA != candidateB ? candidateA < candidateB : a > b;
    };
    std::priority_queue<std::size_t, std::vector<std::size_t>, decltype(isLater)> ready(isLater);
    for (std::size_t i = 0; i < count; ++i)
        if (earlier[i] == 0) ready.push(i);
    std::vector<std::size_t> order;
    std::vector<bool> placed(count);
    while (order.size() < count) {
        if (ready.empty()) {
            std::size_t chosen = count;
            for (std::size_t i = 0; i < count; ++i)
                if (!placed[i] && !transmits(i) && (chosen == count || earlier[i] <= earlier[chosen])) chosen = i;
            nodes_[chosen].run.stochastic = true;
            ready.push(chosen);
        }
        const std::size_t next = ready.top();
        ready.pop();
        if (placed[next]) continue;
        placed[next] = true;
        order.push_back(next);
        for (const std::size_t i : later[next])
            if (--earlier[i] == 0) ready.push(i);
    }
    return order;
}

// Appends a run, or extends the last run if both have triangles of the same primitive and level.
void append(std::vector<BlendRun>& runs, const BlendRun& run) {
    const bool extends = !runs.empty() && !runs.back().triangles.empty() && !run.triangles.empty() &&
                         runs.back().object == run.object && runs.back().primitive == run.primitive &&
                         runs.back().level == run.level && runs.back().stochastic == run.stochastic;
    if (!extends) {
        runs.push_back(run);
        return;
    }
    IndexRange& last = runs.back().triangles.back();
    if (last.first + last.count == run.triangles.front().first)
        last.count += run.triangles.front().count;
    else
        runs.back().triangles.push_back(run.triangles.front());
}

std::vector<BlendRun> BlendSorter::runs() {
    findCandidates();
    for (std::size_t i = 0; i < candidates_.size(); ++i) addNodes(i);
    relate();
    std::vector<BlendRun> runs;
    for (const std::size_t i : backToFront()) append(runs, nodes_[i].run);
    return runs;
}

}  // namespace

bool isConvex(const std::vector<glm::vec3>& positions, std::span<const std::uint32_t> indices) {
    if (indices.size() > 3 * maxConvexTriangles) return false;
    std::vector<std::uint32_t> used(indices.begin(), indices.end());
    std::ranges::sort(used);
    used.erase(std::ranges::unique(used).begin(), used.end());
    Bounds box;
    for (const std::uint32_t i : used) box.extend(glm::dvec3(positions[i]));
    if (box.empty()) return true;
    const double above = tolerance * glm::length(box.maximum - box.minimum);
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const glm::dvec3 corner = positions[indices[i]];
        const glm::dvec3 normal =
            glm::cross(glm::dvec3(positions[indices[i + 1]]) - corner, glm::dvec3(positions[indices[i + 2]]) - corner);
        const double limit = above * glm::length(normal);
        for (const std::uint32_t j : used)
            if (!(glm::dot(normal, glm::dvec3(positions[j]) - corner) <= limit)) return false;
    }
    return true;
}

void chooseBlending(FramePlan& plan, const World& world) {
    plan.blendOrder = BlendSorter(plan, world).runs();
}

}  // namespace defocus::engine
