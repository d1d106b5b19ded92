#pragma once
// Declares the arguments and options of `defocus render`.

#include <filesystem>
#include <optional>
#include <vector>

#include "cli/options/request_options.h"
#include "render/tiles/part_header.h"

namespace defocus::engine {

struct AovRequest {
    bool depth = false;
    bool coc = false;
    bool level = false;
    bool work = false;
    [[nodiscard]] bool surfaces() const { return depth || coc || level; }
    [[nodiscard]] bool any() const { return surfaces() || work; }
};

struct RenderArguments {
    Request request;
    std::vector<std::filesystem::path> outputs;
    std::filesystem::path stats;
    AovRequest aovs;
    std::optional<SampleRange> sampleRange;  // draw only these samples, for `merge`; nullopt: all
    std::optional<Share> tile;               // draw only these rows, for `merge`; nullopt: all
    bool resume = false;                     // true: keep finished parts of an interrupted run
    std::filesystem::path lensImages;        // write lens images (one per lens sample) to this file instead of outputs
    std::optional<FocusRange> focusRange;    // focus distances that the lens images must support
    bool keepPartial = false;                // true: if a signal stops the run, write the image of the samples so far
};

// Adds all options of the command. `arguments` must exist until the command line is parsed.
void addRenderOptions(CLI::App& command, RenderArguments& arguments);

}  // namespace defocus::engine
