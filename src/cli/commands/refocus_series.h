#pragma once
// Writes series of pictures from one file of lens images (one image per lens sample): the video of a focus pull, or a
// focal stack.

#include <filesystem>
#include <functional>
#include <string>

#include "cli/command.h"
#include "image/image_io.h"
#include "refocus/refocus.h"

namespace defocus::engine {

struct FocusPullFilm {
    double from = 1;  // m
    double to = 1;    // m
    int frames = 96;
    double frameRate = 24;        // frames per second
    std::filesystem::path video;  // output file
};

// Parses "A:B", two distances in m. Throws Error for other text.
void parseFocusPull(const std::string& text, FocusPullFilm& pull);

// Writes a video in which the focus moves from one distance to another, evenly in 1/distance. `refocusing` gives the
// aperture.
void writeFocusPull(LightField& field, const Refocusing& refocusing, const FocusPullFilm& pull,
                    const WriteOptions& write, const GlobalOptions& global);

// Returns the file of picture `name` of a stack: out.exr and "02" give out.02.exr.
std::filesystem::path stackPath(const std::filesystem::path& output, const std::string& name);

// Writes `pictures` pictures as out.00.exr, out.01.exr …; their focus distances are spaced evenly in 1/distance over
// the rendered range, the nearest first. Also writes out.sharp.exr with everything in focus, and out.depth.exr with
// depths in m. The pictures have the file type of `output`; the depths are always EXR.
void writeFocalStack(LightField& field, const Refocusing& refocusing, int pictures, const std::filesystem::path& output,
                     const WriteOptions& write, const GlobalOptions& global);

}  // namespace defocus::engine
