// defocus plan: prints what a render would draw, without drawing anything.

#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "cli/command.h"
#include "cli/options/request_options.h"
#include "frame/report/plan_report.h"
#include "frame/report/plan_warnings.h"
#include "frame/setup/prepared_frame.h"
#include "plan/frame_plan.h"
#include "plan/plan_text.h"
#include "render/sampling/automatic_samples.h"

namespace defocus::engine {

namespace {

struct PlanArguments {
    Request request;
    bool json = false;
};

void runPlan(const PlanArguments& arguments, const GlobalOptions& global) {
    const PreparedFrame frame = prepareFrame(arguments.request, terminalProgress(global));
    FramePlan plan = planFrame(frame.world, frame.view, frame.settings);
    const StopSettings stop = stopSettings(arguments.request);
    if (stop.automatic) {  // a render begins with firstSamples() samples and may add more
        const std::uint32_t samples = firstSamples(plan, *stop.automatic);
        plan = planFrame(frame.world, frame.view, withSamples(frame.settings, plan, samples, stop.choosesPositions));
    }
    fmt::print("{}", arguments.json ? toJson(reportedPlan(plan)) : planTable(plan));
    printCacheUse(frame, global);
    WarningPrinter warnings(global);
    warnings.print(requestWarnings(arguments.request, frame));
    warnings.print(planWarnings(plan, drawnMethod(parseMethodUse(automaticMethod), plan)));
}

}  // namespace

void addPlanCommand(CLI::App& program, const GlobalOptions& global) {
    auto arguments = std::make_shared<PlanArguments>();
    CLI::App* command = program.add_subcommand(
        "plan", "Print the plan of a frame: blur, level and samples of each object, and the culled parts");
    command->add_flag("--json", arguments->json, "Print JSON instead of a table")->group("Output");
    // Leave out settings that don't affect a plan: method, environment and brightness.
    addSettings(*command, arguments->request,
                settingsOf(frameGroups, {"environment", "environmentRotation", "targetError", "timeLimit", "method",
                                         "layerFormat", "exposureTime", "iso", "multipleScattering"}));
    addSettings(*command, arguments->request, {"exrLayers"});
    addDeveloperSettings(*command, arguments->request, {"memory", "wave", "threads"});
    command->footer("Example:\n  defocus plan scene.glb --fstop 1.4 --focus-node Bottle --json");
    command->callback([arguments, &global] { runPlan(*arguments, global); });
}

}  // namespace defocus::engine
