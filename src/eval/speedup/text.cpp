#include "eval/speedup/text.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "eval/csv.h"
#include "eval/seed_errors.h"
#include "eval/spread.h"
#include "frame/driver/reference_image.h"
#include "frame/report/json_values.h"

namespace defocus::engine {

namespace {

using nlohmann::ordered_json;

ordered_json differenceJson(const Difference& difference) {
    return {{"rmse", difference.rmse},
            {"psnr", jsonNumber(difference.psnr)},
            {"ssim", difference.ssim},
            {"flip", difference.flip}};
}

ordered_json partJson(const std::optional<SpeedupPart>& part) {
    if (!part) return nullptr;
    return {{"milliseconds", part->milliseconds},
            {"speedUp", part->speedUp},
            {"triangles", part->triangles},
            {"fromFullDetail", differenceJson(part->fromFullDetail)}};
}

ordered_json rowJson(const SpeedupRow& row) {
    ordered_json json = {
        {"sweep", row.sweep},
        {"preset", row.preset},
        {"method", row.method},
        {"samples", row.samples},
        {"fStop", row.fStop},
        {"focusDistance", row.focusDistance},
        {"lod", lodModeName(row.mode)},
        {"runs", row.runs},
        {"milliseconds", spreadJson(row.milliseconds)},
        {"gpuMilliseconds", spreadJson(row.gpuMilliseconds)},
        {"setupMilliseconds", row.setupMilliseconds},
        {"pyramidMilliseconds", row.pyramidMilliseconds},
        {"speedUp", row.speedUp},
        {"sizeOnly", partJson(row.sizeOnly)},
        {"blurOnly", partJson(row.blurOnly)},
        {"triangles", row.triangles},
        {"gpuBytes", row.gpuBytes},
        {"fromFullDetail", differenceJson(row.fromFullDetail)},
        {"fromReference", row.fromReference ? differenceJson(*row.fromReference) : ordered_json(nullptr)},
        {"referenceSamples", row.referenceSamples},
        {"referenceRemaining", row.fromReference ? differenceJson(row.referenceRemaining) : ordered_json(nullptr)}};
    if (row.ofSeeds.size() > 1) json["errorsOverSeeds"] = seedErrorsJson(row.ofSeeds);
    return json;
}

std::string partText(const std::optional<SpeedupPart>& part) {
    return part ? fmt::format("{:.2f}", part->speedUp) : std::string();
}

// Returns the row's label: the level mode for accumulation, else the method with its settings.
std::string drawnText(const SpeedupRow& row) {
    return row.method == "accumulation" ? lodModeName(row.mode) : row.method;
}

}  // namespace

std::string speedupHeader() {
    return fmt::format(
        "{:<9} {:>7} {:>7} {:>7} {:<10} {:<10} {:>9} {:>17} {:>6} {:>6} {:>6} {:>7} {:>8} {:>9}  {:^22}  {:^30}\n"
        "{:<9} {:>7} {:>7} {:>7} {:<10} {:<10} {:>9} {:>17} {:>6} {:>6} {:>6} {:>7} {:>8} {:>9}  {:>7} {:>6} {:>7}  "
        "{:>7} {:>7} {:>6} {:>7}\n",
        "", "", "", "focus", "", "", "frame", "10-90 %", "times", "size", "blur", "set-up", "pyramids", "triangles",
        "from full detail", "from reference", "sweep", "samples", "f-stop", "m", "preset", "levels", "ms", "ms", "fast",
        "only", "only", "ms", "ms", "millions", "PSNR", "SSIM", "FLIP", "samples", "PSNR", "SSIM", "FLIP");
}

std::string speedupLine(const SpeedupRow& row) {
    const Difference& full = row.fromFullDetail;
    std::string line = fmt::format(
        "{:<9} {:>7} {:>7.3g} {:>7.3g} {:<10} {:<10} {:>9.1f} {:>17} {:>6.2f} {:>6} {:>6} {:>7.0f} {:>8.0f} {:>9.2f}  ",
        row.sweep, row.samples, row.fStop, row.focusDistance, row.preset.empty() ? "none" : row.preset, drawnText(row),
        row.milliseconds.median, fmt::format("{:.0f} to {:.0f}", row.milliseconds.low, row.milliseconds.high),
        row.speedUp, partText(row.sizeOnly), partText(row.blurOnly), row.setupMilliseconds, row.pyramidMilliseconds,
        static_cast<double>(row.triangles) / 1e6);
    const bool fullDetail = row.mode == LodMode::off && row.method == "accumulation";
    if (fullDetail && !row.fromReference) return line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
    line += fullDetail ? fmt::format("{:>22}", "")
                       : fmt::format("{:>7.2f} {:>6.4f} {:>7.4f}", full.psnr, full.ssim, full.flip);
    if (row.fromReference)
        line += fmt::format("  {:>7} {:>7.2f} {:>6.4f} {:>7.4f}{}", row.referenceSamples, row.fromReference->psnr,
                            row.fromReference->ssim, row.fromReference->flip,
                            belowReferenceText(row.fromReference->rmse < row.referenceRemaining.rmse,
                                               row.fromReference->flip < row.referenceRemaining.flip));
    return line + '\n';
}

std::string speedupCsv(std::span<const SpeedupRow> rows) {
    return csvText(rows, rowJson);
}

std::string speedupJson(std::span<const SpeedupRow> rows, const BenchSubject& subject) {
    ordered_json document = subjectJson("speedup", subject);
    document["heldEqual"] =
        "scene, camera, lens, lens samples, image size, layers drawn at once, renderer and process; runs alternate "
        "between the modes, presets and methods; the frame times exclude set-up and the building of pyramids";
    document["parts"] =
        "sizeOnly: fractional levels with a blur threshold of 0; blurOnly: fractional levels with a size threshold "
        "of 0; both are compared with the same frame at full detail";
    document["rows"] = ordered_json::array();
    for (const SpeedupRow& row : rows) document["rows"].push_back(rowJson(row));
    return documentText(document);
}

}  // namespace defocus::engine
