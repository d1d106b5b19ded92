#include "eval/convergence/equal_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace defocus::engine {

namespace {

struct Step {
    double milliseconds = 0;
    double rmse = 0;
};

std::string competitorOf(const ConvergenceRow& row) {
    if (row.form == "published") return fmt::format("{} as published ({})", row.method, row.setting);
    if (row.setting == "lod=off") return row.method + " at full detail";
    return row.bias ? row.method + " with levels" : row.method;
}

// Returns the Pareto front of a competitor's rows (time against error), from the fastest to the most accurate row.
std::vector<Step> frontOf(std::span<const ConvergenceRow> rows, const std::string& competitor) {
    std::vector<Step> steps;
    std::vector<Trial> trials;
    for (const ConvergenceRow& row : rows) {
        if (!row.fault.empty() || competitorOf(row) != competitor) continue;
        steps.push_back({row.milliseconds.median, std::sqrt(row.error.mse)});
        trials.push_back({steps.back().milliseconds, steps.back().rmse});
    }
    const std::vector<bool> best = paretoFront(trials);
    std::vector<Step> front;
    for (std::size_t i = 0; i < steps.size(); ++i)
        if (best[i]) front.push_back(steps[i]);
    std::ranges::sort(front, {}, &Step::milliseconds);
    return front;
}

// Returns the time at which the error is `rmse`, by linear interpolation of log time over log error between two steps.
double timeBetween(const Step& far, const Step& close, double rmse) {
    if (!(close.rmse > 0) || !(far.milliseconds > 0)) return close.milliseconds;
    const double part = std::log(far.rmse / rmse) / std::log(far.rmse / close.rmse);
    return far.milliseconds * std::pow(close.milliseconds / far.milliseconds, part);
}

Competitor::Time timeTo(double rmse, const std::vector<Step>& front) {
    const auto close = std::ranges::find_if(front, [&](const Step& step) { return step.rmse <= rmse; });
    if (close == front.end()) return {rmse, {}, false};
    if (close == front.begin()) return {rmse, close->milliseconds, true};
    return {rmse, timeBetween(*(close - 1), *close, rmse), false};
}

std::string cell(const Competitor::Time& time, const Competitor::Time& first) {
    if (!time.milliseconds) return "not reached";
    const std::string seconds = fmt::format("{}{:.3g} s", time.atMost ? "< " : "", *time.milliseconds / 1000);
    if (&time == &first || !first.milliseconds || time.atMost || first.atMost) return seconds;
    return fmt::format("{} {:>6.2f}x", seconds, *time.milliseconds / *first.milliseconds);
}

}  // namespace

std::vector<Competitor> timesToErrors(std::span<const ConvergenceRow> rows, std::span<const double> errors) {
    std::vector<Competitor> competitors;
    for (const ConvergenceRow& row : rows) {
        const std::string name = competitorOf(row);
        if (!row.fault.empty() || std::ranges::find(competitors, name, &Competitor::name) != competitors.end())
            continue;
        Competitor competitor{name, {}};
        const std::vector<Step> front = frontOf(rows, name);
        for (const double error : errors) competitor.times.push_back(timeTo(error, front));
        competitors.push_back(std::move(competitor));
    }
    std::ranges::stable_partition(competitors,
                                  [](const Competitor& c) { return c.name == "accumulation with levels"; });
    return competitors;
}

std::string equalErrorTable(std::span<const Competitor> competitors) {
    if (competitors.size() < 2) return {};
    std::string text = fmt::format("\n{:<40}", "seconds per frame to reach an RMSE of");
    for (const Competitor::Time& time : competitors[0].times) text += fmt::format("{:>20}", time.rmse);
    for (const Competitor& competitor : competitors) {
        text += fmt::format("\n  {:<38}", competitor.name);
        for (std::size_t i = 0; i < competitor.times.size(); ++i)
            text += fmt::format("{:>20}", cell(competitor.times[i], competitors[0].times[i]));
    }
    return text + fmt::format("\n  (each with its best settings; 2x means twice as long as {})\n", competitors[0].name);
}

}  // namespace defocus::engine
