#include "render/pops/level_change.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "image/tone_map.h"
#include "plan/visible/visibility.h"

namespace defocus::engine {

namespace {

constexpr float maxBlur = 256;  // max diameter (px) of the blur disks by which an object's pixels are dilated

bool sameDraw(const LevelDraw& a, const LevelDraw& b) {
    return a.sampleCount == b.sampleCount &&
           (a.sampleCount == 0 || (a.level == b.level && a.firstSample == b.firstSample));
}

}  // namespace

const ObjectPlan* objectOf(const FramePlan& plan, int object) {
    const auto found = std::ranges::find(plan.objects, object, &ObjectPlan::object);
    return found == plan.objects.end() ? nullptr : &*found;
}

void markUsed(FramePlan& plan) {
    for (const ObjectPlan& object : plan.objects)
        for (const LevelDraw& draw : {object.coarse, object.fine})
            if (draw.sampleCount > 0) plan.levelsUsed[static_cast<std::size_t>(object.mesh)][draw.level] = true;
}

std::optional<HeldPlan> asBefore(const FramePlan& plan, const FramePlan& before) {
    if (plan.samples.size() != before.samples.size()) return {};
    HeldPlan held{plan, {}};
    for (std::size_t i = 0; i < plan.objects.size(); ++i) {
        ObjectPlan& object = held.plan.objects[i];
        const ObjectPlan* earlier = objectOf(before, object.object);
        if (earlier == nullptr) continue;
        if (!sameDraw(object.coarse, earlier->coarse) || !sameDraw(object.fine, earlier->fine) ||
            object.boundaryShare != earlier->boundaryShare)
            held.changed.push_back(&plan.objects[i]);
        object.coarse = earlier->coarse;
        object.fine = earlier->fine;
        object.boundaryShare = earlier->boundaryShare;
    }
    if (held.changed.empty()) return {};
    markUsed(held.plan);
    return held;
}

Image objectPixels(const Image& level, const Image& coc) {
    // For each pixel that shows an object, mark the rows of its blur disk: +1 where a row begins, −1 after its end.
    const int width = level.width;
    std::vector<int> runs(static_cast<std::size_t>(width + 1) * static_cast<std::size_t>(level.height));
    for (int y = 0; y < level.height; ++y)
        for (int x = 0; x < width; ++x) {
            if (*level.at(x, y) < 0) continue;
            const float radius = 0.5f * std::min(std::abs(*coc.at(x, y)), maxBlur);
            const int rows = static_cast<int>(radius);
            for (int row = std::max(y - rows, 0); row <= std::min(y + rows, level.height - 1); ++row) {
                const auto away = static_cast<float>(row - y);
                const int half = static_cast<int>(std::sqrt(radius * radius - away * away));
                int* run = runs.data() + static_cast<std::ptrdiff_t>(row) * (width + 1);
                ++run[std::max(x - half, 0)];
                --run[std::min(x + half + 1, width)];
            }
        }
    Image mask(width, level.height, 1);
    for (int y = 0; y < level.height; ++y) {
        int open = 0;
        for (int x = 0; x < width; ++x) {
            open +=
                runs[static_cast<std::size_t>(y) * static_cast<std::size_t>(width + 1) + static_cast<std::size_t>(x)];
            *mask.at(x, y) = open > 0 ? 1.0f : 0.0f;
        }
    }
    return mask;
}

Image pixelsOf(const std::vector<const ObjectPlan*>& changed, const FramePlan& plan, const Image& objects) {
    Image pixels(objects.width, objects.height, 1);
    const auto bounded = [](double place, int size) { return static_cast<int>(std::clamp<double>(place, 0, size)); };
    for (const ObjectPlan* object : changed) {
        CocBox box{.ndcMin = glm::dvec2(-1), .ndcMax = glm::dvec2(1)};
        if (object->nearestDepth > plan.view.nearPlane) box = cocBoxOf(object->viewBox, object->own, plan);
        // The margin of 1 px is more than the half pixel by which a covered pixel extends beyond its centre.
        const double reach = 0.5 * object->coc.largest + 1;
        const int left = bounded(0.5 * (1 + box.ndcMin.x) * objects.width - reach, objects.width);
        const int right = bounded(0.5 * (1 + box.ndcMax.x) * objects.width + reach + 1, objects.width);
        const int top = bounded(0.5 * (1 - box.ndcMax.y) * objects.height - reach, objects.height);
        const int bottom = bounded(0.5 * (1 - box.ndcMin.y) * objects.height + reach + 1, objects.height);
        for (int y = top; y < bottom; ++y)
            for (int x = left; x < right; ++x) *pixels.at(x, y) = *objects.at(x, y);
    }
    return pixels;
}

Image displayColours(const Image& linear) {
    const Image encoded = displayEncoded(linear);
    Image colours(linear.width, linear.height, 3);
    const auto channels = static_cast<std::size_t>(encoded.channels);
    for (std::size_t i = 0; i < colours.pixels.size(); ++i)
        colours.pixels[i] = encoded.pixels[i / 3 * channels + i % 3];
    return colours;
}

double rootMeanSquare(const Image& difference, const Image* mask) {
    double sum = 0;
    std::uint64_t values = 0;
    for (std::size_t i = 0; i < difference.pixels.size(); ++i) {
        if (mask != nullptr && !(mask->pixels[i / 3] > 0)) continue;
        const auto value = static_cast<double>(difference.pixels[i]);
        sum += value * value;
        ++values;
    }
    return values > 0 ? std::sqrt(sum / static_cast<double>(values)) : 0;
}

}  // namespace defocus::engine
