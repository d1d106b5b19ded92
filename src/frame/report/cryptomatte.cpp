#include "frame/report/cryptomatte.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/hash.h"
#include "core/parallel.h"

namespace defocus::engine {

namespace {

constexpr std::size_t ranksPerPixel = 6;  // customary number of (id, coverage) pairs; an RGBA image holds two pairs

// Returns the hashed names (ids) of a pixel and their sample counts, sorted by count, then by id. Equal ids are merged.
void ranksOf(const std::uint32_t* entries, int count, const std::vector<float>& ids,
             std::vector<std::pair<std::uint32_t, float>>& ranks) {
    ranks.clear();
    for (int i = 0; i < count && entries[i] != 0; ++i) {
        const std::uint32_t number = entries[i] >> 16;
        const std::uint32_t samples = entries[i] & 0xffffu;
        if (number == 0 || number > ids.size()) continue;
        const float id = ids[number - 1];
        const auto same = std::ranges::find(ranks, id, &std::pair<std::uint32_t, float>::second);
        if (same != ranks.end())
            same->first += samples;
        else
            ranks.emplace_back(samples, id);
    }
    std::ranges::sort(ranks, [](const auto& a, const auto& b) {
        return a.first != b.first ? a.first > b.first
                                  : std::bit_cast<std::uint32_t>(a.second) < std::bit_cast<std::uint32_t>(b.second);
    });
}

std::string hexadecimal(std::uint32_t bits) {
    return fmt::format("{:08x}", bits);
}

}  // namespace

float cryptomatteId(std::string_view name) {
    std::uint32_t bits = murmurHash3(name);
    const std::uint32_t exponent = bits >> 23 & 255;
    if (exponent == 0 || exponent == 255) bits ^= 1u << 23;
    return std::bit_cast<float>(bits);
}

Cryptomatte cryptomatte(const NumberCounts& counts, const Image& samples, const std::vector<std::string>& names) {
    Cryptomatte result;
    std::vector<float> ids;
    nlohmann::ordered_json manifest = nlohmann::ordered_json::object();
    for (const std::string& name : names) {
        ids.push_back(cryptomatteId(name));
        manifest[name] = hexadecimal(std::bit_cast<std::uint32_t>(ids.back()));
    }
    result.manifest = manifest.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    for (std::size_t i = 0; i < ranksPerPixel / 2; ++i) result.ranks.emplace_back(counts.width, counts.height, 4);
    const auto width = static_cast<std::size_t>(counts.width);
    parallelFor(static_cast<std::size_t>(counts.height), [&](std::size_t y) {
        std::vector<std::pair<std::uint32_t, float>> ranks;
        for (std::size_t pixel = y * width; pixel < (y + 1) * width; ++pixel) {
            ranksOf(&counts.values[pixel * static_cast<std::size_t>(counts.entries)], counts.entries, ids, ranks);
            const float all = std::max(samples.pixels[pixel], 1.0f);
            for (std::size_t r = 0; r < std::min(ranks.size(), ranksPerPixel); ++r) {
                float* value = &result.ranks[r / 2].pixels[4 * pixel + 2 * (r % 2)];
                value[0] = ranks[r].second;
                value[1] = static_cast<float>(ranks[r].first) / all;
            }
        }
    });
    return result;
}

void addCryptomatteMetadata(const std::string& layer, const std::string& manifest, Metadata& metadata) {
    const std::string key = "cryptomatte/" + hexadecimal(murmurHash3(layer)).substr(0, 7) + "/";
    metadata[key + "name"] = layer;
    metadata[key + "hash"] = std::string("MurmurHash3_32");
    metadata[key + "conversion"] = std::string("uint32_to_float32");
    metadata[key + "manifest"] = manifest;
}

}  // namespace defocus::engine
