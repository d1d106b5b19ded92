#pragma once
// Creates finishes. A finish is a simplified material. The program renders the levels of a mesh with finishes and
// compares the images (picture.h) to measure the levels' errors. Finishes follow glTF's metallic-roughness model,
// without normal maps, occlusion maps, transparency, clear coat and sheen.

#include <cstddef>
#include <cstdint>
#include <glm/gtc/type_precision.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "scene/scene.h"

namespace defocus::engine {

// A texture, downsampled to the size that the images of picture.h need.
struct FinishImage {
    static constexpr int maxSide = 256;  // max width and height in texels

    int width = 0;
    int height = 0;
    bool srgb = false;
    std::vector<glm::u8vec3> texels;  // sRGB-encoded if `srgb` is set, else linear; row by row from the top
};

struct FinishMap {
    std::shared_ptr<const FinishImage> image;  // image that the map samples; null: none
    Wrap wrapS = Wrap::repeat;
    Wrap wrapT = Wrap::repeat;
    int uvSet = 0;
    glm::mat3 uvTransform{1.0f};
    // Returns the map's linear value, interpolated between texels. The member uvSet selects uv0 or uv1. Returns 1 if
    // the map has no image.
    [[nodiscard]] glm::vec3 at(const glm::vec2& uv0, const glm::vec2& uv1) const;
};

// Simplified material. By default, it is white and matt, tinted by vertex colours only; meshes without a scene use the
// default.
struct Finish {
    bool unlit = false;
    glm::vec3 baseColor{1.0f};
    float metallic = 0;
    float roughness = 1;
    float reflectance = 0;  // reflectance of non-metals at normal incidence
    glm::vec3 emission{0.0f};
    FinishMap baseColorMap = {};
    FinishMap metallicRoughnessMap = {};  // y (green): roughness, z (blue): metallic
    FinishMap emissionMap = {};
};

// Creates the finishes (simplified materials) of a scene, which must outlive this object. An image is downsampled when
// a finish first needs it, and kept as long as any finish uses it. Thread-safe.
class Finishes {
public:
    explicit Finishes(const Scene& scene);
    // Returns the finish of a material; −1 selects glTF's default material.
    [[nodiscard]] Finish of(int material) const;
    // Returns a hash of those properties of the mesh's materials and textures that a Finish holds.
    [[nodiscard]] std::uint64_t hash(const Mesh& mesh) const;

private:
    [[nodiscard]] FinishMap mapOf(const TextureUse& use, bool srgb) const;

    const Scene& scene_;
    std::vector<std::uint64_t> imageHashes_;  // one hash per image; 0 if no Finish uses the image
    mutable std::mutex mutex_;
    mutable std::map<std::pair<int, bool>, std::weak_ptr<const FinishImage>> images_;  // keyed by image and sRGB flag
};

}  // namespace defocus::engine
