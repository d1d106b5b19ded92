#include "eval/scaling/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "eval/csv.h"
#include "frame/report/json_values.h"

namespace defocus::engine {

namespace {

using nlohmann::ordered_json;

// Formats a number briefly, such as "300 k" or "10 M".
std::string shortNumber(double value) {
    if (value >= 1e6) return fmt::format("{:.3g} M", value / 1e6);
    return value >= 1e4 ? fmt::format("{:.3g} k", value / 1e3) : fmt::format("{:.4g}", value);
}

std::string valueText(const ScalingRow& row) {
    if (row.axis == ScalingAxis::pixels) return fmt::format("{}x{}", row.width, row.height);
    return row.axis == ScalingAxis::blur ? fmt::format("{:.1f} px", row.value) : shortNumber(row.value);
}

// Groups the rows by axis and mode, ordered by first appearance.
std::vector<std::vector<ScalingRow>> curvesOf(std::span<const ScalingRow> rows) {
    std::vector<std::vector<ScalingRow>> curves;
    for (const ScalingRow& row : rows) {
        const auto known = std::ranges::find_if(curves, [&](const std::vector<ScalingRow>& curve) {
            return curve.front().axis == row.axis && curve.front().mode == row.mode;
        });
        if (known == curves.end())
            curves.push_back({row});
        else
            known->push_back(row);
    }
    return curves;
}

double timeOf(const ScalingRow& row) {
    return row.milliseconds.median;
}

double memoryOf(const ScalingRow& row) {
    return static_cast<double>(row.gpuBytes);
}

std::optional<PowerLaw> lawOf(std::span<const ScalingRow> curve, double (*quantity)(const ScalingRow&)) {
    std::vector<std::pair<double, double>> points;
    for (const ScalingRow& row : curve)
        if (row.value > 0 && quantity(row) > 0) points.emplace_back(row.value, quantity(row));
    return fittedPowerLaw(points);
}

// Returns the names of the parts that take most of the row's frame time, such as "fill" or "vertex work and fill
// alike".
std::string largestText(const ScalingRow& row) {
    std::string text;
    const std::vector<ScalingPart> largest = row.largestParts();
    for (const ScalingPart part : largest) text += (text.empty() ? "" : " and ") + std::string(scalingPartName(part));
    return largest.size() > 1 ? text + " alike" : text;
}

ordered_json lawJson(const std::optional<PowerLaw>& law) {
    if (!law) return nullptr;
    return {{"exponent", law->exponent}, {"residual", law->residual}, {"points", law->points}};
}

ordered_json rowJson(const ScalingRow& row) {
    return {
        {"axis", scalingAxisName(row.axis)},
        {"value", row.value},
        {"lod", lodModeName(row.mode)},
        {"samples", row.samples},
        {"width", row.width},
        {"height", row.height},
        {"runs", row.runs},
        {"milliseconds", spreadJson(row.milliseconds)},
        {"layersMilliseconds", row.layers.median},
        {"verticesMilliseconds", row.vertices.median},
        {"fillMilliseconds", row.fill.median},
        {"partSpreads",
         {{"layers", spreadJson(row.layers)}, {"vertices", spreadJson(row.vertices)}, {"fill", spreadJson(row.fill)}}},
        {"largestPart", largestText(row)},
        {"triangles", row.triangles},
        {"gpuBytes", row.gpuBytes},
        {"pyramidBytes", row.pyramidBytes}};
}

ordered_json sceneJson(const LargeSceneRow& row) {
    return {{"scene", row.scene.name},
            {"objects", row.scene.objects},
            {"meshes", row.meshes},
            {"triangles", row.triangles},
            {"worldMilliseconds", row.worldMilliseconds},
            {"planMilliseconds", spreadJson(row.planMilliseconds)},
            {"firstImageMilliseconds", row.firstImageMilliseconds},
            {"frameMilliseconds", row.frameMilliseconds},
            {"trianglesDrawn", row.trianglesDrawn},
            {"residentBytes", row.residentBytes},
            {"gpuBytes", row.gpuBytes}};
}

ordered_json curveJson(std::span<const ScalingRow> curve) {
    return {{"axis", scalingAxisName(curve.front().axis)},
            {"lod", lodModeName(curve.front().mode)},
            {"bounds", boundsAlong(curve)},
            {"time", lawJson(lawOf(curve, timeOf))},
            {"gpuMemory", lawJson(lawOf(curve, memoryOf))}};
}

}  // namespace

std::string scalingHeader() {
    return fmt::format(
        "{:<10} {:>10} {:<10} {:>9} {:>15}  {:>9} {:>9} {:>9}  {:>10} {:>8} {:>8}\n"
        "{:<10} {:>10} {:<10} {:>9} {:>15}  {:>9} {:>9} {:>9}  {:>10} {:>8} {:>8}\n",
        "", "", "", "frame", "10-90 %", "layers", "vertices", "fill", "triangles", "GPU", "pyramids", "axis", "value",
        "levels", "ms", "ms", "ms", "ms", "ms", "millions", "MB", "MB");
}

std::string scalingLine(const ScalingLeftOut& leftOut) {
    return fmt::format("{} {} is left out: {}\n", scalingAxisName(leftOut.point.axis), shortNumber(leftOut.point.value),
                       leftOut.reason);
}

std::string scalingLine(const ScalingRow& row) {
    return fmt::format(
        "{:<10} {:>10} {:<10} {:>9.1f} {:>15}  {:>9.1f} {:>9.1f} {:>9.1f}  {:>10.3f} {:>8.1f} {:>8.1f}\n",
        scalingAxisName(row.axis), valueText(row), lodModeName(row.mode), row.milliseconds.median,
        fmt::format("{:.1f} to {:.1f}", row.milliseconds.low, row.milliseconds.high), row.layers.median,
        row.vertices.median, row.fill.median, static_cast<double>(row.triangles) / 1e6,
        static_cast<double>(row.gpuBytes) / 1e6, static_cast<double>(row.pyramidBytes) / 1e6);
}

std::string boundsAlong(std::span<const ScalingRow> rows) {
    std::string text;
    for (std::size_t begin = 0; begin < rows.size();) {
        std::size_t end = begin;
        while (end < rows.size() && largestText(rows[end]) == largestText(rows[begin])) ++end;
        if (!text.empty()) text += ", ";
        text += largestText(rows[begin]);
        const bool fromStart = begin == 0;
        const bool toEnd = end == rows.size();
        if (fromStart && toEnd)
            text += " throughout";
        else if (fromStart)
            text += " up to " + valueText(rows[end - 1]);
        else if (toEnd)
            text += " from " + valueText(rows[begin]);
        else if (end - begin == 1)
            text += " at " + valueText(rows[begin]);
        else
            text += " from " + valueText(rows[begin]) + " to " + valueText(rows[end - 1]);
        begin = end;
    }
    return text;
}

std::string scalingSummary(std::span<const ScalingRow> rows) {
    std::string text =
        "\nexponents of power laws for time and GPU memory along each axis, fitted to the upper half of the axis's "
        "points, and the largest parts of the frame time\n(alike: the spreads of the parts overlap, or the parts "
        "differ by less than a twentieth of the frame time)\n";
    for (const std::vector<ScalingRow>& curve : curvesOf(rows)) {
        text += fmt::format("  {:<10} {:<10} ", scalingAxisName(curve.front().axis), lodModeName(curve.front().mode));
        const std::optional<PowerLaw> time = lawOf(curve, timeOf);
        const std::optional<PowerLaw> memory = lawOf(curve, memoryOf);
        if (time)
            text += fmt::format("time exponent {:>5.2f} (residual {:.1f} %, {} points), ", time->exponent,
                                100 * time->residual, time->points);
        if (memory) text += fmt::format("GPU memory exponent {:>5.2f}; ", memory->exponent);
        text += boundsAlong(curve) + '\n';
    }
    return text;
}

std::string scalingCsv(std::span<const ScalingRow> rows) {
    return csvText(rows, rowJson);
}

std::string scalingJson(std::span<const ScalingRow> rows, std::span<const ScalingLeftOut> leftOut,
                        std::span<const LargeSceneRow> scenes, const BenchSubject& subject) {
    ordered_json document = subjectJson("scaling", subject);
    document["heldEqual"] =
        "along an axis: process, scene, camera, lens, lens samples and image size, except the quantity that the axis "
        "varies; runs alternate between the modes";
    document["parts"] =
        "layers: time of the frame with nothing drawn; vertices: time of the same draw calls at 1/40 of the width and "
        "height; fill: the rest of the frame's time";
    for (const char* list : {"curves", "rows", "leftOut"}) document[list] = ordered_json::array();
    for (const std::vector<ScalingRow>& curve : curvesOf(rows)) document["curves"].push_back(curveJson(curve));
    for (const ScalingRow& row : rows) document["rows"].push_back(rowJson(row));
    for (const ScalingLeftOut& entry : leftOut)
        document["leftOut"].push_back(
            {{"axis", scalingAxisName(entry.point.axis)}, {"value", entry.point.value}, {"reason", entry.reason}});
    for (const LargeSceneRow& row : scenes) document["scenes"].push_back(sceneJson(row));
    return documentText(document);
}

}  // namespace defocus::engine
