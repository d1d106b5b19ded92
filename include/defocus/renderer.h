#pragma once
// From a request to an image, at once or step by step.
//
// Rendering uses an OpenGL 4.5 context of the library's own, without a window (EGL); Mesa's llvmpipe serves where there
// is no GPU. A context that the caller has current through EGL is current again when a call returns. An object is used
// by one thread at a time; several objects may be used by several threads.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "defocus/export.h"
#include "defocus/image.h"
#include "defocus/progress.h"
#include "defocus/request.h"
#include "defocus/scene.h"

namespace defocus {

// What a frame took. Times are wall clock, in milliseconds.
struct RenderStatistics {
    std::uint32_t samples = 0;                // lens samples drawn
    double loadMilliseconds = 0;              // the scene, read and placed
    double pyramidMilliseconds = 0;           // simplified meshes, built or read from the cache
    double setupMilliseconds = 0;             // uploads and shaders
    double renderMilliseconds = 0;            // the frame, from start() to its last sample
    std::uint64_t trianglesDrawn = 0;         // over all samples
    std::uint64_t trianglesAtFullDetail = 0;  // what full detail would have drawn
    std::uint64_t gpuBytes = 0;               // resources of the renderer at their peak
    std::string device;
    StopReason stopped = StopReason::sampleCount;  // why there are no more samples
    std::optional<double> estimatedError;          // with Request::stop: RMSE as StopSettings has it; none: one block
};

// What the nearest surface at each pixel is, through the pinhole at the pixel's centre: images of one channel.
struct Aovs {
    Image depth;  // m along the view axis; infinity where nothing is
    Image coc;    // signed diameter of the circle of confusion, px, > 0 behind the focus plane
    Image level;  // the object's fractional level of detail; −1 where nothing is
};

// Renders one scene, frame after frame. The scene and its simplified meshes are read and built once.
class DEFOCUS_API SceneRenderer {
public:
    // Opens what the request names, or takes a scene that is open already (Request::scene and the school's values then
    // mean nothing). Throws Error for files, names and values that can't be rendered, and where there is no OpenGL 4.5;
    // what `progress` throws passes through.
    explicit SceneRenderer(const Request& request, const Progress& progress = {});
    SceneRenderer(const Scene& scene, const Request& request, const Progress& progress = {});
    ~SceneRenderer();
    SceneRenderer(SceneRenderer&&) noexcept;
    SceneRenderer& operator=(SceneRenderer&&) noexcept;

    // Begins a frame: the constructor's request, or another one of the same scene: other camera, lens, moment, samples,
    // levels or method. Throws Error as the constructor does, and for another scene.
    void start();
    void start(const Request& request);
    // Draws some more samples; false once the frame is done. A frame that doesn't fit into memory in one piece
    // (Request::memory) is drawn in tiles from the top, each with all samples, to the same bits; start() throws Error
    // where it can't be.
    bool advance();
    // Samples in the image so far, and when the frame is done. With tiles, the mean over the image's rows, rounded
    // down.
    [[nodiscard]] std::uint32_t samples() const;
    [[nodiscard]] std::uint32_t sampleTotal() const;
    // The image of the samples so far, linear, 4 channels; with no sample yet it throws Error. Tiles that aren't
    // finished are black and of no coverage.
    [[nodiscard]] Image image();
    [[nodiscard]] RenderStatistics statistics() const;

    // start(), advance() to the end or until `stop` is asked for, image().
    Image render(const Progress& progress = {}, std::stop_token stop = {});
    Image render(const Request& request, const Progress& progress = {}, std::stop_token stop = {});

    // Of the frame that was started last; throws Error where it is drawn in tiles.
    [[nodiscard]] Aovs aovs();
    // The FramePlan of the frame that was started last as JSON, as `defocus plan --json` prints it: blur, level and
    // samples of each object, and what is left out and why.
    [[nodiscard]] std::string planJson() const;
    // Writes an image of this renderer's frame with its metadata, tone-mapped and exposed as the request says where the
    // file is a PNG or JPEG. A metered exposure is that of the first image that is written.
    void write(const std::filesystem::path& path, const ImageView& image) const;
    // What is worth knowing of the file, the request and the frame that was started, a line each: damage, what isn't
    // drawn, values that aren't used, a lens that blurs nothing, samples too few for the blur, and that most of the PNG
    // or JPEG that was written last is white or black.
    [[nodiscard]] std::vector<std::string> warnings() const;
    [[nodiscard]] Scene scene() const;

private:
    class DEFOCUS_HIDDEN State;
    std::unique_ptr<State> state_;
};

// The image of a request. SceneRenderer does the same in steps.
DEFOCUS_API Image render(const Request& request, const Progress& progress = {});

// The plan of a request as JSON, without rendering and without a GPU.
DEFOCUS_API std::string planJson(const Request& request, const Progress& progress = {});

// The levels of detail of each mesh of a request's scene as JSON: triangles, mean edge and error of each level, in the
// mesh's units.
DEFOCUS_API std::string pyramidJson(const Request& request, const Progress& progress = {});

// Sets a value of a request by its name in docs/settings.md ("fStop", "blurThreshold") from text as the command line
// has it. For bindings and files. Throws UsageError naming the setting.
DEFOCUS_API void setSetting(Request& request, const std::string& name, const std::string& text);

}  // namespace defocus
