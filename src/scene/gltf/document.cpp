// Sources: glTF 2.0 specification, URIs (3.6) and GLB (4); RFC 2397 (data URIs), RFC 3986 (percent-encoding), RFC 4648
// (base64).
#include "scene/gltf/document.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <span>
#include <string_view>
#include <utility>

#include "core/file.h"
#include "core/json_text.h"
#include "core/message.h"

namespace defocus::engine::gltf {

namespace {

constexpr std::uint32_t glbMagic = 0x46546C67;   // "glTF"
constexpr std::uint32_t jsonChunk = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t binChunk = 0x004E4942;   // "BIN"
constexpr std::size_t headerBytes = 12;
constexpr std::size_t chunkHeaderBytes = 8;

constexpr std::string_view spaces = " \t\r\n";

using Bytes = std::span<const std::byte>;

std::uint32_t littleEndian32(Bytes bytes, std::size_t offset) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value |= std::to_integer<std::uint32_t>(bytes[offset + i]) << (8 * i);
    return value;
}

bool endsWithIgnoringCase(const std::string& text, const std::string& ending) {
    return text.size() >= ending.size() &&
           std::equal(ending.rbegin(), ending.rend(), text.rbegin(),
                      [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
}

struct Container {
    Bytes json;
    std::optional<Bytes> binary;
};

// Splits a GLB file into its JSON and binary chunks. tinygltf's GLB reader is not used: it parses the JSON and reads
// external files before their sizes can be checked.
Container splitGlb(const Document& document, Bytes bytes) {
    if (bytes.size() < headerBytes) fault(document, "truncated: a .glb needs a header of {} bytes", headerBytes);
    if (littleEndian32(bytes, 0) != glbMagic) fault(document, "not a .glb file: its magic number is wrong");
    const std::uint32_t version = littleEndian32(bytes, 4);
    if (version != 2) fault(document, "GLB version {} is not supported (only 2)", version);
    const std::uint32_t length = littleEndian32(bytes, 8);
    if (length != bytes.size())
        fault(document, "length mismatch: the header says {} bytes, the file has {}{}", length, bytes.size(),
              bytes.size() < length ? " (truncated)" : "");
    if (length < headerBytes + chunkHeaderBytes) fault(document, "the length {} is too small for a GLB file", length);

    Container result;
    std::size_t offset = headerBytes;
    for (int chunk = 0; offset < bytes.size(); ++chunk) {
        if (bytes.size() - offset < chunkHeaderBytes)
            fault(document, "truncated: the header of chunk {} is incomplete", chunk);
        const std::uint32_t chunkLength = littleEndian32(bytes, offset);
        const std::uint32_t type = littleEndian32(bytes, offset + 4);
        offset += chunkHeaderBytes;
        if (chunkLength > bytes.size() - offset)
            fault(document, "truncated: chunk {} has {} of its {} bytes", chunk, bytes.size() - offset, chunkLength);
        const Bytes content = bytes.subspan(offset, chunkLength);
        if (chunk == 0 && type != jsonChunk) fault(document, "the first chunk is not JSON");
        if (chunk == 0) result.json = content;
        if (chunk == 1 && type == binChunk) result.binary = content;
        offset += chunkLength;
    }
    return result;
}

// Replaces control characters in all "name" properties, because names are printed to terminals.
void freeNames(nlohmann::json& json) {
    if (json.is_object())
        if (const auto found = json.find("name"); found != json.end() && found->is_string()) {
            auto name = printable(found->get_ref<const std::string&>());
            std::replace(name.begin(), name.end(), '\n', '?');
            *found = std::move(name);
        }
    if (json.is_structured())
        for (nlohmann::json& part : json) freeNames(part);
}

nlohmann::json parseJson(const Document& document, Bytes bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.starts_with("\xEF\xBB\xBF")) fault(document, "not valid glTF JSON: it starts with a byte order mark");
    if (jsonNesting(text) > deepestJson) fault(document, "JSON nested deeper than {} levels", deepestJson);
    try {
        nlohmann::json json = nlohmann::json::parse(text.begin(), text.end());
        if (!json.is_object()) fault(document, "not glTF: its JSON is not an object");
        freeNames(json);
        return json;
    } catch (const nlohmann::json::exception& exception) {
        const std::string message = exception.what();
        const std::size_t prefix = message.find("] ");
        fault(document, "not valid JSON: {}", prefix == std::string::npos ? message : message.substr(prefix + 2));
    }
}

void checkVersion(const Document& document) {
    const auto asset = document.json.find("asset");
    if (asset == document.json.end() || !asset->is_object() || !asset->contains("version") ||
        !(*asset)["version"].is_string())
        fault(document, "not glTF: it has no asset.version");
    const auto version = (*asset)["version"].get<std::string>();
    const auto minimum = asset->value("minVersion", nlohmann::json(version));
    const std::string needed = minimum.is_string() ? minimum.get<std::string>() : version;
    if (!version.starts_with("2.") || (needed != version && needed != "2.0"))
        fault(document, "glTF version {} is not supported (only 2.0)", needed != version ? needed : version);
}

// Decodes percent-encoding in a URI. tinygltf's decoder is not used because it turns + into a space.
std::string percentDecoded(std::string_view text) {
    if (text.find('%') == std::string_view::npos) return std::string(text);
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char* const digits = text.data() + i + 1;
        unsigned code = 0;
        const bool coded =
            text[i] == '%' && i + 2 < text.size() && std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2;
        result += coded ? static_cast<char>(code) : text[i];
        if (coded) i += 2;
    }
    return result;
}

// Decodes base64; skips line breaks and accepts missing padding. Returns nullopt for invalid characters. tinygltf's
// decoder does not report invalid characters, and it is ten times slower.
std::optional<std::vector<std::byte>> base64Decoded(std::string_view text) {
    static const std::array<int, 256> digits = [] {
        std::array<int, 256> table{};
        table.fill(-1);
        constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        for (std::size_t i = 0; i < alphabet.size(); ++i)
            table[static_cast<unsigned char>(alphabet[i])] = static_cast<int>(i);
        return table;
    }();
    text = text.substr(0, text.find_last_not_of("= \t\r\n") + 1);
    std::vector<std::byte> result;
    result.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        const int digit = digits[static_cast<unsigned char>(c)];
        if (digit < 0 && spaces.find(c) != std::string_view::npos) continue;
        if (digit < 0) return std::nullopt;
        bits = (bits << 6) | static_cast<std::uint32_t>(digit);
        count += 6;
        if (count >= 8) {
            count -= 8;
            result.push_back(static_cast<std::byte>((bits >> count) & 0xFF));
        }
    }
    return result;
}

