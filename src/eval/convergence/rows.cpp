#include "eval/convergence/rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace defocus::engine {

namespace {

// Max relative difference of the MSE between runs of the same case and seed. Their images should be equal.
constexpr double maxDifference = 0.01;

bool sameRow(const ConvergenceRow& row, const ConvergenceRun& run) {
    return row.method == run.method && row.setting == run.setting && row.asked == run.asked;
}

std::string faultOf(const std::vector<const ConvergenceRun*>& runs, int seeds) {
    for (const ConvergenceRun* run : runs)
        if (!run->fault.empty()) return run->fault;
    for (const ConvergenceRun* run : runs) {
        const auto other = std::ranges::find_if(
            runs, [&](const ConvergenceRun* each) { return each->run % seeds == run->run % seeds; });
        const auto [min, max] = std::minmax(run->error.mse, (*other)->error.mse);
        if (max - min > maxDifference * min)
            return fmt::format(
                "runs with the same seed should give the same image, but their MSE ranges from {:.3g} to {:.3g}", min,
                max);
    }
    return {};
}

ImageError meanOf(const std::vector<ImageError>& errors) {
    ImageError mean{.mse = 0, .ssim = 0, .flip = 0};
    for (const ImageError& error : errors) {
        mean.mse += error.mse / static_cast<double>(errors.size());
        mean.ssim += error.ssim / static_cast<double>(errors.size());
        mean.flip += error.flip / static_cast<double>(errors.size());
    }
    return mean;
}

// Sets the row's errors to the means over the seeds, using the first run of each seed.
void addErrors(ConvergenceRow& row, const std::vector<const ConvergenceRun*>& runs, int seeds) {
    std::set<int> seen;
    std::vector<ImageError> biases;
    for (const ConvergenceRun* run : runs) {
        if (!seen.insert(run->run % seeds).second) continue;
        row.ofSeeds.push_back(run->error);
        if (run->bias) biases.push_back(*run->bias);
    }
    // With a single seed, copy the error instead of averaging, so that it stays bit-identical.
    row.error = row.ofSeeds.size() == 1 ? row.ofSeeds.front() : meanOf(row.ofSeeds);
    if (!biases.empty()) row.bias = biases.size() == 1 ? biases.front() : meanOf(biases);
}

void complete(ConvergenceRow& row, std::span<const ConvergenceRun> all, int seeds) {
    std::vector<const ConvergenceRun*> runs;
    std::vector<double> milliseconds;
    std::vector<double> setup;
    std::vector<double> gpu;
    for (const ConvergenceRun& run : all) {
        if (!sameRow(row, run)) continue;
        runs.push_back(&run);
        milliseconds.push_back(run.milliseconds);
        setup.push_back(run.setupMilliseconds);
        gpu.push_back(run.gpuMilliseconds);
        row.peakBytes = std::max(row.peakBytes, run.peakBytes);
    }
    const ConvergenceRun& first = *runs.front();
    row.samples = first.samples;
    row.runs = static_cast<int>(runs.size());
    row.milliseconds = spreadOf(milliseconds);
    row.setupMilliseconds = spreadOf(setup);
    row.pyramidMilliseconds = first.pyramidMilliseconds;
    row.gpuMilliseconds = spreadOf(gpu).median;
    addErrors(row, runs, seeds);
    row.triangles = first.triangles;
    row.fault = faultOf(runs, seeds);
}

template <typename Chosen, typename ErrorOf>
void mark(std::vector<ConvergenceRow>& rows, bool ConvergenceRow::*flag, const Chosen& chosen, const ErrorOf& errorOf) {
    std::vector<ConvergenceRow*> members;
    std::vector<Trial> trials;
    for (ConvergenceRow& row : rows) {
        if (!row.fault.empty() || !chosen(row)) continue;
        members.push_back(&row);
        trials.push_back({row.milliseconds.median, errorOf(row)});
    }
    const std::vector<bool> front = paretoFront(trials);
    for (std::size_t i = 0; i < members.size(); ++i) members[i]->*flag = front[i];
}

void markFronts(std::vector<ConvergenceRow>& rows) {
    const auto any = [](const ConvergenceRow&) { return true; };
    const auto mse = [](const ConvergenceRow& row) { return row.error.mse; };
    mark(rows, &ConvergenceRow::front, any, mse);
    mark(rows, &ConvergenceRow::frontByFlip, any, [](const ConvergenceRow& row) { return row.error.flip; });
    std::set<std::string> methods;
    for (const ConvergenceRow& row : rows) methods.insert(row.method);
    for (const std::string& method : methods)
        mark(
            rows, &ConvergenceRow::frontOfMethod, [&](const ConvergenceRow& row) { return row.method == method; }, mse);
}

bool beats(const Trial& a, const Trial& b) {
    return a.cost <= b.cost && a.error <= b.error && (a.cost < b.cost || a.error < b.error);
}

}  // namespace

std::vector<bool> paretoFront(std::span<const Trial> trials) {
    std::vector<bool> front;
    for (const Trial& trial : trials)
        front.push_back(std::ranges::none_of(trials, [&](const Trial& other) { return beats(other, trial); }));
    return front;
}

std::vector<ConvergenceRow> convergenceRows(std::span<const ConvergenceRun> runs, const Difference& remaining,
                                            int seeds) {
    std::vector<ConvergenceRow> rows;
    for (const ConvergenceRun& run : runs) {
        if (std::ranges::any_of(rows, [&](const ConvergenceRow& row) { return sameRow(row, run); })) continue;
        rows.emplace_back();
        rows.back().method = run.method;
        rows.back().form = run.form;
        rows.back().setting = run.setting;
        rows.back().asked = run.asked;
    }
    for (ConvergenceRow& row : rows) {
        complete(row, runs, seeds);
        row.mseBelowReference = row.error.mse < remaining.rmse * remaining.rmse;
        row.flipBelowReference = row.error.flip < remaining.flip;
    }
    markFronts(rows);
    return rows;
}

std::vector<BiasFloor> biasFloors(std::span<const ConvergenceRow> rows) {
    std::vector<BiasFloor> floors;
    for (const ConvergenceRow& row : rows) {
        if (!row.bias) continue;
        const auto known = std::ranges::find_if(
            floors, [&](const BiasFloor& f) { return f.method == row.method && f.setting == row.setting; });
        const BiasFloor floor{row.method, row.setting, row.asked, *row.bias};
        if (known == floors.end())
            floors.push_back(floor);
        else if (known->samples < row.asked)
            *known = floor;
    }
    return floors;
}

}  // namespace defocus::engine
