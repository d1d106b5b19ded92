#pragma once
// Computes the time codes and frame rates that EXR files of video frames store. Source: SMPTE ST 12-1, non-drop-frame
// time address of 60-field television.

#include <cstdint>
#include <optional>

#include "image/image_io.h"

namespace defocus::engine {

// Packs a time code into 32 bits: four bits for each decimal digit.
std::uint32_t timeCodeBits(const TimeCode& code);
TimeCode timeCodeOf(std::uint32_t bits);

// Returns the time code of a frame; nullopt for negative frames, after 24 hours, and above 30 frames per second, which
// time codes cannot express.
std::optional<TimeCode> timeCodeOfFrame(int frame, double frameRate);

// Returns the frame rate as a fraction. Television frame rates, such as 23.976, have the denominator 1001.
Rational rationalFrameRate(double frameRate);

}  // namespace defocus::engine
