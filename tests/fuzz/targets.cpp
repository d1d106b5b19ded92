#include "fuzz/targets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <numbers>
#include <string_view>
#include <utility>

#include "capture/shot_json.h"
#include "core/error.h"
#include "core/hash.h"
#include "frame/prepared_frame.h"
#include "frame/settings.h"
#include "image/image_io.h"
#include "image/metrics.h"
#include "image/scratch_folder.h"
#include "lens/aperture.h"
#include "lod/pyramid/file.h"
#include "lod/shapes.h"
#include "plan/frame_plan.h"
#include "scene/gltf/gltf.h"

namespace defocus {
namespace {

using Bytes = std::vector<std::byte>;

Bytes bytesOf(std::string_view text) {
    const auto* const first = reinterpret_cast<const std::byte*>(text.data());
    return {first, first + text.size()};
}

std::string_view textOf(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// A file for readers that take a path, in a folder that lives as long as the process.
std::filesystem::path written(const std::string& name, std::span<const std::byte> bytes) {
    static const ScratchFolder folder;
    const std::filesystem::path path = folder / name;
    std::ofstream(path, std::ios::binary) << textOf(bytes);
    return path;
}

std::vector<Bytes> filesIn(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) paths.push_back(entry.path());
    std::ranges::sort(paths);
    std::vector<Bytes> files;
    for (const std::filesystem::path& path : paths) {
        std::ifstream file(path, std::ios::binary);
        files.push_back(bytesOf(std::string(std::istreambuf_iterator<char>(file), {})));
    }
    return files;
}

// ---- scenes

constexpr std::uint64_t mostPlannedTriangles = 5'000;
constexpr std::size_t mostPlannedNodes = 1'000;

void runGltf(std::span<const std::byte> bytes) {
    const bool binary = textOf(bytes).starts_with("glTF");
    try {
        const auto scene = std::make_shared<Scene>(loadGltf(written(binary ? "scene.glb" : "scene.gltf", bytes)));
        if (trianglesOf(scene->meshes) > mostPlannedTriangles || scene->nodes.size() > mostPlannedNodes) return;
        Request request;
        request.width = 64;
        request.height = 48;
        request.settings.sampleCount = 8;
        PreparedFrame frame = placeFrame(scene, request);
        for (const Mesh& mesh : scene->meshes) frame.world.pyramids.push_back(buildPyramid(mesh));
        static_cast<void>(planFrame(frame.world, frame.view, frame.settings));
    } catch (const Error&) {  // refused
    }
}

std::vector<Bytes> gltfSeeds() {
    return filesIn(std::filesystem::path(DEFOCUS_SOURCE_DIR) / "tests/data/models");
}

// ---- shots

void runShot(std::span<const std::byte> bytes) {
    try {
        static_cast<void>(parseShot(textOf(bytes), "shot.json"));
    } catch (const Error&) {
    }
}

std::vector<Bytes> shotSeeds() {
    return filesIn(std::filesystem::path(DEFOCUS_SOURCE_DIR) / "shots");
}

// ---- caches

const Mesh& cachedMesh() {
    static const Mesh mesh = sphere(24, 16);
    return mesh;
}

// The bytes as a file whose key and checksum are right, since no mutation would ever find those.
void runCache(std::span<const std::byte> bytes) {
    const PyramidKey key = pyramidKey(cachedMesh(), {});
    Bytes file(bytes.begin(), bytes.end());
    if (file.size() < sizeof(PyramidFileHeader)) file.resize(sizeof(PyramidFileHeader));
    PyramidFileHeader header;
    std::memcpy(&header, file.data(), sizeof(header));
    const PyramidFileHeader expected;
    header.magic = expected.magic;
    header.version = expected.version;
    header.mesh = key.mesh;
    header.leastTriangles = key.options.leastTriangles;
    header.mostLevels = key.options.mostLevels;
    header.vertices = static_cast<std::uint32_t>(key.options.vertices);
    std::memcpy(file.data(), &header, sizeof(header));
    header.checksum = hashBytes(std::span(file).subspan(offsetof(PyramidFileHeader, version)));
    std::memcpy(file.data(), &header, sizeof(header));

    const std::optional<Pyramid> pyramid = decodePyramid(file, cachedMesh(), key);
    if (!pyramid) return;
    // Whatever was taken can be drawn: no index leads out of its level.
    for (const PyramidLevel& level : pyramid->levels)
        for (const IndexRange& range : level.primitives)
            for (std::uint32_t i = 0; i < range.count; ++i)
                if (pyramid->indices.at(range.first + i) >= level.vertexCount) std::abort();
}

std::vector<Bytes> cacheSeeds() {
    const PyramidKey key = pyramidKey(cachedMesh(), {});
    return {encodePyramid(buildPyramid(cachedMesh()), cachedMesh(), key)};
}

// ---- images

constexpr std::array<const char*, 4> imageNames = {"image.exr", "image.png", "image.hdr", "image.jpg"};
constexpr std::size_t mostImagePixels = 1 << 14;

void runImage(std::span<const std::byte> bytes) {
    if (bytes.empty()) return;
    const auto format = std::to_integer<std::size_t>(bytes[0]) % imageNames.size();
    const std::filesystem::path path = written(imageNames[format], bytes.subspan(1));
    try {
        const Image image = readImage(path);
        if (image.pixels.size() <= mostImagePixels) static_cast<void>(compareImages(image, image));
        Lens lens;
        lens.apertureImage = std::make_shared<const Image>(image);
        static_cast<void>(makeAperture(lens));
    } catch (const Error&) {
    }
    try {
        static_cast<void>(readLayers(path));
    } catch (const Error&) {
    }
    try {
        static_cast<void>(decodeTexture(bytes.subspan(1), "texture"));
    } catch (const Error&) {
    }
}

std::vector<Bytes> imageSeeds() {
    Image image(7, 5, 3);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<float>(i % 11) / 8;
    std::vector<Bytes> seeds;
    for (std::size_t format = 0; format < imageNames.size(); ++format) {
        if (std::string_view(imageNames[format]).ends_with("hdr")) continue;  // is read, never written
        const std::filesystem::path path = written(std::string("seed-") + imageNames[format], {});
        writeImage(path, image);
        std::ifstream file(path, std::ios::binary);
        Bytes seed = bytesOf(std::string(std::istreambuf_iterator<char>(file), {}));
        seed.insert(seed.begin(), static_cast<std::byte>(format));
        seeds.push_back(std::move(seed));
    }
    std::string hdr("\x02#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 2\n");
    for (int i = 0; i < 4; ++i) hdr += "\x40\x80\xc0\x81";
    seeds.push_back(bytesOf(hdr));
    return seeds;
}

// ---- settings

void runSettings(std::span<const std::byte> bytes) {
    Request request;
    std::string_view rest = textOf(bytes);
    while (!rest.empty()) {
        const std::string_view line = rest.substr(0, rest.find('\n'));
        rest.remove_prefix(std::min(rest.size(), line.size() + 1));
        const std::size_t equals = std::min(line.find('='), line.size());
        const std::string_view value = line.substr(std::min(equals + 1, line.size()));
        try {
            setByName(request, line.substr(0, equals), std::string(value));
        } catch (const Error&) {
            continue;
        }
        if (settingNamed(line.substr(0, equals)) == nullptr) continue;  // of a method, which may not be the request's
        // What was taken is written as it is read.
        for (const Setting& setting : settings()) {
            if (setting.repeated || setting.name == "method") continue;
            const std::optional<std::string> text = setting.text(request);
            if (!text) continue;
            Request again = request;
            setting.set(again, *text);
            if (setting.text(again) != text) std::abort();
        }
    }
}

std::vector<Bytes> settingsSeeds() {
    std::vector<Bytes> seeds;
    for (const Setting& setting : settings()) {
        std::string line = setting.name + "=";
        if (!setting.choices.empty()) line += setting.choices.front();
        if (setting.least != setting.most) line += "1";
        seeds.push_back(bytesOf(line + "\n"));
    }
    return seeds;
}

constexpr std::array targets = {
    FuzzTarget{"gltf", runGltf, gltfSeeds, 1 << 15},
    FuzzTarget{"shot", runShot, shotSeeds, 1 << 13},
    FuzzTarget{"cache", runCache, cacheSeeds, 1 << 16},
    FuzzTarget{"image", runImage, imageSeeds, 1 << 12},
    FuzzTarget{"settings", runSettings, settingsSeeds, 1 << 10},
};

}  // namespace

std::span<const FuzzTarget> fuzzTargets() {
    return targets;
}

const FuzzTarget& fuzzTargetNamed(const std::string& name) {
    const auto found = std::ranges::find(targets, name, &FuzzTarget::name);
    if (found == targets.end()) fail("no fuzz target is named '{}'", name);
    return *found;
}

}  // namespace defocus
