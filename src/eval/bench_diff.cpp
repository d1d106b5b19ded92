#include "eval/bench_diff.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/error.h"

namespace defocus {

namespace {

constexpr double ssimRounding = 1e-6;  // CSV has six digits of it

// ---- subjects -------------------------------------------------------------------------------------------------------

struct Comparable {
    bool times = true;
    bool errors = true;
    bool errorsFromReference = true;
};

// What two files say that must be alike, and don't: a sentence each. Leaves in `comparable` what can be compared still.
std::vector<std::string> unlikeSubjects(const BenchResults& before, const BenchResults& after, Comparable& comparable) {
    std::vector<std::string> sentences;
    for (const auto& [name, text] : before.subject) {
        const auto other = after.subject.find(name);
        if (other == after.subject.end() || other->second == text) continue;
        std::string left = "neither times nor errors can be compared";
        if (name == "machine") {
            left = "times can't be compared";
            comparable.times = false;
        } else if (name == "reference") {
            left = "errors from it can't be compared";
            comparable.errorsFromReference = false;
        } else {
            comparable = {false, false, false};
        }
        sentences.push_back(fmt::format("another {}: {} in old, {} in new: {}", name, text, other->second, left));
    }
    return sentences;
}

bool isFromReference(const std::string& column) {
    return !column.starts_with("bias") && !column.ends_with("Full");
}

// ---- times ----------------------------------------------------------------------------------------------------------

double ratioOf(double after, double before) {
    return before > 0 ? after / before : std::numeric_limits<double>::infinity();
}

// Empty where there can be a verdict.
std::string whyNoVerdict(const BenchRow& before, const BenchRow& after, const Comparable& comparable) {
    if (!comparable.times) return "not comparable";
    const int runs = std::min(before.runs, after.runs);
    if (runs == 0) return "runs not said";
    if (runs == 1) return "one run";
    return runs < leastRuns ? fmt::format("{} runs", runs) : "";
}

TimeDifference timeDifference(const BenchRow& before, const BenchRow& after, const Comparable& comparable) {
    TimeDifference time;
    time.before = *before.milliseconds;
    time.after = *after.milliseconds;
    time.ratio = ratioOf(time.after.median, time.before.median);
    time.leastRatio = ratioOf(time.after.low, time.before.high);
    time.mostRatio = ratioOf(time.after.high, time.before.low);
    time.unknownBecause = whyNoVerdict(before, after, comparable);
    if (!time.unknownBecause.empty())
        time.change = TimeChange::unknown;
    else if (time.after.high < time.before.low)
        time.change = TimeChange::faster;
    else if (time.after.low > time.before.high)
        time.change = TimeChange::slower;
    return time;
}

// ---- errors ---------------------------------------------------------------------------------------------------------

// 0 for no error at all.
double distanceOf(const std::string& column, double value) {
    if (column.starts_with("psnr")) return std::pow(10, -value / 20);
    return column.starts_with("ssim") ? 1 - value : value;
}

ErrorDifference errorDifference(const std::string& column, const BenchRow& before, const BenchRow& after,
                                const Comparable& comparable) {
    ErrorDifference error{before.errors.at(column), after.errors.at(column)};
    const bool otherReference = !comparable.errorsFromReference || before.referenceSamples != after.referenceSamples;
    if (!comparable.errors || (otherReference && isFromReference(column))) {
        error.change = ErrorChange::unknown;
        return error;
    }
    const double old = distanceOf(column, error.before);
    const double now = distanceOf(column, error.after);
    const double rounding = column.starts_with("ssim") ? ssimRounding : 0;
    if (std::abs(now - old) > errorTolerance * std::max(now, old) + rounding)
        error.change = now < old ? ErrorChange::closer : ErrorChange::farther;
    error.beyondLimit = after.limit && error.after > *after.limit && error.before <= *after.limit;
    return error;
}

// ---- rows -----------------------------------------------------------------------------------------------------------

const BenchRow* find(const BenchResults& results, const std::string& key) {
    const auto found = std::ranges::find(results.rows, key, &BenchRow::key);
    return found == results.rows.end() ? nullptr : &*found;
}

RowDifference differenceOf(const BenchRow& before, const BenchRow& after, const Comparable& comparable) {
    RowDifference row;
    row.key = before.key;
    if (before.milliseconds && after.milliseconds) row.time = timeDifference(before, after, comparable);
    for (const auto& [column, value] : after.errors)
        if (before.errors.contains(column)) row.errors[column] = errorDifference(column, before, after, comparable);
    return row;
}

// ---- for people -----------------------------------------------------------------------------------------------------

std::string timeText(const TimeDifference& time) {
    constexpr std::array words = {"within noise", "faster", "slower", "unknown"};
    std::string verdict = words[static_cast<std::size_t>(time.change)];
    if (time.change == TimeChange::unknown) verdict += ": " + time.unknownBecause;
    return fmt::format("{:>10.1f} {:>10.1f} {:>6.3f} {:>15} {:<22}", time.before.median, time.after.median, time.ratio,
                       fmt::format("{:.3f} to {:.3f}", time.leastRatio, time.mostRatio), verdict);
}

std::string errorText(const std::string& column, const ErrorDifference& error) {
    constexpr std::array words = {"", " closer", " farther", ""};
    return fmt::format("  {} {:.4g} to {:.4g}{}{}", column, error.before, error.after,
                       words[static_cast<std::size_t>(error.change)], error.beyondLimit ? ", BEYOND ITS LIMIT" : "");
}

// Errors that haven't changed are not spelt out.
std::string rowText(const RowDifference& row, std::size_t keyWidth) {
    std::string text = fmt::format("{:<{}}", row.key, keyWidth);
    if (row.time) text += ' ' + timeText(*row.time);
    std::string errors;
    for (const auto& [column, error] : row.errors)
        if (error.change != ErrorChange::none || error.beyondLimit) errors += errorText(column, error);
    text += errors.empty() && !row.errors.empty() ? "  alike" : errors;
    return text.substr(0, text.find_last_not_of(' ') + 1) + '\n';
}

std::string timeCounts(const BenchDifference& difference) {
    std::array<int, 4> counts{};
    for (const RowDifference& row : difference.rows)
        if (row.time) ++counts[static_cast<std::size_t>(row.time->change)];
    return fmt::format(
        "{} rows: {} faster, {} slower, {} within noise, {} unknown (within noise: spreads of 10-90 % that touch; a "
        "verdict takes {} runs)\n",
        difference.rows.size(), counts[1], counts[2], counts[0], counts[3], leastRuns);
}

std::string errorCounts(const BenchDifference& difference) {
    std::array<int, 4> counts{};
    int beyond = 0;
    for (const RowDifference& row : difference.rows)
        for (const auto& [column, error] : row.errors) {
            ++counts[static_cast<std::size_t>(error.change)];
            beyond += error.beyondLimit ? 1 : 0;
        }
    std::string text =
        fmt::format("errors: {} closer, {} farther, {} alike, {} not comparable (alike: within {:g} %)\n", counts[1],
                    counts[2], counts[0], counts[3], 100 * errorTolerance);
    return beyond > 0 ? text + fmt::format("{} errors are beyond their limits now\n", beyond) : text;
}

// What each file was measured on. A CSV file doesn't say.
std::string subjectText(const char* which, const BenchResults& results) {
    return fmt::format("{}: {}\n", which,
                       results.measuredOn.empty()
                           ? "doesn't say scene, size, lens and machine (its JSON does); taken to be those of the other"
                           : results.measuredOn);
}

}  // namespace

BenchDifference diffBenches(const BenchResults& before, const BenchResults& after) {
    if (before.bench != after.bench)
        fail("bench {} and bench {}: only results of one bench can be compared", before.bench, after.bench);
    BenchDifference difference;
    Comparable comparable;
    difference.unlike = unlikeSubjects(before, after, comparable);
    for (const BenchRow& row : before.rows) {
        if (const BenchRow* other = find(after, row.key))
            difference.rows.push_back(differenceOf(row, *other, comparable));
        else
            difference.onlyBefore.push_back(row.key);
    }
    for (const BenchRow& row : after.rows)
        if (find(before, row.key) == nullptr) difference.onlyAfter.push_back(row.key);
    return difference;
}

std::string benchDifferenceTable(const BenchResults& before, const BenchResults& after) {
    const BenchDifference difference = diffBenches(before, after);
    std::string text = subjectText("old", before) + subjectText("new", after);
    for (const std::string& sentence : difference.unlike) text += sentence + '\n';

    std::size_t width = 4;
    for (const RowDifference& row : difference.rows) width = std::max(width, row.key.size());
    const bool timed =
        std::ranges::any_of(difference.rows, [](const RowDifference& row) { return row.time.has_value(); });
    text += fmt::format("{:<{}}", "row", width);
    if (timed)
        text += fmt::format(" {:>10} {:>10} {:>6} {:>15} {:<22}", "old ms", "new ms", "ratio", "10-90 %", "time");
    text += "  errors\n";
    for (const RowDifference& row : difference.rows) text += rowText(row, width);
    for (const std::string& key : difference.onlyBefore) text += "only in old: " + key + '\n';
    for (const std::string& key : difference.onlyAfter) text += "only in new: " + key + '\n';

    if (timed) text += timeCounts(difference);
    const bool hasErrors =
        std::ranges::any_of(difference.rows, [](const RowDifference& row) { return !row.errors.empty(); });
    return hasErrors ? text + errorCounts(difference) : text;
}

}  // namespace defocus
