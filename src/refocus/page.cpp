#include "refocus/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/base64.h"
#include "core/error.h"
#include "core/parallel.h"
#include "gl/shader_source.h"
#include "image/webp.h"
#include "refocus/page_text.h"

namespace defocus::engine {

namespace {

// k of the tone curve log2(1 + k·radiance); larger values keep more detail in shadows, less in highlights.
constexpr double curveFactor = 24;
constexpr double mostRadiance = 4096;
constexpr int depthColumns = 256;  // max columns of the depth image in which a click looks up the focus distance
constexpr int maxQuality = 90;
constexpr int minQuality = 20;

// Returns the dither offset that is added to all values of an image before they are rounded to 8 bits, from −1/2 to 1/2
// of a step. Multiples of the golden ratio spread the offsets of the images evenly.
double stepOffset(std::size_t image) {
    const double place = static_cast<double>(image) * 0.6180339887498949;
    return place - std::floor(place) - 0.5;
}

// Returns the largest radiance in the images, at least 1.
double largestRadiance(LightField& field, std::size_t count) {
    double largest = 1;
    for (std::size_t i = 0; i < count; ++i) {
        const std::shared_ptr<const HalfImage> image = field.colour(i);
        for (std::size_t p = 0; p < image->rgba.size(); p += 4)
            for (std::size_t c = 0; c < 3; ++c)
                largest = std::max(largest, static_cast<double>(fromHalf(image->rgba[p + c])));
    }
    return std::min(largest, mostRadiance);
}

std::vector<unsigned char> encodedRadiance(const HalfImage& image, double maximum, double offset) {
    std::vector<unsigned char> bytes(image.rgba.size() / 4 * 3);
    const double scale = 255 / std::log2(1 + curveFactor * maximum);
    const auto width = static_cast<std::size_t>(image.width);
    parallelFor(static_cast<std::size_t>(image.height), [&](std::size_t y) {
        for (std::size_t p = y * width; p < (y + 1) * width; ++p)
            for (std::size_t c = 0; c < 3; ++c) {
                const double radiance = std::clamp(static_cast<double>(fromHalf(image.rgba[4 * p + c])), 0.0, maximum);
                const double value = scale * std::log2(1 + curveFactor * radiance) + offset;
                bytes[3 * p + c] = static_cast<unsigned char>(std::clamp(std::lround(value), 0l, 255l));
            }
    });
    return bytes;
}

// Returns the images as WebP in base64, at the highest quality for which all images together fit into `limit` bytes.
std::vector<std::string> encodedImages(LightField& field, std::size_t count, double maximum, std::size_t limit,
                                       const Progress& progress) {
    const PartSize& size = field.info().size;
    std::vector<std::vector<unsigned char>> pixels;
    for (std::size_t i = 0; i < count; ++i) {
        pixels.push_back(encodedRadiance(*field.colour(i), maximum, stepOffset(i)));
        report(progress, "lens images", i + 1, 2 * count);
    }
    // To find the quality quickly, encode only the first four images until they fit into their share of `limit`. Then
    // encode all images, at a lower quality if they are still too large.
    std::vector<std::string> images(count);
    for (int quality = maxQuality;; quality -= 10) {
        const std::size_t tried = quality > minQuality ? std::min<std::size_t>(count, 4) : count;
        const auto encodeFrom = [&](std::size_t first, std::size_t end) {
            parallelFor(end - first, [&](std::size_t i) {
                const std::vector<unsigned char> encoded =
                    encodeWebp(size.fullWidth(), size.fullHeight(), pixels[first + i], quality);
                images[first + i] = base64(std::as_bytes(std::span(encoded)));
            });
            std::size_t bytes = 0;
            for (std::size_t i = 0; i < end; ++i) bytes += images[i].size() + 3;
            return bytes;
        };
        if (quality > minQuality && encodeFrom(0, tried) > limit * tried / count) continue;
        if (encodeFrom(0, count) <= limit || quality <= minQuality) break;
    }
    report(progress, "lens images", 2 * count, 2 * count);
    return images;
}

// Returns the inverse depth map (1/depth) seen from the lens's centre, at a lower resolution. Values are 16-bit
// fractions of the largest 1/depth.
nlohmann::json depthsOf(LightField& field) {
    const PartSize& size = field.info().size;
    const Image depth = field.depth(field.central());
    const int step = (size.width + depthColumns - 1) / depthColumns;
    const int columns = (size.width + step - 1) / step;
    const int rows = (size.height + step - 1) / step;
    std::vector<double> dioptres;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const int x = std::min(column * step + step / 2, size.width - 1);
            const int y = std::min(row * step + step / 2, size.height - 1);
            dioptres.push_back(1 / static_cast<double>(*depth.at(x + size.margin, y + size.margin)));
        }
    const double largest = std::max(*std::ranges::max_element(dioptres), 1e-12);
    std::vector<unsigned char> bytes;
    for (const double value : dioptres) {
        const long share = std::lround(65535 * value / largest);
        bytes.push_back(static_cast<unsigned char>(share & 255));
        bytes.push_back(static_cast<unsigned char>(share >> 8));
    }
    return {{"width", columns},
            {"height", rows},
            {"step", step},
            {"maximum", largest},
            {"data", base64(std::as_bytes(std::span(bytes)))}};
}

void replace(std::string& text, std::string_view what, std::string_view with) {
    const std::size_t at = text.find(what);
    text.replace(at, what.size(), with);
}

std::string escapedHtml(const std::string& text) {
    std::string escaped;
    for (const char letter : text) {
        if (letter == '<')
            escaped += "&lt;";
        else if (letter == '&')
            escaped += "&amp;";
        else
            escaped += letter;
    }
    return escaped;
}

}  // namespace

