#pragma once
// Lists OpenImageIO's names of EXR's standard attributes, and shortens OpenImageIO's error messages to one line.

#include <array>
#include <string>
#include <string_view>
#include <utility>

namespace defocus::engine {

// Pairs of an EXR attribute name and the name that OpenImageIO uses for it.
inline constexpr std::array<std::pair<std::string_view, std::string_view>, 8> oiioNames = {{
    {"aperture", "FNumber"},
    {"expTime", "ExposureTime"},
    {"comments", "ImageDescription"},
    {"owner", "Copyright"},
    {"capDate", "DateTime"},
    {"worldToCamera", "worldtocamera"},
    {"timeCode", "smpte:TimeCode"},
    {"pixelAspectRatio", "PixelAspectRatio"},
}};

inline std::string oiioNameOf(std::string_view exrName) {
    for (const auto& [exr, oiio] : oiioNames)
        if (exr == exrName) return std::string(oiio);
    return std::string(exrName);
}

inline std::string exrNameOf(std::string_view oiioName) {
    for (const auto& [exr, oiio] : oiioNames)
        if (oiio == oiioName) return std::string(exr);
    return std::string(oiioName);
}

// Returns the first line of a library's error message. The first line states the cause; further lines only rephrase it.
inline std::string firstLine(const std::string& message) {
    const std::string line = message.substr(0, message.find('\n'));
    return line.empty() ? "no reason given" : line;
}

}  // namespace defocus::engine
