// Decodes KHR_draco_mesh_compression (Khronos glTF extension) with Google's Draco library.
#include "scene/gltf/draco.h"

#include <draco/compression/decode.h>
#include <draco/mesh/mesh.h>

#include <algorithm>
#include <array>
#include <new>
#include <stdexcept>

namespace defocus::engine::gltf {

struct DracoPrimitive::Decoded {
    std::unique_ptr<draco::Mesh> mesh;
};

namespace {

// Converts one vertex's value of an attribute to floats; integers are divided by `scale`. Returns false if the stored
// type cannot be converted.
bool convert(const draco::PointAttribute& attribute, draco::AttributeValueIndex index, int components, double scale,
             float* result) {
    if (attribute.data_type() == draco::DT_FLOAT32)
        return attribute.ConvertValue<float>(index, static_cast<std::int8_t>(components), result);
    std::array<std::int32_t, 4> integers{};
    if (!attribute.ConvertValue<std::int32_t>(index, static_cast<std::int8_t>(components), integers.data()))
        return false;
    for (int i = 0; i < components; ++i) {
        const double value = integers[static_cast<std::size_t>(i)];
        result[i] = static_cast<float>(scale != 1.0 ? std::max(value / scale, -1.0) : value);
    }
    return true;
}

}  // namespace

DracoPrimitive::DracoPrimitive(Source& source, const nlohmann::json& json, const std::string& what)
    : decoded_(std::make_unique<Decoded>()), what_(what + ": KHR_draco_mesh_compression") {
    for (const auto& [name, id] : json["attributes"].items()) ids_[name] = id.get<std::uint32_t>();

    const std::span<const std::byte> bytes = viewBytes(source, json["bufferView"].get<int>());
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    try {
        draco::Decoder decoder;
        auto result = decoder.DecodeMeshFromBuffer(&buffer);
        if (!result.ok())
            fault(source.document, "{}: the data is damaged ({})", what_, result.status().error_msg_string());
        decoded_->mesh = std::move(result).value();
    } catch (const std::bad_alloc&) {
        fault(source.document, "{}: the data is damaged (it requests more memory than is available)", what_);
    } catch (const std::length_error&) {
        fault(source.document, "{}: the data is damaged (it requests an impossible amount of memory)", what_);
    }
    takeBudget(source, decoded_->mesh->num_points(), 32, what_);
    takeBudget(source, decoded_->mesh->num_faces(), 12, what_);
}

DracoPrimitive::~DracoPrimitive() = default;
DracoPrimitive::DracoPrimitive(DracoPrimitive&&) noexcept = default;
DracoPrimitive& DracoPrimitive::operator=(DracoPrimitive&&) noexcept = default;

std::size_t DracoPrimitive::vertexCount() const {
    return decoded_->mesh->num_points();
}

std::vector<std::uint32_t> DracoPrimitive::triangles() const {
    std::vector<std::uint32_t> result;
    result.reserve(std::size_t{3} * decoded_->mesh->num_faces());
    for (draco::FaceIndex face(0); face < decoded_->mesh->num_faces(); ++face)
        for (const draco::PointIndex& point : decoded_->mesh->face(face)) result.push_back(point.value());
    return result;
}

bool DracoPrimitive::has(const std::string& attribute) const {
    return ids_.contains(attribute);
}

std::vector<float> DracoPrimitive::floats(const Source& source, const std::string& attribute, int components,
                                          double scale) const {
    const draco::PointAttribute* data = decoded_->mesh->GetAttributeByUniqueId(ids_.at(attribute));
    if (data == nullptr)
        fault(source.document, "{}: the compressed data has no attribute {} for {}", what_, ids_.at(attribute),
              attribute);
    if (data->num_components() != components)
        fault(source.document, "{}: {} has {} components, not {}", what_, attribute, data->num_components(),
              components);
    const auto perVertex = static_cast<std::size_t>(components);
    std::vector<float> result(vertexCount() * perVertex);
    for (std::size_t i = 0; i < vertexCount(); ++i) {
        const draco::AttributeValueIndex index = data->mapped_index(draco::PointIndex(static_cast<std::uint32_t>(i)));
        if (index.value() >= data->size() || !convert(*data, index, components, scale, &result[i * perVertex]))
            fault(source.document, "{}: {} of vertex {} cannot be read", what_, attribute, i);
    }
    return result;
}

}  // namespace defocus::engine::gltf
