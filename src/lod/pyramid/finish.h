#pragma once
// What the surfaces of a scene's meshes look like, for the pictures that levels are judged by (picture.h): glTF's
// metallic-roughness materials without normal and occlusion maps and without transparency, which the pictures leave
// out of full detail and of levels alike.

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

namespace defocus {

// An image no larger than such a picture can show.
struct FinishImage {
    static constexpr int mostSide = 256;  // texels

    int width = 0;
    int height = 0;
    bool srgb = false;
    std::vector<glm::u8vec3> texels;  // encoded as the file's, row by row from the top
};

struct FinishMap {
    std::shared_ptr<const FinishImage> image;  // null: none
    Wrap wrapS = Wrap::repeat;
    Wrap wrapT = Wrap::repeat;
    int uvSet = 0;
    glm::mat3 uvTransform{1.0f};
    // By the texture coordinates of both sets, linear Rec.709 and linear between texels; 1 where there is no image.
    [[nodiscard]] glm::vec3 at(const glm::vec2& uv0, const glm::vec2& uv1) const;
};

// Without a scene everything is white and matt, with the colours of the vertices alone.
struct Finish {
    bool unlit = false;
    glm::vec3 baseColor{1.0f};
    float metallic = 0;
    float roughness = 1;
    float reflectance = 0;  // at normal incidence, of what isn't metal
    glm::vec3 emission{0.0f};
    FinishMap baseColorMap = {};
    FinishMap metallicRoughnessMap = {};  // y roughness, z metallic
    FinishMap emissionMap = {};
};

// The finishes of a scene, which must outlive it. Images are reduced when they are asked for, and kept as long as a
// finish has them; several threads may ask at once.
class Finishes {
public:
    explicit Finishes(const Scene& scene);
    // Of a primitive's material; −1: glTF's default.
    [[nodiscard]] Finish of(int material) const;
    // Of all that the look of the mesh depends on beside the mesh itself.
    [[nodiscard]] std::uint64_t hash(const Mesh& mesh) const;

private:
    [[nodiscard]] FinishMap mapOf(const TextureUse& use, bool srgb) const;

    const Scene& scene_;
    std::vector<std::uint64_t> imageHashes_;  // of those that materials use; else 0
    mutable std::mutex mutex_;
    mutable std::map<std::pair<int, bool>, std::weak_ptr<const FinishImage>> images_;  // by image, sRGB or not
};

}  // namespace defocus
