#include "eval/speedup/text.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "eval/json_number.h"
#include "eval/spread.h"
#include "frame/reference_image.h"

namespace defocus {

namespace {

using nlohmann::ordered_json;

ordered_json differenceJson(const Difference& difference) {
    return {{"rmse", difference.rmse},
            {"psnr", jsonNumber(difference.psnr)},
            {"ssim", difference.ssim},
            {"flip", difference.flip}};
}

ordered_json rowJson(const SpeedupRow& row) {
    return {{"sweep", row.sweep},
            {"samples", row.samples},
            {"fStop", row.fStop},
            {"focusDistance", row.focusDistance},
            {"lod", lodModeName(row.mode)},
            {"milliseconds", spreadJson(row.milliseconds)},
            {"gpuMilliseconds", spreadJson(row.gpuMilliseconds)},
            {"setupMilliseconds", row.setupMilliseconds},
            {"pyramidMilliseconds", row.pyramidMilliseconds},
            {"speedUp", row.speedUp},
            {"triangles", row.triangles},
            {"gpuBytes", row.gpuBytes},
            {"fromFullDetail", differenceJson(row.fromFullDetail)},
            {"fromReference", row.fromReference ? differenceJson(*row.fromReference) : ordered_json(nullptr)},
            {"referenceSamples", row.referenceSamples},
            {"referenceRemaining", row.fromReference ? differenceJson(row.referenceRemaining) : ordered_json(nullptr)}};
}

std::string csvDifference(const Difference& d) {
    return fmt::format("{:.8g},{:.6g},{:.6g},{:.6g}", d.rmse, d.psnr, d.ssim, d.flip);
}

}  // namespace

std::string speedupHeader() {
    return fmt::format(
        "{:<9} {:>7} {:>7} {:>7} {:<10} {:>9} {:>17} {:>6} {:>7} {:>8} {:>9}  {:^22}  {:^30}\n"
        "{:<9} {:>7} {:>7} {:>7} {:<10} {:>9} {:>17} {:>6} {:>7} {:>8} {:>9}  {:>7} {:>6} {:>7}  {:>7} {:>7} {:>6} "
        "{:>7}\n",
        "", "", "", "focus", "", "frame", "10-90 %", "times", "set-up", "pyramids", "triangles", "from full detail",
        "from reference", "sweep", "samples", "f-stop", "m", "levels", "ms", "ms", "fast", "ms", "ms", "millions",
        "PSNR", "SSIM", "FLIP", "samples", "PSNR", "SSIM", "FLIP");
}

std::string speedupLine(const SpeedupRow& row) {
    const Difference& full = row.fromFullDetail;
    std::string line = fmt::format(
        "{:<9} {:>7} {:>7.3g} {:>7.3g} {:<10} {:>9.1f} {:>17} {:>6.2f} {:>7.0f} {:>8.0f} {:>9.2f}  ", row.sweep,
        row.samples, row.fStop, row.focusDistance, lodModeName(row.mode), row.milliseconds.median,
        fmt::format("{:.0f} to {:.0f}", row.milliseconds.low, row.milliseconds.high), row.speedUp,
        row.setupMilliseconds, row.pyramidMilliseconds, static_cast<double>(row.triangles) / 1e6);
    if (row.mode == LodMode::off && !row.fromReference) return line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
    line += row.mode == LodMode::off ? fmt::format("{:>22}", "")
                                     : fmt::format("{:>7.2f} {:>6.4f} {:>7.4f}", full.psnr, full.ssim, full.flip);
    if (row.fromReference)
        line += fmt::format("  {:>7} {:>7.2f} {:>6.4f} {:>7.4f}{}", row.referenceSamples, row.fromReference->psnr,
                            row.fromReference->ssim, row.fromReference->flip,
                            belowReferenceText(row.fromReference->rmse < row.referenceRemaining.rmse,
                                               row.fromReference->flip < row.referenceRemaining.flip));
    return line + '\n';
}

std::string speedupCsv(std::span<const SpeedupRow> rows) {
    std::string text =
        "sweep,samples,fStop,focusDistance,lod,milliseconds,low,high,gpuMilliseconds,speedUp,triangles,gpuBytes,"
        "rmseFull,psnrFull,ssimFull,flipFull,rmseReference,psnrReference,ssimReference,flipReference,"
        "runs,setupMilliseconds,pyramidMilliseconds,referenceSamples,referenceRmse,referenceFlip\n";
    for (const SpeedupRow& row : rows)
        text += fmt::format(
            "{},{},{:.8g},{:.8g},{},{:.3f},{:.3f},{:.3f},{:.3f},{:.4f},{},{},{},{},{},{:.3f},{:.3f},{},"
            "{:.6g},{:.6g}\n",
            row.sweep, row.samples, row.fStop, row.focusDistance, lodModeName(row.mode), row.milliseconds.median,
            row.milliseconds.low, row.milliseconds.high, row.gpuMilliseconds.median, row.speedUp, row.triangles,
            row.gpuBytes, csvDifference(row.fromFullDetail),
            row.fromReference ? csvDifference(*row.fromReference) : ",,,", row.runs, row.setupMilliseconds,
            row.pyramidMilliseconds, row.referenceSamples, row.referenceRemaining.rmse, row.referenceRemaining.flip);
    return text;
}

std::string speedupJson(std::span<const SpeedupRow> rows, const BenchSubject& subject) {
    ordered_json document = subjectJson("speedup", subject);
    document["heldEqual"] =
        "scene, camera, lens, lens samples, image size, layers drawn at once, renderer, process; runs alternate "
        "between the modes; neither set-up nor pyramids are in a frame's time";
    document["rows"] = ordered_json::array();
    for (const SpeedupRow& row : rows) document["rows"].push_back(rowJson(row));
    return document.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace defocus
