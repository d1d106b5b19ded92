#include "frame/report/plan_warnings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/number_text.h"
#include "defocus/settings.h"
#include "frame/settings/unused_settings.h"
#include "gl/shader_cache.h"
#include "lens/lens_fields.h"
#include "plan/lens_cells/lens_cells.h"
#include "render/sampling/automatic_samples.h"
#include "scene/hidden_nodes.h"

namespace defocus::engine {

namespace {

constexpr double visibleShare = 0.02;   // blur that is easy to see, as a fraction of the image width
constexpr std::size_t maxSharing = 8;   // maximum number of nodes in a warning about their common name
constexpr std::size_t maxIgnored = 20;  // maximum number of lines in ignoredWarnings

// Rounds `value` > 0 to 1, 2 or 5 times a power of ten, for readable suggestions.
double roundNumber(double value) {
    const double power = std::pow(10, std::floor(std::log10(value)));
    const double digit = value / power;
    return power * (digit < 1.5 ? 1 : digit < 3.5 ? 2 : digit < 7.5 ? 5 : 10);
}

std::string nothingBlurred(const FramePlan& plan) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const ObjectPlan& object : plan.objects) nearest = std::min(nearest, object.nearestDepth);
    const double scale = roundNumber(plan.view.lens.blurScale * visibleShare * plan.view.width / plan.largestBlur);
    const std::string help = scale <= lensFieldNamed("blurScale")->max
                                 ? fmt::format("try --blur-scale {:g} or a smaller --fstop", scale)
                                 : "check --units";
    return fmt::format(
        "no visible blur: the maximum is {:.2g} px, because the nearest surface is {:.3g} m away (focus at {:.3g} m, "
        "f/{:g}); {}",
        plan.largestBlur, nearest, plan.view.lens.focusDistance, plan.view.lens.fStop, help);
}

// Gaps between the images of a blurred point in neighbouring lens samples. With lens cells (parts of the lens), each
// sample's image is blurred by a Gaussian to fill the gaps.
struct Gaps {
    double size = 0;  // gap in px; with lens cells: standard deviation of the Gaussian, px
    double max = 16;  // largest `size` that causes no warning, px
    double good = 8;  // target for `size` with the settings that the warning suggests, px
};

Gaps gapsOf(const FramePlan& plan, const MethodUse& use, double blur, std::uint64_t samples) {
    if (const LensCells cells = use.method->blursCells ? lensCells(plan) : LensCells{}; cells.blur > 0) {
        const double widest = std::sqrt(cellClassVariance(maxCellClasses - 1));  // max σ of the Gaussian, px
        return {cells.blur * blur, widest, 0.7 * widest};
    }
    return {blur * std::sqrt(std::numbers::pi / (4.0 * static_cast<double>(samples)))};
}

std::string copiesShow(const FramePlan& plan, double blur, const Gaps& gaps, std::uint64_t samples) {
    const double needed = static_cast<double>(samples) * std::pow(gaps.size / gaps.good, 2);
    const double scale = plan.view.lens.blurScale * gaps.good / gaps.size;
    const std::string more =
        needed <= maxSamples
            ? fmt::format("use about {} samples, or ", grouped(64 * static_cast<std::uint64_t>(std::ceil(needed / 64))))
            : std::string();
    return fmt::format(
        "blur of up to {:.0f} px from {} sample{}: bright points may appear as separate copies; {}--blur-scale {:g} "
        "for less blur",
        blur, grouped(samples), samples == 1 ? "" : "s", more, roundNumber(scale));
}

// Returns a warning if the blur of some object is too large to be resolved by lens samples; otherwise empty.
std::vector<std::string> immenseBlur(const FramePlan& plan) {
    double largest = 0;
    for (const ObjectPlan& object : plan.objects)
        if (std::isfinite(object.coc.largest)) largest = std::max(largest, object.coc.largest);
    if (largest <= largestSampledBlur(plan)) return {};
    return {fmt::format(
        "blur of up to {:.2g} px spreads a point over more than {} times the image's area, which no number of samples "
        "resolves; check the f-number and the lens values in the camera's extras, or use --blur-scale {:g}",
        largest, grouped(maxAutomaticSamples),
        roundNumber(plan.view.lens.blurScale * visibleShare * plan.view.width / largest))};
}

