#include "stability/stability.h"

#include <algorithm>
#include <cmath>

#include "render/methods.h"

namespace defocus::engine {

namespace {

bool hasMethod(const std::string& name) {
    return std::ranges::any_of(methods(), [&](const Method& method) { return method.name == name; });
}

}  // namespace

std::vector<StabilityCase> stabilityCases() {
    std::vector<StabilityCase> cases;
    addSumCases(cases);
    addLensCases(cases);
    addEdgeCases(cases);
    addMotionCases(cases);
    addSpaceCases(cases);
    addValueCases(cases);
    addSplitCases(cases);
    addTracedCases(cases);
    return cases;
}

void measureStability(const std::function<void(const StabilityRow&)>& visit, const Progress& progress) {
    const std::vector<StabilityCase> cases = stabilityCases();
    for (std::size_t i = 0; i < cases.size(); ++i) {
        report(progress, "cases", i, cases.size());
        const bool leftOut = !cases[i].method.empty() && !hasMethod(cases[i].method);
        visit({cases[i], leftOut ? std::nan("") : cases[i].error(), leftOut});
    }
}

}  // namespace defocus::engine
