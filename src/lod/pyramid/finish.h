#pragma once
// Holds what the surfaces of a scene's meshes look like, for the pictures that levels are judged by (picture.h). These
// are glTF's metallic-roughness materials. The pictures leave out normal maps, occlusion maps, transparency, coats and
// sheen, of full detail and of levels alike.

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

// A texture, reduced to a size that such a picture can show.
struct FinishImage {
    static constexpr int maxSide = 256;  // texels

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
    // Returns the map's linear value at texture coordinates, of which both sets are given. It is interpolated between
    // texels, and 1 if there is no image.
    [[nodiscard]] glm::vec3 at(const glm::vec2& uv0, const glm::vec2& uv1) const;
};

// What one material looks like. The defaults are what meshes without a scene get: white and matt, coloured by their
// vertices alone.
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

// The finishes of a scene, which must outlive this object. An image is reduced when a finish first needs it, and kept
// as long as a finish holds it. Several threads may ask at once.
class Finishes {
public:
    explicit Finishes(const Scene& scene);
    // Returns the finish of a primitive's material; −1 is glTF's default material.
    [[nodiscard]] Finish of(int material) const;
    // Returns a hash of the materials and textures that the mesh uses, as far as finishes hold them.
    [[nodiscard]] std::uint64_t hash(const Mesh& mesh) const;

private:
    [[nodiscard]] FinishMap mapOf(const TextureUse& use, bool srgb) const;

    const Scene& scene_;
    std::vector<std::uint64_t> imageHashes_;  // 0 for images that no finish uses
    mutable std::mutex mutex_;
    mutable std::map<std::pair<int, bool>, std::weak_ptr<const FinishImage>> images_;  // by image, sRGB or not
};

}  // namespace defocus::engine