// Returns a warning if the blur varies so much inside triangles that even their maximum subdivision only approximates
// it; otherwise empty.
std::vector<std::string> coarseDivisions(const FramePlan& plan) {
    const auto bounded = [](const ObjectPlan& object) {
        return object.refinement == Refinement::subdivide && object.maxParts < maxEdgeParts;
    };
    const auto count = std::ranges::count_if(plan.objects, bounded);
    if (count == 0) return {};
    return {
        fmt::format("the blur of {} object{} varies too much within triangles and is approximated: edges are divided "
                    "into at most {} parts, to limit the number of triangles; use a smaller --field-curvature, "
                    "--radial-blur-gain or --astigmatism, or levels of detail, whose fewer triangles can be divided "
                    "further",
                    count, count == 1 ? "" : "s", std::ranges::find_if(plan.objects, bounded)->maxParts)};
}

// Returns the names or numbers by which the request refers to nodes.
std::vector<std::string> namedNodes(const Request& request) {
    std::vector<std::string> names = request.hide;
    for (const auto& [name, scale] : request.nodeBlur) names.push_back(name);
    if (const auto* focus = std::get_if<FocusNode>(&request.focus)) names.push_back(focus->name);
    return names;
}

// Returns a warning that lists all nodes named `name` and says which of them is used; empty unless there are several.
std::vector<std::string> sharedName(const std::string& name, const PreparedFrame& frame) {
    const std::vector<Node>& nodes = frame.scene->nodes;
    std::vector<std::string> sharing;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (nodes[i].name != name) continue;
        const glm::dvec4& origin = frame.world.pose.worldFromNode[i][3];
        sharing.push_back(fmt::format("#{} at ({:.3g}, {:.3g}, {:.3g})", i, origin.x, origin.y, origin.z));
    }
    if (sharing.size() < 2) return {};
    const int used = nodeCalled(*frame.scene, name);
    const std::size_t listed = std::min(sharing.size(), maxSharing);
    return {fmt::format("{} nodes are named '{}': {}{}; #{} is used; to use another node, give its number",
                        sharing.size(), name, fmt::join(sharing.begin(), sharing.begin() + listed, ", "),
                        listed < sharing.size() ? ", …" : "", used)};
}

}  // namespace

std::vector<std::string> planWarnings(const FramePlan& plan, const MethodUse& use, std::uint64_t samples) {
    const Method& method = *use.method;
    if (samples == 0) samples = plan.samples.size();
    std::vector<std::string> lines;
    if (plan.usesTransmission && !method.showsThrough)
        lines.push_back(
            fmt::format("method {}: transmissive materials are drawn opaque; choose accumulation", method.name));
    if (!plan.shadows.maps.empty() && !method.drawsShadows)
        lines.push_back(fmt::format("method {}: shadows are not supported; choose accumulation", method.name));
    if (plan.objects.empty() || !plan.view.lens.dofEnabled) return lines;
    if (plan.largestBlur > 0 && plan.largestBlur < minBlur) lines.push_back(nothingBlurred(plan));
    for (std::string& line : coarseDivisions(plan)) lines.push_back(std::move(line));
    if (!method.usesLensSamples) return lines;
    for (std::string& line : immenseBlur(plan)) lines.push_back(std::move(line));
    const double blur = largestBoundedBlur(plan);
    if (!std::isfinite(blur)) return lines;
    if (const Gaps gaps = gapsOf(plan, use, blur, samples); gaps.size > gaps.max)
        lines.push_back(copiesShow(plan, blur, gaps, samples));
    return lines;
}

std::vector<std::string> ignoredWarnings(const Scene& scene) {
    std::vector<std::string> lines;
    std::uint64_t more = 0;
    for (const Ignored& ignored : scene.ignored) {
        if (ignored.damage) continue;
        if (lines.size() == maxIgnored)
            ++more;
        else
            lines.push_back(fmt::format("{}{}: {}", ignored.count > 1 ? grouped(ignored.count) + " x " : "",
                                        ignored.what, ignored.reason));
    }
    if (more > 0)
        lines.push_back(fmt::format("{} more kind{} of content {} ignored", grouped(more), more == 1 ? "" : "s",
                                    more == 1 ? "is" : "are"));
    return lines;
}

std::vector<std::string> requestWarnings(const Request& request, const PreparedFrame& frame) {
    std::vector<std::string> lines = frameWarnings(frame);
    if (std::string full = shaderCacheWarning(); !full.empty()) lines.push_back(std::move(full));
    const auto add = [&](const std::vector<std::string>& more) { lines.insert(lines.end(), more.begin(), more.end()); };
    add(ignoredWarnings(*frame.scene));
    for (const std::string& name : namedNodes(request)) add(sharedName(name, frame));
    add(unusedSettings(request, *frame.scene, frame.view.lens));
    return lines;
}

}  // namespace defocus::engine
