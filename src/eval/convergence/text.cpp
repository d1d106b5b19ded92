#include "eval/convergence/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>

#include "eval/convergence/equal_error.h"
#include "eval/csv.h"
#include "eval/seed_errors.h"
#include "eval/spread.h"
#include "frame/report/json_values.h"

namespace defocus::engine {

namespace {

using nlohmann::ordered_json;

std::string nameOf(const ConvergenceRow& row) {
    const bool isDefault = row.form.empty() || row.form == "default";
    return isDefault ? row.method + ", " + row.setting : fmt::format("{} ({}), {}", row.method, row.form, row.setting);
}

// Returns two marks for the Pareto fronts on which the row lies: one for time and MSE, one for time and FLIP. A space
// means none.
std::string frontsOf(const ConvergenceRow& row) {
    return std::string(row.front ? "*" : row.frontOfMethod ? "+" : " ") + (row.frontByFlip ? "f" : " ");
}

ordered_json errorJson(const ImageError& error) {
    return {{"mse", error.mse}, {"psnr", jsonNumber(error.psnr())}, {"ssim", error.ssim}, {"flip", error.flip}};
}

std::vector<SeedError> seedErrors(const ConvergenceRow& row) {
    std::vector<SeedError> errors;
    for (const ImageError& error : row.ofSeeds) errors.push_back({std::sqrt(error.mse), error.flip});
    return errors;
}

ordered_json rowJson(const ConvergenceRow& row) {
    ordered_json json = {{"method", row.method},
                         {"form", row.form},
                         {"setting", row.setting},
                         {"samples", row.samples},
                         {"takesLensSamples", row.asked > 0},
                         {"runs", row.runs},
                         {"milliseconds", spreadJson(row.milliseconds)},
                         {"setupMilliseconds", spreadJson(row.setupMilliseconds)},
                         {"pyramidMilliseconds", row.pyramidMilliseconds},
                         {"gpuMilliseconds", row.gpuMilliseconds}};
    json.update(errorJson(row.error));
    if (row.ofSeeds.size() > 1) json["errorsOverSeeds"] = seedErrorsJson(seedErrors(row));
    json["bias"] = row.bias ? errorJson(*row.bias) : ordered_json(nullptr);
    json["triangles"] = row.triangles;
    json["peakBytes"] = row.peakBytes;
    json["front"] = row.front;
    json["frontOfMethod"] = row.frontOfMethod;
    json["frontByFlip"] = row.frontByFlip;
    json["mseBelowReference"] = row.mseBelowReference;
    json["flipBelowReference"] = row.flipBelowReference;
    json["fault"] = row.fault;
    json["image"] = imageName(row.method, row.setting, row.asked);
    json["errorMap"] = errorMapName(row.method, row.setting, row.asked);
    return json;
}

ordered_json referenceJson(const ReferenceImage& reference) {
    const Difference& r = reference.remaining;
    return {
        {"file", "reference.exr"},
        {"image", "images/reference.png"},
        {"samples", reference.samples},
        {"firstSample", referenceOffset},
        {"hash", fmt::format("{:016x}", reference.hash)},
        {"milliseconds", reference.milliseconds},
        {"reused", reference.reused},
        {"remaining", {{"mse", r.rmse * r.rmse}, {"psnr", jsonNumber(r.psnr)}, {"ssim", r.ssim}, {"flip", r.flip}}}};
}

ordered_json competitorJson(const Competitor& competitor) {
    ordered_json times = ordered_json::array();
    for (const Competitor::Time& time : competitor.times)
        times.push_back({{"rmse", time.rmse},
                         {"milliseconds", time.milliseconds ? ordered_json(*time.milliseconds) : ordered_json()},
                         {"atMost", time.atMost}});
    return {{"name", competitor.name}, {"times", std::move(times)}};
}

// Returns a file name made of method, setting and number of samples, such as "accumulation-lod-off-64".
std::string fileName(std::string_view method, std::string_view setting, std::uint32_t asked) {
    std::string name = fmt::format("{} {}", method, setting);
    if (asked > 0) name += fmt::format(" {}", asked);
    for (char& letter : name)
        if (std::isalnum(static_cast<unsigned char>(letter)) == 0 && letter != '.') letter = '-';
    return name;
}

}  // namespace

std::string convergenceHeader() {
    return fmt::format(
        "{:<60} {:>7} {:>9} {:>17} {:>8} {:>8} {:>7} {:>6} {:>7} {:>7} {:>9} {:>7}\n{:<60} {:>7} {:>9} {:>17} {:>8} "
        "{:>8} {:>7} {:>6} {:>7} {:>7} {:>9} {:>7}\n",
        "", "lens", "frame", "10-90 %", "set-up", "pyramids", "", "", "", "bias", "triangles", "peak",
        "   method, setting", "samples", "ms", "ms", "ms", "ms", "PSNR", "SSIM", "FLIP", "PSNR", "millions", "MiB");
}

std::string convergenceLine(const ConvergenceRow& row) {
    std::string line = fmt::format(
        "{} {:<57} {:>7} {:>9.1f} {:>17} {:>8.0f} {:>8.0f} {:>7.2f} {:>6.4f} {:>7.4f} {:>7} {:>9.2f} {:>7.0f}",
        frontsOf(row), nameOf(row), row.samples, row.milliseconds.median,
        fmt::format("{:.1f} to {:.1f}", row.milliseconds.low, row.milliseconds.high), row.setupMilliseconds.median,
        row.pyramidMilliseconds, row.error.psnr(), row.error.ssim, row.error.flip,
        row.bias ? fmt::format("{:.2f}", row.bias->psnr()) : "", static_cast<double>(row.triangles) / 1e6,
        static_cast<double>(row.peakBytes) / (1 << 20));
    line += belowReferenceText(row.mseBelowReference, row.flipBelowReference);
    if (!row.fault.empty()) line += "  INVALID IMAGE: " + row.fault;
    return line + '\n';
}

std::string convergenceSummary(std::span<const ConvergenceRow> rows, const ReferenceImage& reference) {
    const Difference& remaining = reference.remaining;
    std::string text = fmt::format(
        "\n"
        "reference: {} lens samples at full detail; its own sampling error is about PSNR {:.2f} dB, FLIP {:.4f}; "
        "smaller errors in the table are not reliable\n"
        "* no other row is both faster and closer to the reference by MSE\n"
        "+ no other row of the same method is both faster and closer by MSE\n"
        "f no other row is both faster and closer by FLIP\n",
        reference.samples, remaining.psnr, remaining.flip);
    for (const BiasFloor& floor : biasFloors(rows))
        text += fmt::format(
            "bias of {}, {}: PSNR {:.2f} dB, FLIP {:.4f} relative to full detail with the same {} lens samples; with "
            "these thresholds, more samples do not reduce the bias\n",
            floor.method, floor.setting, floor.error.psnr(), floor.error.flip, floor.samples);
    return text + equalErrorTable(timesToErrors(rows, comparedErrors));
}

std::string imageName(std::string_view method, std::string_view setting, std::uint32_t asked) {
    return "images/" + fileName(method, setting, asked) + ".png";
}

std::string errorMapName(std::string_view method, std::string_view setting, std::uint32_t asked) {
    return "images/" + fileName(method, setting, asked) + ".flip.png";
}

std::string convergenceCsv(std::span<const ConvergenceRow> rows) {
    return csvText(rows, rowJson);
}

std::string convergenceJson(std::span<const ConvergenceRow> rows, const ReferenceImage& reference,
                            const ConvergenceSubject& subject) {
    ordered_json document = subjectJson("convergence", subject.bench);
    document["heldEqual"] =
        "scene, camera, lens, image size, reference and process; runs alternate between the methods; the first wave of "
        "lens samples is drawn once before a timed run; threads are not pinned to cores";
    document["errorsMeasuredOn"] = "sRGB-encoded values in [0, 1] at EV 0, whole image; FLIP at 67 pixels per degree";
    document["errorMapFullScale"] = errorMapFullScale;
    document["reference"] = referenceJson(reference);
    document["rows"] = ordered_json::array();
    for (const ConvergenceRow& row : rows) document["rows"].push_back(rowJson(row));
    document["biasFloors"] = ordered_json::array();
    for (const BiasFloor& floor : biasFloors(rows)) {
        ordered_json json = {{"method", floor.method}, {"setting", floor.setting}, {"samples", floor.samples}};
        json.update(errorJson(floor.error));
        document["biasFloors"].push_back(std::move(json));
    }
    document["timesToErrors"] = ordered_json::array();
    for (const Competitor& competitor : timesToErrors(rows, comparedErrors))
        document["timesToErrors"].push_back(competitorJson(competitor));
    document["crops"] = ordered_json::array();
    for (const Crop& crop : subject.crops)
        document["crops"].push_back(
            {{"title", crop.title}, {"x", crop.x}, {"y", crop.y}, {"width", crop.width}, {"height", crop.height}});
    document["leftOut"] = ordered_json::array();
    for (const ConvergenceSubject::LeftOut& entry : subject.leftOut)
        document["leftOut"].push_back({{"method", entry.method}, {"setting", entry.setting}, {"reason", entry.reason}});
    return documentText(document);
}

}  // namespace defocus::engine
