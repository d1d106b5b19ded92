// Source: glTF 2.0 specification, chapter 5 (properties reference), and the specifications of the supported extensions.
#include "scene/gltf/schema.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string_view>

namespace defocus::engine::gltf {

namespace {

using Json = nlohmann::json;

enum class Kind {
    string,
    strings,
    boolean,
    number,
    numbers,    // array of numbers, with `length` entries if `length` > 0
    size,       // integer ≥ 0
    index,      // integer index into the top-level array `target`
    indices,    // array of indices
    indexMap,   // object whose values are indices
    indexMaps,  // array of objects whose values are indices
    object,     // object whose members are listed in `properties`
    objects,    // array of objects whose members are listed in `properties`
};

struct Property {
    std::string_view name;
    Kind kind;
    // Top-level array that the indices refer to; only for the kinds index, indices, indexMap and indexMaps.
    std::string_view target = {};
    std::span<const Property> properties = {};  // members of the object; only for Kind::object and Kind::objects
    std::size_t length = 0;                     // number of entries; 0: any; only for Kind::numbers
    bool required = false;
};

constexpr Property required(Property property) {
    property.required = true;
    return property;
}
constexpr Property numbers(std::string_view name, std::size_t length) {
    return {name, Kind::numbers, {}, {}, length};
}
constexpr Property object(std::string_view name, std::span<const Property> properties) {
    return {name, Kind::object, {}, properties};
}
constexpr Property objects(std::string_view name, std::span<const Property> properties) {
    return {name, Kind::objects, {}, properties};
}
constexpr Property nameProperty{"name", Kind::string};

// ---- buffers and accessors ----------------------------------------------------------------------

constexpr Property bufferProperties[] = {nameProperty, {"uri", Kind::string}, required({"byteLength", Kind::size})};

constexpr Property meshoptProperties[] = {required({"buffer", Kind::index, "buffers"}),
                                          {"byteOffset", Kind::size},
                                          required({"byteLength", Kind::size}),
                                          required({"byteStride", Kind::size}),
                                          required({"count", Kind::size}),
                                          required({"mode", Kind::string}),
                                          {"filter", Kind::string}};
constexpr Property bufferViewExtensions[] = {object("EXT_meshopt_compression", meshoptProperties)};
constexpr Property bufferViewProperties[] = {nameProperty,
                                             required({"buffer", Kind::index, "buffers"}),
                                             {"byteOffset", Kind::size},
                                             required({"byteLength", Kind::size}),
                                             {"byteStride", Kind::size},
                                             {"target", Kind::size},
                                             object("extensions", bufferViewExtensions)};

constexpr Property sparseIndicesProperties[] = {required({"bufferView", Kind::index, "bufferViews"}),
                                                {"byteOffset", Kind::size},
                                                required({"componentType", Kind::size})};
constexpr Property sparseValuesProperties[] = {required({"bufferView", Kind::index, "bufferViews"}),
                                               {"byteOffset", Kind::size}};
constexpr Property sparseProperties[] = {required({"count", Kind::size}),
                                         required(object("indices", sparseIndicesProperties)),
                                         required(object("values", sparseValuesProperties))};
constexpr Property accessorProperties[] = {nameProperty,
                                           {"bufferView", Kind::index, "bufferViews"},
                                           {"byteOffset", Kind::size},
                                           required({"componentType", Kind::size}),
                                           {"normalized", Kind::boolean},
                                           required({"count", Kind::size}),
                                           required({"type", Kind::string}),
                                           {"min", Kind::numbers},
                                           {"max", Kind::numbers},
                                           object("sparse", sparseProperties)};

// ---- meshes -------------------------------------------------------------------------------------

constexpr Property dracoProperties[] = {required({"bufferView", Kind::index, "bufferViews"}),
                                        required({"attributes", Kind::indexMap})};
constexpr Property variantMappingProperties[] = {required(numbers("variants", 0)),
                                                 required({"material", Kind::index, "materials"})};
constexpr Property primitiveVariantsProperties[] = {required(objects("mappings", variantMappingProperties))};
constexpr Property primitiveExtensions[] = {object("KHR_draco_mesh_compression", dracoProperties),
                                            object("KHR_materials_variants", primitiveVariantsProperties)};
constexpr Property primitiveProperties[] = {required({"attributes", Kind::indexMap, "accessors"}),
                                            {"indices", Kind::index, "accessors"},
                                            {"material", Kind::index, "materials"},
                                            {"mode", Kind::size},
                                            {"targets", Kind::indexMaps, "accessors"},
                                            object("extensions", primitiveExtensions)};
constexpr Property meshProperties[] = {
    nameProperty, required(objects("primitives", primitiveProperties)), {"weights", Kind::numbers}};

// ---- materials ----------------------------------------------------------------------------------

constexpr Property textureTransformProperties[] = {
    numbers("offset", 2), {"rotation", Kind::number}, numbers("scale", 2), {"texCoord", Kind::size}};
constexpr Property textureInfoExtensions[] = {object("KHR_texture_transform", textureTransformProperties)};
constexpr Property textureInfoProperties[] = {required({"index", Kind::index, "textures"}),
                                              {"texCoord", Kind::size},
                                              {"scale", Kind::number},
                                              {"strength", Kind::number},
                                              object("extensions", textureInfoExtensions)};
constexpr Property metallicRoughnessProperties[] = {numbers("baseColorFactor", 4),
                                                    object("baseColorTexture", textureInfoProperties),
                                                    {"metallicFactor", Kind::number},
                                                    {"roughnessFactor", Kind::number},
                                                    object("metallicRoughnessTexture", textureInfoProperties)};
constexpr Property emissiveStrengthProperties[] = {{"emissiveStrength", Kind::number}};
constexpr Property specularGlossinessProperties[] = {numbers("diffuseFactor", 4),
                                                     object("diffuseTexture", textureInfoProperties),
                                                     numbers("specularFactor", 3),
                                                     {"glossinessFactor", Kind::number},
                                                     object("specularGlossinessTexture", textureInfoProperties)};
constexpr Property unlitProperties[] = {nameProperty};
constexpr Property iorProperties[] = {{"ior", Kind::number}};
constexpr Property specularProperties[] = {{"specularFactor", Kind::number},
                                           object("specularTexture", textureInfoProperties),
                                           numbers("specularColorFactor", 3),
                                           object("specularColorTexture", textureInfoProperties)};
constexpr Property transmissionProperties[] = {{"transmissionFactor", Kind::number},
                                               object("transmissionTexture", textureInfoProperties)};
constexpr Property volumeProperties[] = {{"thicknessFactor", Kind::number},
                                         object("thicknessTexture", textureInfoProperties),
                                         {"attenuationDistance", Kind::number},
                                         numbers("attenuationColor", 3)};
constexpr Property clearcoatProperties[] = {{"clearcoatFactor", Kind::number},
                                            object("clearcoatTexture", textureInfoProperties),
                                            {"clearcoatRoughnessFactor", Kind::number},
                                            object("clearcoatRoughnessTexture", textureInfoProperties),
                                            object("clearcoatNormalTexture", textureInfoProperties)};
constexpr Property sheenProperties[] = {numbers("sheenColorFactor", 3),
                                        object("sheenColorTexture", textureInfoProperties),
                                        {"sheenRoughnessFactor", Kind::number},
                                        object("sheenRoughnessTexture", textureInfoProperties)};
constexpr Property anisotropyProperties[] = {{"anisotropyStrength", Kind::number},
                                             {"anisotropyRotation", Kind::number},
                                             object("anisotropyTexture", textureInfoProperties)};
constexpr Property iridescenceProperties[] = {{"iridescenceFactor", Kind::number},
                                              {"iridescenceIor", Kind::number},
                                              {"iridescenceThicknessMinimum", Kind::number},
                                              {"iridescenceThicknessMaximum", Kind::number},
                                              object("iridescenceTexture", textureInfoProperties),
                                              object("iridescenceThicknessTexture", textureInfoProperties)};
constexpr Property dispersionProperties[] = {{"dispersion", Kind::number}};
constexpr Property diffuseTransmissionProperties[] = {{"diffuseTransmissionFactor", Kind::number},
                                                      object("diffuseTransmissionTexture", textureInfoProperties),
                                                      numbers("diffuseTransmissionColorFactor", 3),
                                                      object("diffuseTransmissionColorTexture", textureInfoProperties)};
constexpr Property materialExtensions[] = {object("KHR_materials_anisotropy", anisotropyProperties),
                                           object("KHR_materials_diffuse_transmission", diffuseTransmissionProperties),
                                           object("KHR_materials_dispersion", dispersionProperties),
                                           object("KHR_materials_iridescence", iridescenceProperties),
                                           object("KHR_materials_clearcoat", clearcoatProperties),
                                           object("KHR_materials_emissive_strength", emissiveStrengthProperties),
                                           object("KHR_materials_ior", iorProperties),
                                           object("KHR_materials_pbrSpecularGlossiness", specularGlossinessProperties),
                                           object("KHR_materials_sheen", sheenProperties),
                                           object("KHR_materials_specular", specularProperties),
                                           object("KHR_materials_transmission", transmissionProperties),
                                           object("KHR_materials_unlit", unlitProperties),
                                           object("KHR_materials_volume", volumeProperties)};
constexpr Property materialProperties[] = {nameProperty,
                                           object("pbrMetallicRoughness", metallicRoughnessProperties),
                                           object("normalTexture", textureInfoProperties),
                                           object("occlusionTexture", textureInfoProperties),
                                           object("emissiveTexture", textureInfoProperties),
                                           numbers("emissiveFactor", 3),
                                           {"alphaMode", Kind::string},
                                           {"alphaCutoff", Kind::number},
                                           {"doubleSided", Kind::boolean},
                                           object("extensions", materialExtensions)};
constexpr Property imageProperties[] = {
    nameProperty, {"uri", Kind::string}, {"mimeType", Kind::string}, {"bufferView", Kind::index, "bufferViews"}};
constexpr Property samplerProperties[] = {
    nameProperty, {"magFilter", Kind::size}, {"minFilter", Kind::size}, {"wrapS", Kind::size}, {"wrapT", Kind::size}};
constexpr Property webpProperties[] = {{"source", Kind::index, "images"}};
constexpr Property textureExtensions[] = {object("EXT_texture_webp", webpProperties)};
constexpr Property textureProperties[] = {nameProperty,
                                          {"sampler", Kind::index, "samplers"},
                                          {"source", Kind::index, "images"},
                                          object("extensions", textureExtensions)};

// ---- hierarchy ----------------------------------------------------------------------------------

constexpr Property instancingProperties[] = {required({"attributes", Kind::indexMap, "accessors"})};
constexpr Property nodeLightProperties[] = {required({"light", Kind::size})};
constexpr Property visibilityProperties[] = {{"visible", Kind::boolean}};
constexpr Property nodeExtensions[] = {object("EXT_mesh_gpu_instancing", instancingProperties),
                                       object("KHR_lights_punctual", nodeLightProperties),
                                       object("KHR_node_visibility", visibilityProperties)};
constexpr Property nodeProperties[] = {nameProperty,
                                       {"camera", Kind::index, "cameras"},
                                       {"children", Kind::indices, "nodes"},
                                       {"skin", Kind::index, "skins"},
                                       numbers("matrix", 16),
                                       {"mesh", Kind::index, "meshes"},
                                       numbers("rotation", 4),
                                       numbers("scale", 3),
                                       numbers("translation", 3),
                                       {"weights", Kind::numbers},
                                       object("extensions", nodeExtensions)};
constexpr Property sceneProperties[] = {nameProperty, {"nodes", Kind::indices, "nodes"}};
constexpr Property skinProperties[] = {nameProperty,
                                       {"inverseBindMatrices", Kind::index, "accessors"},
                                       {"skeleton", Kind::index, "nodes"},
                                       required({"joints", Kind::indices, "nodes"})};

constexpr Property perspectiveProperties[] = {{"aspectRatio", Kind::number},
                                              required({"yfov", Kind::number}),
                                              {"zfar", Kind::number},
                                              required({"znear", Kind::number})};
constexpr Property orthographicProperties[] = {
    {"xmag", Kind::number}, {"ymag", Kind::number}, {"zfar", Kind::number}, {"znear", Kind::number}};
// EXT_camera_physical, draft of July 2026 in the glTF repository; lengths in metres.
constexpr Property physicalCameraProperties[] = {required({"focalLength", Kind::number}),
                                                 required(numbers("sensorSize", 2)),
                                                 {"fStop", Kind::number},
                                                 {"focusDistance", Kind::number}};
constexpr Property cameraExtensions[] = {object("EXT_camera_physical", physicalCameraProperties)};
constexpr Property cameraProperties[] = {
    nameProperty, required({"type", Kind::string}), object("perspective", perspectiveProperties),
    object("orthographic", orthographicProperties), object("extensions", cameraExtensions)};

constexpr Property spotProperties[] = {{"innerConeAngle", Kind::number}, {"outerConeAngle", Kind::number}};
constexpr Property lightProperties[] = {nameProperty,
                                        required({"type", Kind::string}),
                                        numbers("color", 3),
                                        {"intensity", Kind::number},
                                        {"range", Kind::number},
                                        object("spot", spotProperties)};
constexpr Property lightsProperties[] = {required(objects("lights", lightProperties))};

// ---- animation ----------------------------------------------------------------------------------

constexpr Property animationPointerProperties[] = {required({"pointer", Kind::string})};
constexpr Property animationTargetExtensions[] = {object("KHR_animation_pointer", animationPointerProperties)};
constexpr Property animationTargetProperties[] = {
    {"node", Kind::index, "nodes"}, required({"path", Kind::string}), object("extensions", animationTargetExtensions)};
constexpr Property animationChannelProperties[] = {required({"sampler", Kind::size}),
                                                   required(object("target", animationTargetProperties))};
constexpr Property animationSamplerProperties[] = {required({"input", Kind::index, "accessors"}),
                                                   {"interpolation", Kind::string},
                                                   required({"output", Kind::index, "accessors"})};
constexpr Property animationProperties[] = {nameProperty, required(objects("channels", animationChannelProperties)),
                                            required(objects("samplers", animationSamplerProperties))};

// ---- properties of the root object --------------------------------------------------------------

constexpr Property variantProperties[] = {required({"name", Kind::string})};
constexpr Property variantsProperties[] = {required(objects("variants", variantProperties))};
constexpr Property rootExtensions[] = {object("KHR_lights_punctual", lightsProperties),
                                       object("KHR_materials_variants", variantsProperties)};
constexpr Property rootProperties[] = {
    {"extensionsUsed", Kind::strings},        {"extensionsRequired", Kind::strings},
    objects("accessors", accessorProperties), objects("animations", animationProperties),
    objects("buffers", bufferProperties),     objects("bufferViews", bufferViewProperties),
    objects("cameras", cameraProperties),     objects("images", imageProperties),
    objects("materials", materialProperties), objects("meshes", meshProperties),
    objects("nodes", nodeProperties),         objects("samplers", samplerProperties),
    {"scene", Kind::index, "scenes"},         objects("scenes", sceneProperties),
    objects("skins", skinProperties),         objects("textures", textureProperties),
    object("extensions", rootExtensions)};

// ---- validation ---------------------------------------------------------------------------------

// JSON numbers represent all integers exactly only up to 2^53.
constexpr std::uint64_t largestSize = 1ull << 53;

// Position in the document, such as "nodes[3].mesh". The position becomes text only for an error message, because a
// file may have millions of properties.
class Place {
public:
    Place() = default;  // the root object of the document
    [[nodiscard]] Place property(std::string_view name) const { return {this, name, noIndex}; }
    [[nodiscard]] Place entry(std::size_t index) const { return {this, {}, index}; }