std::vector<std::byte> readDataUri(const Document& document, const std::string& uri, const std::string& what) {
    const std::size_t comma = uri.find(',');
    if (comma == std::string::npos) fault(document, "{}: its data URI has no comma", what);
    const std::string data = percentDecoded(std::string_view(uri).substr(comma + 1));
    if (endsWithIgnoringCase(uri.substr(0, comma), ";base64")) {
        std::optional<std::vector<std::byte>> decoded = base64Decoded(data);
        if (!decoded) fault(document, "{}: its data URI is not valid base64", what);
        return std::move(*decoded);
    }
    const auto bytes = std::as_bytes(std::span(data));
    return {bytes.begin(), bytes.end()};
}

std::string slashed(std::string text) {
    std::replace(text.begin(), text.end(), '\\', '/');
    return text;
}

// Returns whether the URI has a scheme: two or more letters, digits, '+', '-' or '.' before the first colon. A single
// letter is a drive or part of a file name.
bool hasScheme(std::string_view uri) {
    const std::size_t colon = uri.find(':');
    return colon != std::string_view::npos && colon > 1 &&
           std::all_of(uri.begin(), uri.begin() + static_cast<std::ptrdiff_t>(colon),
                       [](unsigned char c) { return std::isalnum(c) != 0 || c == '+' || c == '-' || c == '.'; });
}

}  // namespace

std::size_t entryCount(const Document& document, std::string_view name) {
    const auto found = document.json.find(name);
    return found != document.json.end() && found->is_array() ? found->size() : 0;
}

std::string withoutFile(const Document& document, const std::string& message) {
    const std::string prefix = document.file + ": ";
    return message.starts_with(prefix) ? message.substr(prefix.size()) : message;
}

bool isDataUri(const std::string& uri) {
    const std::size_t begin = uri.find_first_not_of(spaces);
    return begin != std::string::npos && endsWithIgnoringCase(uri.substr(begin, 5), "data:");
}

std::optional<std::filesystem::path> uriFile(const Document& document, const std::string& uri,
                                             const std::string& what) {
    if (isDataUri(uri)) return std::nullopt;
    if (hasScheme(uri)) fault(document, "{}: '{}' is not a relative path; only local files are read", what, uri);

    // glTF requires percent-encoded URIs, so try the decoded path first. Some exporters write file names without
    // encoding.
    const std::filesystem::path decoded = percentDecoded(uri);
    const std::filesystem::path withSlashes = slashed(decoded.string());
    if (uri.empty() || uri.find('\0') != std::string::npos || decoded.is_absolute() || withSlashes.is_absolute())
        fault(document, "{}: '{}' is not a relative path", what, uri);
    std::error_code status;
    for (const std::filesystem::path& path : {decoded, std::filesystem::path(uri), withSlashes})
        if (std::filesystem::is_regular_file(document.folder / path, status)) return document.folder / path;
    fault(document, "{}: '{}' does not exist in the file's folder", what, uri);
}

std::vector<std::byte> readUri(const Document& document, const std::string& uri, const std::string& what) {
    const std::optional<std::filesystem::path> file = uriFile(document, uri, what);
    return file ? readFile(*file) : readDataUri(document, uri, what);
}

Document readDocument(const std::filesystem::path& path) {
    Document document;
    document.file = path.string();
    document.folder = path.parent_path();

    // A file is GLB if it has the magic number or the extension .glb. The extension alone suffices, so that error
    // messages about a damaged .glb file can mention the GLB header.
    const std::vector<std::byte> bytes = readFile(path);
    document.fileBytes = bytes.size();
    if (bytes.empty()) fault(document, "the file is empty, so it is not valid JSON");
    const bool glb =
        (bytes.size() >= 4 && littleEndian32(bytes, 0) == glbMagic) || endsWithIgnoringCase(document.file, ".glb");
    const Container container = glb ? splitGlb(document, bytes) : Container{bytes, std::nullopt};

    document.json = parseJson(document, container.json);
    if (container.binary) document.binaryChunk.emplace(container.binary->begin(), container.binary->end());
    checkVersion(document);
    return document;
}

}  // namespace defocus::engine::gltf
