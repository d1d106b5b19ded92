#pragma once
// A focus puller's hand: the focus goes from one distance to another within a moment, slowly at both ends. Even steps
// in dioptres (1/m) look even, as the circle of confusion is linear in them.

namespace defocus {

struct FocusPull {
    double from = 1;  // m, > 0; infinity is allowed
    double to = 1;
    double begin = 0;       // s, of any clock
    double duration = 0.4;  // s

    [[nodiscard]] bool over(double now) const { return now >= begin + duration; }
    // m; exactly `to` once it is over.
    [[nodiscard]] double distanceAt(double now) const;
};

// 0 … 1 with no slope at either end: 3t² − 2t³, t clamped.
double eased(double t);

// The focus distance `notches` of a mouse wheel farther (> 0) or nearer, each a fixed step of 1/distance relative to
// the distance at hand.
double rackedFocus(double focusDistance, double notches);

}  // namespace defocus
