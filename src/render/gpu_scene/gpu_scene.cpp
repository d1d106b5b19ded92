#include "render/gpu_scene/gpu_scene.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/gtc/packing.hpp>

#include "core/error.h"
#include "render/gpu_scene/cut_out.h"

namespace defocus::engine {

namespace {

// A mesh is far from its origin on an axis if its centre's coordinate is at least this multiple of half its largest
// side.
constexpr double farFromOrigin = 4;

template <typename T>
Buffer prefixBuffer(const std::vector<T>& items, std::size_t count) {
    return items.empty() ? Buffer() : Buffer(count * sizeof(T), items.data());
}

// Colours of level 0 are in [0, 1]; 16-bit fixed point is exact for files with 8 or 16 bits. Colours of coarser levels
// are fitted and may lie outside [0, 1].
GLenum colorTypeOf(std::size_t level) {
    return level == 0 ? GL_UNSIGNED_SHORT : GL_HALF_FLOAT;
}

std::vector<glm::u16vec4> packed(const std::vector<glm::vec4>& colors, GLenum type) {
    std::vector<glm::u16vec4> result;
    result.reserve(colors.size());
    for (const glm::vec4& color : colors)
        result.push_back(type == GL_HALF_FLOAT ? glm::packHalf(color) : glm::packUnorm<glm::uint16>(color));
    return result;
}

// Returns a buffer with the values of all parts, one after another. Calls part(i), which returns values of type T or a
// view of them, for each part i. A single part is uploaded without a copy.
template <typename T>
Buffer joinedBuffer(std::size_t partCount, std::size_t valueCount, const auto& part) {
    if (valueCount == 0) return {};
    if (partCount == 1) return Buffer::of(std::span<const T>(part(0)));
    Buffer buffer(valueCount * sizeof(T));
    std::size_t at = 0;
    for (std::size_t i = 0; i < partCount; ++i) {
        const auto& values = part(i);
        const std::span<const T> view(values);
        buffer.update(at, view.size_bytes(), view.data());
        at += view.size_bytes();
    }
    return buffer;
}

GLenum wrapMode(Wrap wrap) {
    switch (wrap) {
        case Wrap::repeat:
            return GL_REPEAT;
        case Wrap::clampToEdge:
            return GL_CLAMP_TO_EDGE;
        case Wrap::mirroredRepeat:
            return GL_MIRRORED_REPEAT;
    }
    return GL_REPEAT;
}

GLenum minificationFilter(const Texture& texture) {
    if (!texture.mipmaps) return texture.minification == Filter::linear ? GL_LINEAR : GL_NEAREST;
    return texture.minification == Filter::linear ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST_MIPMAP_LINEAR;
}

constexpr float minAttenuation = 1e-6f;  // lower bound of a colour channel before its logarithm

constexpr float rangeRounding = 1e-3f;  // tolerance in 1/255 when rounding outwards

void measureColors(const std::vector<glm::vec4>& colors, GpuLevel& level) {
    if (colors.empty()) return;
    level.minColor = level.maxColor = colors.front();
    for (const glm::vec4& color : colors) {
        level.minColor = glm::min(level.minColor, color);
        level.maxColor = glm::max(level.maxColor, color);
    }
}

// Returns the indices of a level's triangles, which are contiguous in Pyramid::indices.
std::span<const std::uint32_t> indicesOf(const Pyramid& pyramid, std::size_t level) {
    const std::vector<IndexRange>& ranges = pyramid.levels[level].primitives;
    if (ranges.empty()) return {};
    const std::uint32_t end = ranges.back().first + ranges.back().count;
    return std::span(pyramid.indices).subspan(ranges.front().first, end - ranges.front().first);
}

std::vector<glm::vec3> relative(const std::vector<glm::vec3>& positions, const glm::dvec3& origin) {
    std::vector<glm::vec3> result;
    result.reserve(positions.size());
    for (const glm::vec3& position : positions) result.emplace_back(glm::dvec3(position) - origin);
    return result;
}

}  // namespace

glm::dvec3 meshOrigin(const Bounds& bounds) {
    if (bounds.empty()) return glm::dvec3(0);
    const glm::dvec3 middle = bounds.centre();
    const glm::dvec3 size = bounds.size();
    const double reach = 0.5 * std::max({size.x, size.y, size.z});
    glm::dvec3 origin(0);
    for (glm::length_t axis = 0; axis < 3; ++axis)
        if (std::abs(middle[axis]) >= farFromOrigin * reach) origin[axis] = static_cast<float>(middle[axis]);
    return origin;
}

std::vector<glm::u16vec4> cornerColorRanges(const std::vector<glm::vec4>& colors,
                                            std::span<const std::uint32_t> indices) {
    if (colors.empty()) return {};
    std::vector<glm::vec4> min = colors;
    std::vector<glm::vec4> max = colors;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const glm::vec4 &a = colors[indices[i]], &b = colors[indices[i + 1]], &c = colors[indices[i + 2]];
        const glm::vec4 low = glm::min(glm::min(a, b), c);
        const glm::vec4 high = glm::max(glm::max(a, b), c);
        for (std::size_t k = i; k < i + 3; ++k) {
            min[indices[k]] = glm::min(min[indices[k]], low);
            max[indices[k]] = glm::max(max[indices[k]], high);
        }
    }
    std::vector<glm::u16vec4> ranges;
    ranges.reserve(colors.size());
    for (std::size_t v = 0; v < colors.size(); ++v)
        ranges.push_back(glm::u16vec4(glm::ceil(255.0f * max[v] - rangeRounding)) * std::uint16_t{256} +
                         glm::u16vec4(glm::floor(255.0f * min[v] + rangeRounding)));
    return ranges;
}

