// defocus view and defocus bench view in a build without the window: both commands report that the window is missing.

#include <string>

#include "cli/command.h"
#include "cli/commands/bench_commands.h"
#include "core/error.h"

namespace defocus::engine {

namespace {

void addMissing(CLI::App& program, const std::string& name, const std::string& instead) {
    CLI::App* command = program.add_subcommand("view", "Interactive viewer (not in this build)");
    command->fallthrough(false)->allow_extras();
    command->callback([name, instead] {
        fail(
            "{}: the program was built without the viewer; build it with -DDEFOCUS_VIEWER=ON (GLFW, Dear ImGui), or "
            "use {}",
            name, instead);
    });
}

}  // namespace

void addViewCommand(CLI::App& program, const GlobalOptions&) {
    addMissing(program, "view", "render");
}

void addBenchViewCommand(CLI::App& bench, const GlobalOptions&) {
    addMissing(bench, "bench view", "bench convergence");
}

}  // namespace defocus::engine
