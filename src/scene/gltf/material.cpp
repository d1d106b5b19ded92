// Sources: glTF 2.0 specification, materials (3.9). Extensions: KHR_texture_transform, KHR_materials_unlit,
// _emissive_strength, _pbrSpecularGlossiness, _ior, _specular, _transmission, _volume, _dispersion,
// _diffuse_transmission, _clearcoat, _sheen, _anisotropy and _iridescence.
#include "scene/gltf/material.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace defocus::engine::gltf {

namespace {

constexpr double dielectricReflectance = 0.04;  // reflectance at normal incidence
constexpr double minShare = 1e-6;               // lower bound of divisors in the conversion from specular-glossiness

// ---- materials ----------------------------------------------------------------------------------

float numberOf(const nlohmann::json& json, const char* name, double otherwise) {
    return toFloat(json.value(name, otherwise));
}

// Returns the matrix T · R · S (offset, rotation, scale) that transforms (u, v, 1). The rotation is counter-clockwise
// in the image, whose v axis points down.
glm::mat3 textureTransform(const nlohmann::json& json) {
    const auto offset = json.value("offset", std::vector<double>{0, 0});
    const auto scale = json.value("scale", std::vector<double>{1, 1});
    const double rotation = json.value("rotation", 0.0);
    const double c = std::cos(rotation);
    const double s = std::sin(rotation);
    return {toFloat(c * scale[0]), toFloat(-s * scale[0]), 0.0f,  // GLM matrices are column-major
            toFloat(s * scale[1]), toFloat(c * scale[1]),  0.0f, toFloat(offset[0]), toFloat(offset[1]), 1.0f};
}

// Returns the reason why a texture without a supported image is not drawn: it has no image, or only an image in a
// format of an unsupported extension.
std::string withoutImage(const nlohmann::json& texture) {
    std::vector<std::string> formats;
    if (const auto extensions = texture.find("extensions"); extensions != texture.end() && extensions->is_object())
        for (const auto& [name, extension] : extensions->items()) formats.push_back(name);
    if (formats.empty()) return "it has no image";
    return fmt::format("its only image is in the format {}, which is not supported", fmt::join(formats, " and "));
}

// Returns the texture reference `name` of the JSON object `owner`. A texture that cannot be drawn is omitted and listed
// in Source::ignored.
TextureUse textureUse(Source& source, const nlohmann::json& owner, const char* name) {
    TextureUse use;
    const auto found = owner.find(name);
    if (found == owner.end()) return use;
    const int texture = (*found)["index"].get<int>();
    auto uvSet = found->value("texCoord", std::uint64_t{0});
    if (const nlohmann::json* transform = findExtension(*found, "KHR_texture_transform")) {
        use.uvTransform = textureTransform(*transform);
        uvSet = transform->value("texCoord", uvSet);
    }
    if (uvSet > 1) {
        ignore(source, fmt::format("texture with texture coordinate set {}", uvSet), "only sets 0 and 1 are used");
        return use;
    }
    if (source.model.textures[static_cast<std::size_t>(texture)].source < 0) {
        ignore(source, "texture", withoutImage(source.document.json["textures"][static_cast<std::size_t>(texture)]));
        return use;
    }
    use.texture = texture;
    use.uvSet = static_cast<int>(uvSet);
    return use;
}

void readMetallicRoughness(Source& source, const nlohmann::json& json, Material& material) {
    if (json.contains("baseColorFactor"))
        for (int i = 0; i < 4; ++i)
            material.baseColorFactor[i] = toFloat(json["baseColorFactor"][static_cast<std::size_t>(i)].get<double>());
    material.metallicFactor = numberOf(json, "metallicFactor", 1.0);
    material.roughnessFactor = numberOf(json, "roughnessFactor", 1.0);
    material.baseColor = textureUse(source, json, "baseColorTexture");
    material.metallicRoughness = textureUse(source, json, "metallicRoughnessTexture");
}

glm::dvec3 colorOf(const nlohmann::json& json, const char* name) {
    glm::dvec3 color(1);
    if (json.contains(name))
        for (glm::length_t i = 0; i < 3; ++i) color[i] = json[name][static_cast<std::size_t>(i)].get<double>();
    return color;
}

float alphaOf(const nlohmann::json& json) {
    return json.contains("diffuseFactor") ? toFloat(json["diffuseFactor"][3].get<double>()) : 1.0f;
}

// Returns the metalness m for diffuse colour d and specular colour s: the solution of b = d·(1 − max s) / ((1 − 0.04)(1
// − m)) and s = 0.04·(1 − m) + b·m with base colour b, where colours are replaced by their brightness. `left` is 1 −
// max s. Source: Khronos, "Convert between workflows", KHR_materials_pbrSpecularGlossiness.
double metalnessOf(const glm::dvec3& diffuse, const glm::dvec3& specular, double left) {
    const auto brightness = [](const glm::dvec3& c) {
        return std::sqrt(glm::dot(glm::dvec3(0.299, 0.587, 0.114), c * c));
    };
    const double reflected = brightness(specular);
    if (reflected <= dielectricReflectance) return 0;
    const double b = brightness(diffuse) * left / (1 - dielectricReflectance) + reflected - 2 * dielectricReflectance;
    const double root =
        std::sqrt(std::max(b * b - 4 * dielectricReflectance * (dielectricReflectance - reflected), 0.0));
    return std::clamp((root - b) / (2 * dielectricReflectance), 0.0, 1.0);
}

// Converts a material with a specular-glossiness texture, without loss (KHR_materials_specular, "Conversion from
// specular-glossiness"): refractive index 0 stands for a reflectance that equals the specular colour. The
// specular-glossiness texture is also stored as the metallic-roughness texture, until readTextures converts it.
void readSpecularGlossinessTexture(Source& source, const nlohmann::json& json, Material& material) {
    const glm::dvec3 diffuse = colorOf(json, "diffuseFactor");
    material.baseColorFactor = glm::vec4(glm::vec3(diffuse), alphaOf(json));
    material.metallicFactor = 0;
    material.ior = 0;
    material.specularColorFactor = glm::vec3(colorOf(json, "specularFactor"));
    material.specularColor = textureUse(source, json, "specularGlossinessTexture");
    material.metallicRoughness = material.specularColor;
}

// Converts a specular-glossiness material without a specular-glossiness texture to the closest metallic-roughness
// material. The conversion is exact if diffuse and specular colours are the same grey, or if the specular colour is
// 0.04.
void readSpecularGlossinessFactors(const nlohmann::json& json, Material& material) {
    const glm::dvec3 diffuse = colorOf(json, "diffuseFactor");
    const glm::dvec3 specular = colorOf(json, "specularFactor");
    const double left = 1 - std::max({specular.r, specular.g, specular.b});
    const double metalness = metalnessOf(diffuse, specular, left);
    const glm::dvec3 fromDiffuse = diffuse * (left / (1 - dielectricReflectance) / std::max(1 - metalness, minShare));
    const glm::dvec3 fromSpecular =
        (specular - dielectricReflectance * (1 - metalness)) / std::max(metalness, minShare);
    const glm::dvec3 base = glm::clamp(glm::mix(fromDiffuse, fromSpecular, metalness * metalness), 0.0, 1.0);
    material.baseColorFactor = glm::vec4(glm::vec3(base), alphaOf(json));
    material.metallicFactor = toFloat(metalness);
}

void readSpecularGlossiness(Source& source, const nlohmann::json& json, Material& material) {
    material.roughnessFactor = toFloat(1 - std::clamp(json.value("glossinessFactor", 1.0), 0.0, 1.0));
    material.baseColor = textureUse(source, json, "diffuseTexture");
    if (json.contains("specularGlossinessTexture"))
        readSpecularGlossinessTexture(source, json, material);
    else
        readSpecularGlossinessFactors(json, material);
}

glm::vec3 colorOf(const nlohmann::json& json, const char* name, const glm::vec3& otherwise) {
    return json.contains(name) ? glm::max(glm::vec3(colorOf(json, name)), 0.0f) : otherwise;
}

float shareOf(const nlohmann::json& json, const char* name, double otherwise) {
    return std::clamp(numberOf(json, name, otherwise), 0.0f, 1.0f);
}

void readReflectance(Source& source, const nlohmann::json& json, Material& material) {
    if (const nlohmann::json* ior = findExtension(json, "KHR_materials_ior")) {
        const float index = numberOf(*ior, "ior", 1.5);
        material.ior = index > 0 ? std::max(index, 1.0f) : 0.0f;
    }
    const nlohmann::json* specular = findExtension(json, "KHR_materials_specular");
    if (specular == nullptr) return;
    material.specularFactor = shareOf(*specular, "specularFactor", 1);
    material.specularColorFactor = colorOf(*specular, "specularColorFactor", glm::vec3(1));
    material.specular = textureUse(source, *specular, "specularTexture");
    material.specularColor = textureUse(source, *specular, "specularColorTexture");
}

void readTransmission(Source& source, const nlohmann::json& json, Material& material) {
    const nlohmann::json* transmission = findExtension(json, "KHR_materials_transmission");
    if (transmission == nullptr) return;
    material.transmissionFactor = shareOf(*transmission, "transmissionFactor", 0);
    material.transmission = textureUse(source, *transmission, "transmissionTexture");
    const nlohmann::json* volume = findExtension(json, "KHR_materials_volume");
    if (volume == nullptr) return;
    material.thicknessFactor = std::max(numberOf(*volume, "thicknessFactor", 0), 0.0f);
    material.thickness = textureUse(source, *volume, "thicknessTexture");
    material.attenuationColor = glm::min(colorOf(*volume, "attenuationColor", glm::vec3(1)), 1.0f);
    const float distance = numberOf(*volume, "attenuationDistance", 0);
    if (distance > 0) material.attenuationDistance = distance;
}

void readClearcoat(Source& source, const nlohmann::json& json, Material& material) {
    const nlohmann::json* clearcoat = findExtension(json, "KHR_materials_clearcoat");
    if (clearcoat == nullptr) return;
    material.clearcoatFactor = shareOf(*clearcoat, "clearcoatFactor", 0);
    material.clearcoatRoughnessFactor = shareOf(*clearcoat, "clearcoatRoughnessFactor", 0);
    material.clearcoat = textureUse(source, *clearcoat, "clearcoatTexture");
    material.clearcoatRoughness = textureUse(source, *clearcoat, "clearcoatRoughnessTexture");
    material.clearcoatNormal = textureUse(source, *clearcoat, "clearcoatNormalTexture");
    if (clearcoat->contains("clearcoatNormalTexture"))
        material.clearcoatNormalScale = numberOf((*clearcoat)["clearcoatNormalTexture"], "scale", 1);
}

void readSheen(Source& source, const nlohmann::json& json, Material& material) {
    const nlohmann::json* sheen = findExtension(json, "KHR_materials_sheen");
    if (sheen == nullptr) return;
    material.sheenColorFactor = glm::min(colorOf(*sheen, "sheenColorFactor", glm::vec3(0)), 1.0f);
    material.sheenRoughnessFactor = shareOf(*sheen, "sheenRoughnessFactor", 0);
    material.sheenColor = textureUse(source, *sheen, "sheenColorTexture");
    material.sheenRoughness = textureUse(source, *sheen, "sheenRoughnessTexture");
}

void readAnisotropy(Source& source, const nlohmann::json& json, Material& material) {
    const nlohmann::json* anisotropy = findExtension(json, "KHR_materials_anisotropy");
    if (anisotropy == nullptr) return;
    material.anisotropyStrength = shareOf(*anisotropy, "anisotropyStrength", 0);
    material.anisotropyRotation = numberOf(*anisotropy, "anisotropyRotation", 0);
    material.anisotropy = textureUse(source, *anisotropy, "anisotropyTexture");
}

void readIridescence(Source& source, const nlohmann::json& json, Material& material) {
    const nlohmann::json* iridescence = findExtension(json, "KHR_materials_iridescence");
    if (iridescence == nullptr) return;
    material.iridescenceFactor = shareOf(*iridescence, "iridescenceFactor", 0);
    material.iridescenceIor = std::max(numberOf(*iridescence, "iridescenceIor", 1.3), 1.0f);
    material.iridescenceThicknessMinimum = std::max(numberOf(*iridescence, "iridescenceThicknessMinimum", 100), 0.0f);
    material.iridescenceThicknessMaximum = std::max(numberOf(*iridescence, "iridescenceThicknessMaximum", 400), 0.0f);
    material.iridescence = textureUse(source, *iridescence, "iridescenceTexture");
    material.iridescenceThickness = textureUse(source, *iridescence, "iridescenceThicknessTexture");
}

void readDiffuseTransmission(Source& source, const nlohmann::json& json, Material& material) {
    const nlohmann::json* diffuse = findExtension(json, "KHR_materials_diffuse_transmission");
    if (diffuse == nullptr) return;
    material.diffuseTransmissionFactor = shareOf(*diffuse, "diffuseTransmissionFactor", 0);
    material.diffuseTransmissionColorFactor =
        glm::min(colorOf(*diffuse, "diffuseTransmissionColorFactor", glm::vec3(1)), 1.0f);
    material.diffuseTransmission = textureUse(source, *diffuse, "diffuseTransmissionTexture");
    material.diffuseTransmissionColor = textureUse(source, *diffuse, "diffuseTransmissionColorTexture");
}

AlphaMode alphaModeOf(const Source& source, const std::string& name, const std::string& label) {
    if (name == "OPAQUE") return AlphaMode::opaque;
    if (name == "MASK") return AlphaMode::mask;
    if (name == "BLEND") return AlphaMode::blend;
    fault(source.document, "{}: unknown alphaMode '{}'", label, name);
}

// Reads the emission and clamps it to 1e30, so that sums over 65,536 lens samples stay finite in 32-bit floats.
void readEmission(Source& source, const nlohmann::json& json, const std::string& label, Material& material) {
    constexpr double maxEmission = 1e30;
    material.emissive = textureUse(source, json, "emissiveTexture");
    double strength = 1.0;
    if (const nlohmann::json* extension = findExtension(json, "KHR_materials_emissive_strength"))
        strength = extension->value("emissiveStrength", 1.0);
    if (!json.contains("emissiveFactor")) return;
    bool limited = false;
    for (int i = 0; i < 3; ++i) {
        const double emission = strength * json["emissiveFactor"][static_cast<std::size_t>(i)].get<double>();
        limited |= emission > maxEmission;
        material.emissiveFactor[i] = toFloat(std::min(emission, maxEmission));
    }
    if (limited) ignore(source, "emission of " + label, "the value is too large; 1e30 is used");
}

Material readMaterial(Source& source, std::size_t index) {
    const nlohmann::json& json = source.document.json["materials"][index];
    Material material;
    material.name = json.value("name", std::string());
    if (const nlohmann::json* extension = findExtension(json, "KHR_materials_pbrSpecularGlossiness"))
        readSpecularGlossiness(source, *extension, material);
    else if (json.contains("pbrMetallicRoughness"))
        readMetallicRoughness(source, json["pbrMetallicRoughness"], material);

    material.normal = textureUse(source, json, "normalTexture");
    if (json.contains("normalTexture")) material.normalScale = numberOf(json["normalTexture"], "scale", 1.0);
    material.occlusion = textureUse(source, json, "occlusionTexture");
    if (json.contains("occlusionTexture"))
        material.occlusionStrength = numberOf(json["occlusionTexture"], "strength", 1.0);

    readEmission(source, json, labelOf("material", index, material.name), material);
    material.alphaMode =
        alphaModeOf(source, json.value("alphaMode", std::string("OPAQUE")), labelOf("material", index, material.name));
    material.alphaCutoff = numberOf(json, "alphaCutoff", 0.5);
    material.doubleSided = json.value("doubleSided", false);
    material.unlit = findExtension(json, "KHR_materials_unlit") != nullptr;
    if (findExtension(json, "KHR_materials_pbrSpecularGlossiness") == nullptr) readReflectance(source, json, material);
    readTransmission(source, json, material);
    if (const nlohmann::json* dispersion = findExtension(json, "KHR_materials_dispersion"))
        material.dispersion = std::max(numberOf(*dispersion, "dispersion", 0), 0.0f);
    readDiffuseTransmission(source, json, material);
    readAnisotropy(source, json, material);
    readIridescence(source, json, material);
    readClearcoat(source, json, material);
    readSheen(source, json, material);
    return material;
}

}  // namespace

std::vector<Material> readMaterials(Source& source) {
    std::vector<Material> materials;
    const std::size_t count = entryCount(source.document, "materials");
    materials.reserve(count);
    for (std::size_t i = 0; i < count; ++i) materials.push_back(readMaterial(source, i));
    return materials;
}

}  // namespace defocus::engine::gltf
