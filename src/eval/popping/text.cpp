#include "eval/popping/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "eval/csv.h"
#include "eval/spread.h"
#include "frame/report/json_values.h"

namespace defocus::engine {

namespace {

using nlohmann::ordered_json;

using Measure = double (*)(const PoppingFrame&);

struct NamedMeasure {
    const char* name;
    Measure of;
    PopSummary PoppingRow::*place;
};

// Errors over the object pixels, followed by errors over the complete image.
constexpr NamedMeasure measures[] = {
    {"changeRmse", [](const PoppingFrame& f) { return f.change.objects.rmse; }, &PoppingRow::changeRmse},
    {"changeFlip", [](const PoppingFrame& f) { return f.change.objects.flip; }, &PoppingRow::changeFlip},
    {"stepRmse", [](const PoppingFrame& f) { return f.step.objects.rmse; }, &PoppingRow::stepRmse},
    {"stepFlip", [](const PoppingFrame& f) { return f.step.objects.flip; }, &PoppingRow::stepFlip},
    {"changeRmseImage", [](const PoppingFrame& f) { return f.change.image.rmse; }, &PoppingRow::changeRmseImage},
    {"changeFlipImage", [](const PoppingFrame& f) { return f.change.image.flip; }, &PoppingRow::changeFlipImage},
    {"stepRmseImage", [](const PoppingFrame& f) { return f.step.image.rmse; }, &PoppingRow::stepRmseImage},
    {"stepFlipImage", [](const PoppingFrame& f) { return f.step.image.flip; }, &PoppingRow::stepFlipImage},
};

PopSummary summaryOf(std::span<const PoppingFrame* const> frames, Measure measure) {
    PopSummary summary;
    std::vector<double> values;
    for (const PoppingFrame* frame : frames) {
        values.push_back(measure(*frame));
        if (values.size() > 1 && values.back() <= summary.worst) continue;
        summary.worst = values.back();
        summary.worstFrame = frame->frame;
    }
    summary.percentile99 = percentile(values, 0.99);
    return summary;
}

bool sameRun(const PoppingRow& row, const PoppingFrame& frame) {
    return row.movement == frame.movement && row.samples == frame.samples;
}

std::string fraction(double value) {
    return std::isfinite(value) ? fmt::format("{:.3f}", value) : "-";
}

ordered_json summaryJson(const PopSummary& summary) {
    return {{"worst", summary.worst},
            {"worstFrame", summary.worstFrame},
            {"percentile99", summary.percentile99},
            {"ofNearest", jsonNumber(summary.ofNearest)}};
}

ordered_json rowJson(const PoppingRow& row) {
    ordered_json json = {{"movement", movementName(row.movement)},
                         {"samples", row.samples},
                         {"lod", poppingModeName(row.mode)},
                         {"frames", row.frames},
                         {"largestSpeed", row.speed}};
    for (const NamedMeasure& measure : measures) json[measure.name] = summaryJson(row.*measure.place);
    return json;
}

ordered_json stepJson(const SampleStep& step) {
    return {{"samples", step.samples},     {"object", step.object},     {"level", step.level},      {"coc", step.coc},
            {"edgeError", step.edgeError}, {"expected", step.expected}, {"measured", step.measured}};
}

ordered_json frameJson(const PoppingFrame& frame) {
    ordered_json json = {{"movement", movementName(frame.movement)},
                         {"samples", frame.samples},
                         {"lod", poppingModeName(frame.mode)},
                         {"frame", frame.frame},
                         {"speed", frame.speed}};
    for (const NamedMeasure& measure : measures) json[measure.name] = jsonNumber(measure.of(frame));
    return json;
}

}  // namespace

std::vector<PoppingRow> poppingRows(std::span<const PoppingFrame> frames) {
    std::vector<PoppingRow> rows;
    for (const PoppingFrame& frame : frames) {
        const auto known = std::ranges::find_if(
            rows, [&](const PoppingRow& row) { return sameRun(row, frame) && row.mode == frame.mode; });
        if (known != rows.end()) continue;
        PoppingRow row;
        row.movement = frame.movement;
        row.samples = frame.samples;
        row.mode = frame.mode;
        std::vector<const PoppingFrame*> own;
        for (const PoppingFrame& other : frames)
            if (sameRun(row, other) && row.mode == other.mode) own.push_back(&other);
        row.frames = static_cast<int>(own.size());
        for (const PoppingFrame* one : own) row.speed = std::max(row.speed, one->speed);
        for (const NamedMeasure& measure : measures) row.*measure.place = summaryOf(own, measure.of);
        rows.push_back(row);
    }
    for (PoppingRow& row : rows) {
        const auto nearest = std::ranges::find_if(rows, [&](const PoppingRow& other) {
            return other.mode == PoppingMode::nearest && other.movement == row.movement && other.samples == row.samples;
        });
        for (const NamedMeasure& measure : measures) {
            PopSummary& summary = row.*measure.place;
            const double worst = nearest == rows.end() ? 0 : ((*nearest).*measure.place).worst;
            summary.ofNearest = worst > 0 ? summary.worst / worst : std::numeric_limits<double>::quiet_NaN();
        }
    }
    return rows;
}

std::string firstFramesLine(std::span<const PoppingFrame> frames) {
    const std::vector<PoppingRow> rows = poppingRows(frames);
    std::string line;
    for (const PoppingRow& row : rows)
        line += fmt::format("{}{} {:.5f}", line.empty() ? "" : ", ", poppingModeName(row.mode), row.stepRmse.worst);
    return fmt::format("first {} frames of {}, {} samples, largest pop (RMSE over pixels covered by objects): {}\n",
                       rows.front().frames + 1, movementName(rows.front().movement), rows.front().samples, line);
}

std::string poppingHeader() {
    return fmt::format(
        "{:<10} {:>7} {:<10} {:>7}  {:^40}  {:^31}\n"
        "{:<10} {:>7} {:<10} {:>7}  {:>8} {:>5} {:>8} {:>7} {:>8}  {:>8} {:>7} {:>8} {:>7}\n",
        "", "", "", "fastest", "pop alone: RMSE, objects' pixels", "whole change, objects' pixels", "movement",
        "samples", "mode", "l/frame", "worst", "frame", "99 %", "of near", "FLIP", "RMSE", "of near", "FLIP",
        "of near");
}

std::string poppingLine(const PoppingRow& row) {
    return fmt::format(
        "{:<10} {:>7} {:<10} {:>7.4f}  {:>8.5f} {:>5} {:>8.5f} {:>7} {:>8.5f}  {:>8.5f} {:>7} {:>8.5f} {:>7}\n",
        movementName(row.movement), row.samples, poppingModeName(row.mode), row.speed, row.stepRmse.worst,
        row.stepRmse.worstFrame, row.stepRmse.percentile99, fraction(row.stepRmse.ofNearest), row.stepFlip.worst,
        row.changeRmse.worst, fraction(row.changeRmse.ofNearest), row.changeFlip.worst,
        fraction(row.changeFlip.ofNearest));
}

std::string sampleStepLine(const SampleStep& step) {
    return fmt::format(
        "N = {} samples, {}: changing one sample from level {} to {} causes {:.4f} of the image change that changing "
        "all samples causes ({:.2f}/N); expected {} = {:.4f} for a blur c of {:.1f} px and level differences w of "
        "{:.2f} px\n",
        step.samples, step.object, step.level, step.level + 1, step.measured, step.measured * step.samples,
        step.coc > step.edgeError ? "sqrt(c/w)/N" : "1/N", step.expected, step.coc, step.edgeError);
}

std::string poppingSummary(std::span<const PoppingRow> rows) {
    std::uint32_t max = 0;
    for (const PoppingRow& row : rows) max = std::max(max, row.samples);
    std::string text = fmt::format(
        "\nlargest pop at {} samples as a fraction of the largest pop of mode 'nearest' (RMSE and FLIP of the pop "
        "alone, without other changes):\n",
        max);
    for (const PoppingMode mode : poppingModes) {
        if (mode == PoppingMode::nearest) continue;
        text += fmt::format("  {:<10}", poppingModeName(mode));
        for (const PoppingRow& row : rows)
            if (row.samples == max && row.mode == mode)
                text += fmt::format("  {} {} / {}", movementName(row.movement), fraction(row.stepRmse.ofNearest),
                                    fraction(row.stepFlip.ofNearest));
        text += '\n';
    }
    return text;
}

std::string poppingCsv(std::span<const PoppingFrame> frames) {
    return csvText(frames, frameJson);
}

std::string poppingJson(std::span<const PoppingFrame> frames, std::span<const SampleStep> steps,
                        const BenchSubject& subject, const PoppingOptions& options) {
    ordered_json document = subjectJson("popping", subject);
    document["frames"] = options.frames;
    document["pathFrames"] = options.pathFrames;
    document["definitions"] = {
        {"change",
         "(I_t - I_t-1) - (R_t - R_t-1) of display values, where I is a frame of the mode and R the same frame at "
         "full detail with the same lens samples; FLIP between I_t and I_t-1 + (R_t - R_t-1), the latter clipped to "
         "[0, 1]"},
        {"step",
         "I_t minus the same view drawn with the levels of frame t-1 and its division of samples between levels"},
        {"objects",
         "errors are measured over the pixels that objects or their blur cover in frame t or t-1; errors whose names "
         "end in Image are measured over the complete image"},
        {"speed", "the largest change of an object's fractional level from frame to frame"},
        {"fullDetail", "equals the reference"}};
    document["heldEqual"] =
        "scene, views, lens samples, thresholds, image size and layer format; also the renderer, except for multirate";
    for (const char* list : {"rows", "sampleSteps"}) document[list] = ordered_json::array();
    for (const PoppingRow& row : poppingRows(frames)) document["rows"].push_back(rowJson(row));
    for (const SampleStep& step : steps) document["sampleSteps"].push_back(stepJson(step));
    return documentText(document);
}

}  // namespace defocus::engine
