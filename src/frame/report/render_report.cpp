// Writes the metadata, statistics and summary of a render. The matrices in the metadata follow OpenEXR, "Standard
// Attributes". They transform world space to a left-handed camera space that looks along +z, and world space to NDC:
// (0, 0) is the upper left corner of the image, (1, 1) the lower right corner.

#include "frame/report/render_report.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <nlohmann/json.hpp>

#include "core/parse.h"
#include "core/source_date.h"
#include "frame/program_facts.h"
#include "frame/report/json_values.h"
#include "frame/settings/settings.h"
#include "frame/setup/moment.h"
#include "lens/lens_fields.h"
#include "lens/photographic_exposure.h"
#include "render/sampling/block_schedule.h"

namespace defocus::engine {

namespace {

std::uint64_t peakMemory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // ru_maxrss is in KiB on Linux
}

glm::dmat4 cameraFromWorld(const View& view) {
    return glm::scale(glm::dmat4(1.0), glm::dvec3(1, 1, -1)) * glm::inverse(view.worldFromCamera);
}

glm::dmat4 ndcFromWorld(const FramePlan& plan) {
    const double tanX = plan.tanHalfHorizontal;
    const double tanY = tanX * plan.view.height / plan.view.width;
    glm::dmat4 ndcFromCamera(0.0);
    ndcFromCamera[0][0] = 0.5 / tanX;
    ndcFromCamera[1][1] = -0.5 / tanY;
    ndcFromCamera[2] = glm::dvec4(0.5, 0.5, 0, 1);
    ndcFromCamera[3][2] = plan.view.nearPlane;  // reversed depth: 1 at the near plane, 0 at infinity
    return ndcFromCamera * cameraFromWorld(plan.view);
}

// Adds to the metadata all settings whose Setting::recorded is true. Leaves out camera and lens, which have attributes
// of their own, and paths, which are private.
void addSettings(Metadata& metadata, const Request& request) {
    for (const Setting& setting : settings()) {
        const std::optional<std::string> text = setting.text(request);
        const bool elsewhere = setting.lensField || setting.group == SettingGroup::camera;
        if (!setting.recorded || elsewhere || setting.kind == SettingKind::path || !text) continue;
        const std::string name = fmt::format("defocus:{}", setting.name);
        if (std::ranges::find(setting.choices, *text) != setting.choices.end())
            metadata[name] = *text;
        else if (setting.kind == SettingKind::number || setting.kind == SettingKind::integer)
            metadata[name] = parseNumber(*text, {setting.min, setting.max});
        else if (setting.kind == SettingKind::boolean)
            metadata[name] = *text == "true" ? 1 : 0;
        else
            metadata[name] = *text;
    }
}

// Returns the date to store in files, in UTC, such as "2026-01-31T12:00:00Z": the current time, or SOURCE_DATE_EPOCH.
std::string dateNow() {
    return utcText(sourceDate().value_or(std::time(nullptr)), "%Y-%m-%dT%H:%M:%SZ");
}

std::string inMillions(std::uint64_t count) {
    const double value = static_cast<double>(count);
    return count < 1'000'000 ? fmt::format("{}", count) : fmt::format("{:.1f} M", value * 1e-6);
}

bool usesLensSamples(const RenderReport& report) {
    return parseMethodUse(report.method).method->usesLensSamples;
}

}  // namespace

Metadata renderMetadata(const RenderReport& report) {
    const View& view = report.plan.view;
    const Lens& lens = view.lens;
    Metadata metadata = {
        {"software", "defocus " + programVersion()},
        {"cameraLabel", report.frame.cameraName},
        {"aperture", lens.fStop},
        {"focus", lens.focusDistance},
        {"nominalFocalLength", lens.focalLength},
        {"worldToCamera", glm::mat4(cameraFromWorld(view))},
        {"worldToNDC", glm::mat4(ndcFromWorld(report.plan))},
        {"defocus:scene", report.frame.sceneName},
        {"defocus:device", report.stats.device},
    };
    if (!sourceDate()) metadata["defocus:seconds"] = report.stats.renderMilliseconds / 1000;
    addSettings(metadata, report.options);
    // Values that the renderer chose for settings that the request leaves unset.
    metadata["defocus:samples"] = static_cast<int>(report.stats.samples);
    metadata["defocus:positions"] = static_cast<int>(report.plan.settings.positions);
    if (stopSettings(report.options).given()) metadata["defocus:stopped"] = stopReasonText(report.stats.stopped);
    if (report.stats.estimatedError) metadata["defocus:estimatedError"] = *report.stats.estimatedError;
    metadata["defocus:method"] = report.method;
    metadata["defocus:lod"] = lodModeName(report.plan.settings.lod);
    metadata["defocus:layerFormat"] = report.stats.layerFormat;
    metadata["defocus:blurThreshold"] = report.plan.thresholds.blur;
    metadata["defocus:sizeThreshold"] = report.plan.thresholds.size;
    metadata["defocus:lightThreshold"] = report.plan.thresholds.light;
    if (lens.exposureTime > 0) {
        metadata["expTime"] = lens.exposureTime;
        metadata["isoSpeed"] = lens.iso;
        metadata["defocus:exposure"] = photographicExposure(lens);
    } else if (const double seconds = shutterOf(report.options, *report.frame.scene).seconds; seconds > 0) {
        metadata["expTime"] = seconds;
    }
    if (report.exposure) metadata["defocus:exposure"] = *report.exposure;
    for (const LensField& field : lensFields()) {
        const double value = lensFieldValue(lens, field);
        if (std::isfinite(value)) metadata[std::string("defocus:") + field.name] = value;
    }
    return metadata;
}

