#pragma once
// Draws the input of the post-process methods: colour, including the sky, and depth of the scene as seen from the lens
// centre.

#include <optional>
#include <vector>

#include "gl/target.h"
#include "render/gpu_scene/shadow_maps.h"
#include "render/gpu_scene/surface_pass.h"
#include "render/layer_format.h"
#include "render/post_process/bucket_pass.h"
#include "render/post_process/pinhole_image.h"
#include "render/post_process/transparency_buckets.h"

namespace defocus::engine {

// Returns a plan for `count` samples at the lens centre, with each object at the integer level nearest to its
// fractional level λ. The samples' positions in the pixel are Hammersley points; a single sample is at the pixel's
// centre. The plan's lens and circle of confusion do not change. Moving objects are drawn at the middle of the
// exposure. Soft shadows use 16 points per light in each sample.
FramePlan pinholePlan(const World& world, const FramePlan& plan, std::uint32_t count);

class PinholePass {
public:
    // `format` must have alpha (rgba16f, rgba32f). If `ownBlur`, the blur modifiers of surfaces are also stored. With
    // `samples` > 1 per pixel, the image is multisampled. Needs a current OpenGL context.
    PinholePass(GpuScene& scene, int width, int height, LayerFormat format, bool ownBlur, int samples,
                const std::filesystem::path& shaderFolder);

    // Prepares the pass for the plan `pinholes`, made by pinholePlan(). `frame` must hold the uniforms of this plan,
    // uploaded for a single layer (layerCount 1), and must exist until the last draw. Objects in `buckets` are drawn
    // only by drawBucket().
    void prepare(const FramePlan& pinholes, const FrameUniforms& frame, const std::vector<TransparencyBucket>& buckets);
    // Draws sample `index`. Alpha-blended surfaces that are in no bucket (group of objects that is blurred separately)
    // write their depth in a second pass. The background visible through such a surface is thus blurred according to
    // the depth of the surface (Scheuermann 2004).
    void draw(std::uint32_t index);
    // Returns the image of the latest draw(): linear radiance with coverage as alpha (1 for an opaque background), and
    // depth. In a multisampled image, transmitting surfaces refract the opaque surfaces behind them, but not each
    // other.
    [[nodiscard]] PinholeImage& image() { return image_; }

    [[nodiscard]] std::size_t buckets() const { return buckets_.size(); }
    // Draws a bucket (blended objects of similar depth) on a transparent background, without the parts that are hidden
    // by surfaces in image(). `index` must be the sample of the latest draw(). Bucket 0 is the farthest.
    [[nodiscard]] PinholeImage& drawBucket(std::uint32_t index, std::size_t bucket);

    [[nodiscard]] bool hasOwnBlur() const { return static_cast<bool>(image_.ownBlur); }
    [[nodiscard]] std::size_t bytes() const {
        return image_.bytes() + multisampled_.bytes() + shadows_.bytes() + surfaces_.bytes() +
               (bucketPass_ ? bucketPass_->bytes() : 0);
    }

private:
    LayerFormat format_;
    std::filesystem::path shaderFolder_;
    PinholeImage image_;
    PinholeImage multisampled_;  // multisampled image; empty without multisampling
    // target_ is drawn into. With multisampling, its samples are then averaged into resolvedTarget_.
    Target target_, resolvedTarget_;
    bool transparent_ = false;
    ShadowMaps shadows_;
    SurfacePass surfaces_;
    std::vector<ObjectSet> buckets_;
    std::vector<TexelRectangle> reaches_;  // per bucket of objects: rectangle that contains the bucket's blurred image
    ObjectSet inNoBucket_;
    std::optional<BucketPass> bucketPass_;
};

}  // namespace defocus::engine