const Material& GpuScene::material(int index) const {
    static const Material gltfDefault;
    return index >= 0 ? world_->scene->materials[static_cast<std::size_t>(index)] : gltfDefault;
}

void GpuScene::prepare(const FramePlan& plan) {
    prepareObjects(plan, plan.objects);
    prepareObjects(plan, plan.shadows.casters);
}

void GpuScene::prepareObjects(const FramePlan& plan, const std::vector<ObjectPlan>& objects) {
    for (const ObjectPlan& object : objects) {
        const std::vector<bool>& used = plan.levelsUsed[static_cast<std::size_t>(object.mesh)];
        const auto found = meshes_.find(object.mesh);
        if (found == meshes_.end()) {
            uploadMesh(object.mesh, used);
            for (const Primitive& primitive : world_->scene->meshes[static_cast<std::size_t>(object.mesh)].primitives)
                prepareMaterial(primitive.material);
            continue;
        }
        const std::vector<GpuLevel>& levels = found->second.levels;
        bool missing = false;
        for (std::size_t level = 0; level < used.size(); ++level) missing |= used[level] && !levels[level].uploaded;
        if (!missing) continue;
        std::vector<bool> wanted = used;
        for (std::size_t level = 0; level < used.size(); ++level) wanted[level] = used[level] || levels[level].uploaded;
        uploadMesh(object.mesh, wanted);
    }
}

