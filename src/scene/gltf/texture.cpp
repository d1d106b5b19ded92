// Source: glTF 2.0 specification, textures (3.8).
#include "scene/gltf/texture.h"

#include <cmath>
#include <map>
#include <mutex>
#include <utility>

#include "core/parallel.h"
#include "image/image_io.h"

namespace defocus::engine::gltf {

namespace {

// ---- textures -----------------------------------------------------------------------------------

Wrap wrapOf(int mode) {
    if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::clampToEdge;
    if (mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) return Wrap::mirroredRepeat;
    return Wrap::repeat;
}

Texture readTexture(const tinygltf::Model& model, const tinygltf::Texture& from) {
    Texture texture;
    if (from.sampler < 0) return texture;
    const tinygltf::Sampler& sampler = model.samplers[static_cast<std::size_t>(from.sampler)];
    const int minification = sampler.minFilter;
    texture.wrapS = wrapOf(sampler.wrapS);
    texture.wrapT = wrapOf(sampler.wrapT);
    if (sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST) texture.magnification = Filter::nearest;
    const bool nearest = minification == TINYGLTF_TEXTURE_FILTER_NEAREST ||
                         minification == TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST ||
                         minification == TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR;
    if (nearest) texture.minification = Filter::nearest;
    texture.mipmaps = minification != TINYGLTF_TEXTURE_FILTER_NEAREST && minification != TINYGLTF_TEXTURE_FILTER_LINEAR;
    return texture;
}

// ---- images -------------------------------------------------------------------------------------

std::string imageName(const nlohmann::json& json, std::size_t index) {
    std::string name = json.value("name", std::string());
    if (!name.empty()) return name;
    std::string uri = json.value("uri", std::string());
    return uri.empty() || isDataUri(uri) ? fmt::format("image {}", index) : uri;
}

std::vector<std::byte> encodedImage(const Source& source, const nlohmann::json& json, const std::string& label) {
    if (json.contains("uri")) return readUri(source.document, json["uri"].get<std::string>(), label);
    if (!json.contains("bufferView")) fault(source.document, "{}: it has neither uri nor bufferView", label);
    const std::span<const std::byte> bytes = viewBytes(source, json["bufferView"].get<int>());
    return {bytes.begin(), bytes.end()};
}

// One image of the file. `image` is empty if `fault` is set.
struct ReadImage {
    TextureImage image;
    std::string name;
    std::string label;  // name of the image in messages
    std::string fault;  // why the image cannot be used
};

// Calls `step`. If it throws Error, stores the message in `image.fault`.
void attempt(const Source& source, ReadImage& image, const auto& step) {
    try {
        step();
    } catch (const Error& error) {
        image.fault = withoutFile(source.document, error.what());
    }
}

// Returns image `index` with its name and label, but not yet decoded. Raises the memory limit in proportion to the size
// of an external file (grantFile).
ReadImage openImage(Source& source, std::size_t index) {
    const nlohmann::json& json = source.document.json["images"][index];
    ReadImage result;
    result.name = shortLine(imageName(json, index));
    result.label = fmt::format("image {} '{}'", index, result.name);
    if (json.contains("uri"))
        attempt(source, result, [&] { grantFile(source, json["uri"].get<std::string>(), result.label); });
    return result;
}

// Returns, for each image, whether a material uses it.
std::vector<bool> usedImages(const Source& source, const std::vector<Material>& materials) {
    std::vector<bool> used(entryCount(source.document, "images"));
    for (const Material& material : materials)
        for (const TextureUse* use : textureUses(material))
            if (use->used())
                used[static_cast<std::size_t>(source.model.textures[static_cast<std::size_t>(use->texture)].source)] =
                    true;
    return used;
}

// Returns an image whose roughness (G) is 1 − glossiness. Glossiness is the factor times the alpha of image `glossy`.
TextureImage roughnessOf(const TextureImage& glossy, double glossinessFactor) {
    TextureImage rough = glossy;
    for (std::size_t i = 0; i < rough.rgba.size(); i += 4) {
        const double roughness = 255 - glossinessFactor * glossy.rgba[i + 3];
        rough.rgba[i] = rough.rgba[i + 2] = rough.rgba[i + 3] = 255;
        rough.rgba[i + 1] = static_cast<std::uint8_t>(std::lround(roughness));
    }
    return rough;
}

// Replaces the specular-glossiness textures, which materials hold in `metallicRoughness`, with roughness textures. If
// such a texture was removed because it has no image, its material becomes a dielectric.
void convertGlossiness(Source& source, std::vector<Material>& materials, Textures& textures) {
    std::map<std::pair<int, float>, int> converted;  // (texture, roughness factor) → converted texture
    for (std::size_t i = 0; i < materials.size(); ++i) {
        TextureUse& use = materials[i].metallicRoughness;
        const nlohmann::json* extension =
            findExtension(source.document.json["materials"][i], "KHR_materials_pbrSpecularGlossiness");
        if (extension == nullptr || !extension->contains("specularGlossinessTexture")) continue;
        if (!use.used()) {
            // The reflectance at normal incidence was in the specular-glossiness texture, which has been removed. Such
            // materials have an IOR of 0, with which the surface would be a mirror. Make it a dielectric instead.
            materials[i].ior = Material().ior;
            continue;
        }
        float& factor = materials[i].roughnessFactor;
        const auto [place, added] = converted.try_emplace({use.texture, factor}, int(textures.textures.size()));
        if (added) {
            Texture texture = textures.textures[static_cast<std::size_t>(use.texture)];
            const auto image = static_cast<std::size_t>(texture.image);
            takeBudget(source, textures.images[image].rgba.size(), 1, textures.names[image] + ": pixels");
            texture.image = static_cast<int>(textures.images.size());
            textures.images.push_back(roughnessOf(textures.images[image], 1.0 - static_cast<double>(factor)));
            textures.names.push_back(textures.names[image] + " (roughness)");
            textures.textures.push_back(texture);
        }
        use.texture = place->second;
        factor = 1;
    }
}

}  // namespace

Textures readTextures(Source& source, std::vector<Material>& materials, const Progress& progress) {
    const std::vector<bool> used = usedImages(source, materials);
    std::vector<ReadImage> read(used.size());
    for (std::size_t i = 0; i < used.size(); ++i)
        if (used[i]) read[i] = openImage(source, i);
    const auto count = static_cast<std::size_t>(std::ranges::count(used, true));
    std::mutex mutex;
    std::size_t done = 0;
    parallelFor(used.size(), [&](std::size_t i) {
        if (!used[i]) return;
        ReadImage& image = read[i];
        const auto take = [&](std::uint64_t pixels) {
            const std::scoped_lock lock(mutex);
            takeBudget(source, pixels, sizeof(std::uint32_t), image.label + ": pixels");
        };
        if (image.fault.empty())
            attempt(source, image, [&] {
                const nlohmann::json& json = source.document.json["images"][i];
                image.image = decodeTexture(encodedImage(source, json, image.label), image.label, take);
            });
        const std::scoped_lock lock(mutex);
        report(progress, "reading images", ++done, count);
    });

    Textures result;
    std::vector<int> places(used.size(), -1);  // index into `result.images` of each image of the file; −1: not read
    for (std::size_t i = 0; i < used.size(); ++i) {
        if (!read[i].fault.empty()) ignoreDamaged(source, "texture", read[i].fault, 1);
        if (!used[i] || !read[i].fault.empty()) continue;
        places[i] = static_cast<int>(result.images.size());
        result.images.push_back(std::move(read[i].image));
        result.names.push_back(std::move(read[i].name));
    }

    // Set each texture's image index, and remove textures without an image from the materials.
    for (const tinygltf::Texture& texture : source.model.textures) {
        result.textures.push_back(readTexture(source.model, texture));
        if (texture.source >= 0) result.textures.back().image = places[static_cast<std::size_t>(texture.source)];
    }
    for (Material& material : materials)
        for (TextureUse* use : textureUses(material))
            if (use->used() && result.textures[static_cast<std::size_t>(use->texture)].image < 0) *use = {};
    convertGlossiness(source, materials, result);
    return result;
}

}  // namespace defocus::engine::gltf
