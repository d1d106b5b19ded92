#include "eval/stability.h"

namespace defocus {

std::vector<StabilityCase> stabilityCases() {
    std::vector<StabilityCase> cases;
    addSumCases(cases);
    addLensCases(cases);
    addMotionCases(cases);
    addSpaceCases(cases);
    addLevelCases(cases);
    return cases;
}

void measureStability(const std::function<void(const StabilityRow&)>& visit, const Progress& progress) {
    const std::vector<StabilityCase> cases = stabilityCases();
    for (std::size_t i = 0; i < cases.size(); ++i) {
        report(progress, "cases", i, cases.size());
        visit({cases[i], cases[i].error()});
    }
}

}  // namespace defocus
