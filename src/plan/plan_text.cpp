#include "plan/plan_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plan/lens_cells/automatic_cells.h"
#include "plan/lens_cells/lens_cells.h"

namespace defocus::engine {

namespace {

// Formats the level, its number of triangles and the number of samples that draw it. An object's two levels may share
// one sample, in which each draws some of the pixels. `shared` is the fraction of these pixels that is drawn with the
// object's other level.
std::string drawText(const LevelDraw& draw, double shared) {
    if (draw.sampleCount == 0) return "";
    return fmt::format("{} ({} tri) x {:.4g}", draw.level, draw.triangleCount, draw.sampleCount - shared);
}

std::string drawsText(const ObjectPlan& object) {
    const bool shares = boundarySample(object).has_value();
    return fmt::format("{:<24}  {}{}", drawText(object.coarse, shares ? 1 - object.boundaryShare : 0),
                       drawText(object.fine, shares ? object.boundaryShare : 0),
                       object.motion.empty() ? object.blurMoves ? "  blur changes" : "" : "  moves");
}

std::string thresholdsText(const FramePlan& plan) {
    const LodThresholds& thresholds = plan.thresholds;
    if (plan.settings.metric == LodMetric::measured) return fmt::format("light threshold {:.4g}", thresholds.light);
    if (plan.settings.metric == LodMetric::score || plan.settings.metric == LodMetric::proportional)
        return fmt::format("blur threshold {:.4g}", thresholds.blur);
    return fmt::format("blur threshold {:.4g}, size threshold {:.4g} px", thresholds.blur, thresholds.size);
}

// Describes which method "auto" has chosen, and why.
std::string chosenMethodText(const FramePlan& plan) {
    if (const std::string reason = reasonForAccumulation(plan); !reason.empty())
        return fmt::format("--method auto selects accumulation, because {}\n", reason);
    const LensCells cells = lensCells(plan);
    return fmt::format(
        "--method auto selects multirate, because about {:.0f} % of the image is blurred by {:g} px or more\n"
        "each sample stands for a small part of the lens, and its image is blurred by as much as this part blurs: a "
        "Gaussian with σ = {:.3g} times "
        "the CoC ({:.2g} px for the largest CoC)\n",
        100 * blurredShare(plan, minBlurOfCells), minBlurOfCells, cells.blur, cells.blur * plan.largestBlur);
}

// Rounds a tiny CoC to 0, to avoid printing −0.00.
double shownCoc(double coc) {
    return std::abs(coc) < 0.005 ? 0 : coc;
}

}  // namespace

std::size_t movingCount(const FramePlan& plan) {
    const auto moves = [](const ObjectPlan& object) { return !object.motion.empty(); };
    return static_cast<std::size_t>(std::ranges::count_if(plan.objects, moves));
}

std::size_t momentCount(const FramePlan& plan) {
    std::size_t count = 0;
    for (const ObjectPlan& object : plan.objects) count = std::max(count, object.motion.size());
    return count;
}

std::string planTable(const FramePlan& plan) {
    const Lens& lens = plan.view.lens;
    std::string text = fmt::format(
        "{} x {} px, {} sample{} of {}{}, {:.4g} mm f/{:.3g}, focus at {:.4g} m, aperture diameter {:.4g} mm\n"
        "level of detail: {}, metric {}, {}, {}, level vertices {}\n\n",
        plan.view.width, plan.view.height, plan.samples.size(), plan.samples.size() == 1 ? "" : "s",
        sequenceName(plan.settings.sequence),
        plan.settings.positions > 1 ? fmt::format(" with {} positions", plan.settings.positions) : "", lens.focalLength,
        lens.fStop, lens.focusDistance, plan.apertureDiameter * 1000, lodModeName(plan.settings.lod),
        lodMetricName(plan.settings.metric), thresholdsText(plan),
        plan.settings.lodCoc == LodCoc::centre ? "blur at the centre" : "smallest blur",
        levelVerticesName(plan.settings.levelVertices));
    if (!plan.moments.empty())
        text.insert(text.size() - 1, fmt::format("shutter: {} time samples, {} of {} objects move{}\n",
                                                 momentCount(plan), movingCount(plan), plan.objects.size(),
                                                 plan.middleFromView.empty() ? "" : ", the camera moves"));
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
    text += fmt::format("\n{} triangles, summed over all samples; {} at full detail ({:.1f} times as many)\n",
                        plan.trianglesDrawn, plan.trianglesAtFullDetail, ratio);
    if (!plan.settings.keepAll && plan.usesLens) text += chosenMethodText(plan);
    if (!plan.leftOut.empty()) text += "\nleft out\n";
    for (const LeftOut& entry : plan.leftOut) text += fmt::format("  {}: {}\n", entry.what, entry.reason);
    return text;
}

}  // namespace defocus::engine
