// defocus compare: measures the difference between two images.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/command.h"
#include "cli/options/image_output.h"
#include "cli/options/option_text.h"
#include "core/error.h"
#include "core/file.h"
#include "frame/report/json_values.h"
#include "image/colour_map.h"
#include "image/image_io.h"
#include "image/image_rows.h"
#include "image/metrics.h"

namespace defocus::engine {

namespace {

struct CompareArguments {
    std::filesystem::path reference;
    std::filesystem::path test;
    std::filesystem::path errorMap;
    bool json = false;
    bool hdr = false;
    HdrFlipOptions hdrFlip;
    std::vector<std::string> failAbove;  // strings METRIC=VALUE; validated while the command line is parsed
};

struct Metric {
    std::string_view name;
    double (*value)(const Difference&);
    bool largerIsBetter;
};
constexpr std::array<Metric, 7> metrics = {{
    {"mae", [](const Difference& d) { return d.mae; }, false},
    {"rmse", [](const Difference& d) { return d.rmse; }, false},
    {"psnr", [](const Difference& d) { return d.psnr; }, true},
    {"ssim", [](const Difference& d) { return d.ssim; }, true},
    {"flip", [](const Difference& d) { return d.flip; }, false},
    {"maxError", [](const Difference& d) { return d.maxError; }, false},
    {"nonFinite", [](const Difference& d) { return static_cast<double>(d.nonFinite); }, false},
}};

struct Limit {
    const Metric* metric = nullptr;
    double value = 0;
};

// Parses METRIC=VALUE. For any other text, returns a limit whose metric is null.
Limit limitOf(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) return {};
    Limit limit;
    for (const Metric& metric : metrics)
        if (metric.name == std::string_view(text).substr(0, equals)) limit.metric = &metric;
    if (!CLI::detail::lexical_cast(text.substr(equals + 1), limit.value) || !std::isfinite(limit.value)) return {};
    return limit;
}

std::string limitFault(const std::string& text) {
    if (limitOf(text).metric != nullptr) return {};
    return fmt::format(
        "'{}' is not METRIC=VALUE, such as psnr=42; the metrics are: mae, rmse, psnr, ssim, flip, maxError, nonFinite",
        text);
}

void printJson(const Difference& difference) {
    nlohmann::ordered_json json;
    for (const Metric& metric : metrics) {
        if (metric.name == "nonFinite") continue;
        json[std::string(metric.name)] = jsonNumber(metric.value(difference));
    }
    json["maxErrorPixel"] = {difference.maxErrorPixel.column, difference.maxErrorPixel.row};
    json["nonFinite"] = difference.nonFinite;
    json["pixelCount"] = difference.pixelCount;
    fmt::print("{}", documentText(json));
}

void printTable(const CompareArguments& arguments, const Difference& difference) {
    const auto row = [](std::string_view name, const std::string& value) { fmt::print("{:<12}{}\n", name, value); };
    row("reference", arguments.reference.string());
    row("test", arguments.test.string());
    row("mae", fmt::format("{:.6f}", difference.mae));
    row("rmse", fmt::format("{:.6f}", difference.rmse));
    row("psnr",
        std::isfinite(difference.psnr) ? fmt::format("{:.2f} dB", difference.psnr) : "infinite (no difference)");
    row("ssim", fmt::format("{:.6f}", difference.ssim));
    row("flip", fmt::format("{:.6f} ({})", difference.flip, arguments.hdr ? "HDR" : "LDR"));
    row("max error", fmt::format("{:.6f} at pixel {},{}", difference.maxError, difference.maxErrorPixel.column,
                                 difference.maxErrorPixel.row));
    row("non-finite", fmt::format("{} of {} pixels", difference.nonFinite, difference.pixelCount));
}

// Writes an error map, a few rows at a time: raw values to an EXR file, false colours to files of other formats.
class ErrorMap {
public:
    ErrorMap(const std::filesystem::path& path, int width, int height)
        : coloured_(!isExr(path)), writer_(path, width, height, coloured_ ? 3 : 1, {}) {}

