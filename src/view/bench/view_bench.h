#pragma once
// Measures the picture of the window without a display: a camera moves along a fixed path, then rests.

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
    std::uint32_t frames = 60;             // frames of the movement, ≥ 4: an orbit of 1° per frame
    double restSeconds = 10;               // max time to measure after the movement, s
    double convergedError = 0.005;         // estimated error at which the picture at rest counts as converged
    std::uint32_t referenceSamples = 512;  // lens samples of a reference at full detail, 2 … maxSamples
    std::filesystem::path shaderFolder;    // replacement shaders; empty: the embedded shaders
    bool software = false;                 // OpenGL runs on the CPU
};

struct ViewBenchRow {
    std::string method;          // method in the format of MethodUse::text
    double framesPerSecond = 0;  // mean frame rate over the movement
    double slowFrame = 0;        // 95th percentile of the frame times, ms
    double firstPicture = 0;     // time from the first change of the camera to its finished frame, ms
    FrameQuality quality;        // quality of the last frame of the movement
    double movingPsnr = 0;       // PSNR in dB, from the mean squared error of three frames of the movement
    double stillPicture = 0;     // time from the end of the movement to the first accumulated picture, s
    double converged = 0;        // time from the end of the movement to the converged picture, s; infinity: not reached
    std::uint32_t samples = 0;   // lens samples of the picture at the end
    double stillPsnr = 0;        // PSNR of the picture at the end, dB
};

// Opens the scene of `state.options` and waits for its pyramids. Throws Error if it can't be opened.
void openForBench(Document& document, ViewState& state);

// Measures the methods on the document's scene at ViewState::pictureSize. Errors are measured on the picture as the
// window shows it: frames at a lower resolution are enlarged. Needs a current GL context. Throws Error for a method
// that doesn't support the scene or the settings.
void measureView(Document& document, ViewState& state, const ViewBenchOptions& options,
                 const std::function<void(const ViewBenchRow&)>& take, const Progress& progress = {});

}  // namespace defocus::engine
