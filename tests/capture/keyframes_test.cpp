#include "capture/keyframes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace defocus::engine {
namespace {

const std::vector<Key<double>> steps = {{0, 1}, {10, 4}, {14, 4}, {30, -2}, {31, -3}};

TEST(Keyframes, hitEachKeyAndHoldTheEnds) {
    for (const Easing easing : {Easing::linear, Easing::smooth}) {
        for (const Key<double>& key : steps) EXPECT_NEAR(valueAt(steps, easing, key.frame), key.value, 1e-12);
        EXPECT_EQ(valueAt(steps, easing, -5), 1);
        EXPECT_EQ(valueAt(steps, easing, 99), -3);
        EXPECT_EQ(valueAt({{7, 2.5}}, easing, 3), 2.5);
    }
}

TEST(Keyframes, linearIsStraight) {
    EXPECT_DOUBLE_EQ(valueAt(steps, Easing::linear, 2.5), 1.75);
    EXPECT_DOUBLE_EQ(valueAt(steps, Easing::linear, 22), 1);
}

// Smooth interpolation between two keys is 3t² − 2t³, where t grows from 0 to 1 between the keys.
TEST(Keyframes, smoothBetweenTwoKeysIsTheSmoothStep) {
    const std::vector<Key<double>> keys = {{10, 2}, {20, 6}};
    for (double t = 0; t <= 1; t += 0.125)
        EXPECT_NEAR(valueAt(keys, Easing::smooth, 10 + 10 * t), 2 + 4 * t * t * (3 - 2 * t), 1e-12) << t;
}

TEST(Keyframes, smoothNeverLeavesTheKeysAround) {
    for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
        const double low = std::min(steps[i].value, steps[i + 1].value);
        const double high = std::max(steps[i].value, steps[i + 1].value);
        for (double t = 0; t <= 1; t += 1.0 / 64) {
            const double frame = steps[i].frame + t * (steps[i + 1].frame - steps[i].frame);
            const double value = valueAt(steps, Easing::smooth, frame);
            EXPECT_GE(value, low - 1e-12) << frame;
            EXPECT_LE(value, high + 1e-12) << frame;
        }
    }
    EXPECT_EQ(valueAt(steps, Easing::smooth, 12.3), 4) << "equal keys hold";
}

// Smooth interpolation has the same slope on both sides of a key: the difference quotients for a step h agree within
// their error O(h).
TEST(Keyframes, smoothHasNoKinks) {
    const double h = 1e-5;
    for (std::size_t i = 1; i + 1 < steps.size(); ++i) {
        const double at = steps[i].frame;
        const double before = (valueAt(steps, Easing::smooth, at) - valueAt(steps, Easing::smooth, at - h)) / h;
        const double after = (valueAt(steps, Easing::smooth, at + h) - valueAt(steps, Easing::smooth, at)) / h;
        EXPECT_NEAR(before, after, 1e-3) << at;
    }
}

TEST(Keyframes, pointsMoveComponentByComponent) {
    const std::vector<Key<glm::dvec3>> keys = {{0, {0, 1, 2}}, {10, {10, 1, -2}}};
    EXPECT_EQ(valueAt(keys, Easing::linear, 5), glm::dvec3(5, 1, 0));
}

}  // namespace
}  // namespace defocus::engine
