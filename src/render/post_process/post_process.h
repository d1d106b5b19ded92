#pragma once
// Renderer of the post-process methods, which blur pinhole images. For antialiasing, several pinhole images with
// different subpixel offsets are blurred separately and averaged (setting "pinholes").

#include <memory>

#include "gl/target.h"
#include "render/gpu_scene/frame_uniforms.h"
#include "render/methods.h"
#include "render/post_process/pinhole_image.h"

namespace defocus::engine {

// Interface for methods that blur a pinhole image by depth.
class PostProcess {
public:
    virtual ~PostProcess() = default;
    // Prepares the blur for a frame; called before the frame's first draw().
    virtual void start(const FramePlan& plan, const FrameUniforms& frame) = 0;
    // Blurs `pinhole` and draws the result into `output`: linear radiance, alpha 1. The blur must be a linear function
    // of the radiance, because it is also applied to coverage. Pixels outside PinholeImage::part may be omitted.
    virtual void draw(const PinholeImage& pinhole, const FrameUniforms& frame, const Target& output) = 0;
    // Returns whether this method's blur never exceeds the blur of the plan's lens.
    [[nodiscard]] virtual bool blursAsTheLens() const { return true; }
    // Returns the number of samples per pixel of the pinhole image that is passed to draw(). Above 1, the image is
    // multisampled.
    [[nodiscard]] virtual int samplesPerPixel() const { return 1; }
    [[nodiscard]] virtual std::size_t bytes() const = 0;
};

// Each of these functions returns a setting that several post-process methods share.
MethodSetting pinholesSetting();
MethodSetting transparencyBucketsSetting(const char* defaultValue);
MethodSetting maxCocSetting(const char* defaultValue);

// Returns a renderer that blurs with `process`. `options.settings` must be complete. With a transparent background,
// each pinhole image is blurred twice: its premultiplied radiance and its coverage. Each bucket of alpha-blended
// surfaces (transparency_buckets.h) is also blurred twice.
std::unique_ptr<Renderer> makePostProcessRenderer(const World& world, const RendererOptions& options,
                                                  std::unique_ptr<PostProcess> process);

}  // namespace defocus::engine
