// Source: glTF 2.0 specification, 3.7.2 (meshes).
#include "scene/gltf/attributes.h"

#include <algorithm>
#include <cmath>
#include <glm/ext/vector_float1.hpp>
#include <glm/geometric.hpp>

#include "core/bounds.h"
#include "scene/gltf/accessor.h"

namespace defocus::engine::gltf {

namespace {

class AttributeReader {
public:
    AttributeReader(Source& source, const tinygltf::Primitive& primitive, const DracoPrimitive* draco, std::string what)
        : source_(source), primitive_(primitive), draco_(draco), what_(std::move(what)) {
        count_ =
            draco_ != nullptr ? draco_->vertexCount() : elementCount(source_, primitive_.attributes.at("POSITION"));
    }

    void checkCounts() const {
        for (const auto& [name, accessor] : primitive_.attributes)
            if (draco_ == nullptr || !draco_->has(name)) checkCount(name, accessor);
        for (const auto& target : primitive_.targets)
            for (const auto& [name, accessor] : target) checkCount("morph target " + name, accessor);
    }

    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] bool has(const std::string& name) const { return primitive_.attributes.contains(name); }
    [[nodiscard]] int components(const std::string& name) const {
        return componentCount(source_, primitive_.attributes.at(name));
    }

    // Returns the values of attribute `name`; empty if the primitive lacks this attribute.
    template <typename Vector>
    std::vector<Vector> read(const std::string& name) const {
        const auto found = primitive_.attributes.find(name);
        if (found == primitive_.attributes.end()) return {};
        if (draco_ == nullptr || !draco_->has(name)) return readVectors<Vector>(source_, found->second, label(name));
        const std::vector<float> floats =
            draco_->floats(source_, name, Vector::length(), normalisationScale(source_, found->second));
        std::vector<Vector> result(count_);
        for (std::size_t i = 0; i < count_; ++i)
            for (int c = 0; c < Vector::length(); ++c)
                result[i][c] = floats[i * static_cast<std::size_t>(Vector::length()) + static_cast<std::size_t>(c)];
        return result;
    }

    std::vector<MorphTarget> readTargets() const {
        std::vector<MorphTarget> result;
        for (const auto& target : primitive_.targets)
            result.push_back(
                {displacements(target, "POSITION"), displacements(target, "NORMAL"), displacements(target, "TANGENT")});
        return result;
    }

private:
    [[nodiscard]] std::string label(const std::string& name) const { return what_ + ": " + name; }

    void checkCount(const std::string& name, int accessor) const {
        const std::size_t elements = elementCount(source_, accessor);
        if (elements != count_)
            fault(source_.document, "{} has {} elements, but POSITION has {}", label(name), elements, count_);
    }

    [[nodiscard]] std::vector<glm::vec3> displacements(const std::map<std::string, int>& target,
                                                       const char* name) const {
        const auto found = target.find(name);
        if (found == target.end()) return {};
        std::vector<glm::vec3> result = readVectors<glm::vec3>(source_, found->second, label("morph target"));
        for (glm::vec3& displacement : result)
            if (!std::isfinite(glm::dot(displacement, displacement))) displacement = glm::vec3(0);
        return result;
    }