void GpuScene::uploadMesh(int mesh, const std::vector<bool>& levels) {
    const Pyramid& pyramid = world_->pyramids[static_cast<std::size_t>(mesh)];
    GpuMesh result;
    result.origin = meshOrigin(pyramid.bounds);
    result.levels.resize(pyramid.levels.size());

    // Each level uses a prefix of the pyramid's vertices, so the finest requested level determines the vertex count.
    std::size_t vertexCount = 0;
    std::size_t vectors = 0, colors = 0, uvs0 = 0, uvs1 = 0, indices = 0;  // numbers of values
    std::vector<std::size_t> used;                                         // levels
    for (std::size_t level = 0; level < levels.size(); ++level) {
        if (!levels[level]) continue;
        used.push_back(level);
        const PyramidLevel& source = pyramid.levels[level];
        GpuLevel& target = result.levels[level];
        vertexCount = std::max<std::size_t>(vertexCount, source.vertexCount);
        target.uploaded = true;
        target.vectorOffset = vectors * sizeof(glm::vec3);
        target.colorOffset = colors * sizeof(glm::u16vec4);
        target.colorType = colorTypeOf(level);
        target.uvOffset = std::max(uvs0, uvs1) * sizeof(glm::vec2);
        for (const IndexRange& range : source.primitives) {
            target.indexOffsets.push_back(indices * sizeof(std::uint32_t));
            indices += range.count;
        }
        if (level > 0) measureColors(source.colors, target);
        vectors += source.normals.size();
        colors += source.colors.size();
        uvs0 += source.uv0.size();
        uvs1 += source.uv1.size();
    }
    const auto ofLevels = [&]<typename T>(std::vector<T> PyramidLevel::*values, std::size_t count) {
        return joinedBuffer<T>(used.size(), count,
                               [&](std::size_t i) { return std::span(pyramid.levels[used[i]].*values); });
    };
    result.positions = joinedBuffer<glm::vec3>(used.size(), vectors, [&](std::size_t i) {
        return relative(pyramid.levels[used[i]].positions, result.origin);
    });
    result.normals = ofLevels(&PyramidLevel::normals, vectors);
    result.colors = joinedBuffer<glm::u16vec4>(used.size(), colors, [&](std::size_t i) {
        return packed(pyramid.levels[used[i]].colors, colorTypeOf(used[i]));
    });
    result.uv0 = ofLevels(&PyramidLevel::uv0, uvs0);
    result.uv1 = ofLevels(&PyramidLevel::uv1, uvs1);
    result.indices =
        joinedBuffer<std::uint32_t>(used.size(), indices, [&](std::size_t i) { return indicesOf(pyramid, used[i]); });
    if (levels.front() && !pyramid.levels.front().colors.empty())
        result.colorRanges = Buffer::of(
            std::span<const glm::u16vec4>(cornerColorRanges(pyramid.levels.front().colors, indicesOf(pyramid, 0))));
    const Vertices& vertices = pyramid.vertices;
    result.tangents = prefixBuffer(vertices.tangents, vertexCount);
    result.blurs = prefixBuffer(vertices.blurs, vertexCount);

    VertexArray& array = result.vertexArray;
    // bindLevel binds the buffers of attributes that each level has of its own.
    array.attribute(positionLocation, 3, GL_FLOAT, false);
    array.attribute(normalLocation, 3, GL_FLOAT, false);
    if (result.uv0) array.attribute(uv0Location, 2, GL_FLOAT, false);
    if (result.uv1) array.attribute(uv1Location, 2, GL_FLOAT, false);
    const auto attach = [&](unsigned location, const Buffer& buffer, GLint components, std::size_t stride) {
        if (!buffer) return;
        array.attribute(location, components, GL_FLOAT, false);
        array.bind(location, buffer, 0, stride);
    };
    attach(tangentLocation, result.tangents, 4, sizeof(glm::vec4));
    attach(blurLocation, result.blurs, 3, sizeof(VertexBlur));
    if (result.colorRanges) {
        array.attribute(colorRangeLocation, 4, GL_UNSIGNED_SHORT, false);
        array.bind(colorRangeLocation, result.colorRanges, 0, sizeof(glm::u16vec4));
    }
    array.attribute(lensLocation, 4, GL_FLOAT, false, true);
    array.attribute(eyeLocation, 4, GL_FLOAT, false, true);
    if (result.indices) array.indices(result.indices);
    uploadDeformation(mesh, vertexCount, result);
    meshes_.insert_or_assign(mesh, std::move(result));
}

void GpuScene::uploadDeformation(int mesh, std::size_t vertexCount, GpuMesh& target) {
    const Pyramid& pyramid = world_->pyramids[static_cast<std::size_t>(mesh)];
    GpuDeformation& deformation = target.deformation;
    deformation.joints = prefixBuffer(pyramid.vertices.joints, vertexCount);
    deformation.weights = prefixBuffer(pyramid.vertices.weights, vertexCount);
    deformation.joints1 = prefixBuffer(pyramid.vertices.joints1, vertexCount);
    deformation.weights1 = prefixBuffer(pyramid.vertices.weights1, vertexCount);
    const auto attach = [&](unsigned location, const Buffer& buffer, GLenum type, std::size_t stride) {
        if (!buffer) return;
        target.vertexArray.attribute(location, 4, type, false);
        target.vertexArray.bind(location, buffer, 0, stride);
    };
    attach(jointsLocation, deformation.joints, GL_UNSIGNED_SHORT, sizeof(glm::u16vec4));
    attach(weightsLocation, deformation.weights, GL_FLOAT, sizeof(glm::vec4));
    attach(joints1Location, deformation.joints1, GL_UNSIGNED_SHORT, sizeof(glm::u16vec4));
    attach(weights1Location, deformation.weights1, GL_FLOAT, sizeof(glm::vec4));

    const Mesh& source = world_->scene->meshes[static_cast<std::size_t>(mesh)];
    if (source.morphTargets.empty()) return;
    deformation.vertexCount = vertexCount;
    for (const MorphTarget& morph : source.morphTargets) {
        deformation.morphNormals |= !morph.normals.empty();
        deformation.morphTangents |= !morph.tangents.empty() && !source.vertices.tangents.empty();
    }
    std::vector<glm::vec3> texels;
    texels.reserve(static_cast<std::size_t>(deformation.attributesPerTarget()) * vertexCount *
                   source.morphTargets.size());
    const auto add = [&](const std::vector<glm::vec3>& displacements) {
        for (std::size_t v = 0; v < vertexCount; ++v)
            texels.push_back(displacements.empty() ? glm::vec3(0) : displacements[pyramid.source[v]]);
    };
    for (const MorphTarget& morph : source.morphTargets) {
        add(morph.positions);
        if (deformation.morphNormals) add(morph.normals);
        if (deformation.morphTangents) add(morph.tangents);
    }
    deformation.morphs =
        TexelBuffer({texels.empty() ? nullptr : &texels.front().x, texels.size() * 3}, GL_RGB32F, 3, "morph targets");
}

