// Decodes EXT_meshopt_compression (glTF vendor extension) with the meshoptimizer library.
#include "scene/gltf/meshopt.h"

#include <meshoptimizer.h>

namespace defocus::engine::gltf {

namespace {

struct CompressedView {
    std::span<const std::byte> bytes;
    std::uint64_t count = 0;
    std::uint64_t stride = 0;
    std::string mode;
    std::string filter;
    std::string what;
};

CompressedView compressedView(const Source& source, std::size_t index, const nlohmann::json& json) {
    CompressedView view;
    view.what = fmt::format("buffer view {}: EXT_meshopt_compression", index);
    view.count = json["count"].get<std::uint64_t>();
    view.stride = json["byteStride"].get<std::uint64_t>();
    view.mode = json["mode"].get<std::string>();
    view.filter = json.value("filter", std::string("NONE"));

    const auto bufferIndex = json["buffer"].get<std::size_t>();
    const auto& buffer = source.buffers[bufferIndex];
    const auto offset = json.value("byteOffset", std::uint64_t{0});
    const auto length = json["byteLength"].get<std::uint64_t>();
    if (!buffer) fault(source.document, "{}: buffer {} has no data", view.what, bufferIndex);
    if (offset > buffer->size() || length > buffer->size() - offset)
        fault(source.document, "{}: {} bytes from byte {} extend past the end of buffer {}", view.what, length, offset,
              bufferIndex);
    view.bytes = std::span(*buffer).subspan(offset, length);
    return view;
}

// Throws Error if the mode, stride, filter or count of a compressed view violates the extension; meshoptimizer does not
// check them.
void checkLimits(const Source& source, const CompressedView& view) {
    const bool attributes = view.mode == "ATTRIBUTES";
    if (!attributes && view.mode != "TRIANGLES" && view.mode != "INDICES")
        fault(source.document, "{}: unknown mode '{}'", view.what, view.mode);
    const bool strideFits = attributes ? view.stride % 4 == 0 && view.stride > 0 && view.stride <= 256
                                       : view.stride == 2 || view.stride == 4;
    if (!strideFits)
        fault(source.document, "{}: {} data cannot have a stride of {}", view.what, view.mode, view.stride);
    if (view.mode == "TRIANGLES" && view.count % 3 != 0)
        fault(source.document, "{}: the number of indices, {}, is not a multiple of 3", view.what, view.count);
    const bool filterFits =
        view.filter == "NONE" ||
        (attributes && ((view.filter == "OCTAHEDRAL" && (view.stride == 4 || view.stride == 8)) ||
                        (view.filter == "QUATERNION" && view.stride == 8) || view.filter == "EXPONENTIAL"));
    if (!filterFits)
        fault(source.document, "{}: filter '{}' cannot be used with {} data of stride {}", view.what, view.filter,
              view.mode, view.stride);
}

std::vector<std::byte> unpack(Source& source, const CompressedView& view) {
    takeBudget(source, view.count, view.stride, view.what);
    std::vector<std::byte> result(view.count * view.stride);
    const auto* packed = reinterpret_cast<const unsigned char*>(view.bytes.data());
    int status = 0;
    if (view.mode == "ATTRIBUTES")
        status = meshopt_decodeVertexBuffer(result.data(), view.count, view.stride, packed, view.bytes.size());
    else if (view.mode == "TRIANGLES")
        status = meshopt_decodeIndexBuffer(result.data(), view.count, view.stride, packed, view.bytes.size());
    else
        status = meshopt_decodeIndexSequence(result.data(), view.count, view.stride, packed, view.bytes.size());
    if (status != 0) fault(source.document, "{}: the data is damaged", view.what);

    if (view.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(result.data(), view.count, view.stride);
    if (view.filter == "QUATERNION") meshopt_decodeFilterQuat(result.data(), view.count, view.stride);
    if (view.filter == "EXPONENTIAL") meshopt_decodeFilterExp(result.data(), view.count, view.stride);
    return result;
}

}  // namespace

void unpackMeshoptViews(Source& source) {
    source.unpackedViews.resize(source.model.bufferViews.size());
    for (std::size_t i = 0; i < source.unpackedViews.size(); ++i) {
        const nlohmann::json* json = findExtension(source.document.json["bufferViews"][i], "EXT_meshopt_compression");
        if (json == nullptr) continue;
        const CompressedView view = compressedView(source, i, *json);
        checkLimits(source, view);
        std::vector<std::byte> bytes = unpack(source, view);
        if (bytes.size() < source.model.bufferViews[i].byteLength)
            fault(source.document, "{}: the decoded data has {} bytes, but byteLength is {}", view.what, bytes.size(),
                  source.model.bufferViews[i].byteLength);
        source.unpackedViews[i] = std::move(bytes);
    }
}

}  // namespace defocus::engine::gltf
