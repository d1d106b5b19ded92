// defocus bench stability: stiff and extreme cases against their truth, and whether blur follows the lens.

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <vector>

#include "app/bench_commands.h"
#include "app/bench_report.h"
#include "core/error.h"
#include "core/file.h"
#include "eval/stability_text.h"
#include "gl/context.h"

namespace defocus {

namespace {

struct StabilityArguments {
    std::filesystem::path output;  // JSON; empty: only the table
    std::filesystem::path report;  // folder; empty: none
};

void runStability(const StabilityArguments& arguments, const GlobalOptions& global) {
    makeOutputFolder(arguments.report, {"stability.json"});
    const std::filesystem::path output =
        arguments.report.empty() ? arguments.output : arguments.report / "stability.json";
    if (!output.empty()) checkWritable(output);
    const auto context = createHeadlessContext();
    const Progress progress = terminalProgress(global);
    std::vector<StabilityRow> rows;
    std::vector<HonestyRow> honesty;
    fmt::print("{}, OpenGL {}\n\n{}", context->device(), context->driver(), stabilityHeader());
    measureStability(
        [&](const StabilityRow& row) {
            fmt::print("{}", stabilityLine(row));
            std::fflush(stdout);
            rows.push_back(row);
        },
        progress);
    fmt::print(
        "\nThe disk of a point of light against the lens: 100 mm f/1.4 focused at 2 m, light at 6 m, 36 mm, 192 px, "
        "256 samples, but for what is varied\n\n{}",
        honestyHeader());
    measureHonesty(
        {},
        [&](const HonestyRow& row) {
            fmt::print("{}", honestyLine(row));
            std::fflush(stdout);
            honesty.push_back(row);
        },
        progress);
    if (!output.empty()) writeFile(output, stabilityJson(rows, honesty, benchSubject(*context)));
    drawReport(arguments.report, arguments.report);
    const auto failed = std::count_if(rows.begin(), rows.end(), [](const StabilityRow& row) { return !row.passed(); });
    if (failed > 0) fail("{} of {} cases are beyond their limits", failed, rows.size());
}

}  // namespace

void addStabilityCommand(CLI::App& bench, const GlobalOptions& global) {
    auto arguments = std::make_shared<StabilityArguments>();
    CLI::App* command = bench.add_subcommand(
        "stability", "Stiff and extreme cases against closed forms, and whether the blur follows the lens alone");
    CLI::Option* output = command->add_option("-o,--output", arguments->output, "JSON file for the rows")
                              ->type_name("FILE")
                              ->group("Output");
    addReport(*command, output, arguments->report);
    command->footer("Example:\n  defocus bench stability -o stability.json");
    command->callback([arguments, &global] { runStability(*arguments, global); });
}

}  // namespace defocus
