#include "scene/animation.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/error.h"
#include "core/parse.h"
#include "core/suggestion.h"

namespace defocus::engine {

namespace {

// Position of a time between two key frames: `fraction` in [0, 1) of the way from key `key` to `key + 1`, which are
// `span` seconds apart. `span` is 0 before the first and after the last key.
struct Segment {
    std::size_t key = 0;
    double fraction = 0;
    double span = 0;
};

Segment segmentAt(const std::vector<float>& times, double time) {
    const auto after = std::upper_bound(times.begin(), times.end(), time);
    if (after == times.begin()) return {};
    const auto key = static_cast<std::size_t>(after - times.begin()) - 1;
    if (after == times.end()) return {key, 0, 0};
    const double span = static_cast<double>(*after) - static_cast<double>(times[key]);
    return {key, (time - static_cast<double>(times[key])) / span, span};
}

// Returns one component of a Hermite spline between two keys (glTF 2.0, C.5). A key stores `count` components each of
// in-tangent, value and out-tangent; tangents are scaled by the seconds between the keys.
double cubicSpline(const float* key, const float* next, std::size_t count, const Segment& segment) {
    const double t = segment.fraction;
    const double t2 = t * t;
    const double t3 = t2 * t;
    return (2 * t3 - 3 * t2 + 1) * static_cast<double>(key[count]) +
           segment.span * (t3 - 2 * t2 + t) * static_cast<double>(key[2 * count]) +
           (-2 * t3 + 3 * t2) * static_cast<double>(next[count]) +
           segment.span * (t3 - t2) * static_cast<double>(next[0]);
}

glm::dquat rotationKey(const AnimationChannel& channel, std::size_t key) {
    const float* value = channel.values.data() + 4 * key;
    return glm::normalize(glm::dquat(value[3], value[0], value[1], value[2]));
}

}  // namespace

std::vector<double> sampleValues(const AnimationChannel& channel, std::size_t count, double time) {
    const std::size_t perKey = channel.interpolation == Interpolation::cubicSpline ? 3 * count : count;
    assert(!channel.times.empty() && channel.values.size() == channel.times.size() * perKey);
    const Segment segment = segmentAt(channel.times, time);
    const float* key = channel.values.data() + segment.key * perKey;
    const float* next = segment.span > 0 ? key + perKey : key;

    std::vector<double> result(count);
    for (std::size_t i = 0; i < count; ++i) {
        switch (channel.interpolation) {
            case Interpolation::step:
                result[i] = key[i];
                break;
            case Interpolation::linear:
                result[i] = (1 - segment.fraction) * static_cast<double>(key[i]) +
                            segment.fraction * static_cast<double>(next[i]);
                break;
            case Interpolation::cubicSpline:
                result[i] = cubicSpline(key + i, next + i, count, segment);
                break;
        }
    }
    return result;
}

int clipNamed(const Scene& scene, std::string_view nameOrNumber) {
    std::vector<std::string> names;
    for (const AnimationClip& clip : scene.clips) names.push_back(clip.name);
    const auto named = placeOfName(nameOrNumber, names);
    if (named && !nameOrNumber.empty()) return static_cast<int>(*named);
    const std::optional<std::size_t> number = parsedNumber<std::size_t>(nameOrNumber);
    if (number && *number < scene.clips.size()) return static_cast<int>(*number);

    std::string help = "; the scene has no animations";
    if (const std::string nearest = nearestWord(nameOrNumber, names); !nearest.empty()) {
        help = fmt::format("; did you mean '{}'?", nearest);
    } else if (!names.empty()) {
        for (std::size_t i = 0; i < names.size(); ++i) names[i].insert(0, fmt::format("{} ", i));
        help = fmt::format("; the scene has: {}", fmt::join(names, ", "));
    }
    throw MissingName(std::string(nameOrNumber), fmt::format("there is no animation '{}'{}", nameOrNumber, help));
}

double loopedTime(const AnimationClip& clip, double time) {
    const auto duration = static_cast<double>(clip.duration);
    if (!(duration > 0) || !std::isfinite(time)) return 0;
    const double looped = time - duration * std::floor(time / duration);
    return looped < duration && looped >= 0 ? looped : 0;
}

glm::dquat sampleRotation(const AnimationChannel& channel, double time) {
    if (channel.interpolation == Interpolation::linear) {
        const Segment segment = segmentAt(channel.times, time);
        const glm::dquat from = rotationKey(channel, segment.key);
        if (segment.span <= 0) return from;
        return glm::normalize(glm::slerp(from, rotationKey(channel, segment.key + 1), segment.fraction));
    }
    const std::vector<double> value = sampleValues(channel, 4, time);
    const glm::dquat rotation(value[3], value[0], value[1], value[2]);
    return glm::dot(rotation, rotation) > 0 ? glm::normalize(rotation) : glm::dquat(1, 0, 0, 0);
}

}  // namespace defocus::engine
