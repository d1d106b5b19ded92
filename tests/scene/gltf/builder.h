#pragma once
// Builds small glTF files from JSON and binary data, and saves them as .glb.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scene/gltf/gltf.h"
#include "scratch_folder.h"

namespace defocus::engine {

inline const std::vector<float> unitTriangle = {0, 0, 0, 1, 0, 0, 0, 1, 0};  // corner positions

// glTF's component types.
inline constexpr int gltfByte = 5120, gltfUnsignedByte = 5121, gltfShort = 5122, gltfUnsignedShort = 5123,
                     gltfUnsignedInt = 5125, gltfFloat = 5126;

class GltfBuilder {
public:
    nlohmann::json json = {{"asset", {{"version", "2.0"}}}};

    // Appends values as one buffer view and returns its index.
    template <typename T>
    int view(const std::vector<T>& values, int stride = 0) {
        while (binary_.size() % 4 != 0) binary_.push_back(0);
        const std::size_t offset = binary_.size();
        binary_.resize(offset + values.size() * sizeof(T));
        if (!values.empty()) std::memcpy(&binary_[offset], values.data(), values.size() * sizeof(T));
        nlohmann::json entry = {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", values.size() * sizeof(T)}};
        if (stride != 0) entry["byteStride"] = stride;
        return add("bufferViews", entry);
    }

    int accessor(int bufferView, int componentType, const char* type, std::size_t count,
                 const nlohmann::json& more = nlohmann::json::object()) {
        nlohmann::json entry = {{"componentType", componentType}, {"type", type}, {"count", count}};
        if (bufferView >= 0) entry["bufferView"] = bufferView;
        entry.update(more);
        return add("accessors", entry);
    }

    // Adds an accessor for tightly packed floats and returns its index.
    int floats(const std::vector<float>& values, const char* type, std::size_t components) {
        return accessor(view(values), gltfFloat, type, values.size() / components);
    }
    int positions(const std::vector<float>& values) { return floats(values, "VEC3", 3); }
    int indices(const std::vector<std::uint16_t>& values) {
        return accessor(view(values), gltfUnsignedShort, "SCALAR", values.size());
    }

    // Adds a mesh of these primitives, and a scene node that has the mesh and the members of the JSON object `node`.
    // Returns the mesh's index.
    int mesh(const nlohmann::json& primitives, const nlohmann::json& node = nlohmann::json::object()) {
        const int index = add("meshes", {{"primitives", primitives}});
        nlohmann::json entry = {{"mesh", index}};
        entry.update(node);
        add("nodes", entry);
        return index;
    }

    int add(const char* list, const nlohmann::json& entry) {
        json[list].push_back(entry);
        return static_cast<int>(json[list].size()) - 1;
    }

    [[nodiscard]] std::string glb() const {
        nlohmann::json complete = json;
        std::string binary(binary_.begin(), binary_.end());
        if (!binary.empty()) complete["buffers"] = {{{"byteLength", binary.size()}}};
        binary.resize((binary.size() + 3) / 4 * 4);
        std::string text = complete.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        std::string file = "glTF" + word(2) + word(0) + word(text.size()) + "JSON" + text;
        if (!binary.empty()) file += word(binary.size()) + std::string("BIN\0", 4) + binary;
        return file.replace(8, 4, word(file.size()));
    }

    // Saves the file to a temporary folder and returns the loaded scene.
    [[nodiscard]] Scene load() const {
        const ScratchFolder folder;
        save(folder / "built.glb", glb());
        return loadGltf(folder / "built.glb");
    }

    static void save(const std::filesystem::path& path, const std::string& bytes) {
        std::ofstream(path, std::ios::binary) << bytes;
    }

private:
    static std::string word(std::size_t value) {
        std::string bytes(4, '\0');
        for (std::size_t i = 0; i < 4; ++i) bytes[i] = static_cast<char>((value >> (8 * i)) & 0xFF);
        return bytes;
    }

    std::vector<unsigned char> binary_;
};

}  // namespace defocus::engine
