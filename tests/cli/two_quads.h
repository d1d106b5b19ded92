#pragma once
// Writes a glTF file with two squares that face the camera at the origin. The camera has a 50 mm
// lens, a sensor 36 mm wide and the aspect ratio 4:3.
//   "Near", 0.4 m wide, centre (0, 0.3, −2): in the upper half of the image.
//   "Far", 3 m wide, centre (3, 0, −8): at the right.

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

namespace defocus::engine {

namespace two_quads_detail {

inline std::string base64(const std::string& bytes) {
    constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        for (std::size_t k = 0; k < count; ++k)
            group |= std::uint32_t{static_cast<unsigned char>(bytes[i + k])} << (16 - 8 * k);
        for (std::size_t k = 0; k < 4; ++k) text += k <= count ? digits[group >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

// Returns the vertex positions of a unit square in the plane z = 0 as bytes: two triangles without an index buffer.
inline std::string unitSquare() {
    const std::array<float, 18> positions = {-.5f, -.5f, 0, .5f, -.5f, 0, .5f,  .5f, 0,
                                             -.5f, -.5f, 0, .5f, .5f,  0, -.5f, .5f, 0};
    std::string bytes(sizeof positions, '\0');
    std::memcpy(bytes.data(), positions.data(), sizeof positions);
    return bytes;
}

}  // namespace two_quads_detail

inline void writeTwoQuads(const std::filesystem::path& path) {
    using nlohmann::json;
    const std::string square = two_quads_detail::unitSquare();
    const json document = {
        {"asset", {{"version", "2.0"}}},
        {"scene", 0},
        {"scenes", {{{"nodes", {0, 1, 2}}}}},
        {"nodes",
         {{{"name", "Near"}, {"mesh", 0}, {"translation", {0, 0.3, -2}}, {"scale", {0.4, 0.4, 0.4}}},
          {{"name", "Far"}, {"mesh", 0}, {"translation", {3, 0, -8}}, {"scale", {3, 3, 3}}},
          {{"name", "Tripod"}, {"camera", 0}}}},
        {"cameras",
         {{{"name", "Main"},
           {"type", "perspective"},
           {"perspective", {{"yfov", 2 * std::atan(0.27)}, {"aspectRatio", 4.0 / 3}, {"znear", 0.1}}}}}},
        {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"material", 0}}}}}}},
        {"materials", {{{"pbrMetallicRoughness", {{"baseColorFactor", {0.8, 0.2, 0.1, 1}}}}}}},
        {"accessors",
         {{{"bufferView", 0},
           {"componentType", 5126},
           {"count", 6},
           {"type", "VEC3"},
           {"min", {-0.5, -0.5, 0}},
           {"max", {0.5, 0.5, 0}}}}},
        {"bufferViews", {{{"buffer", 0}, {"byteLength", square.size()}}}},
        {"buffers",
         {{{"byteLength", square.size()},
           {"uri", "data:application/octet-stream;base64," + two_quads_detail::base64(square)}}}}};
    std::ofstream(path) << document.dump(2);
}

}  // namespace defocus::engine
