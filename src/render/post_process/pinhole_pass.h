#pragma once
// Draws the input of the post-process methods: the scene with its sky through the lens centre, and the depth of each
// pixel.

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

// Returns a plan for `count` samples at the lens centre, with each object at the integer level nearest to its λ. The
// samples are Hammersley points over the pixel; a single one is at its centre. The plan keeps its lens, and so its CoC.
// Moving objects are drawn as in the middle of the exposure. Each pinhole uses 16 points per light.
FramePlan pinholePlan(const World& world, const FramePlan& plan, std::uint32_t count);

class PinholePass {
public:
    // `format` must hold alpha (rgba16f, rgba32f). `ownBlur`: also stores the blur controls of surfaces. Needs a
    // current GL context.
    PinholePass(GpuScene& scene, int width, int height, LayerFormat format, bool ownBlur,
                const std::filesystem::path& shaderFolder);

    // `frame` must have been uploaded for `pinholes` with one layer, and must outlive the drawing. Objects in `buckets`
    // are left to drawBucket.
    void prepare(const FramePlan& pinholes, const FrameUniforms& frame, const std::vector<TransparencyBucket>& buckets);
    // Draws sample `index`. Alpha-blended surfaces outside buckets write their depth in a second pass. The background
    // seen through them is then blurred like them (Scheuermann 2004).
    void draw(std::uint32_t index);
    // Image of the sample drawn last: linear radiance with coverage as alpha (1 for an opaque background), and depth.
    [[nodiscard]] PinholeImage& image() { return image_; }

    [[nodiscard]] std::size_t buckets() const { return buckets_.size(); }
    // Draws a bucket of the sample drawn last, without the parts that image() hides, on a transparent background.
    // Bucket 0 is the farthest.
    [[nodiscard]] PinholeImage& drawBucket(std::uint32_t index, std::size_t bucket);

    [[nodiscard]] bool hasOwnBlur() const { return static_cast<bool>(image_.ownBlur); }
    [[nodiscard]] std::size_t bytes() const {
        return image_.bytes() + shadows_.bytes() + surfaces_.bytes() + (bucketPass_ ? bucketPass_->bytes() : 0);
    }

private:
    LayerFormat format_;
    std::filesystem::path shaderFolder_;
    PinholeImage image_;
    Target target_;
    bool transparent_ = false;  // whether the background is transparent
    ShadowMaps shadows_;
    SurfacePass surfaces_;
    std::vector<ObjectSet> buckets_;
    std::vector<TexelRectangle> reaches_;  // one per bucket, see reachOf
    ObjectSet inNoBucket_;
    std::optional<BucketPass> bucketPass_;
};

}  // namespace defocus::engine