    [[nodiscard]] std::string text() const {
        if (parent_ == nullptr) return "";
        const std::string before = parent_->text();
        if (index_ != noIndex) return fmt::format("{}[{}]", before, index_);
        return before.empty() ? std::string(name_) : fmt::format("{}.{}", before, name_);
    }

private:
    static constexpr std::size_t noIndex = std::numeric_limits<std::size_t>::max();

    Place(const Place* parent, std::string_view name, std::size_t index)
        : parent_(parent), name_(name), index_(index) {}

    const Place* parent_ = nullptr;
    std::string_view name_;
    std::size_t index_ = noIndex;  // index in the array; noIndex for a member of an object
};

class Checker {
public:
    explicit Checker(Document& document) : document_(document) {}

    void checkObject(Json& json, std::span<const Property> properties, const Place& place) {
        if (!json.is_object()) fault(document_, "{} must be an object", place.text());
        for (const Property& property : properties) {
            const auto found = json.find(property.name);
            if (found == json.end() && !property.required) continue;
            const Place inside = place.property(property.name);
            if (found != json.end())
                checkValue(*found, property, inside);
            else
                fault(document_, "{} is missing", inside.text());
        }
    }

private:
    void checkValue(Json& json, const Property& property, const Place& place) {
        switch (property.kind) {
            case Kind::string:
                if (!json.is_string()) fault(document_, "{} must be a string", place.text());
                break;
            case Kind::boolean:
                if (!json.is_boolean()) fault(document_, "{} must be true or false", place.text());
                break;
            case Kind::number:
                if (!json.is_number()) fault(document_, "{} must be a number", place.text());
                break;
            case Kind::size:
                checkSize(json, place);
                break;
            case Kind::index:
                checkIndex(json, property.target, place);
                break;
            case Kind::indexMap:
                checkIndexMap(json, property.target, place);
                break;
            case Kind::object:
                checkObject(json, property.properties, place);
                break;
            case Kind::strings:
            case Kind::numbers:
            case Kind::indices:
            case Kind::indexMaps:
            case Kind::objects:
                checkArray(json, property, place);
                break;
        }
    }