    Source& source_;
    const tinygltf::Primitive& primitive_;
    const DracoPrimitive* draco_;
    std::string what_;
    std::size_t count_ = 0;
};

// Returns vertex colours as RGBA, clamped to [0, 1] as glTF requires.
std::vector<glm::vec4> readColors(const AttributeReader& reader) {
    std::vector<glm::vec4> result;
    if (!reader.has("COLOR_0")) return result;
    if (reader.components("COLOR_0") == 3) {
        result.reserve(reader.count());
        for (const glm::vec3& color : reader.read<glm::vec3>("COLOR_0")) result.emplace_back(color, 1);
    } else {
        result = reader.read<glm::vec4>("COLOR_0");
    }
    for (glm::vec4& color : result)
        for (glm::length_t c = 0; c < 4; ++c)
            color[c] = std::clamp(std::isfinite(color[c]) ? color[c] : 0.0f, 0.0f, 1.0f);
    return result;
}

std::vector<glm::u16vec4> readJoints(Source& source, const AttributeReader& reader, const char* name,
                                     const std::string& what) {
    std::vector<glm::u16vec4> result;
    for (const glm::vec4& joints : reader.read<glm::vec4>(name)) {
        for (int i = 0; i < 4; ++i)
            if (!(joints[i] >= 0 && joints[i] <= 65535))
                fault(source.document, "{}: {} has values that are not joint indices", what, name);
        result.emplace_back(joints);
    }
    return result;
}

constexpr float maxBlur = 1e6f;  // max of _COC… attributes, which are in mm or multiples of the lens's blur

// Returns the scalar attribute `name` per vertex; empty if the primitive lacks it. Throws Error for values outside
// [min, maxBlur].
std::vector<float> readScalars(Source& source, const AttributeReader& reader, const char* name, float min,
                               const std::string& what) {
    if (!reader.has(name)) return {};
    if (reader.components(name) != 1)
        fault(source.document, "{}: {} must have one component per vertex, not {}", what, name,
              reader.components(name));
    std::vector<float> values;
    for (const glm::vec1& value : reader.read<glm::vec1>(name)) {
        if (!(value.x >= min && value.x <= maxBlur))
            fault(source.document, "{}: {} of vertex {} is {}; it must be from {} to {}", what, name, values.size(),
                  value.x, min, maxBlur);
        values.push_back(value.x);
    }
    return values;
}

// Returns the blur per vertex, _COC_SCALE · c + _COC_OFFSET. c is the attribute _COC, or changes linearly from _COC_0
// to _COC_1 during the exposure. Without these attributes, c is the lens's circle of confusion.
std::vector<VertexBlur> readBlurs(Source& source, const AttributeReader& reader, const std::string& what) {
    const std::vector<float> scales = readScalars(source, reader, "_COC_SCALE", 0, what);
    const std::vector<float> offsets = readScalars(source, reader, "_COC_OFFSET", -maxBlur, what);
    if (reader.has("_COC_0") != reader.has("_COC_1"))
        fault(source.document,
              "{}: _COC_0 and _COC_1 must be given together: the blur when the shutter opens and when it closes", what);
    const bool pair = reader.has("_COC_0");
    if (pair && reader.has("_COC")) fault(source.document, "{}: _COC cannot be combined with _COC_0 and _COC_1", what);
    const std::vector<float> opening = readScalars(source, reader, pair ? "_COC_0" : "_COC", -maxBlur, what);
    const std::vector<float> closing = pair ? readScalars(source, reader, "_COC_1", -maxBlur, what) : opening;
    if (scales.empty() && offsets.empty() && opening.empty()) return {};
    std::vector<VertexBlur> blurs(reader.count());
    for (std::size_t i = 0; i < blurs.size(); ++i) {
        const float scale = scales.empty() ? 1 : scales[i];
        const float offset = offsets.empty() ? 0 : offsets[i];
        blurs[i] = opening.empty() ? VertexBlur{scale, offset, offset}
                                   : VertexBlur{0, scale * opening[i] + offset, scale * closing[i] + offset};
    }
    return blurs;
}

std::vector<glm::vec2> readTextureCoordinates(const AttributeReader& reader, const std::string& name) {
    std::vector<glm::vec2> result = reader.read<glm::vec2>(name);
    for (glm::vec2& uv : result)
        if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) uv = glm::vec2(0);
    return result;
}

}  // namespace

VertexBlock readAttributes(Source& source, const tinygltf::Primitive& primitive, const DracoPrimitive* draco,
                           const std::string& what) {
    const AttributeReader reader(source, primitive, draco, what);
    reader.checkCounts();
    VertexBlock block;
    block.vertices.positions = reader.read<glm::vec3>("POSITION");
    block.vertices.normals = reader.read<glm::vec3>("NORMAL");
    if (!block.vertices.normals.empty()) block.vertices.tangents = reader.read<glm::vec4>("TANGENT");
    block.vertices.uv0 = readTextureCoordinates(reader, "TEXCOORD_0");
    block.vertices.uv1 = readTextureCoordinates(reader, "TEXCOORD_1");
    block.vertices.colors = readColors(reader);
    if (reader.has("WEIGHTS_0")) {
        block.vertices.joints = readJoints(source, reader, "JOINTS_0", what);
        block.vertices.weights = reader.read<glm::vec4>("WEIGHTS_0");
    }
    if (block.vertices.joints.empty()) block.vertices.weights.clear();
    if (!block.vertices.joints.empty() && reader.has("WEIGHTS_1")) {
        block.vertices.joints1 = readJoints(source, reader, "JOINTS_1", what);
        block.vertices.weights1 = reader.read<glm::vec4>("WEIGHTS_1");
    }
    if (block.vertices.joints1.empty()) block.vertices.weights1.clear();
    block.vertices.blurs = readBlurs(source, reader, what);
    block.morphTargets = reader.readTargets();
    return block;
}

std::uint64_t dropUnplaced(Source& source, const std::vector<glm::vec3>& positions,
                           std::span<std::vector<std::uint32_t>* const> indices) {
    std::uint64_t dropped = 0;
    for (std::vector<std::uint32_t>* list : indices) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i + 2 < list->size(); i += 3) {
            const std::uint32_t* const corners = list->data() + i;
            const bool placed = std::all_of(corners, corners + 3, [&](auto v) { return isFinite(positions[v]); });
            if (placed)
                kept = static_cast<std::size_t>(std::copy(corners, corners + 3, list->data() + kept) - list->data());
        }
        dropped += (list->size() - kept) / 3;
        list->resize(kept);
    }
    if (dropped > 0) ignoreDamaged(source, "triangles", "a vertex position is NaN or infinite", dropped);
    return dropped;
}

}  // namespace defocus::engine::gltf