std::string statsJson(const RenderReport& report) {
    const RenderStats& stats = report.stats;
    const Lens& lens = report.plan.view.lens;
    const RenderSettings& settings = report.plan.settings;
    nlohmann::ordered_json json = {
        {"version", programVersion()},
        {"commit", programCommit()},
        {"command", report.command},
        {"date", dateNow()},
        {"scene", report.frame.sceneName},
        {"camera", report.frame.cameraName},
        {"time", report.options.time},
        {"shutter", shutterOf(report.options, *report.frame.scene).seconds},
        {"width", report.plan.view.width},
        {"height", report.plan.view.height},
        {"method", report.method},
        {"samples", stats.samples},
        {"positions", settings.positions},
        {"largestBlur", report.plan.largestBlur},
        {"sequence", sequenceName(settings.sequence)},
        {"seed", settings.seed},
        {"lod", lodModeName(settings.lod)},
        {"lodMetric", lodMetricName(settings.metric)},
        {"blurThreshold", report.plan.thresholds.blur},
        {"sizeThreshold", report.plan.thresholds.size},
        {"lightThreshold", report.plan.thresholds.light},
        {"lens",
         {{"fStop", lens.fStop},
          {"focalLength", lens.focalLength},
          {"focusDistance", lens.focusDistance},
          {"horizontalAperture", lens.horizontalAperture}}},
        {"loadMilliseconds", report.frame.loadMilliseconds},
        {"pyramidMilliseconds", report.frame.pyramidMilliseconds},
        {"setupMilliseconds", stats.setupMilliseconds},
        {"renderMilliseconds", stats.renderMilliseconds},
        {"totalMilliseconds", report.totalMilliseconds},
        {"cpuMilliseconds", stats.cpuTime.milliseconds},
        {"busiestThreadMilliseconds", stats.cpuTime.busiestMilliseconds},
        {"gpuMilliseconds", stats.gpuMilliseconds},
        {"gpuMillisecondsNote",
         report.softwareDriver ? "timer queries of a software driver; they exclude vertex work, so do not compare them "
                                 "with other times"
                               : "GPU timer queries around each batch of samples"},
        {"trianglesDrawn", stats.trianglesDrawn},
        {"trianglesFacingAway", report.plan.trianglesFacingAway},
        {"trianglesOutside", report.plan.trianglesOutside},
        {"trianglesHidden", stats.trianglesHidden},
        {"trianglesAtFullDetail", report.plan.trianglesAtFullDetail},
        {"peakBytes", peakMemory()},
        {"memoryLimit", report.memoryLimit},
        {"tiles", report.tiles},
        {"gpuBytes", stats.peakBytes},
        {"wave", stats.wave},
        {"threads", stats.threads},
        {"layerFormat", stats.layerFormat},
        {"device", stats.device},
        {"driver", stats.driver},
    };
    if (stopSettings(report.options).given()) {
        json["stopped"] = stopReasonText(stats.stopped);
        json["estimatedError"] = stats.estimatedError ? nlohmann::ordered_json(*stats.estimatedError) : nullptr;
    }
    if (stopSettings(report.options).automatic) {
        json["samplesAutomatic"] = true;
        json["estimatedError"] = stats.estimatedError ? nlohmann::ordered_json(*stats.estimatedError) : nullptr;
    }
    for (const PassTime& pass : stats.passes) json["passMilliseconds"][pass.name] = pass.milliseconds;
    for (const MethodFigure& figure : stats.figures) json["methodFigures"][figure.name] = figure.value;
    return documentText(json);
}

std::string errorText(const RenderStats& stats) {
    return stats.estimatedError ? fmt::format("RMSE about {:.2g}", *stats.estimatedError) : "RMSE not estimated";
}

std::string imageCount(const RenderReport& report, std::uint32_t count) {
    return fmt::format("{} {}{}", count, usesLensSamples(report) ? "sample" : "pinhole image", count == 1 ? "" : "s");
}

std::string summary(const RenderReport& report) {
    const RenderStats& stats = report.stats;
    std::string triangles = inMillions(stats.trianglesDrawn) + " triangles";
    if (report.plan.trianglesAtFullDetail > stats.trianglesDrawn)
        triangles += fmt::format(" (full detail: {})", inMillions(report.plan.trianglesAtFullDetail));
    std::string samples = imageCount(report, stats.samples);
    if (report.plan.settings.positions > 1)
        samples += fmt::format(" with {} positions", report.plan.settings.positions);
    if (stopSettings(report.options).given())
        samples += fmt::format(" ({}; {})", errorText(stats), stopReasonText(stats.stopped));
    else if (stopSettings(report.options).automatic)
        samples += stats.estimatedError ? fmt::format(" (automatic, {})", errorText(stats)) : " (automatic)";
    else if (const std::uint32_t asked = report.options.samples.value_or(0);
             asked > stats.samples && stats.samples == report.plan.frameSamples && !report.plan.usesLens &&
             usesLensSamples(report))
        samples += fmt::format(" (of {}: nothing is blurred, so fewer suffice; --keep-all draws all)", asked);
    return fmt::format("{}x{}, {} in {:.2f} s: {}, {}", report.plan.view.width, report.plan.view.height, samples,
                       stats.renderMilliseconds / 1000, triangles, stats.device);
}

}  // namespace defocus::engine
