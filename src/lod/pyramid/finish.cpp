#include "lod/pyramid/finish.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <span>

#include "core/hash.h"
#include "image/tone_map.h"

namespace defocus::engine {

namespace {

constexpr float dielectric = 0.04f;  // reflectance of non-metals at normal incidence, as defined by glTF

using Decoding = std::array<float, 256>;

// Returns a table that maps each byte value of a texel channel to its linear value.
const Decoding& decoding(bool srgb) {
    const auto made = [](const auto& decode) {
        Decoding values{};
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = decode(static_cast<float>(i) / 255);
        return values;
    };
    static const Decoding encoded = made([](float value) { return srgbDecode(value); });
    static const Decoding linear = made([](float value) { return value; });
    return srgb ? encoded : linear;
}

std::uint8_t byteOf(float value, bool srgb) {
    return static_cast<std::uint8_t>(std::lround(255 * (srgb ? srgbEncode(value) : value)));
}

// Downsamples an image by averaging blocks of texels; ignores alpha.
FinishImage reduced(const TextureImage& image, bool srgb) {
    const Decoding& values = decoding(srgb);
    FinishImage result;
    result.width = std::min(image.width, FinishImage::maxSide);
    result.height = std::min(image.height, FinishImage::maxSide);
    result.srgb = srgb;
    result.texels.reserve(static_cast<std::size_t>(result.width) * static_cast<std::size_t>(result.height));
    const auto piece = [](int i, int count, int size) {
        const auto begin = std::int64_t{i} * size / count;
        return std::pair(begin, std::max(std::int64_t{i + 1} * size / count, begin + 1));
    };
    for (int y = 0; y < result.height; ++y) {
        const auto [top, bottom] = piece(y, result.height, image.height);
        for (int x = 0; x < result.width; ++x) {
            const auto [left, right] = piece(x, result.width, image.width);
            glm::vec3 sum(0);
            for (std::int64_t row = top; row < bottom; ++row)
                for (std::int64_t column = left; column < right; ++column) {
                    const std::uint8_t* const texel =
                        &image.rgba[4 * static_cast<std::size_t>(row * image.width + column)];
                    sum += glm::vec3(values[texel[0]], values[texel[1]], values[texel[2]]);
                }
            const glm::vec3 mean = sum / static_cast<float>((bottom - top) * (right - left));
            result.texels.emplace_back(byteOf(mean.r, srgb), byteOf(mean.g, srgb), byteOf(mean.b, srgb));
        }
    }
    return result;
}

int wrapped(int texel, int size, Wrap wrap) {
    if (wrap == Wrap::clampToEdge) return std::clamp(texel, 0, size - 1);
    const int period = wrap == Wrap::mirroredRepeat ? 2 * size : size;
    const int within = (texel % period + period) % period;
    return within < size ? within : 2 * size - 1 - within;
}

std::uint64_t hashOf(const TextureImage& image) {
    const std::array<int, 2> size{image.width, image.height};
    return hashBytes(std::as_bytes(std::span(image.rgba)), hashBytes(std::as_bytes(std::span(size))));
}

}  // namespace

glm::vec3 FinishMap::at(const glm::vec2& uv0, const glm::vec2& uv1) const {
    constexpr float farthest = 1e6f;
    if (!image) return glm::vec3(1);
    const glm::vec2 uv(uvTransform * glm::vec3(uvSet == 0 ? uv0 : uv1, 1));
    if (!(std::abs(uv.x) < farthest && std::abs(uv.y) < farthest)) return glm::vec3(1);
    const glm::vec2 place = uv * glm::vec2(image->width, image->height) - 0.5f;
    const glm::vec2 corner = glm::floor(place);
    const glm::vec2 f = place - corner;
    const Decoding& values = decoding(image->srgb);
    const auto texel = [&](int dx, int dy) {
        const int x = wrapped(static_cast<int>(corner.x) + dx, image->width, wrapS);
        const int y = wrapped(static_cast<int>(corner.y) + dy, image->height, wrapT);
        const glm::u8vec3& t = image->texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(image->width) +
                                             static_cast<std::size_t>(x)];
        return glm::vec3(values[t.r], values[t.g], values[t.b]);
    };
    return glm::mix(glm::mix(texel(0, 0), texel(1, 0), f.x), glm::mix(texel(0, 1), texel(1, 1), f.x), f.y);
}

Finishes::Finishes(const Scene& scene) : scene_(scene), imageHashes_(scene.images.size(), 0) {
    for (const Material& material : scene.materials)
        for (const TextureUse* use : {&material.baseColor, &material.metallicRoughness, &material.emissive}) {
            const int image = use->used() ? scene.textures[static_cast<std::size_t>(use->texture)].image : -1;
            if (image < 0) continue;
            std::uint64_t& hash = imageHashes_[static_cast<std::size_t>(image)];
            if (hash == 0) hash = hashOf(scene.images[static_cast<std::size_t>(image)]);
        }
}

FinishMap Finishes::mapOf(const TextureUse& use, bool srgb) const {
    if (!use.used()) return {};
    const Texture& texture = scene_.textures[static_cast<std::size_t>(use.texture)];
    if (texture.image < 0) return {};
    const TextureImage& image = scene_.images[static_cast<std::size_t>(texture.image)];
    if (image.width < 1 || image.height < 1) return {};
    const std::scoped_lock lock(mutex_);
    auto& known = images_[{texture.image, srgb}];
    std::shared_ptr<const FinishImage> own = known.lock();
    if (!own) known = own = std::make_shared<const FinishImage>(reduced(image, srgb));
    return {own, texture.wrapS, texture.wrapT, use.uvSet, use.uvTransform};
}

Finish Finishes::of(int material) const {
    const Material& m = materialAt(scene_, material);
    return {.unlit = m.unlit,
            .baseColor = glm::vec3(m.baseColorFactor),
            .metallic = m.metallicFactor,
            .roughness = m.roughnessFactor,
            .reflectance = dielectric,
            .emission = m.emissiveFactor,
            .baseColorMap = mapOf(m.baseColor, true),
            .metallicRoughnessMap = mapOf(m.metallicRoughness, false),
            .emissionMap = mapOf(m.emissive, true)};
}

std::uint64_t Finishes::hash(const Mesh& mesh) const {
    std::uint64_t hash = hashSeed;
    const auto add = [&hash](const auto& values) { hash = hashBytes(std::as_bytes(std::span(values)), hash); };
    for (const Primitive& primitive : mesh.primitives) {
        if (primitive.material < 0) {
            add(std::array{-1});
            continue;
        }
        const Material& m = scene_.materials[static_cast<std::size_t>(primitive.material)];
        add(std::array{m.baseColorFactor.r, m.baseColorFactor.g, m.baseColorFactor.b, m.metallicFactor,
                       m.roughnessFactor, m.emissiveFactor.r, m.emissiveFactor.g, m.emissiveFactor.b,
                       m.unlit ? 1.0f : 0.0f});
        for (const TextureUse* use : {&m.baseColor, &m.metallicRoughness, &m.emissive}) {
            if (!use->used()) {
                add(std::array{-1});
                continue;
            }
            const Texture& texture = scene_.textures[static_cast<std::size_t>(use->texture)];
            add(std::array{use->uvSet, static_cast<int>(texture.wrapS), static_cast<int>(texture.wrapT)});
            for (glm::length_t column = 0; column < 3; ++column)
                add(std::array{use->uvTransform[column].x, use->uvTransform[column].y});
            add(std::array{texture.image < 0 ? 0 : imageHashes_[static_cast<std::size_t>(texture.image)]});
        }
    }
    return hash;
}

}  // namespace defocus::engine
