#pragma once
// What post-process methods start from: the scene through the middle of the lens, its sky included, with the depth of
// each pixel.

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

// The objects of `plan`, each at the whole level nearest to its λ, for `count` samples in the middle of the lens. They
// are spread over the pixel by Hammersley's points; one alone lies in its middle. The plan's lens (its CoC) is kept.
// What moves is drawn as it is in the middle of the exposure. A pinhole has 16 points on each light.
FramePlan pinholePlan(const World& world, const FramePlan& plan, std::uint32_t count);

class PinholePass {
public:
    // `format` holds alpha (rgba16f, rgba32f). `ownBlur`: what the surfaces make of the blur is kept too. Needs a
    // current GL context.
    PinholePass(GpuScene& scene, int width, int height, LayerFormat format, bool ownBlur,
                const std::filesystem::path& shaderFolder);

    // `frame` was uploaded for `pinholes` with one layer, and must outlive the drawing. `buckets` are drawn
    // apart, each by drawBucket.
    void prepare(const FramePlan& pinholes, const FrameUniforms& frame, const std::vector<TransparencyBucket>& buckets);
    // Draws sample `index`. Alpha-blended surfaces that are in no bucket leave their depth too, in a pass of its own:
    // what lies behind them is blurred as they are (Scheuermann 2004).
    void draw(std::uint32_t index);
    // Of the sample drawn last: linear radiance with coverage as alpha (1 but over a transparent background), and
    // depth.
    [[nodiscard]] PinholeImage& image() { return image_; }

    [[nodiscard]] std::size_t buckets() const { return buckets_.size(); }
    // The image of a bucket of the sample drawn last, the farthest first: what image() doesn't hide of it, over
    // nothing.
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
    bool transparent_ = false;  // the background
    ShadowMaps shadows_;
    SurfacePass surfaces_;
    std::vector<ObjectSet> buckets_;
    std::vector<TexelRectangle> reaches_;  // of the buckets
    ObjectSet inNoBucket_;
    std::optional<BucketPass> bucketPass_;
};

}  // namespace defocus::engine
