#include "cli/commands/lens_images.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "cli/options/image_output.h"
#include "cli/terminal/stop_signal.h"
#include "core/error.h"
#include "core/message.h"
#include "core/parse.h"
#include "core/stopwatch.h"
#include "refocus/light_field_output.h"

namespace defocus::engine {

namespace {

void checkFile(const RenderArguments& arguments) {
    const std::filesystem::path& path = arguments.lensImages;
    LightFieldOutput::checkPath(path);
    if (!arguments.stats.empty() || arguments.keepPartial)
        throw UsageError("--lens-images cannot be combined with --stats or --keep-partial");
    checkImageOutputs({path}, {},
                      {arguments.request.scene, arguments.request.environment, arguments.request.lens.apertureImage});
}

std::string distanceText(double metres) {
    return std::isinf(metres) ? "infinity" : fmt::format("{:.3g} m", metres);
}

}  // namespace

FocusRange parseFocusRange(const std::string& text) {
    const std::vector<std::string> parts = splitAt(text, ':');
    if (parts.size() != 2) fail("'{}' is not a range NEAR:FAR of distances in m, such as 0.8:5 or 2:inf", text);
    const Range metres{1e-6, 1e12};
    const FocusRange range{parseNumber(parts[0], metres),
                           parts[1] == "inf" ? std::numeric_limits<double>::infinity() : parseNumber(parts[1], metres)};
    if (range.nearest > range.farthest) fail("'{}': the first distance must not exceed the second", text);
    return range;
}

void renderLensImages(const RenderArguments& arguments, const GlobalOptions& global) {
    const Clock::time_point start = Clock::now();
    checkFile(arguments);
    const Request request = LightFieldOutput::suited(arguments.request);
    Progress progress = terminalProgress(global);
    SceneDriver driver(nullptr, request, global.shaderDir, progress);
    LightFieldOutput output(driver, arguments.lensImages, arguments.focusRange);
    output.start(progress);
    progress = {};  // ends the progress line
    WarningPrinter(global).print(driver.warnings());

    progress = terminalProgress(global);
    const LightFieldInfo& info = output.info();
    stopWhenAsked();
    setStopMessage("stopped; the file of lens images is not written");
    std::uint64_t done = 0;
    do {
        if (stopAsked()) fail("stopped after {} of {} lens images; the file was not written", done, info.points.size());
        report(progress, "lens images", done++, info.points.size());
    } while (output.advance());
    output.finish();
    progress = {};
    if (!global.quiet)
        printMessage(
            "{}: {} lens images of {}x{} px with a margin of {} px, for focus distances from {} to {}, in "
            "{:.2f} s\n",
            arguments.lensImages.string(), info.points.size(), info.size.width, info.size.height, info.size.margin,
            distanceText(info.range.nearest), distanceText(info.range.farthest), millisecondsSince(start) / 1000);
}

}  // namespace defocus::engine
