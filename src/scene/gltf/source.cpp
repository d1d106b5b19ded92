#include "scene/gltf/source.h"

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <string_view>

#include "scene/gltf/accessor.h"
#include "scene/gltf/meshopt.h"
#include "scene/gltf/schema.h"
#include "scene/gltf/structure.h"
#include "scene/gltf/variants.h"

namespace defocus::engine::gltf {

namespace {

constexpr std::array<std::string_view, 24> supportedExtensions = {
    "EXT_camera_physical",
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "EXT_texture_webp",
    "KHR_animation_pointer",
    "KHR_draco_mesh_compression",
    "KHR_lights_punctual",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_diffuse_transmission",
    "KHR_materials_dispersion",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_iridescence",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_variants",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_node_visibility",
    "KHR_texture_transform",
};

// Extensions that do not change the image, because they only store metadata about the file.
constexpr std::array<std::string_view, 2> metadataExtensions = {"KHR_xmp", "KHR_xmp_json_ld"};

// An extension that is not supported, and how files with this extension are drawn.
struct Fallback {
    std::string_view extension;
    std::string_view look;
};
constexpr std::array<Fallback, 2> fallbacks = {{
    {"KHR_texture_basisu", "not supported; the texture's fallback image is used if there is one"},
    {"MSFT_texture_dds", "not supported; the texture's fallback image is used if there is one"},
}};

const Fallback* fallbackOf(std::string_view extension) {
    const auto* found = std::ranges::find(fallbacks, extension, &Fallback::extension);
    return found != fallbacks.end() ? found : nullptr;
}

std::vector<std::string> stringsOf(const nlohmann::json& json, const char* name) {
    const auto found = json.find(name);
    return found != json.end() ? found->get<std::vector<std::string>>() : std::vector<std::string>();
}

void checkExtensions(Source& source) {
    const auto supported = [](const std::string& name) {
        return std::ranges::find(supportedExtensions, name) != supportedExtensions.end() ||
               std::ranges::find(metadataExtensions, name) != metadataExtensions.end();
    };
    for (const std::string& name : stringsOf(source.document.json, "extensionsRequired")) {
        if (!supported(name))
            fault(source.document, "the file requires the extension {}, which is not supported", name);
    }
    const std::vector<std::string> used = stringsOf(source.document.json, "extensionsUsed");
    for (const std::string& name : std::set<std::string>(used.begin(), used.end())) {
        if (supported(name)) continue;
        const Fallback* fallback = fallbackOf(name);
        ignore(source, "extension " + name, std::string(fallback != nullptr ? fallback->look : "not supported"));
    }
}

// Textures without an image of a core format (PNG or JPEG) get the image of EXT_texture_webp.
void useWebpImages(Source& source) {
    for (std::size_t i = 0; i < source.model.textures.size(); ++i) {
        int& image = source.model.textures[i].source;
        const nlohmann::json* webp = findExtension(source.document.json["textures"][i], "EXT_texture_webp");
        if (image < 0 && webp != nullptr) image = webp->value("source", -1);
    }
}

void readBuffers(Source& source, const Progress& progress) {
    const std::size_t count = entryCount(source.document, "buffers");
    for (std::size_t i = 0; i < count; ++i) {
        report(progress, "reading buffers", i, count);
        const nlohmann::json& buffer = source.document.json["buffers"][i];
        const std::string what = fmt::format("buffer {}", i);
        const auto length = buffer["byteLength"].get<std::uint64_t>();
        std::optional<std::vector<std::byte>> bytes;
        if (buffer.contains("uri")) {
            const auto uri = buffer["uri"].get<std::string>();
            grantFile(source, uri, what);
            bytes = readUri(source.document, uri, what);
        } else if (i == 0 && source.document.binaryChunk) {
            bytes = std::move(source.document.binaryChunk);
        }
        if (bytes && bytes->size() < length)
            fault(source.document, "{}: byteLength is {}, but the data has {} bytes", what, length, bytes->size());
        if (bytes) bytes->resize(length);
        source.buffers.push_back(std::move(bytes));
    }
}

// Throws Error if a buffer view exceeds its buffer. glTF allows buffers without data; viewBytes throws Error if such a
// buffer is read.
void checkViews(const Source& source) {
    for (std::size_t i = 0; i < source.model.bufferViews.size(); ++i)
        if (!source.unpackedViews[i] && source.buffers[static_cast<std::size_t>(source.model.bufferViews[i].buffer)])
            (void)viewBytes(source, static_cast<int>(i));
}

}  // namespace

void UnpackBudget::grant(std::uint64_t fileBytes) {
    fileBytes_ += fileBytes;
    limit_ += perFileByte * fileBytes;
}

bool UnpackBudget::take(std::uint64_t count, std::uint64_t elementBytes) {
    if (elementBytes != 0 && count > (limit_ - taken_) / elementBytes) return false;
    taken_ += count * elementBytes;
    return true;
}

Source openSource(const std::filesystem::path& path, const std::string& variant, const Progress& progress) {
    Source source;

    // 1. Read the container and validate its JSON.
    source.document = readDocument(path);
    source.budget.grant(source.document.fileBytes);
    checkSchema(source.document);
    checkExtensions(source);
    if (!variant.empty()) chooseVariant(source.document, variant);

    // 2. Convert the JSON to tinygltf structures.
    source.model = readStructure(source.document);
    useWebpImages(source);

    // 3. Read the buffers and decompress buffer views.
    readBuffers(source, progress);
    unpackMeshoptViews(source);
    checkViews(source);

    // 4. Check that accessors lie inside their buffer views.
    checkAccessors(source);
    return source;
}

std::span<const std::byte> viewBytes(const Source& source, int view) {
    const auto index = static_cast<std::size_t>(view);
    if (source.unpackedViews[index]) return *source.unpackedViews[index];
    const tinygltf::BufferView& bufferView = source.model.bufferViews[index];
    const auto& buffer = source.buffers[static_cast<std::size_t>(bufferView.buffer)];
    if (!buffer) fault(source.document, "buffer view {}: buffer {} has no data", view, bufferView.buffer);
    if (bufferView.byteOffset > buffer->size() || bufferView.byteLength > buffer->size() - bufferView.byteOffset)
        fault(source.document,
              "buffer view {}: {} bytes from byte {} extend past the end of buffer {}, which has {} bytes", view,
              bufferView.byteLength, bufferView.byteOffset, bufferView.buffer, buffer->size());
    return std::span(*buffer).subspan(bufferView.byteOffset, bufferView.byteLength);
}

void takeBudget(Source& source, std::uint64_t count, std::uint64_t elementBytes, const std::string& what) {
    if (!source.budget.take(count, elementBytes))
        fault(source.document,
              "{}: {} elements would expand a file of {} bytes to {:.3g} MiB; for a file of this size, at most {:.3g} "
              "MiB are read",
              what, count, source.budget.fileBytes(),
              (double(source.budget.taken()) + double(count) * double(elementBytes)) / 0x1p20,
              double(source.budget.limit()) / 0x1p20);
}

void grantFile(Source& source, const std::string& uri, const std::string& what) {
    const std::optional<std::filesystem::path> file = uriFile(source.document, uri, what);
    if (!file) return;
    const std::string name = file->lexically_relative(source.document.folder).string();
    if (uri.find('\\') != std::string::npos && name.find('\\') == std::string::npos)
        ignore(source, "backslash in a URI", fmt::format("{}: read as '{}'", what, name));
    std::error_code status;
    if (!source.files.insert(std::filesystem::canonical(*file, status)).second) return;
    const std::uintmax_t bytes = std::filesystem::file_size(*file, status);
    if (!status) source.budget.grant(bytes);
}

void ignore(Source& source, const std::string& what, const std::string& reason, std::uint64_t count) {
    const auto [place, added] = source.ignoredPlaces.try_emplace({what, reason}, source.ignored.size());
    if (added)
        source.ignored.push_back({what, reason, count});
    else
        source.ignored[place->second].count += count;
}

void ignoreDamaged(Source& source, const std::string& what, const std::string& reason, std::uint64_t count) {
    ignore(source, what, reason, count);
    source.ignored[source.ignoredPlaces.at({what, reason})].damage = true;
}

const nlohmann::json* findExtension(const nlohmann::json& object, const char* name) {
    const auto extensions = object.find("extensions");
    if (extensions == object.end() || !extensions->is_object()) return nullptr;
    const auto found = extensions->find(name);
    return found != extensions->end() ? &*found : nullptr;
}

const nlohmann::json* extrasOf(const nlohmann::json& object) {
    const auto extras = object.find("extras");
    return extras != object.end() && extras->is_object() ? &*extras : nullptr;
}

std::string labelOf(const char* kind, std::size_t index, const std::string& name) {
    return name.empty() ? fmt::format("{} {}", kind, index) : fmt::format("{} {} '{}'", kind, index, name);
}

float toFloat(double value) {
    constexpr double largest = std::numeric_limits<float>::max();
    return static_cast<float>(std::clamp(value, -largest, largest));
}

}  // namespace defocus::engine::gltf