std::string refocusPage(LightField& field, const std::string& title, const Refocusing& start, const WriteOptions& write,
                        const Progress& progress) {
    const LightFieldInfo& info = field.info();
    static_cast<void>(shiftedImages(info, {start.focusDistance, start.fStop, {}}, field.name()));  // validates `start`
    const std::size_t count = std::min(info.points.size(), maxPageImages);
    const double maximum = largestRadiance(field, count);
    const double share = double(info.size.width) * info.size.height / (1024.0 * 768);
    constexpr double otherBytes = 300'000;  // bytes of the page without its images
    const auto limit = static_cast<std::size_t>(std::max(pageBytes * std::max(share, 0.1) - otherBytes, 0.0));
    nlohmann::json data = {{"width", info.size.width},
                           {"height", info.size.height},
                           {"margin", info.size.margin},
                           {"focus", info.focusDistance},
                           {"start", {{"focus", start.focusDistance}, {"fStop", start.fStop}}},
                           {"fStop", info.fStop},
                           {"near", 1 / info.range.nearest},
                           {"far", 1 / info.range.farthest},
                           {"pixelsPerDioptre", info.pixelsPerDioptre},
                           {"shaped", !info.disk},
                           {"toneMap", static_cast<int>(write.toneMap)},
                           {"exposure", write.exposure},
                           {"curve", {{"k", curveFactor}, {"maximum", maximum}}},
                           {"depth", depthsOf(field)},
                           {"images", encodedImages(field, count, maximum, limit, progress)}};
    for (std::size_t i = 0; i < count; ++i) {
        data["points"].push_back({info.points[i].x, info.points[i].y});
        data["pixels"].push_back({info.pixels[i].x, info.pixels[i].y});
        data["offsets"].push_back(stepOffset(i) / 255);
    }
    std::string page(refocusPageText);
    replace(page, "@PAGE_TITLE@", escapedHtml(title));
    replace(page, "@PAGE_TONE_MAP@", embeddedShaders().at("include/tone_map.glsl"));
    replace(page, "@PAGE_DATA@", data.dump());
    return page;
}

}  // namespace defocus::engine
