#include "frame/report/layer_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "frame/layer_names.h"
#include "frame/report/cryptomatte.h"

namespace defocus::engine {

namespace {

constexpr const char* viewLayer = "ViewLayer.";  // Blender's name of a scene's first view layer

std::string fullName(const LayerNames& row, ExrNames names) {
    return names == ExrNames::nuke ? row.nuke : viewLayer + std::string(row.blender);
}

NamedChannels named(const std::string& layer, std::span<const char* const> channels, Image image) {
    NamedChannels result;
    for (std::size_t i = 0; i < static_cast<std::size_t>(image.channels); ++i)
        result.names.push_back(layer.empty() ? channels[i] : layer + "." + channels[i]);
    result.image = std::move(image);
    return result;
}

// Returns the names of all objects or materials. The indices in NumberCounts::values refer to this list.
std::vector<std::string> namesIn(Layer layer, const Scene& scene, const Pose& pose) {
    std::vector<std::string> names;
    if (layer == Layer::objects) {
        for (const Object& object : pose.objects) names.push_back(object.name);
        for (std::size_t i = 0; i < names.size(); ++i)
            if (names[i].empty()) names[i] = fmt::format("object {}", i);
    } else {
        for (const Material& material : scene.materials) names.push_back(material.name);
        for (std::size_t i = 0; i < names.size(); ++i)
            if (names[i].empty()) names[i] = fmt::format("material {}", i);
        names.emplace_back("default");  // glTF's default material
    }
    return names;
}

}  // namespace

std::vector<NamedChannels> layerChannels(const ImageView& picture, const LayerImages& layers, const Scene& scene,
                                         const Pose& pose, ExrNames names, Metadata& metadata) {
    constexpr std::array colour = {"R", "G", "B", "A"};
    const bool nuke = names == ExrNames::nuke;
    Image copy(picture.width, picture.height, picture.channels);
    std::ranges::copy(picture.pixels, copy.pixels.begin());
    std::vector<NamedChannels> channels;
    channels.push_back(named(nuke ? "" : viewLayer + std::string("Combined"), colour, std::move(copy)));
    const auto add = [&](const std::string& layer, std::span<const char* const> letters, const Image& image) {
        channels.push_back(named(layer, letters, image));
    };
    constexpr std::array coverage = {"A"};
    constexpr std::array depth = {"Z"};
    add(nuke ? "coverage" : viewLayer + std::string("Coverage"), coverage, layers.coverage);
    if (!layers.nearestDepth.empty())
        add(nuke ? "depth_nearest" : viewLayer + std::string("DepthNearest"), depth, layers.nearestDepth);
    for (const auto& [layer, image] : layers.means)
        add(fullName(layerNames(layer), names), layerNames(layer).channels, image);
    for (const auto& [layer, counts] : layers.numbers) {
        const std::string name = fullName(layerNames(layer), names);
        Cryptomatte matte = cryptomatte(counts, layers.samples, namesIn(layer, scene, pose));
        for (std::size_t i = 0; i < matte.ranks.size(); ++i)
            channels.push_back(named(fmt::format("{}{:02}", name, i), colour, std::move(matte.ranks[i])));
        addCryptomatteMetadata(name, matte.manifest, metadata);
    }
    return channels;
}

void writePicture(const std::filesystem::path& path, const ImageView& picture, const LayerImages* layers,
                  const Scene& scene, const Pose& pose, ExrNames names, Metadata metadata,
                  const WriteOptions& options) {
    if (layers == nullptr || !isExr(path)) return writeImage(path, picture, metadata, options);
    const std::vector<NamedChannels> channels = layerChannels(picture, *layers, scene, pose, names, metadata);
    writeChannels(path, channels, metadata);
}

}  // namespace defocus::engine