const GlTexture* GpuScene::texture(const TextureUse& use, bool srgb, float cutoff) {
    if (!use.used()) return nullptr;
    const auto [entry, isNew] = textures_.try_emplace({use.texture, srgb, cutoff});
    if (!isNew) return &entry->second;
    const Texture& source = world_->scene->textures[static_cast<std::size_t>(use.texture)];
    const TextureImage& image = world_->scene->images[static_cast<std::size_t>(source.image)];
    GlTexture& result = entry->second;
    try {
        result = GlTexture({.format = srgb ? TextureFormat::srgb8Alpha8 : TextureFormat::rgba8,
                            .width = image.width,
                            .height = image.height,
                            .levels = source.mipmaps ? mipmapLevels(image.width, image.height) : 1});
    } catch (const Error& error) {
        fail("texture '{}': {}; use a smaller image",
             world_->scene->imageNames.at(static_cast<std::size_t>(source.image)), error.what());
    }
    if (source.mipmaps) {
        result.upload(0, image.width, image.height, cutoff > 0 ? cutOut(image, cutoff).data() : image.rgba.data());
        result.generateMipmaps();
    }
    if (!source.mipmaps || cutoff > 0) result.upload(0, image.width, image.height, image.rgba.data());
    result.sampling(minificationFilter(source), source.magnification == Filter::linear ? GL_LINEAR : GL_NEAREST,
                    wrapMode(source.wrapS), wrapMode(source.wrapT));
    return &result;
}

void GpuScene::prepareMaterial(int index) {
    if (materialTextures_.contains(index)) return;
    const Material& m = material(index);
    GpuMaterialTextures& slots = materialTextures_[index];
    const float cutoff = m.alphaMode == AlphaMode::mask ? m.alphaCutoff / std::max(m.baseColorFactor.a, 1e-3f) : 0;
    slots.slots[0] = texture(m.baseColor, true, cutoff);
    if (m.unlit) return;
    slots.slots[1] = texture(m.metallicRoughness, false);
    slots.slots[2] = texture(m.normal, false);
    slots.slots[3] = texture(m.occlusion, false);
    slots.slots[4] = texture(m.emissive, true);
    if (m.hasOwnReflectance()) {
        slots.slots[5] = texture(m.specular, false);
        slots.slots[6] = texture(m.specularColor, true);
    }
    if (m.transmits()) {
        slots.slots[7] = texture(m.transmission, false);
        slots.slots[8] = texture(m.thickness, false);
    }
    if (m.hasClearcoat()) {
        slots.slots[9] = texture(m.clearcoat, false);
        slots.slots[10] = texture(m.clearcoatRoughness, false);
        slots.slots[11] = texture(m.clearcoatNormal, false);
    }
    if (m.hasSheen()) {
        slots.slots[12] = texture(m.sheenColor, true);
        slots.slots[13] = texture(m.sheenRoughness, false);
    }
    if (m.isAnisotropic()) slots.slots[14] = texture(m.anisotropy, false);
    if (m.isIridescent()) {
        slots.slots[15] = texture(m.iridescence, false);
        slots.slots[16] = texture(m.iridescenceThickness, false);
    }
    if (m.transmitsDiffusely()) {
        slots.slots[17] = texture(m.diffuseTransmission, false);
        slots.slots[18] = texture(m.diffuseTransmissionColor, true);
    }
}

int GpuMaterialTextures::unit(std::size_t slot) const {
    return static_cast<int>(slot - static_cast<std::size_t>(std::count(slots, slots + slot, nullptr)));
}

