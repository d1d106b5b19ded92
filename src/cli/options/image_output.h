#pragma once
// Where images go that a command writes: a file, or standard output. "-" is a PNG image to standard output; "exr:-",
// "png:-" and "jpg:-" say the format.

#include <filesystem>
#include <string>
#include <vector>

#include "image/image_io.h"

namespace defocus::engine {

// What --help says of it, after the formats.
inline constexpr const char* standardOutputHelp = "- is standard output, as PNG or as in exr:- and jpg:-";

bool isStandardOutput(const std::filesystem::path& output);

// "a.exr", "standard output"
std::string shownOutput(const std::filesystem::path& output);

// Throws Error for a format that there isn't, for what can't be written, for an image to a terminal, for two outputs to
// standard output or to one file, and for one that would replace an input. `more`: others that are written beside them,
// such as figures. `inputs`: what is read; empty ones, and those that aren't there, don't count.
void checkImageOutputs(const std::vector<std::filesystem::path>& images, const std::vector<std::filesystem::path>& more,
                       const std::vector<std::filesystem::path>& inputs);

// writeImage of a file, or of standard output.
void writeOutput(const std::filesystem::path& output, const Image& image, const Metadata& metadata,
                 const WriteOptions& options);

// The same for text.
void writeOutput(const std::filesystem::path& output, const std::string& text);

}  // namespace defocus::engine
