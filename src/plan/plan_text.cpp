#include "plan/plan_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "lens/lens_fields.h"
#include "plan/lens_cells/lens_cells.h"

namespace defocus::engine {

namespace {

using nlohmann::json;

json number(double value) {
    return std::isfinite(value) ? json(value) : json(nullptr);
}

json drawJson(const LevelDraw& draw) {
    return {{"level", draw.level},
            {"triangles", draw.triangleCount},
            {"firstSample", draw.firstSample},
            {"sampleCount", draw.sampleCount}};
}

json objectJson(const ObjectPlan& object, const LensCells& cells) {
    json draws = json::array();
    for (const LevelDraw& draw : {object.coarse, object.fine})
        if (draw.sampleCount > 0) draws.push_back(drawJson(draw));
    json result = {{"name", object.name},
                   {"depth", {number(object.nearestDepth), number(object.farthestDepth)}},
                   {"coc",
                    {{"nearest", number(object.coc.nearest)},
                     {"farthest", number(object.coc.farthest)},
                     {"smallest", number(object.coc.smallest)},
                     {"largest", number(object.coc.largest)}}},
                   {"projectedEdge", number(object.projectedEdge)},
                   {"lambda", object.lambda},
                   {"blended", object.blended},
                   {"transmits", object.transmits},
                   {"moves", !object.motion.empty()},
                   {"draws", std::move(draws)},
                   {"pixelRate", pixelRate(cells, object.coc.smallest)}};
    if (boundarySample(object)) result["boundaryShare"] = object.boundaryShare;
    return result;
}

// Describes one draw. `shared` is the share of the boundary sample that the other level draws.
std::string drawText(const LevelDraw& draw, double shared) {
    if (draw.sampleCount == 0) return "";
    return fmt::format("{} ({} tri) x {:.4g}", draw.level, draw.triangleCount, draw.sampleCount - shared);
}

std::string drawsText(const ObjectPlan& object) {
    const bool shares = boundarySample(object).has_value();
    return fmt::format("{:<24}  {}{}", drawText(object.coarse, shares ? 1 - object.boundaryShare : 0),
                       drawText(object.fine, shares ? object.boundaryShare : 0),
                       object.motion.empty() ? object.blurMoves ? "  changes its blur" : "" : "  moves");
}

std::size_t movingCount(const FramePlan& plan) {
    return static_cast<std::size_t>(std::count_if(plan.objects.begin(), plan.objects.end(),
                                                  [](const ObjectPlan& object) { return !object.motion.empty(); }));
}

// Returns the number of shutter moments; 0 if nothing moves.
std::size_t momentCount(const FramePlan& plan) {
    std::size_t count = 0;
    for (const ObjectPlan& object : plan.objects) count = std::max(count, object.motion.size());
    return count;
}

std::string thresholdsText(const FramePlan& plan) {
    const LodThresholds& thresholds = plan.thresholds;
    if (plan.settings.metric == LodMetric::measured) return fmt::format("light threshold {:.4g}", thresholds.light);
    if (plan.settings.metric == LodMetric::score) return fmt::format("blur threshold {:.4g}", thresholds.blur);
    return fmt::format("blur threshold {:.4g}, size threshold {:.4g} px", thresholds.blur, thresholds.size);
}

// Describes how images are blurred as lens cells, or the reason why they aren't.
std::string lensCellsText(const FramePlan& plan) {
    const LensCells cells = lensCells(plan);
    if (cells.blur > 0)
        return fmt::format(
            "--method multirate blurs each sample's image as its part of the lens would, by σ = {:.3g} of the CoC: "
            "{:.2g} px "
            "of the largest\n",
            cells.blur, cells.blur * plan.largestBlur);
    return fmt::format("--method multirate draws this frame as the accumulation does: {}\n", cells.reason);
}

// Rounds a tiny CoC to 0, to avoid printing −0.00.
double shownCoc(double coc) {
    return std::abs(coc) < 0.005 ? 0 : coc;
}

// Returns the camera's position (m) and its right, up and back directions.
json cameraJson(const View& view) {
    const auto column = [&](int c) {
        const glm::dvec4& v = view.worldFromCamera[c];
        return json::array({v.x, v.y, v.z});
    };
    return {{"position", column(3)}, {"right", column(0)}, {"up", column(1)}, {"back", column(2)}};
}

json lensJson(const FramePlan& plan) {
    json lens;
    for (const LensField& field : lensFields()) lens[field.name] = number(lensFieldValue(plan.view.lens, field));
    lens["apertureImage"] = plan.view.lens.apertureImage != nullptr;
    lens["apertureDiameter"] = plan.apertureDiameter;
    lens["used"] = plan.usesLens;
    return lens;
}

json shadowsJson(const ShadowPlan& shadows) {
    json maps = json::array();
    for (const ShadowMap& map : shadows.maps)
        maps.push_back({{"light", map.light}, {"face", map.face}, {"lightSize", map.lightSize}});
    return {{"maps", std::move(maps)}, {"size", shadows.size}, {"pointsPerSample", shadows.points}};
}

}  // namespace

std::string planTable(const FramePlan& plan) {
    const Lens& lens = plan.view.lens;
    std::string text = fmt::format(
        "{} x {} px, {} samples of {}, {:.4g} mm f/{:.3g}, focus at {:.4g} m, aperture {:.4g} mm\n"
        "level of detail: {}, {} metric, {}, {}, {} vertices\n\n",
        plan.view.width, plan.view.height, plan.samples.size(), sequenceName(plan.settings.sequence), lens.focalLength,
        lens.fStop, lens.focusDistance, plan.apertureDiameter * 1000, lodModeName(plan.settings.lod),
        lodMetricName(plan.settings.metric), thresholdsText(plan),
        plan.settings.lodCoc == LodCoc::centre ? "blur at the centre" : "smallest blur",
        levelVerticesName(plan.settings.levelVertices));
    if (!plan.moments.empty())
        text.insert(text.size() - 1,
                    fmt::format("shutter: {} moments, {} of {} objects move{}\n", momentCount(plan), movingCount(plan),
                                plan.objects.size(), plan.middleFromView.empty() ? "" : ", and so does the camera"));
    std::size_t width = 6;
    for (const ObjectPlan& object : plan.objects) width = std::max(width, object.name.size());
    text += fmt::format("{:{}}  {:>17}  {:>17}  {:>7}  {:>6}  {:<24}  {}\n", "object", width, "depth m", "CoC px",
                        "edge px", "level", "coarse (first samples)", "fine (the rest)");
    for (const ObjectPlan& object : plan.objects)
        text += fmt::format("{:{}}  {:>8.3f} {:>8.3f}  {:>8.2f} {:>8.2f}  {:>7.2f}  {:>6.2f}  {}\n", object.name, width,
                            object.nearestDepth, object.farthestDepth, shownCoc(object.coc.nearest),
                            shownCoc(object.coc.farthest), object.projectedEdge, object.lambda, drawsText(object));
    const double ratio = plan.trianglesDrawn > 0 ? static_cast<double>(plan.trianglesAtFullDetail) /
                                                       static_cast<double>(plan.trianglesDrawn)
                                                 : 1;
    text += fmt::format("\n{} triangles in all samples; {} at full detail ({:.1f} times as many)\n",
                        plan.trianglesDrawn, plan.trianglesAtFullDetail, ratio);
    if (!plan.settings.keepAll && plan.usesLens) text += lensCellsText(plan);
    if (!plan.leftOut.empty()) text += "\nleft out\n";
    for (const LeftOut& entry : plan.leftOut) text += fmt::format("  {}: {}\n", entry.what, entry.reason);
    return text;
}

std::string planJson(const FramePlan& plan) {
    const LensCells cells = lensCells(plan);
    json objects = json::array();
    for (const ObjectPlan& object : plan.objects) objects.push_back(objectJson(object, cells));
    json leftOut = json::array();
    for (const LeftOut& entry : plan.leftOut) leftOut.push_back({{"what", entry.what}, {"reason", entry.reason}});
    const json document = {{"image", {{"width", plan.view.width}, {"height", plan.view.height}}},
                           {"transparent", plan.needsAlpha},
                           {"camera", cameraJson(plan.view)},
                           {"lens", lensJson(plan)},
                           {"samples", plan.samples.size()},
                           {"sequence", sequenceName(plan.settings.sequence)},
                           {"seed", plan.settings.seed},
                           {"cocTolerance", plan.settings.cocTolerance},
                           {"shutter", {{"moments", momentCount(plan)}, {"movingObjects", movingCount(plan)}}},
                           {"lod",
                            {{"mode", lodModeName(plan.settings.lod)},
                             {"metric", lodMetricName(plan.settings.metric)},
                             {"coc", plan.settings.lodCoc == LodCoc::centre ? "centre" : "smallest"},
                             {"vertices", levelVerticesName(plan.settings.levelVertices)},
                             {"blurThreshold", plan.thresholds.blur},
                             {"sizeThreshold", plan.thresholds.size},
                             {"lightThreshold", plan.thresholds.light}}},
                           {"shadows", shadowsJson(plan.shadows)},
                           {"lensCells", {{"blur", cells.blur}, {"reason", cells.reason}}},
                           {"objects", std::move(objects)},
                           {"leftOut", std::move(leftOut)},
                           {"triangles",
                            {{"drawn", plan.trianglesDrawn},
                             {"facingAway", plan.trianglesFacingAway},
                             {"outside", plan.trianglesOutside},
                             {"fullDetail", plan.trianglesAtFullDetail}}}};
    return document.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

}  // namespace defocus::engine
