#pragma once
// Measures the window's frame rate, latency and image error, without a display. The camera moves along a fixed path and
// then rests.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "frame/setup/prepared_frame.h"
#include "render/methods.h"
#include "view/document/document.h"
#include "view/state/frame_budget.h"

namespace defocus::engine {

struct ViewBenchOptions {
    std::vector<MethodUse> methods;        // methods to measure, one after another
    std::uint32_t frames = 60;             // number of frames of the movement, an orbit of 1° per frame; ≥ 4
    double restSeconds = 10;               // max time to measure after the movement, s
    double convergedError = 0.005;         // estimated error at which the accumulated image counts as converged
    std::uint32_t referenceSamples = 512;  // lens samples of a reference image, which has full detail; 2 … maxSamples
    std::filesystem::path shaderFolder;    // replacement shaders; empty: the embedded shaders
    bool software = false;                 // true: OpenGL runs on the CPU
};

struct ViewBenchRow {
    std::string method;          // method and its settings, in the format of MethodUse::text
    double framesPerSecond = 0;  // mean frame rate while the camera moves
    double slowFrame = 0;        // 95th percentile of the frame times while the camera moves, ms
    double firstPicture = 0;     // time from the first camera change to the end of the frame that shows it, ms
    FrameQuality quality;        // resolution and lens samples of the last frame of the movement
    double movingPsnr = 0;       // PSNR in dB, from the mean squared error of three frames during the movement
    double stillPicture = 0;     // time from the end of the movement to the first accumulated image, s
    double converged = 0;        // time from the end of the movement to the converged image, s; infinity: not reached
    std::uint32_t samples = 0;   // lens samples of the final image
    double stillPsnr = 0;        // PSNR of the final image, dB
};

// Opens the scene of `state.options` and waits for its level-of-detail pyramids. Throws Error if it can't be opened.
void openForBench(Document& document, ViewState& state);

// Measures the methods on the document's scene at ViewState::pictureSize. Errors are measured on the image at the
// window's size: frames of lower resolution are enlarged first. Needs a current GL context. Throws Error for a method
// that doesn't support the scene or the settings.
void measureView(Document& document, ViewState& state, const ViewBenchOptions& options,
                 const std::function<void(const ViewBenchRow&)>& take, const Progress& progress = {});

}  // namespace defocus::engine
