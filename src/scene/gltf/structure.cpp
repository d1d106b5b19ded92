// Calls tinygltf's per-object parsers, which are available only where its implementation is compiled. tinygltf's public
// interface would parse the JSON text again.
#define TINYGLTF_IMPLEMENTATION
#include "scene/gltf/structure.h"

namespace defocus::engine::gltf {

namespace {

using Json = nlohmann::json;

constexpr bool keepText = false;  // tinygltf need not store extras and extensions: Document::json has them

// Converts each entry of the array `owner[name]` to an element of `objects` with `read`. Does nothing if the array does
// not exist. Throws Error, with tinygltf's message, if `read` returns false.
template <typename Object, typename Read>
void readEach(const Document& document, const Json& owner, const char* name, std::vector<Object>& objects,
              const Read& read) {
    const auto entries = owner.find(name);
    if (entries == owner.end()) return;
    objects.resize(entries->size());
    std::string error;
    for (std::size_t i = 0; i < objects.size(); ++i)
        if (!read(objects[i], error, (*entries)[i])) fault(document, "not valid glTF: {}", error);
}

// Throws Error if tinygltf has silently dropped primitives that it cannot read.
void checkPrimitives(const Document& document, const tinygltf::Model& model) {
    for (std::size_t m = 0; m < model.meshes.size(); ++m)
        if (model.meshes[m].primitives.size() != document.json["meshes"][m]["primitives"].size())
            fault(document, "mesh {}: a primitive cannot be read", m);
}

}  // namespace

tinygltf::Model readStructure(Document& document) {
    using namespace tinygltf;
    Json& json = document.json;
    Model model;
    readEach(document, json, "bufferViews", model.bufferViews, [](BufferView& view, auto& error, const Json& entry) {
        return ParseBufferView(&view, &error, entry, keepText);
    });
    readEach(document, json, "accessors", model.accessors, [](Accessor& accessor, auto& error, const Json& entry) {
        return ParseAccessor(&accessor, &error, entry, keepText);
    });
    json.erase("accessors");  // frees memory for the meshes; `model` holds all accessors
    readEach(document, json, "meshes", model.meshes, [&](Mesh& mesh, auto& error, const Json& entry) {
        return ParseMesh(&mesh, &model, &error, entry, keepText);
    });
    checkPrimitives(document, model);
    readEach(document, json, "nodes", model.nodes,
             [](Node& node, auto& error, const Json& entry) { return ParseNode(&node, &error, entry, keepText); });
    readEach(document, json, "textures", model.textures, [](Texture& texture, auto& error, const Json& entry) {
        return ParseTexture(&texture, &error, entry, keepText, "");
    });
    readEach(document, json, "animations", model.animations, [](Animation& animation, auto& error, const Json& entry) {
        return ParseAnimation(&animation, &error, entry, keepText);
    });
    readEach(document, json, "skins", model.skins,
             [](Skin& skin, auto& error, const Json& entry) { return ParseSkin(&skin, &error, entry, keepText); });
    readEach(document, json, "samplers", model.samplers, [](Sampler& sampler, auto& error, const Json& entry) {
        return ParseSampler(&sampler, &error, entry, keepText);
    });
    readEach(document, json, "cameras", model.cameras, [](Camera& camera, auto& error, const Json& entry) {
        return ParseCamera(&camera, &error, entry, keepText);
    });
    const auto extensions = json.find("extensions");
    if (extensions == json.end() || !extensions->contains("KHR_lights_punctual")) return model;
    readEach(document, (*extensions)["KHR_lights_punctual"], "lights", model.lights,
             [](Light& light, auto& error, const Json& entry) { return ParseLight(&light, &error, entry, keepText); });
    return model;
}

}  // namespace defocus::engine::gltf
