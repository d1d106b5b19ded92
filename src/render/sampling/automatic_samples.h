#pragma once
// Chooses the number of lens samples automatically. A first number is predicted from the plan; the estimated error of
// the image then decides whether more samples are drawn (frame_run.h).

#include <cstdint>

#include "defocus/settings.h"
#include "plan/frame_plan.h"

namespace defocus::engine {

inline constexpr std::uint32_t maxAutomaticSamples = 1024;

// Returns the target error of the quality setting: the FLIP between the image and the converged image.
double flipOf(Quality quality);

// Returns the number of samples to begin with: a power of two from 16 (draft, good) or 32 (fine) to 64, or complete
// blocks of 64 up to 1,024. N points in a disk of c px, the largest blur diameter, are about c·√(π/(4N)) px apart. N is
// chosen so that this distance is at most 8 (draft), 4.5 (good) or 3 px (fine). With shadow maps or motion, N is at
// least 64. Objects that extend to the near plane have unbounded blur and are ignored, as is blur above
// largestSampledBlur().
std::uint32_t firstSamples(const FramePlan& plan, Quality quality);
// Returns the number of samples to begin with for a scene without shadow maps or motion whose largest blur diameter is
// `blur` px.
std::uint32_t firstSamples(double blur, Quality quality);

// Returns whether `samples` / 4 lens samples at four subpixel positions each give the same quality as `samples` lens
// samples at one position, and save time. The quality is the same if the images of a blurred point in neighbouring lens
// samples are then at most 1.25 px apart, and if nothing else differs between samples: shadows, motion, wavelengths,
// refraction and stochastic transparency need the larger number of samples. Time is saved if a sample draws at least
// one triangle per ten pixels. Images above 4,096 px a side or 4 megapixels have one position, because with four
// positions, the images of the samples would take too much memory.
bool fourPositionsSuffice(const FramePlan& plan, double samples);

// Returns `settings` with the number of samples that gives about the quality of `samples` samples drawn at one subpixel
// position each. The number is a power of two up to 64, or a multiple of 64. If each sample is drawn at four positions,
// a quarter of the samples is enough. Four positions are set if `choosesPositions` is true and fourPositionsSuffice()
// returns true; an error estimate must then show whether the samples suffice. `plan` is a plan of the frame with any
// number of samples.
RenderSettings withSamples(RenderSettings settings, const FramePlan& plan, double samples, bool choosesPositions);

// Returns the number of samples of a frame whose error cannot be estimated before it is complete, such as a frame in
// tiles. The number is computed as in firstSamples(), with other limits for draft, good and fine: at least 16, 32 or 64
// samples, and at most 3.5, 2 or 1.4 px between the images of a blurred point in neighbouring samples.
std::uint32_t samplesForBlur(const FramePlan& plan, Quality quality);

// Returns the blur diameter in px at which the blur disk has maxAutomaticSamples times the area of the image. If the
// disk is wider, a blurred point falls inside the image in fewer than one of maxAutomaticSamples samples on average.
double largestSampledBlur(const FramePlan& plan);

// Returns whether the largest blur of an object is finite and exceeds largestSampledBlur(). More samples then barely
// improve the image, because few of them, if any, show a point with that much blur.
bool blursBeyondSamples(const FramePlan& plan);

// Returns the largest blur diameter in px of the plan's objects that do not extend to the near plane; 0 without such
// objects. Objects with blur above largestSampledBlur() are ignored, because even maxAutomaticSamples lens samples do
// not resolve it.
double largestBoundedBlur(const FramePlan& plan);

}  // namespace defocus::engine
