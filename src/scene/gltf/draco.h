#pragma once
// KHR_draco_mesh_compression: decodes a primitive's triangles and attributes from one compressed buffer view. Internal
// to the glTF loader.

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "scene/gltf/source.h"

namespace defocus::engine::gltf {

// Decoded primitive with its attributes by name. The file's accessors of these attributes have no data.
class DracoPrimitive {
public:
    // Decodes the primitive that extension object `json` describes. Throws Error, with `what` in its message, if the
    // data is invalid.
    DracoPrimitive(Source& source, const nlohmann::json& json, const std::string& what);
    ~DracoPrimitive();
    DracoPrimitive(DracoPrimitive&&) noexcept;
    DracoPrimitive& operator=(DracoPrimitive&&) noexcept;

    [[nodiscard]] std::size_t vertexCount() const;
    [[nodiscard]] std::vector<std::uint32_t> triangles() const;
    [[nodiscard]] bool has(const std::string& attribute) const;
    // Returns an attribute as `components` floats per vertex; integers are divided by `scale` (see normalisationScale).
    [[nodiscard]] std::vector<float> floats(const Source& source, const std::string& attribute, int components,
                                            double scale) const;

private:
    struct Decoded;
    std::unique_ptr<Decoded> decoded_;
    std::map<std::string, std::uint32_t> ids_;
    std::string what_;
};

}  // namespace defocus::engine::gltf
