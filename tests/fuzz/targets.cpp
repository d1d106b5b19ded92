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

#include "capture/frame_files.h"
#include "capture/shot_json.h"
#include "core/error.h"
#include "core/hash.h"
#include "core/memory_limits.h"
#include "frame/settings/settings.h"
#include "frame/setup/prepared_frame.h"
#include "frame/setup/shared_scene.h"
#include "image/image_io.h"
#include "image/image_rows.h"
#include "image/metrics.h"
#include "lens/aperture.h"
#include "lod/pyramid/file.h"
#include "lod/shapes.h"
#include "plan/frame_plan.h"
#include "refocus/focal_stack.h"
#include "render/tiles/row_file.h"
#include "render/tiles/sum_file.h"
#include "scene/camera_files/usda_camera.h"
#include "scene/camera_files/usda_samples.h"
#include "scene/gltf/builder.h"
#include "scene/gltf/gltf.h"
#include "scene/ground.h"
#include "scratch_folder.h"

namespace defocus::engine {
namespace {

using Bytes = std::vector<std::byte>;

Bytes bytesOf(std::string_view text) {
    const auto* const first = reinterpret_cast<const std::byte*>(text.data());
    return {first, first + text.size()};
}

std::string_view textOf(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// Writes the bytes to a file, for readers that need a path. The file exists until the process ends.
std::filesystem::path written(const std::string& name, std::span<const std::byte> bytes) {
    static const ScratchFolder folder;
    const std::filesystem::path path = folder / name;
    std::ofstream(path, std::ios::binary) << textOf(bytes);
    return path;
}

Bytes fileBytes(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return bytesOf(std::string(std::istreambuf_iterator<char>(file), {}));
}

std::vector<Bytes> filesIn(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) paths.push_back(entry.path());
    std::ranges::sort(paths);
    std::vector<Bytes> files;
    for (const std::filesystem::path& path : paths) files.push_back(fileBytes(path));
    return files;
}

// ---- scenes

constexpr std::uint64_t maxPlannedTriangles = 5'000;
constexpr std::size_t maxPlannedNodes = 1'000;

void runGltf(std::span<const std::byte> bytes) {
    const bool binary = textOf(bytes).starts_with("glTF");
    try {
        const auto scene = std::make_shared<Scene>(loadGltf(written(binary ? "scene.glb" : "scene.gltf", bytes)));
        if (trianglesOf(scene->meshes) > maxPlannedTriangles || scene->nodes.size() > maxPlannedNodes) return;
        Request request;
        request.size.width = 64;
        request.size.height = 48;
        request.samples = 8;
        // Plans the scene without a ground, and again with a ground and shadows.
        SharedPyramids pyramids;
        for (const bool ground : {false, true}) {
            request.ground = ground;
            setGround(request, *scene);
            PreparedFrame frame = placeFrame(scene, request);
            while (pyramids.size() < scene->meshes.size())
                pyramids.push_back(buildPyramid(scene->meshes[pyramids.size()]));
            frame.world.pyramids = pyramids;
            static_cast<void>(planFrame(frame.world, frame.view, frame.settings));
        }
    } catch (const Error&) {  // the scene is rejected, which is correct
    }
}

// Returns a glTF file with lights, every material extension and a texture transform, all animated. The
// available models lack some of these features or are too large to fuzz.
std::string furnishedScene() {
    GltfBuilder file;
    // A grey PNG of 1 × 1 px.
    const std::vector<std::uint8_t> png = {
        0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00,
        0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x00, 0x00, 0x00, 0x00, 0x3a, 0x7e, 0x9b, 0x55, 0x00,
        0x00, 0x00, 0x0a, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0x68, 0x00, 0x00, 0x00, 0x82, 0x00, 0x81,
        0x77, 0xcd, 0x72, 0xb6, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
    file.add("images", {{"bufferView", file.view(png)}, {"mimeType", "image/png"}});
    file.add("textures", {{"source", 0}});
    const nlohmann::json texture = {
        {"index", 0},
        {"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0}}, {"rotation", 0.1}, {"scale", {2, 2}}}}}}};
    file.add("materials",
             {{"emissiveFactor", {1, 1, 1}},
              {"extensions",
               {{"KHR_materials_clearcoat",
                 {{"clearcoatFactor", 1}, {"clearcoatRoughnessFactor", 0.1}, {"clearcoatNormalTexture", texture}}},
                {"KHR_materials_sheen",
                 {{"sheenColorFactor", {1, 0.5, 0}}, {"sheenRoughnessFactor", 0.3}, {"sheenColorTexture", texture}}},
                {"KHR_materials_specular", {{"specularFactor", 0.5}, {"specularColorFactor", {1, 1, 2}}}},
                {"KHR_materials_ior", {{"ior", 1.8}}},
                {"KHR_materials_emissive_strength", {{"emissiveStrength", 5}}}}}});
    file.add("materials",
             {{"extensions",
               {{"KHR_materials_transmission", {{"transmissionFactor", 0.9}, {"transmissionTexture", texture}}},
                {"KHR_materials_volume",
                 {{"thicknessFactor", 0.2}, {"attenuationDistance", 0.5}, {"attenuationColor", {1, 0, 0}}}}}}});
    file.add("materials",
             {{"extensions",
               {{"KHR_materials_pbrSpecularGlossiness",
                 {{"diffuseFactor", {1, 1, 1, 1}}, {"specularFactor", {0, 0, 0}}, {"glossinessFactor", 0.7}}}}}});
    file.add("materials",
             {{"alphaMode", "BLEND"}, {"extensions", {{"KHR_materials_unlit", nlohmann::json::object()}}}});
    const int positions = file.positions(unitTriangle);
    const int coordinates = file.floats({0, 0, 1, 0, 0, 1}, "VEC2", 2);
    for (int material = 0; material < 4; ++material)
        file.mesh(nlohmann::json::array({{{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", coordinates}}},
                                          {"material", material}}}),
                  {{"translation", {0, 0, material}}});
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "directional"}, {"intensity", 3}},
        {{"type", "point"}, {"intensity", 10}, {"range", 5}},
        {{"type", "spot"}, {"color", {1, 0, 0}}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.5}}}}};
    for (int light = 0; light < 3; ++light)
        file.add("nodes",
                 {{"translation", {light, 2, 1}}, {"extensions", {{"KHR_lights_punctual", {{"light", light}}}}}});
    const int times = file.floats({0, 1}, "SCALAR", 1);
    const int values = file.floats({1, 20}, "SCALAR", 1);
    const auto pointer = [](const char* place) {
        return nlohmann::json{
            {"sampler", 0},
            {"target", {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", place}}}}}}}};
    };
    using Json = nlohmann::json;
    file.add("animations",
             {{"samplers", Json::array({{{"input", times}, {"output", values}}})},
              {"channels", Json::array({pointer("/extensions/KHR_lights_punctual/lights/1/intensity")})}});
    return file.glb();
}

std::vector<Bytes> gltfSeeds() {
    std::vector<Bytes> seeds = filesIn(std::filesystem::path(DEFOCUS_SOURCE_DIR) / "tests/data/models");
    // files with emissive materials, and with lens values in the extras of a camera
    for (const char* own : {"bokeh.gltf", "artefact-leaking.gltf"})
        seeds.push_back(fileBytes(std::filesystem::path(DEFOCUS_SOURCE_DIR) / "meshes" / own));
    seeds.push_back(bytesOf(furnishedScene()));
    return seeds;
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

// Corrects the key and the checksum, which would be wrong after any mutation, and reads the bytes as a cache file.
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
    header.minTriangles = key.options.minTriangles;
    header.maxLevels = key.options.maxLevels;
    header.vertices = static_cast<std::uint32_t>(key.options.vertices);
    std::memcpy(file.data(), &header, sizeof(header));
    header.checksum = hashBytes(std::span(file).subspan(offsetof(PyramidFileHeader, version)));
    std::memcpy(file.data(), &header, sizeof(header));

    const std::optional<Pyramid> pyramid = decodePyramid(file, cachedMesh(), key);
    if (!pyramid) return;
    // All indices of an accepted pyramid are within the range of their level, so the pyramid can be drawn safely.
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
constexpr std::size_t maxImagePixels = 1 << 14;

// Reads the file as a tile of a frame: first the tile's rows, then the complete frame if the tile is the frame's last
// one.
void runRows(const std::filesystem::path& path) {
    static_cast<void>(isRowFile(path));
    try {
        ImageRowReader reader(path);
        if (std::size_t(reader.width()) * std::size_t(reader.height()) > maxImagePixels) return;
        static_cast<void>(reader.read(0, reader.height()));
    } catch (const Error&) {
    }
    try {
        const std::vector<RowFile> tiles = completeRows({path});
        joinRows(tiles, {{path.parent_path() / "joined.exr", {}}, {path.parent_path() / "joined.png", {}}},
                 tiles.front().header.metadata);
    } catch (const Error&) {
    }
}

void runImage(std::span<const std::byte> bytes) {
    if (bytes.empty()) return;
    const auto format = std::to_integer<std::size_t>(bytes[0]) % imageNames.size();
    const std::filesystem::path path = written(imageNames[format], bytes.subspan(1));
    try {
        const Image image = readImage(path);
        if (image.pixels.size() <= maxImagePixels) static_cast<void>(compareImages(image, image));
        const Lens lens{.apertureImage = std::make_shared<const Image>(image)};
        static_cast<void>(makeAperture(lens));
    } catch (const Error&) {
    }
    try {
        static_cast<void>(readLayers(path));
    } catch (const Error&) {
    }
    try {
        static_cast<void>(readPart(path));
    } catch (const Error&) {
    }
    try {
        static_cast<void>(decodeTexture(bytes.subspan(1), "texture"));
    } catch (const Error&) {
    }
    runRows(path);
}

std::vector<Bytes> imageSeeds() {
    Image image(7, 5, 3);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<float>(i % 11) / 8;
    std::vector<Bytes> seeds;
    for (std::size_t format = 0; format < imageNames.size(); ++format) {
        if (std::string_view(imageNames[format]).ends_with("hdr")) continue;  // HDR files can be read but not written
        const std::filesystem::path path = written(std::string("seed-") + imageNames[format], {});
        writeImage(path, image);
        Bytes seed = fileBytes(path);
        seed.insert(seed.begin(), static_cast<std::byte>(format));
        seeds.push_back(std::move(seed));
    }
    // Add two tiles, one of which covers a complete frame, and a file with a part of a frame's samples.
    const auto add = [&](const std::filesystem::path& path) {
        Bytes seed = fileBytes(path);
        seed.insert(seed.begin(), std::byte{0});
        seeds.push_back(std::move(seed));
    };
    for (const int frameHeight : {image.height, image.height + 4}) {
        const std::filesystem::path path = written("seed-tile.exr", {});
        const Metadata metadata = {{settingsAttribute, std::string("settings")}, {"defocus:tile", std::string("rows")}};
        ImageRowWriter rows(path, image.width, image.height, image.channels, metadata, {}, {0, frameHeight});
        rows.write(image);
        rows.finish();
        add(path);
    }
    const FramePart part{{0, 64}, 64, "settings", 7, 5, {{64, Image(7, 5, 4), Image(7, 5, 4)}}, {}};
    const std::filesystem::path partFile = written("seed-part.exr", {});
    writePart(partFile, part);
    add(partFile);
    std::string hdr("\x02#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 2\n");
    for (int i = 0; i < 4; ++i) hdr += "\x40\x80\xc0\x81";
    seeds.push_back(bytesOf(hdr));
    return seeds;
}

// ---- lens images

// Refocuses the lens images (views from lens points) at the focus distance and at both ends of the focus range that the
// file states.
void runLensImages(std::span<const std::byte> bytes) {
    try {
        LightField field(written("lens.exr", bytes));
        const LightFieldInfo& info = field.info();
        if (std::size_t(info.size.fullWidth()) * std::size_t(info.size.fullHeight()) > maxImagePixels) return;
        static_cast<void>(centralDepth(field));
        static_cast<void>(allInFocus(field));
        for (const double focusDistance : {info.focusDistance, info.range.nearest, info.range.farthest})
            for (const double stops : {1.0, 2.0}) {
                const Refocusing refocusing{focusDistance, info.fStop * stops, {}};
                const Image picture = refocused(field, refocusing);
                if (picture.width != info.size.width || picture.height != info.size.height) std::abort();
                static_cast<void>(refocusedMetadata(info, refocusing));
                static_cast<void>(refocusedExposure(info, refocusing));
            }
    } catch (const Error&) {
    }
}

std::vector<Bytes> lensImageSeeds() {
    LightFieldInfo info;
    info.size = {6, 4, 3};
    info.focusDistance = 2;
    info.fStop = 1.4;
    info.pixelsPerDioptre = 2;
    info.range = {1.5, 3};
    std::vector<Bytes> seeds;
    for (const std::size_t images : {1u, 3u}) {
        info.points.clear();
        for (std::size_t i = 0; i < images; ++i) info.points.emplace_back(0.5 * double(i) - 0.5, 0.25);
        info.pixels.assign(images, {0.25, -0.5});
        const std::filesystem::path path = written("seed-lens.exr", {});
        ImagePartWriter writer(path, info.size, partMetadata(info));
        for (std::size_t i = 0; i < images; ++i) {
            Image colour(info.size.fullWidth(), info.size.fullHeight(), 4);
            for (std::size_t k = 0; k < colour.pixels.size(); ++k)
                colour.pixels[k] = static_cast<float>((k + i) % 7) / 4;
            Image depth(colour.width, colour.height, 1);
            std::ranges::fill(depth.pixels, static_cast<float>(1 + i));
            writer.write(colour, depth);
        }
        writer.finish();
        seeds.push_back(fileBytes(path));
    }
    return seeds;
}

// ---- settings

// Runs the parsers of options that are not in the table of settings.
void runParsers(std::string_view text) {
    const auto parse = [&](auto parser) {
        try {
            static_cast<void>(parser(text));
        } catch (const Error&) {
        }
    };
    parse(parseTileShare);
    parse(parseSampleRange);
    parse(parseFrameRange);
    parse(parseShotOverride);
    // An amount of memory that is printed, with three significant digits, and parsed again differs by at most 1 %.
    parse([](std::string_view amount) {
        const auto bytes = static_cast<double>(parseBytes(amount));
        if (std::abs(static_cast<double>(parseBytes(bytesText(parseBytes(amount)))) / bytes - 1) > 0.01) std::abort();
        return bytes;
    });
}

void runSettings(std::span<const std::byte> bytes) {
    Request request;
    std::string_view rest = textOf(bytes);
    while (!rest.empty()) {
        const std::string_view line = rest.substr(0, rest.find('\n'));
        rest.remove_prefix(std::min(rest.size(), line.size() + 1));
        const std::size_t equals = std::min(line.find('='), line.size());
        const std::string_view value = line.substr(std::min(equals + 1, line.size()));
        runParsers(value);
        try {
            setByName(request, line.substr(0, equals), std::string(value));
        } catch (const Error&) {
            continue;
        }
        // skips settings of methods other than the request's method
        if (settingNamed(line.substr(0, equals)) == nullptr) continue;
        // Every accepted value is printed in a form that parses to the same value.
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
        if (setting.min != setting.max) line += "1";
        seeds.push_back(bytesOf(line + "\n"));
    }
    for (const char* line : {"memory=1.5 GiB", "memory=2000kB", "tile=3/16", "samples=64:128", "range=0:24",
                             "set=/lens/fStop=1.4", "ground=true\nlightAngle=2\nlightRadius=0.1\nshadows=on"})
        seeds.push_back(bytesOf(std::string(line) + "\n"));
    return seeds;
}

// ---- USD cameras

void runUsda(std::span<const std::byte> bytes) {
    try {
        const CameraTrack track = usdCamera(parseUsda(textOf(bytes), "shot.usda"), "", "shot.usda");
        for (const double time : {-1.0, 0.0, 0.3, 1e9}) static_cast<void>(track.at(time));
    } catch (const Error&) {
    }
}

std::vector<Bytes> usdaSeeds() {
    std::vector<Bytes> seeds;
    for (const char* text : {usda_samples::plain, usda_samples::animated, usda_samples::everything})
        seeds.push_back(bytesOf(text));
    return seeds;
}

constexpr std::array targets = {
    FuzzTarget{"gltf", runGltf, gltfSeeds, 1 << 15},
    FuzzTarget{"shot", runShot, shotSeeds, 1 << 13},
    FuzzTarget{"cache", runCache, cacheSeeds, 1 << 16},
    FuzzTarget{"image", runImage, imageSeeds, 1 << 12},
    FuzzTarget{"lens", runLensImages, lensImageSeeds, 1 << 13},
    FuzzTarget{"usda", runUsda, usdaSeeds, 1 << 12},
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

}  // namespace defocus::engine
