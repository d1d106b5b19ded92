#pragma once
// Writes a command's images to files or to standard output. "-" is a PNG image to standard output; "exr:-", "png:-" and
// "jpg:-" name the format.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "image/image_io.h"

namespace defocus::engine {

// Adds the option --output, which stores the paths of one or more images in `outputs`. --help shows out.exr as its
// default.
CLI::Option* addImageOutputs(CLI::App& command, std::vector<std::filesystem::path>& outputs);

bool isStandardOutput(const std::filesystem::path& output);

// Returns the file's name; "standard output" for "-".
std::string shownOutput(const std::filesystem::path& output);
// Returns the names of all outputs (see shownOutput), separated by commas.
std::string shownOutputs(const std::vector<std::filesystem::path>& outputs);

// Checks all outputs of a command. Throws Error if a format is unknown, a file cannot be written, an image would go to
// a terminal, an output would replace an input, or two outputs go to the same file or to standard output. `more`: other
// files that the command writes, such as figures. `inputs`: files that the command reads; empty and missing paths are
// ignored.
void checkImageOutputs(const std::vector<std::filesystem::path>& images, const std::vector<std::filesystem::path>& more,
                       const std::vector<std::filesystem::path>& inputs);

// Writes an image to a file, with writeImage, or to standard output.
void writeOutput(const std::filesystem::path& output, const Image& image, const Metadata& metadata,
                 const WriteOptions& options);

// Writes text to a file or to standard output.
void writeOutput(const std::filesystem::path& output, const std::string& text);

}  // namespace defocus::engine