    void write(const ImageView& flip) {
        if (!coloured_) return writer_.write(flip);
        Image values(flip.width, flip.height, 1);
        std::ranges::copy(flip.pixels, values.pixels.begin());
        writer_.write(colourMapped(values));
    }
    void finish() { writer_.finish(); }

private:
    bool coloured_;
    ImageRowWriter writer_;
};

void checkLimits(const CompareArguments& arguments, const Difference& difference) {
    std::string faults;
    for (const std::string& text : arguments.failAbove) {
        const Limit limit = limitOf(text);
        const double value = limit.metric->value(difference);
        if (limit.metric->largerIsBetter ? value >= limit.value : value <= limit.value) continue;
        faults += fmt::format("{}{} {:.6g} is {} {:g}", faults.empty() ? "" : ", ", limit.metric->name, value,
                              limit.metric->largerIsBetter ? "below" : "above", limit.value);
    }
    if (!faults.empty())
        fail("{} differs too much from {}: {}", arguments.test.string(), arguments.reference.string(), faults);
}

void runCompare(const CompareArguments& arguments) {
    // Comparing the images may take a long time, so first check that the output file can be written.
    if (!arguments.errorMap.empty()) {
        checkImageOutputs({arguments.errorMap}, {}, {arguments.reference, arguments.test});
    }

    StripReader reference(arguments.reference);
    StripReader test(arguments.test);
    const int width = reference.width(), height = reference.height();
    if (width != test.width() || height != test.height())
        fail("{} has {}x{} pixels, but {} has {}x{}; give images of the same size", arguments.reference.string(), width,
             height, arguments.test.string(), test.width(), test.height());
    std::optional<ErrorMap> map;
    CompareOptions options;
    if (arguments.hdr) options.hdrFlip = arguments.hdrFlip;
    if (!arguments.errorMap.empty()) {
        map.emplace(arguments.errorMap, width, height);
        options.takeFlip = [&](const ImageView& rows) { map->write(rows); };
    }
    const auto strips = [&](StripReader& reader) {
        return ImageStrips{width, height, [&reader](int first, int count) { return reader.rows(first, count); }};
    };
    const Difference difference = compareStrips(strips(reference), strips(test), options);

    if (map) map->finish();
    if (arguments.json)
        printJson(difference);
    else
        printTable(arguments, difference);
    checkLimits(arguments, difference);
}

}  // namespace

void addCompareCommand(CLI::App& program, const GlobalOptions&) {
    auto arguments = std::make_shared<CompareArguments>();
    CLI::App* command = program.add_subcommand("compare", "Measure the difference between two images");
    command->add_option("A", arguments->reference, "Reference image (EXR, PNG, JPEG, HDR or TIFF)")->required();
    command->add_option("B", arguments->test, "Image to compare with the reference, of the same size")->required();
    command->add_flag("--json", arguments->json,
                      "Print JSON: mae, rmse, psnr (dB; null if the images are equal), ssim, flip, maxError, "
                      "maxErrorPixel [column, row], nonFinite, pixelCount");
    command
        ->add_option("--error-map", arguments->errorMap,
                     "Image file for the FLIP value of each pixel: .png and .jpg in magma colours, .exr as values")
        ->type_name("FILE");
    CLI::Option* hdr =
        command->add_flag("--hdr", arguments->hdr,
                          "Use FLIP for HDR images: the maximum over several exposures, instead of the value at EV 0");
    const Range exposures = {-60, 60};
    advanced(addNumber(*command, "--start-exposure", arguments->hdrFlip.startExposure, exposures, "EV",
                       "Lowest exposure of --hdr in EV")
                 ->needs(hdr));
    advanced(addNumber(*command, "--stop-exposure", arguments->hdrFlip.stopExposure, exposures, "EV",
                       "Highest exposure of --hdr in EV")
                 ->needs(hdr));
    advanced(addInteger(*command, "--exposures", arguments->hdrFlip.exposures, 1, 64, "Number of exposures of --hdr")
                 ->needs(hdr));
    command
        ->add_option("--fail-above", arguments->failAbove,
                     "Fail with exit code 1 if METRIC is worse than VALUE: lower for psnr and ssim, higher for the "
                     "other metrics. Can be given several times")
        ->type_name("METRIC=VALUE")
        ->allow_extra_args(false)
        ->check(CLI::Validator(limitFault, ""));
    command->footer(
        "All metrics except HDR FLIP use sRGB-encoded values in [0, 1] at EV 0. A pixel that is NaN or infinite in "
        "one\n"
        "image counts as the maximum difference. If it is NaN or infinite in both, it counts as equal.\n"
        "\n"
        "Example:\n"
        "  defocus compare reference.exr out.exr --error-map error.png --fail-above flip=0.015 --fail-above psnr=42");
    command->callback([arguments] { runCompare(*arguments); });
}

}  // namespace defocus::engine
