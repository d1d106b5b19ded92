#pragma once
// Renders by blurring pinhole images: the frame around the post-process methods. Several pinholes spread over the pixel
// are blurred one by one and averaged, which antialiases; their number is the methods' setting "pinholes".

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
    // Makes what images of this plan need. Called before draw, and again for each frame.
    virtual void start(const FramePlan& plan, const FrameUniforms& frame) = 0;
    // Draws the blurred image of `pinhole` into `output`: linear radiance, alpha 1. Linear in the radiance, so that
    // coverage is blurred by the same. Only PinholeImage::part has to be drawn.
    virtual void draw(const PinholeImage& pinhole, const FrameUniforms& frame, const Target& output) = 0;
    // false: something may be blurred more widely than the plan's lens blurs it.
    [[nodiscard]] virtual bool blursAsTheLens() const { return true; }
    [[nodiscard]] virtual std::size_t bytes() const = 0;
};

// The settings that all these methods share.
MethodSetting pinholesSetting();
MethodSetting transparencyBucketsSetting(const char* standard);

// `options.settings` must be complete. Over a transparent background each pinhole is blurred twice: its premultiplied
// radiance, and its coverage. So is each bucket of alpha-blended surfaces (transparency_buckets.h).
std::unique_ptr<Renderer> makePostProcessRenderer(const World& world, const RendererOptions& options,
                                                  std::unique_ptr<PostProcess> process);

}  // namespace defocus::engine
