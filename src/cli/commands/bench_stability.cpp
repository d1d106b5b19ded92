// defocus bench stability: compares renderings of numerically difficult scenes with exact results, and compares the
// blur that each method draws with the blur of a real lens.

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <vector>

#include "cli/commands/bench_commands.h"
#include "cli/commands/bench_report.h"
#include "core/error.h"
#include "core/file.h"
#include "gl/context.h"
#include "stability/text.h"

namespace defocus::engine {

namespace {

struct StabilityArguments {
    std::filesystem::path output;  // JSON file of the results; empty: print the table only
    std::filesystem::path report;  // folder of the report; empty: no report
    bool allowChanged = false;
};

std::vector<StabilityRow> printedCases(const Progress& progress) {
    std::vector<StabilityRow> rows;
    measureStability(
        [&](const StabilityRow& row) {
            fmt::print("{}", stabilityLine(row, rows.empty() ? nullptr : &rows.back()));
            std::fflush(stdout);
            rows.push_back(row);
        },
        progress);
    const bool leftOut = std::ranges::any_of(rows, &StabilityRow::leftOut);
    if (leftOut) fmt::print("\nThe remaining cases need the ray tracer, which is in defocus_bench.\n");
    return rows;
}

// Compares the blur that each method draws at default settings with the blur of a real lens. Prints a row per method
// and a summary.
std::vector<HonestyRow> printedHonesty(const Progress& progress) {
    fmt::print(
        "\n"
        "Blur disk of a point light, compared with the disk that the lens equation gives. Unless varied: 100 mm f/1.4 "
        "focused\n"
        "at 2 m, light at 6 m, 36 mm sensor, 192 px, 256 samples. A disk follows the lens if its size differs by at "
        "most\n"
        "{:g} px and its energy by at most {:g} %.\n",
        honestDiameter, 100 * honestEnergy, honestyHeader());
    std::vector<HonestyRow> rows;
    measureHonesty(
        honestyMethods(),
        [&](const HonestyRow& row) {
            if (row.method.find(':') == std::string::npos) fmt::print("{}", honestyLine(row));
            std::fflush(stdout);
            rows.push_back(row);
        },
        progress);
    fmt::print(
        "\n"
        "{}\n"
        "The methods cause the differences. scheuermann: as published, the blur is linear in depth between three\n"
        "planes and at most 10 px wide, for any lens; the small, pre-blurred copy of the\n"
        "image widens all disks, also with coc=thin-lens. circular: below full resolution or with fewer taps, small "
        "disks become wider.\n",
        honestySummary(rows));
    return rows;
}

void runStability(const StabilityArguments& arguments, const GlobalOptions& global) {
    const std::filesystem::path output =
        arguments.report.empty() ? arguments.output : arguments.report / "stability.json";
    refuseChangedSources(output, arguments.allowChanged);
    makeOutputFolder(arguments.report, {"stability.json"});
    if (!output.empty()) checkWritable(output);
    const auto context = createHeadlessContext();
    const Progress progress = terminalProgress(global);
    fmt::print("{}, OpenGL {}\n\n", context->device(), context->driver());
    const std::vector<StabilityRow> rows = printedCases(progress);
    const std::vector<HonestyRow> honesty = printedHonesty(progress);
    if (!output.empty()) writeFile(output, stabilityJson(rows, honesty, benchSubject(*context, global)));
    drawReport(arguments.report, arguments.report);
    const auto failed = std::ranges::count_if(rows, &StabilityRow::failed);
    if (failed > 0) fail("{} of {} cases exceed their error limits", failed, rows.size());
}

}  // namespace

void addStabilityCommand(CLI::App& bench, const GlobalOptions& global) {
    auto arguments = std::make_shared<StabilityArguments>();
    CLI::App* command =
        bench.add_subcommand("stability",
                             "Compare extreme cases with their exact results, and check that the blur follows the lens "
                             "equation");
    CLI::Option* output = command->add_option("-o,--output", arguments->output, "JSON file for the results")
                              ->type_name("FILE")
                              ->group("Output");
    addReport(*command, output, arguments->report);
    addAllowChanged(*command, arguments->allowChanged);
    command->footer("Example:\n  defocus bench stability -o stability.json");
    command->callback([arguments, &global] { runStability(*arguments, global); });
}

}  // namespace defocus::engine
