#pragma once
// Writes a web page in which a visitor can refocus an image. The page is one HTML file that needs no network: lens
// images (one image per lens sample) as WebP, and a WebGL 2 shader that moves and adds them (refocus.h).
//
// A radiance r is stored as log2(1 + k·r) / log2(1 + k·maximum) in 8 bits, so that lights far above white stay bright
// when they are blurred. Each image is rounded with a different dither offset, so that rounding errors cancel in the
// sum.

#include <cstddef>
#include <filesystem>
#include <string>

#include "core/progress.h"
#include "image/image_io.h"
#include "refocus/refocus.h"

namespace defocus::engine {

// Maximum number of images in a page. If there are more lens images, the page contains only the first of them, because
// every prefix of the lens points is spread evenly over the lens.
inline constexpr std::size_t maxPageImages = 64;
// Maximum size in bytes of a page at 1024 × 768 px. For other image sizes, the limit is proportional to the number of
// pixels. WebP's quality is lowered until the page fits.
inline constexpr std::size_t pageBytes = 12'000'000;

// Returns the page as HTML. `start`: focus and f-number that the page shows first; its aperture shape is ignored.
// `write`: tone curve and exposure. Throws Error if `start` is outside the rendered range, or if the file of lens
// images is damaged.
std::string refocusPage(LightField& field, const std::string& title, const Refocusing& start, const WriteOptions& write,
                        const Progress& progress = {});

}  // namespace defocus::engine
