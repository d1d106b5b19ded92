#pragma once
// Renders the image of a request, in one call or in steps.
//
// The library renders in its own windowless OpenGL 4.5 context (EGL). Without a GPU, Mesa's llvmpipe renders on the
// CPU. If the caller has a current EGL context, every call restores it before it returns. A renderer must be used by
// only one thread at a time; different renderers may be used concurrently.

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
    std::uint32_t samples = 0;                // lens samples drawn
    std::uint32_t positions = 1;              // number of subpixel positions per lens sample: 1 or 4
    double loadMilliseconds = 0;              // time to read the scene and to pose it
    double pyramidMilliseconds = 0;           // time to build pyramids, or to read them from the cache
    double setupMilliseconds = 0;             // time for uploads and shader compilation
    double renderMilliseconds = 0;            // time to draw all samples
    std::uint64_t trianglesDrawn = 0;         // triangles drawn, summed over all samples
    std::uint64_t trianglesAtFullDetail = 0;  // value of trianglesDrawn if all objects were drawn at full detail
    std::uint64_t gpuBytes = 0;               // peak size of the renderer's GPU resources
    std::string device;
    StopReason stopped = StopReason::sampleCount;  // why no further samples were drawn
    std::optional<double> estimatedError;          // RMSE of the display-encoded image; nullopt: not estimated
};

// Arbitrary output variables: per-pixel data of the nearest surface at the pixel's centre in a pinhole view. Each image
// has one channel.
struct Aovs {
    Image depth;  // depth in m along the view axis; +∞ for pixels without a surface
    Image coc;    // signed diameter of the circle of confusion in px, > 0 behind the focus plane
    Image level;  // fractional level of detail of the pixel's object; −1 for pixels without a surface
};

// Renders frames of one scene, which is read and simplified only once.
class DEFOCUS_API SceneRenderer {
public:
    // The first constructor reads the scene of the request. The second uses `scene` and ignores Request::scene,
    // fishCount and trianglesPerFish. Both throw Error if a file cannot be read, a name is unknown, a value is invalid,
    // or OpenGL 4.5 is not available. Exceptions from `progress` propagate.
    explicit SceneRenderer(const Request& request, const Progress& progress = {});
    SceneRenderer(const Scene& scene, const Request& request, const Progress& progress = {});
    ~SceneRenderer();
    SceneRenderer(SceneRenderer&&) noexcept;
    SceneRenderer& operator=(SceneRenderer&&) noexcept;

    // Starts a frame for the constructor's request, or for a given request with the same scene. All other settings may
    // differ, such as the camera, lens, time, number of samples, levels of detail and method. Throws Error in the same
    // cases as the constructor, and if the request has another scene.
    void start();
    void start(const Request& request);
    // Draws further samples. Returns false once the frame is complete. A frame that exceeds Request::memory is drawn in
    // tiles from top to bottom, with a bit-identical result; start() throws Error if tiles are not possible.
    bool advance();
    // Return the number of lens samples in the image so far, and in the complete frame. With tiles, samples() is the
    // mean over the image's rows, rounded down.
    [[nodiscard]] std::uint32_t samples() const;
    [[nodiscard]] std::uint32_t sampleTotal() const;
    // Returns the mean of the samples so far as linear, premultiplied RGBA. Incomplete tiles are transparent black.
    // Throws Error if there is no sample yet.
    [[nodiscard]] Image image();
    [[nodiscard]] RenderStatistics statistics() const;

    // Render a complete frame: call start(), call advance() until the frame is complete or `stop` is requested, and
    // return image().
    Image render(const Progress& progress = {}, std::stop_token stop = {});
    Image render(const Request& request, const Progress& progress = {}, std::stop_token stop = {});

    // Returns the AOVs of the latest frame. Throws Error if the frame is drawn in tiles.
    [[nodiscard]] Aovs aovs();
    // Returns the plan of the latest frame: blur, levels and samples of each object, and all omitted parts of the
    // scene.
    [[nodiscard]] Plan plan() const;
    // Writes an image with the metadata of the latest frame. PNG and JPEG files use the request's tone mapping and
    // exposure. Metered exposure is measured in the first written image and applied to all later images.
    void write(const std::filesystem::path& path, const ImageView& image) const;
    // Returns warnings about the scene file, the request and the latest frame, one line each: for example, damaged or
    // unsupported parts of the file, unused settings, a lens without blur, too few samples, or a mostly white or black
    // PNG or JPEG image.
    [[nodiscard]] std::vector<std::string> warnings() const;
    [[nodiscard]] Scene scene() const;

private:
    class DEFOCUS_HIDDEN State;
    std::unique_ptr<State> state_;
};

// Returns the image of a request. Throws Error in the same cases as SceneRenderer's constructor and start().
DEFOCUS_API Image render(const Request& request, const Progress& progress = {});

// Sets one setting of a request from text, for bindings and files. `name` is a name in docs/settings.md, such as
// "fStop" or "blurThreshold"; `text` has the command line's syntax. Throws UsageError for an unknown name or an invalid
// value.
DEFOCUS_API void setSetting(Request& request, const std::string& name, const std::string& text);

}  // namespace defocus
