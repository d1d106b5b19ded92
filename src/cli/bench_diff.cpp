// defocus bench diff: two results of one bench.

#include "eval/bench_diff.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "cli/bench_commands.h"
#include "core/file.h"

namespace defocus {

namespace {

struct DiffArguments {
    std::filesystem::path before;
    std::filesystem::path after;
};

BenchResults resultsIn(const std::filesystem::path& path) {
    const std::vector<std::byte> bytes = readFile(path);
    return parseBenchResults({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path.string());
}

}  // namespace

void addBenchDiffCommand(CLI::App& bench) {
    auto arguments = std::make_shared<DiffArguments>();
    CLI::App* command =
        bench.add_subcommand("diff", "Compare two results of one bench: which times and errors changed");
    command
        ->add_option("OLD", arguments->before,
                     "What bench convergence, speedup, scaling, popping or stability has written, JSON or CSV; only "
                     "JSON says what it was measured on")
        ->type_name("FILE")
        ->required();
    command->add_option("NEW", arguments->after, "The same of another run")->type_name("FILE")->required();
    command->footer(
        "A time counts as changed where the two spreads (10th to 90th percentile of at least three runs) share no "
        "value, an error where it differs by more than 1 %. What was measured on another scene, size, lens or driver "
        "has no verdict, nor have times of another machine.\n\n"
        "Example:\n"
        "  defocus bench diff before/results.json after/results.json");
    command->callback([arguments] {
        const BenchResults before = resultsIn(arguments->before);
        const BenchResults after = resultsIn(arguments->after);
        fmt::print("{}", benchDifferenceTable(before, after));
    });
}

}  // namespace defocus
