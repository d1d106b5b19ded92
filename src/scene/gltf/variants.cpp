#include "scene/gltf/variants.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "scene/gltf/source.h"

namespace defocus::engine::gltf {

std::vector<std::string> variantNames(const Document& document) {
    std::vector<std::string> names;
    const nlohmann::json* extension = findExtension(document.json, "KHR_materials_variants");
    if (extension == nullptr) return names;
    for (const nlohmann::json& variant : (*extension)["variants"]) names.push_back(variant["name"].get<std::string>());
    return names;
}

void chooseVariant(Document& document, const std::string& name) {
    const std::vector<std::string> names = variantNames(document);
    const auto found = std::ranges::find(names, name);
    if (found == names.end())
        fault(document, "there is no variant '{}'; {}", name,
              names.empty() ? "the file has no variants" : fmt::format("the file has: {}", fmt::join(names, ", ")));
    const nlohmann::json chosen = found - names.begin();
    if (!document.json.contains("meshes")) return;
    for (nlohmann::json& mesh : document.json["meshes"])
        for (nlohmann::json& primitive : mesh["primitives"]) {
            const nlohmann::json* extension = findExtension(primitive, "KHR_materials_variants");
            if (extension == nullptr) continue;
            for (const nlohmann::json& mapping : (*extension)["mappings"])
                if (std::ranges::count(mapping["variants"], chosen) > 0)
                    primitive["material"] = mapping["material"].get<int>();
        }
}

}  // namespace defocus::engine::gltf
