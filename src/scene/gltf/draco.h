#pragma once
// KHR_draco_mesh_compression: a primitive's triangles and attributes out of one compressed buffer view. Internal to the
// loader.

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "scene/gltf/source.h"

namespace defocus::engine::gltf {

// A decoded primitive; attributes are read from it by name in place of their accessors' (absent) data.
class DracoPrimitive {
public:
    // Decodes the extension object `json` of a primitive. Throws Error naming `what` for data that does not decode.
    DracoPrimitive(Source& source, const nlohmann::json& json, const std::string& what);
    ~DracoPrimitive();
    DracoPrimitive(DracoPrimitive&&) noexcept;
    DracoPrimitive& operator=(DracoPrimitive&&) noexcept;

    [[nodiscard]] std::size_t vertexCount() const;
    [[nodiscard]] std::vector<std::uint32_t> triangles() const;
    [[nodiscard]] bool has(const std::string& attribute) const;
    // `components` floats a vertex, integers divided by `scale` (see normalisationScale).
    [[nodiscard]] std::vector<float> floats(const Source& source, const std::string& attribute, int components,
                                            double scale) const;

private:
    struct Decoded;
    std::unique_ptr<Decoded> decoded_;
    std::map<std::string, std::uint32_t> ids_;
    std::string what_;
};

}  // namespace defocus::engine::gltf
