#pragma once
// What `defocus render` is asked for.

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
    bool rate = false;
    bool work = false;
    bool sweptWork = false;
    [[nodiscard]] bool surfaces() const { return depth || coc || level || rate; }
    [[nodiscard]] bool any() const { return surfaces() || work || sweptWork; }
};

struct RenderArguments {
    Request request;
    std::vector<std::filesystem::path> outputs;
    std::filesystem::path stats;
    AovRequest aovs;
    std::optional<SampleRange> sampleRange;  // only these, for `merge`
    std::optional<TileShare> tile;           // only these rows, for `merge`
    bool resume = false;                     // keeps what an interrupted run has finished
};

// All options of the command. `arguments` must outlive the parse.
void addRenderOptions(CLI::App& command, RenderArguments& arguments);

}  // namespace defocus::engine
