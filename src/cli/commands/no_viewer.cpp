// defocus view, for a build without the window: reports that the program was built without the window.

#include "cli/command.h"
#include "core/error.h"

namespace defocus::engine {

void addViewCommand(CLI::App& program, const GlobalOptions&) {
    CLI::App* command = program.add_subcommand("view", "Interactive viewer (not in this build)");
    command->fallthrough(false)->allow_extras();
    command->callback([] {
        fail(
            "view: the program was built without the viewer; build it with -DDEFOCUS_VIEWER=ON (GLFW, Dear ImGui), or "
            "use render");
    });
}

}  // namespace defocus::engine
