// Applies collapses, and clears away what they leave.

#include <algorithm>
#include <utility>

#include "core/memory.h"
#include "lod/simplify/state.h"

namespace defocus {

Fit judgeFaces(Simplifier& s, HalfedgeHandle along) {
    const Fit shape = s.modules->shape.judge(along);
    return shape == Fit::bad ? shape : std::max(shape, s.modules->wedges.judge(along));
}

Fit judgeCollapse(Simplifier& s, HalfedgeHandle along, Fit worst) {
    const Fit fit = judgeFaces(s, along);
    return fit <= worst && !s.modules->shape.keepsTopology(along) ? Fit::impossible : fit;
}

void collapseEdge(Simplifier& s, HalfedgeHandle along) {
    const CollapseInfo collapse(*s.mesh, along);
    s.modules->wedges.preprocess_collapse(collapse);
    s.mesh->collapse(along);
    s.modules->wedges.postprocess_collapse(collapse);
    s.modules->quadrics.postprocess_collapse(collapse);
    s.survivor(collapse.v0) = collapse.v1;
}

VertexHandle survivorOf(Simplifier& s, VertexHandle v) {
    while (v.is_valid() && s.survivor(v) != v) {
        const VertexHandle next = s.survivor(v);
        if (next.is_valid()) s.survivor(v) = s.survivor(next);
        v = next;
    }
    return v;
}

void compact(Simplifier& s) {
    std::vector<VertexHandle> numbers;
    std::unique_ptr<SurfaceMesh> living = livingCopy(*s.mesh, numbers);
    for (VertexHandle& v : s.current)
        if (v = survivorOf(s, v); v.is_valid()) v = numbers[indexOf(v)];
    s.modules.reset();
    s.mesh = std::move(living);
    s.modules.emplace(*s.mesh);
    if (numbers.size() >= fewestToGiveBack) giveBackFreedMemory();
    s.survivors.resize(s.mesh->n_vertices());
    s.survivors.shrink_to_fit();
    for (std::size_t v = 0; v < s.survivors.size(); ++v) s.survivors[v] = VertexHandle(static_cast<int>(v));
}

}  // namespace defocus