    void checkArray(Json& json, const Property& property, const Place& place) {
        if (!json.is_array()) fault(document_, "{} must be an array", place.text());
        if (property.length != 0 && json.size() != property.length)
            fault(document_, "{} must have {} numbers, not {}", place.text(), property.length, json.size());
        Property entry = property;
        switch (property.kind) {
            case Kind::strings:
                entry.kind = Kind::string;
                break;
            case Kind::numbers:
                if (std::all_of(json.begin(), json.end(), [](const Json& number) { return number.is_number(); }))
                    return;
                fault(document_, "{} must hold numbers only", place.text());
            case Kind::indices:
                entry.kind = Kind::index;
                break;
            case Kind::indexMaps:
                entry.kind = Kind::indexMap;
                break;
            default:
                entry.kind = Kind::object;
                break;
        }
        for (std::size_t i = 0; i < json.size(); ++i) checkValue(json[i], entry, place.entry(i));
    }

    void checkIndexMap(Json& json, std::string_view target, const Place& place) {
        if (!json.is_object()) fault(document_, "{} must be an object", place.text());
        for (auto entry = json.begin(); entry != json.end(); ++entry) {
            const Place inside = place.property(entry.key());
            if (target.empty())
                checkSize(*entry, inside);
            else
                checkIndex(*entry, target, inside);
        }
    }

    void checkSize(Json& json, const Place& place) {
        if (json.is_number_float()) {
            const auto number = json.get<double>();
            if (number >= 0 && number <= static_cast<double>(largestSize) && number == std::floor(number))
                json = static_cast<std::uint64_t>(number);
        }
        if (!json.is_number_integer() || (!json.is_number_unsigned() && json.get<std::int64_t>() < 0))
            fault(document_, "{} must be an integer of at least 0", place.text());
        if (json.get<std::uint64_t>() > largestSize) fault(document_, "{} is too large", place.text());
    }

    void checkIndex(Json& json, std::string_view target, const Place& place) {
        checkSize(json, place);
        const std::size_t count = entryCount(document_, target);
        if (json.get<std::uint64_t>() >= std::min<std::uint64_t>(count, std::numeric_limits<int>::max()))
            fault(document_, "{} is {}, but the file has {} {}", place.text(), json.get<std::uint64_t>(), count,
                  target);
    }

    Document& document_;
};

}  // namespace

void checkSchema(Document& document) {
    Checker(document).checkObject(document.json, rootProperties, Place());
}

}  // namespace defocus::engine::gltf
