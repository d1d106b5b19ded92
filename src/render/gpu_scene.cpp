#include "render/gpu_scene.h"

#include <algorithm>

#include "core/error.h"

namespace defocus {

namespace {

template <typename T>
Buffer prefixBuffer(const std::vector<T>& items, std::size_t count) {
    return items.empty() ? Buffer() : Buffer(count * sizeof(T), items.data());
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

}  // namespace

const Material& GpuScene::material(int index) const {
    static const Material gltfDefault;
    return index >= 0 ? world_->scene->materials[static_cast<std::size_t>(index)] : gltfDefault;
}

void GpuScene::prepare(const FramePlan& plan) {
    for (const ObjectPlan& object : plan.objects) {
        std::vector<bool> wanted = plan.levelsUsed[static_cast<std::size_t>(object.mesh)];
        const auto found = meshes_.find(object.mesh);
        if (found == meshes_.end()) {
            uploadMesh(object.mesh, wanted);
            for (const Primitive& primitive : world_->scene->meshes[static_cast<std::size_t>(object.mesh)].primitives)
                prepareMaterial(primitive.material);
            continue;
        }
        const std::vector<GpuLevel>& levels = found->second.levels;
        bool missing = false;
        for (std::size_t level = 0; level < wanted.size(); ++level) {
            missing |= wanted[level] && !levels[level].uploaded;
            wanted[level] = wanted[level] || levels[level].uploaded;
        }
        if (missing) uploadMesh(object.mesh, wanted);
    }
}

void GpuScene::uploadMesh(int mesh, const std::vector<bool>& levels) {
    const Pyramid& pyramid = world_->pyramids[static_cast<std::size_t>(mesh)];
    GpuMesh result;
    result.levels.resize(pyramid.levels.size());

    // Level l uses a prefix of the vertices: the finest wanted level says how many are needed.
    std::size_t vertexCount = 0;
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::u8vec4> colors;
    std::vector<std::uint32_t> indices;
    for (std::size_t level = 0; level < levels.size(); ++level) {
        if (!levels[level]) continue;
        const PyramidLevel& source = pyramid.levels[level];
        GpuLevel& target = result.levels[level];
        vertexCount = std::max<std::size_t>(vertexCount, source.vertexCount);
        target.uploaded = true;
        target.vectorOffset = normals.size() * sizeof(glm::vec3);
        positions.insert(positions.end(), source.positions.begin(), source.positions.end());
        normals.insert(normals.end(), source.normals.begin(), source.normals.end());
        target.colorOffset = colors.size() * sizeof(glm::u8vec4);
        colors.insert(colors.end(), source.colors.begin(), source.colors.end());
        for (const IndexRange& range : source.primitives) {
            target.indexOffsets.push_back(indices.size() * sizeof(std::uint32_t));
            const auto first = pyramid.indices.begin() + range.first;
            indices.insert(indices.end(), first, first + range.count);
        }
    }
    const Vertices& vertices = pyramid.vertices;
    result.positions = prefixBuffer(positions, positions.size());
    result.normals = prefixBuffer(normals, normals.size());
    result.colors = prefixBuffer(colors, colors.size());
    result.uv0 = prefixBuffer(vertices.uv0, vertexCount);
    result.uv1 = prefixBuffer(vertices.uv1, vertexCount);
    result.tangents = prefixBuffer(vertices.tangents, vertexCount);
    result.cocScales = prefixBuffer(vertices.cocScales, vertexCount);
    result.indices = prefixBuffer(indices, indices.size());

    VertexArray& array = result.vertexArray;
    const auto attach = [&](unsigned location, const Buffer& buffer, GLint components, std::size_t stride) {
        if (!buffer) return;
        array.attribute(location, components, GL_FLOAT, false);
        array.bind(location, buffer, 0, stride);
    };
    attach(positionLocation, result.positions, 3, sizeof(glm::vec3));
    attach(normalLocation, result.normals, 3, sizeof(glm::vec3));
    attach(uv0Location, result.uv0, 2, sizeof(glm::vec2));
    attach(uv1Location, result.uv1, 2, sizeof(glm::vec2));
    attach(tangentLocation, result.tangents, 4, sizeof(glm::vec4));
    attach(cocScaleLocation, result.cocScales, 1, sizeof(float));
    if (result.colors) {
        array.attribute(colorLocation, 4, GL_UNSIGNED_BYTE, true);
        array.bind(colorLocation, result.colors, 0, sizeof(glm::u8vec4));
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

const GlTexture* GpuScene::texture(const TextureUse& use, bool srgb) {
    if (!use.used()) return nullptr;
    const auto [entry, isNew] = textures_.try_emplace({use.texture, srgb});
    if (!isNew) return &entry->second;
    const Texture& source = world_->scene->textures[static_cast<std::size_t>(use.texture)];
    const TextureImage& image = world_->scene->images[static_cast<std::size_t>(source.image)];
    GlTexture& result = entry->second;
    result = GlTexture({.format = srgb ? TextureFormat::srgb8Alpha8 : TextureFormat::rgba8,
                        .width = image.width,
                        .height = image.height,
                        .levels = source.mipmaps ? mipmapLevels(image.width, image.height) : 1});
    result.upload(0, image.width, image.height, image.rgba.data());
    if (source.mipmaps) result.generateMipmaps();
    result.sampling(minificationFilter(source), source.magnification == Filter::linear ? GL_LINEAR : GL_NEAREST,
                    wrapMode(source.wrapS), wrapMode(source.wrapT));
    return &result;
}

void GpuScene::prepareMaterial(int index) {
    if (materialTextures_.contains(index)) return;
    const Material& m = material(index);
    GpuMaterialTextures& slots = materialTextures_[index];
    slots.slots[0] = texture(m.baseColor, true);
    if (m.unlit) return;
    slots.slots[1] = texture(m.metallicRoughness, false);
    slots.slots[2] = texture(m.normal, false);
    slots.slots[3] = texture(m.occlusion, false);
    slots.slots[4] = texture(m.emissive, true);
}

std::array<const TextureUse*, 5> textureUses(const Material& material) {
    return {&material.baseColor, &material.metallicRoughness, &material.normal, &material.occlusion,
            &material.emissive};
}

GpuMaterial GpuScene::materialBlock(const Material& material) {
    GpuMaterial block{};
    block.baseColor = material.baseColorFactor;
    block.emissiveCutoff = glm::vec4(material.emissiveFactor, material.alphaCutoff);
    block.surface = {material.metallicFactor, material.roughnessFactor, material.normalScale,
                     material.occlusionStrength};
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
        for (const Buffer* buffer : {&mesh.positions, &mesh.normals, &mesh.colors, &mesh.uv0, &mesh.uv1, &mesh.tangents,
                                     &mesh.cocScales, &mesh.indices})
            total += buffer->bytes();
    for (const auto& [index, mesh] : meshes_)
        for (const Buffer* buffer : {&mesh.deformation.joints, &mesh.deformation.weights, &mesh.deformation.joints1,
                                     &mesh.deformation.weights1})
            total += buffer->bytes();
    for (const auto& [index, mesh] : meshes_) total += mesh.deformation.morphs.bytes();
    for (const auto& [key, texture] : textures_) total += texture.bytes();
    return total;
}

}  // namespace defocus
