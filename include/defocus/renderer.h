#pragma once
// Renders the image of a request, in one call or step by step.
//
// The library renders in its own windowless OpenGL 4.5 context (EGL). Without a GPU, Mesa's llvmpipe renders on the
// CPU. If the caller has a current EGL context, it is current again when a call returns. Each object must be used by
// one thread at a time; different objects may be used concurrently.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "defocus/export.h"
#include "defocus/image.h"
#include "defocus/plan.h"
#include "defocus/progress.h"
#include "defocus/request.h"
#include "defocus/scene.h"

namespace defocus {

// Cost of a frame. Times are wall-clock milliseconds.
struct RenderStatistics {
    std::uint32_t samples = 0;                // number of lens samples drawn
    double loadMilliseconds = 0;              // reading and placing the scene
    double pyramidMilliseconds = 0;           // simplified meshes, built or read from the cache
    double setupMilliseconds = 0;             // uploads and shader compilation
    double renderMilliseconds = 0;            // the frame, from start() to its last sample
    std::uint64_t trianglesDrawn = 0;         // sum over all samples
    std::uint64_t trianglesAtFullDetail = 0;  // the same sum without level of detail
    std::uint64_t gpuBytes = 0;               // peak size of the renderer's GPU resources
    std::string device;
    StopReason stopped = StopReason::sampleCount;  // why no more samples were drawn
    std::optional<double> estimatedError;          // RMSE of the display-encoded image; none: not estimated
};

// Auxiliary images of the nearest surface at each pixel, seen through a pinhole at the pixel's centre. One channel
// each.
struct Aovs {
    Image depth;  // m along the view axis; infinity if the pixel is empty
    Image coc;    // signed diameter of the circle of confusion, px, > 0 behind the focus plane
    Image level;  // fractional level of detail of the object; −1 if the pixel is empty
};

// Renders frames of one scene. The scene and its simplified meshes are prepared only once.
class DEFOCUS_API SceneRenderer {
public:
    // Opens the scene that the request names, or takes a scene that is already open. With an open scene,
    // Request::scene, fishCount and trianglesPerFish are ignored. Throws Error if a file, name or value is unusable, or
    // if OpenGL 4.5 is not available. Exceptions from `progress` propagate.
    explicit SceneRenderer(const Request& request, const Progress& progress = {});
    SceneRenderer(const Scene& scene, const Request& request, const Progress& progress = {});
    ~SceneRenderer();
    SceneRenderer(SceneRenderer&&) noexcept;
    SceneRenderer& operator=(SceneRenderer&&) noexcept;

    // Begins a frame of the constructor's request, or of another request for the same scene. The other request may
    // differ in camera, lens, time, samples, levels and method. Throws Error like the constructor, and if the request
    // names another scene.
    void start();
    void start(const Request& request);
    // Draws some more samples; returns false when the frame is complete. A frame that exceeds Request::memory is drawn
    // in tiles from top to bottom, with bit-identical results. Each tile receives all its samples in turn. start()
    // throws Error if tiles are not possible.
    bool advance();
    // Return the number of samples in the image so far, and in the complete frame. With tiles, the first is the mean
    // over the image's rows, rounded down.
    [[nodiscard]] std::uint32_t samples() const;
    [[nodiscard]] std::uint32_t sampleTotal() const;
    // Returns the linear RGBA image of the samples so far. Throws Error before the first sample. Unfinished tiles are
    // transparent black.
    [[nodiscard]] Image image();
    [[nodiscard]] RenderStatistics statistics() const;

    // Renders a complete frame: start(), advance() until the frame is complete or `stop` is requested, then image().
    Image render(const Progress& progress = {}, std::stop_token stop = {});
    Image render(const Request& request, const Progress& progress = {}, std::stop_token stop = {});

    // Returns the auxiliary images of the latest frame. Throws Error if the frame is drawn in tiles.
    [[nodiscard]] Aovs aovs();
    // Returns the plan of the latest frame: blur, level and samples of each object, and everything that is left out.
    [[nodiscard]] Plan plan() const;
    // Writes an image of this frame with its metadata. PNG and JPEG use the request's tone mapping and exposure.
    // Metered exposure is measured on the first image written and kept for later ones.
    void write(const std::filesystem::path& path, const ImageView& image) const;
    // Returns warnings about the file, the request and the latest frame, one line each. Examples: damaged or
    // unsupported parts of the file, unused settings, a lens without blur, or too few samples. A mostly white or black
    // PNG or JPEG also causes a warning.
    [[nodiscard]] std::vector<std::string> warnings() const;
    [[nodiscard]] Scene scene() const;

private:
    class DEFOCUS_HIDDEN State;
    std::unique_ptr<State> state_;
};

// Returns the image of a request. SceneRenderer does the same step by step.
DEFOCUS_API Image render(const Request& request, const Progress& progress = {});

// Sets one setting of a request from text, for bindings and files. `name` is a name in docs/settings.md, such as
// "fStop" or "blurThreshold"; `text` has the command line's syntax. Throws UsageError naming the setting.
DEFOCUS_API void setSetting(Request& request, const std::string& name, const std::string& text);

}  // namespace defocus
