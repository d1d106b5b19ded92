#include "render/gpu_scene/gpu_scene.h"

#include <algorithm>

#include "core/error.h"
#include "render/gpu_scene/cut_out.h"

namespace defocus::engine {

namespace {

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

// Returns whether the texture in this slot has sRGB-encoded colours; false: linear values.
bool isColor(TextureSlot slot) {
    using enum TextureSlot;
    return slot == baseColor || slot == emissive || slot == specularColor || slot == sheenColor ||
           slot == diffuseTransmissionColor;
}

// Returns whether the material has the property that the texture in this slot modulates.
bool isUsed(const Material& material, TextureSlot slot) {
    using enum TextureSlot;
    if (material.unlit) return slot == baseColor;
    switch (slot) {
        case specular:
        case specularColor:
            return material.hasOwnReflectance();
        case transmission:
        case thickness:
            return material.transmits();
        case clearcoat:
        case clearcoatRoughness:
        case clearcoatNormal:
            return material.hasClearcoat();
        case sheenColor:
        case sheenRoughness:
            return material.hasSheen();
        case anisotropy:
            return material.isAnisotropic();
        case iridescence:
        case iridescenceThickness:
            return material.isIridescent();
        case diffuseTransmission:
        case diffuseTransmissionColor:
            return material.transmitsDiffusely();
        default:
            return true;
    }
}

}  // namespace

void GpuScene::prepare(const FramePlan& plan) {
    meshes_.resize(world_->pyramids.size());
    materialTextures_.resize(world_->scene->materials.size() + 1);
    std::vector<MeshUpload> missing;
    std::vector<bool> seen(meshes_.size());
    for (const std::vector<ObjectPlan>* objects : {&plan.objects, &plan.shadows.casters})
        for (const ObjectPlan& object : *objects) {
            const auto mesh = static_cast<std::size_t>(object.mesh);
            if (seen[mesh]) continue;
            seen[mesh] = true;
            addMissing(mesh, plan.levelsUsed[mesh], missing);
        }
    uploadMeshes(*world_, missing, meshes_);
}

// Adds a mesh to `missing` if a level that `used` flags is not on the GPU. The upload also includes the mesh's levels
// that are already on the GPU.
void GpuScene::addMissing(std::size_t mesh, const std::vector<bool>& used, std::vector<MeshUpload>& missing) {
    const std::vector<GpuLevel>& present = meshes_[mesh].levels;
    if (present.empty())
        for (const Primitive& primitive : world_->scene->meshes[mesh].primitives) prepareMaterial(primitive.material);
    std::vector<bool> wanted = used;
    bool misses = present.empty();
    for (std::size_t level = 0; level < present.size(); ++level) {
        misses |= used[level] && !present[level].uploaded;
        wanted[level] = used[level] || present[level].uploaded;
    }
    if (misses) missing.push_back({mesh, std::move(wanted)});
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

GpuMaterialTextures GpuScene::texturesOf(const Material& m) {
    GpuMaterialTextures result;
    const float cutoff = m.alphaMode == AlphaMode::mask ? m.alphaCutoff / std::max(m.baseColorFactor.a, 1e-3f) : 0;
    const auto uses = textureUses(m);
    for (std::size_t i = 0; i < uses.size(); ++i) {
        const auto slot = static_cast<TextureSlot>(i);
        if (isUsed(m, slot))
            result.slots[i] = texture(*uses[i], isColor(slot), slot == TextureSlot::baseColor ? cutoff : 0);
    }
    return result;
}

void GpuScene::prepareMaterial(int index) {
    const GpuMaterialTextures*& textures = materialTextures_[static_cast<std::size_t>(index + 1)];
    if (textures == nullptr) textures = &*textureSets_.insert(texturesOf(material(index))).first;
}

int GpuMaterialTextures::unit(std::size_t slot) const {
    return static_cast<int>(slot - static_cast<std::size_t>(std::count(slots.begin(), slots.begin() + slot, nullptr)));
}

void GpuMaterialTextures::attach() const {
    constexpr GLuint firstUnit = 8;  // first texture unit in shaders/include/material_textures.glsl
    for (std::size_t i = 0; i < materialTextureCount; ++i)
        if (slots[i] != nullptr) slots[i]->attach(firstUnit + static_cast<GLuint>(unit(i)));
}

std::size_t GpuScene::bytes() const {
    std::size_t total = 0;
    std::set<const MeshBuffers*> buffers;
    for (const GpuMesh& mesh : meshes_) {
        if (mesh.buffers && buffers.insert(mesh.buffers.get()).second) total += mesh.buffers->bytes();
        total += mesh.morphs.texels.bytes();
    }
    for (const auto& [key, texture] : textures_) total += texture.bytes();
    return total;
}

}  // namespace defocus::engine