void GpuMaterialTextures::attach() const {
    constexpr GLuint firstUnit = 8;  // first texture unit in shaders/include/material_textures.glsl
    for (std::size_t i = 0; i < materialTextureCount; ++i)
        if (slots[i] != nullptr) slots[i]->attach(firstUnit + static_cast<GLuint>(unit(i)));
}

void bindLevel(GpuMesh& mesh, std::size_t level) {
    const GpuLevel& source = mesh.levels[level];
    VertexArray& array = mesh.vertexArray;
    array.bind(positionLocation, mesh.positions, source.vectorOffset, sizeof(glm::vec3));
    array.bind(normalLocation, mesh.normals, source.vectorOffset, sizeof(glm::vec3));
    if (mesh.uv0) array.bind(uv0Location, mesh.uv0, source.uvOffset, sizeof(glm::vec2));
    if (mesh.uv1) array.bind(uv1Location, mesh.uv1, source.uvOffset, sizeof(glm::vec2));
    if (!mesh.colors) return;
    array.attribute(colorLocation, 4, source.colorType, source.colorType == GL_UNSIGNED_SHORT);
    array.bind(colorLocation, mesh.colors, source.colorOffset, sizeof(glm::u16vec4));
}

GpuMaterial GpuScene::materialBlock(int index) const {
    const Material& material = this->material(index);
    GpuMaterial block{};
    block.baseColor = material.baseColorFactor;
    block.emissiveCutoff = glm::vec4(material.emissiveFactor, material.alphaCutoff);
    block.surface = {material.metallicFactor, material.roughnessFactor, material.normalScale,
                     material.occlusionStrength};
    // Reflectance of a dielectric with index of refraction n at normal incidence: ((n − 1)/(n + 1))². n = 0 stands for
    // infinity.
    const float ior = material.ior;
    const float normalIncidence = ior > 0 ? (ior - 1) * (ior - 1) / ((ior + 1) * (ior + 1)) : 1.0f;
    block.reflectance = glm::vec4(normalIncidence * material.specularColorFactor, material.specularFactor);
    // transmission.w is the factor on the blur of the background by roughness: 0 for refractive index 1 (air), 1 for
    // 1.5 and above.
    block.transmission = {material.transmissionFactor, material.thicknessFactor, ior > 0 ? 1 / ior : 0.0f,
                          ior > 0 ? glm::clamp(2 * ior - 2, 0.0f, 1.0f) : 1.0f};
    const double distance = material.attenuationDistance * world_->scene->metresPerUnit;
    block.absorption =
        glm::vec4(-glm::log(glm::max(material.attenuationColor, minAttenuation)) / static_cast<float>(distance),
                  material.dispersion);
    block.coat = {material.clearcoatFactor, material.clearcoatRoughnessFactor, material.clearcoatNormalScale, 0};
    block.sheen = glm::vec4(material.sheenColorFactor, material.sheenRoughnessFactor);
    block.anisotropy = {material.anisotropyStrength, std::cos(material.anisotropyRotation),
                        std::sin(material.anisotropyRotation), 0};
    block.film = {material.iridescenceFactor, material.iridescenceIor, material.iridescenceThicknessMinimum,
                  material.iridescenceThicknessMaximum};
    block.through = glm::vec4(material.diffuseTransmissionColorFactor, material.diffuseTransmissionFactor);
    const auto uses = textureUses(material);
    for (std::size_t i = 0; i < uses.size(); ++i) {
        const glm::mat3& m = uses[i]->uvTransform;
        block.uvRows[2 * i] = {m[0][0], m[1][0], m[2][0], static_cast<float>(uses[i]->uvSet)};
        block.uvRows[2 * i + 1] = {m[0][1], m[1][1], m[2][1], 0};
    }
    return block;
}

std::size_t GpuScene::bytes() const {
    std::size_t total = 0;
    for (const auto& [index, mesh] : meshes_)
        for (const Buffer* buffer : {&mesh.positions, &mesh.normals, &mesh.colors, &mesh.colorRanges, &mesh.uv0,
                                     &mesh.uv1, &mesh.tangents, &mesh.blurs, &mesh.indices})
            total += buffer->bytes();
    for (const auto& [index, mesh] : meshes_)
        for (const Buffer* buffer : {&mesh.deformation.joints, &mesh.deformation.weights, &mesh.deformation.joints1,
                                     &mesh.deformation.weights1})
            total += buffer->bytes();
    for (const auto& [index, mesh] : meshes_) total += mesh.deformation.morphs.bytes();
    for (const auto& [key, texture] : textures_) total += texture.bytes();
    return total;
}

}  // namespace defocus::engine
