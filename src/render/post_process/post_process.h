#pragma once
// Common renderer of the post-process methods, which blur pinhole images. Several pinholes spread over the pixel are
// blurred one by one and averaged for antialiasing (setting "pinholes").

#include <memory>

#include "gl/target.h"
#include "render/gpu_scene/frame_uniforms.h"
#include "render/methods.h"
#include "render/post_process/pinhole_image.h"

namespace defocus::engine {

// Blurs a pinhole image by its depth.
class PostProcess {
public:
    virtual ~PostProcess() = default;
    // Prepares resources for the images of this plan. Called for each frame, before draw.
    virtual void start(const FramePlan& plan, const FrameUniforms& frame) = 0;
    // Draws the blurred image of `pinhole` into `output`: linear radiance, alpha 1. The result must be linear in the
    // radiance, so that the same blur applies to coverage. Only PinholeImage::part must be drawn.
    virtual void draw(const PinholeImage& pinhole, const FrameUniforms& frame, const Target& output) = 0;
    // Returns false if the blur may exceed that of the plan's lens.
    [[nodiscard]] virtual bool blursAsTheLens() const { return true; }
    [[nodiscard]] virtual std::size_t bytes() const = 0;
};

// Settings that all these methods share.
MethodSetting pinholesSetting();
MethodSetting transparencyBucketsSetting(const char* standard);

// `options.settings` must be complete. With a transparent background each pinhole is blurred twice: its premultiplied
// radiance, and its coverage. The same holds for each bucket of alpha-blended surfaces (transparency_buckets.h).
std::unique_ptr<Renderer> makePostProcessRenderer(const World& world, const RendererOptions& options,
                                                  std::unique_ptr<PostProcess> process);

}  // namespace defocus::engine
