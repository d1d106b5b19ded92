#include "image/time_code.h"

#include <cmath>

namespace defocus::engine {

namespace {

std::uint32_t packed(int value, int shift) {
    return static_cast<std::uint32_t>(value / 10 << 4 | value % 10) << shift;
}

int unpacked(std::uint32_t bits, int shift, std::uint32_t tensMask) {
    return static_cast<int>((bits >> (shift + 4) & tensMask) * 10 + (bits >> shift & 15));
}

}  // namespace

std::uint32_t timeCodeBits(const TimeCode& code) {
    return packed(code.frame, 0) | packed(code.seconds, 8) | packed(code.minutes, 16) | packed(code.hours, 24);
}

TimeCode timeCodeOf(std::uint32_t bits) {
    return {unpacked(bits, 24, 3), unpacked(bits, 16, 7), unpacked(bits, 8, 7), unpacked(bits, 0, 3)};
}

std::optional<TimeCode> timeCodeOfFrame(int frame, double frameRate) {
    const int rate = static_cast<int>(std::lround(std::min(frameRate, 1e6)));
    if (frame < 0 || rate < 1 || rate > 30) return {};
    const int seconds = frame / rate;
    if (seconds >= 24 * 3600) return {};
    return TimeCode{seconds / 3600, seconds / 60 % 60, seconds % 60, frame % rate};
}

Rational rationalFrameRate(double frameRate) {
    const double thousandths = frameRate * 1001;
    const double nominal = std::round(thousandths / 1000);
    if (nominal > 0 && frameRate != std::round(frameRate) && std::abs(frameRate - nominal * 1000 / 1001) < 1e-3)
        return {static_cast<int>(nominal) * 1000, 1001};
    int denominator = 1;
    while (denominator < 1000 && frameRate * denominator != std::round(frameRate * denominator)) denominator *= 10;
    return {static_cast<int>(std::lround(frameRate * denominator)), denominator};
}

}  // namespace defocus::engine
